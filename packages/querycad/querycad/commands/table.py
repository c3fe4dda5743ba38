"""`querycad table`: the holes, bends, fasteners, bodies … of a model, a row each."""

from __future__ import annotations

import argparse
import sys

from querycad_answering.drawing.tables import table as make_table
from querycad_answering.drawing.writing import written
from querycad_contracts import LengthUnit, TableFormat, TableKind

from .reading import EXIT_BAD_INPUT, EXIT_DONE, complain, read

ROWS_SHOWN = 100
"""Of a table for people; longer ones group like parts, and say so."""


def table(options: argparse.Namespace) -> int:
    """Prints the table; returns the exit code: 2 also where the model has no such part."""
    artefacts = read(options.file)
    if artefacts is None:
        return EXIT_BAD_INPUT
    parts = artefacts.load_model().parts
    kind, how, unit = TableKind(options.kind), TableFormat(options.format), LengthUnit(options.unit)
    grouped = True if options.grouped else False if options.all else None
    found = make_table(kind, parts, grouped=grouped, unit=unit)
    if not found.rows and how in (TableFormat.TEXT, TableFormat.MARKDOWN):
        return complain(f"{options.file}: the model has no {kind.value}")
    if grouped is None and len(found.rows) > ROWS_SHOWN and how in (TableFormat.TEXT, TableFormat.MARKDOWN):
        each = len(found.rows)
        found = make_table(kind, parts, grouped=True, unit=unit)
        print(f"querycad: {each} {kind.value} in {len(found.rows)} groups; --all prints each", file=sys.stderr)
    print(written(found, how, unit), end="")
    return EXIT_DONE
