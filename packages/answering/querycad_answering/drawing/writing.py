"""A table as text, CSV or Markdown; lengths in the unit asked for, which the head of each column names."""

from __future__ import annotations

import csv
import io
import math

from querycad_contracts import Column, LengthUnit, Quantity, Table, TableFormat
from querycad_contracts.drawings import Cell

from .numbers import length, number, significant

_POWERS = {Quantity.LENGTH: 1, Quantity.AREA: 2, Quantity.VOLUME: 3}
_RAISED = {1: "", 2: "²", 3: "³"}


def written(table: Table, how: TableFormat, unit: LengthUnit = LengthUnit.MM) -> str:
    """The table in that form, a line end at its end. JSON is the contract's own, SI whatever `unit` is."""
    if how is TableFormat.JSON:
        return table.model_dump_json() + "\n"
    columns = [index for index, column in enumerate(table.columns) if how is TableFormat.CSV or _is_used(table, index)]
    head = [_head(table.columns[index], unit) for index in columns]
    body = [[_cell(row[index], table.columns[index], unit) for index in columns] for row in table.rows]
    if how is TableFormat.CSV:
        out = io.StringIO()
        csv.writer(out, lineterminator="\n").writerows([head, *body])
        return out.getvalue()
    right = [table.columns[index].quantity is not Quantity.TEXT for index in columns]
    if how is TableFormat.MARKDOWN:
        rule = ["---:" if number else "---" for number in right]
        rows = ([cell.replace("|", "\\|") for cell in row] for row in (head, rule, *body))
        return "".join("| " + " | ".join(row) + " |\n" for row in rows)
    widths = [max(len(row[i]) for row in (head, *body)) for i in range(len(columns))]
    lines = (
        "  ".join(
            cell.rjust(width) if number else cell.ljust(width)
            for cell, width, number in zip(row, widths, right, strict=True)
        ).rstrip()
        for row in (head, *body)
    )
    return "\n".join(lines) + "\n"


def _is_used(table: Table, index: int) -> bool:
    return any(row[index] is not None for row in table.rows) or not table.rows


def _head(column: Column, unit: LengthUnit) -> str:
    power = _POWERS.get(column.quantity)
    if power is None:
        return f"{column.name} [°]" if column.quantity is Quantity.ANGLE else column.name
    return f"{column.name} [{unit.value}{_RAISED[power]}]"


def _cell(value: Cell, column: Column, unit: LengthUnit) -> str:
    if value is None or isinstance(value, str):
        return value or ""
    if column.quantity is Quantity.LENGTH:
        return length(value, unit)
    if column.quantity is Quantity.ANGLE:
        return number(math.degrees(value), 2)
    power = _POWERS.get(column.quantity)
    return str(value) if power is None else significant(value / unit.metres**power)
