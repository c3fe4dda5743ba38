"""`querycad run`: a program of the guest API, run against a file on this machine."""

from __future__ import annotations

import argparse
import sys

from querycad.runtime import EmbeddedRuntime
from querycad_sandbox.cli import complain, run_program
from querycad_segworker.errors import FileProblem


def run(options: argparse.Namespace) -> int:
    """Exit code 0: `solution` has a value; 1: the program failed; 2: the program or the file could not be read."""

    def progress(line: str) -> None:
        print(line, file=sys.stderr)

    with EmbeddedRuntime() as runtime:
        try:
            model = runtime.model(options.model, progress if sys.stderr.isatty() else None)
            return run_program(options, lambda _: model)
        except FileProblem as problem:
            return complain(str(problem))
