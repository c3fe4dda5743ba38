"""`querycad describe`: what a file holds, and what can be asked about it; `querycad compare`: what became of it."""

from __future__ import annotations

import argparse

from querycad.runtime import EmbeddedRuntime
from querycad_contracts import LengthUnit
from querycad_segworker.errors import FileProblem

from .reading import EXIT_DONE, complain


def describe(options: argparse.Namespace) -> int:
    """Prints the description; returns the exit code."""
    with EmbeddedRuntime() as runtime:
        try:
            found = runtime.describe(options.file, LengthUnit(options.unit))
        except FileProblem as problem:
            return complain(f"{options.file}: {problem}")
    print(found.model_dump_json() if options.json else found.text)
    return EXIT_DONE


def compare(options: argparse.Namespace) -> int:
    """Prints what is different; returns the exit code."""
    with EmbeddedRuntime() as runtime:
        models = []
        for file in (options.before, options.after):
            try:
                models.append(runtime.open(file))
            except FileProblem as problem:
                return complain(f"{file}: {problem}")
        found = models[0].compare(models[1], LengthUnit(options.unit).value)
    print(found.model_dump_json() if options.json else found.text)
    return EXIT_DONE
