"""`querycad describe`: what a file holds, and what can be asked about it; `querycad compare`: what became of it."""

from __future__ import annotations

import argparse

from querycad.runtime import EmbeddedRuntime
from querycad_contracts import Comparison, Description, LengthUnit
from querycad_segworker.errors import FileProblem

from .outcomes import EXIT_DONE, complain_of
from .reading import with_model


def describe(options: argparse.Namespace) -> int:
    """Prints the description; returns the exit code."""
    return with_model(options, lambda model: _print(model.describe(LengthUnit(options.unit)), options))


def compare(options: argparse.Namespace) -> int:
    """Prints what is different; returns the exit code."""
    with EmbeddedRuntime() as runtime:
        models = []
        for file in (options.before, options.after):
            try:
                models.append(runtime.open(file))
            except FileProblem as problem:
                return complain_of(file, problem)
        return _print(models[0].compare(models[1], LengthUnit(options.unit)), options)


def _print(found: Description | Comparison, options: argparse.Namespace) -> int:
    print(found.model_dump_json() if options.json else found.text)
    return EXIT_DONE
