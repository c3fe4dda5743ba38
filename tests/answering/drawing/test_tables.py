"""Tables: a row for each part or for all alike, in every form."""

from __future__ import annotations

import csv
import io
import json
from typing import Any

import pytest
from tests.made import MM, body, hole, part

from querycad_answering.drawing.tables import is_fastener, product_name, table
from querycad_answering.drawing.writing import written
from querycad_contracts import LengthUnit, Part, Table, TableFormat, TableKind

SIX = tuple(hole(number, x=10.0 * number, y=-5.0, diameter=0.005) for number in range(1, 7))
TWO = (hole(7, diameter=0.0085), hole(8, diameter=0.0085))


def cell(found: Table, row: int, name: str) -> object:
    return found.rows[row][[column.name for column in found.columns].index(name)]


def screw(number: int, name: str = "", across: float = 0.01, **more: Any) -> Part:
    fields: dict[str, Any] = {
        "extents": (across, across, 0.021),
        "volume": 5.58e-7,
        "length": 0.021,
        "diameter": 0.005,
        "tags": ("solid", "screw"),
        "faces": (10 * number, 10 * number + 1),
    }
    return body(number, name, **(fields | more))


def test_a_hole_table_has_a_row_a_hole_and_a_letter_for_those_alike() -> None:
    found = table(TableKind.HOLES, [*SIX, *TWO])
    assert [row[0] for row in found.rows] == ["A1", "A2", "A3", "A4", "A5", "A6", "B1", "B2"]
    assert cell(found, 2, "x") == pytest.approx(30 * MM)
    assert cell(found, 2, "z") == pytest.approx(5 * MM), "where the hole opens"
    assert cell(found, 2, "axis") == "+z"
    assert cell(found, 2, "suits") == "tap drill M6"
    assert (cell(found, 2, "count"), found.parts) == (6, 8)


def test_grouped_rows_stand_for_all_alike_and_have_no_place() -> None:
    found = table(TableKind.HOLES, [*SIX, *TWO], grouped=True)
    assert [(row[0], cell(found, i, "ids"), cell(found, i, "count")) for i, row in enumerate(found.rows)] == [
        ("A", "hole-1..6", 6),
        ("B", "hole-7..8", 2),
    ]
    assert cell(found, 0, "x") is None


def test_a_grouped_row_has_an_axis_only_where_all_have_the_same() -> None:
    sideways = hole(7, diameter=0.005, axis=(1.0, 0.0, 0.0), normal=(1.0, 0.0, 0.0))
    assert cell(table(TableKind.HOLES, SIX, grouped=True), 0, "axis") == "+z"
    assert cell(table(TableKind.HOLES, [*SIX, sideways], grouped=True), 0, "axis") is None


def test_a_thousand_holes_are_a_few_grouped_rows() -> None:
    holes = [hole(number, diameter=0.002 + 0.001 * (number % 3)) for number in range(1, 1361)]
    found = table(TableKind.HOLES, holes, grouped=True)
    assert len(found.rows) == 3
    assert sum(int(str(cell(found, i, "count"))) for i in range(3)) == 1360 == found.parts
    assert len(table(TableKind.HOLES, holes, grouped=False).rows) == 1360


def test_instances_of_one_product_are_one_row_of_the_bill_of_material() -> None:
    bodies = [screw(1, "Screw M5 1"), screw(2, "Screw M5 2"), body(3, "Plate", volume=1e-4, color="#ff0000")]
    found = table(TableKind.BODIES, bodies)
    assert [(cell(found, i, "name"), cell(found, i, "count")) for i in range(2)] == [("Screw M5", 2), ("Plate", 1)]
    assert cell(found, 1, "color") == "#ff0000"
    assert cell(found, 1, "volume") == 1e-4


def test_turned_instances_are_alike_and_other_sizes_are_not() -> None:
    turned = screw(2, "Screw M5 2", extents=(0.021, 0.01, 0.01))
    longer = screw(3, "Screw M5 3", extents=(0.01, 0.01, 0.026), volume=1.2e-6)
    assert [row[0] for row in table(TableKind.BODIES, [screw(1, "Screw M5 1"), turned, longer]).rows] == ["A", "B"]
    assert product_name([screw(1, "Screw 1")]) == "Screw 1", "alone it keeps its name"


def test_a_screws_length_is_under_its_head_and_the_overall_length_stands_beside_it() -> None:
    found = table(TableKind.FASTENERS, [screw(1, "ISO 4762 M5x16", nominal_length=0.016), body(2, "Plate")])
    assert len(found.rows) == 1
    assert (cell(found, 0, "length"), cell(found, 0, "overall length")) == (0.016, 0.021)


@pytest.mark.parametrize(("name", "is_one"), [("Hex bolt", True), ("Nut M6", True), ("Doughnut", False), ("", False)])
def test_fasteners_are_known_by_whole_words_of_their_name(name: str, is_one: bool) -> None:
    assert is_fastener(body(1, name)) is is_one


def test_csv_has_every_column_and_quotes_what_needs_it() -> None:
    text = written(table(TableKind.HOLES, [*SIX, *TWO]), TableFormat.CSV)
    rows = list(csv.DictReader(io.StringIO(text)))
    assert len(rows) == 8
    assert (rows[0]["x [mm]"], rows[0]["diameter [mm]"], rows[0]["thread"]) == ("10", "5", "")
    inches = list(csv.DictReader(io.StringIO(written(table(TableKind.HOLES, SIX), TableFormat.CSV, LengthUnit.IN))))
    assert inches[0]["diameter [in]"] == "0.1969"


def test_text_and_markdown_leave_out_empty_columns_and_line_up() -> None:
    found = table(TableKind.HOLES, [*SIX, *TWO])
    lines = written(found, TableFormat.TEXT).splitlines()
    assert len(lines) == 9
    assert "thread" not in lines[0]
    assert lines[0].index("[mm]") > 0
    marked = written(found, TableFormat.MARKDOWN).splitlines()
    assert marked[1].startswith("| --- | --- | ---: |")
    assert len({line.count("|") for line in marked}) == 1


def test_json_is_the_contract_in_si() -> None:
    data = json.loads(written(table(TableKind.HOLES, SIX), TableFormat.JSON, LengthUnit.IN))
    assert Table.model_validate(data).rows[0][6] == 0.005


def test_what_breaks_the_edge_of_a_hole_is_no_row_of_its_own() -> None:
    chamfer = part("chamfer-h1.1", kind="chamfer", chamfer_size=0.001)
    other = part("chamfer-1", chamfer_size=0.001)
    holed = hole(1, children=(chamfer.id,))
    assert [row[1] for row in table(TableKind.EDGES, [holed, chamfer, other]).rows] == ["chamfer-1"]


def test_every_table_of_a_model_without_such_parts_is_empty() -> None:
    assert all(table(kind, []).rows == () for kind in TableKind)
