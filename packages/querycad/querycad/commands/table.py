"""`querycad table`: the holes, bends, fasteners, bodies … of a model, a row each."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from querycad_answering.drawing.writing import written
from querycad_contracts import LengthUnit, TableFormat, TableKind

from .outcomes import EXIT_DONE, complain
from .reading import with_model

if TYPE_CHECKING:
    from querycad.model import Model

ROWS_SHOWN = 100
"""Of a table for people; longer ones group like parts, and say so."""


def table(options: argparse.Namespace) -> int:
    """Prints the table; returns the exit code: 2 also where the model has no such part."""
    return with_model(options, lambda model: _print(model, options))


def _print(model: Model, options: argparse.Namespace) -> int:
    kind, how, unit = TableKind(options.kind), TableFormat(options.format), LengthUnit(options.unit)
    is_for_people = how in (TableFormat.TEXT, TableFormat.MARKDOWN)
    grouped = True if options.grouped else False if options.all else None
    found = model.table(kind, grouped, unit)
    if not found.rows and is_for_people:
        return complain(f"{options.file}: the model has no {kind.value}")
    if grouped is None and len(found.rows) > ROWS_SHOWN and is_for_people:
        each = len(found.rows)
        found = model.table(kind, True, unit)
        print(f"querycad: {each} {kind.value} in {len(found.rows)} groups; --all prints each", file=sys.stderr)
    print(written(found, how, unit), end="")
    return EXIT_DONE
