"""`querycad bench`: the benchmark, which lies in the checkout that this package is installed from.

It is no part of the package: its models are built by scripts, and what it compares with is heavy.
"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Sequence
from pathlib import Path

from .outcomes import complain

CHECKOUT = Path(__file__).resolve().parents[4]


def add_bench(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Adds the command; it passes on all that follows, since what the benchmark understands is told by itself."""
    bench = commands.add_parser(
        "bench", help="measure accuracy and speed, in a checkout", add_help=False, prefix_chars="\0"
    )
    bench.add_argument("arguments", nargs="*")
    bench.set_defaults(run=lambda options: run(options.arguments))


def run(arguments: Sequence[str], checkout: Path = CHECKOUT) -> int:
    """Does what the benchmark's own command line says; returns the exit code, 2 where there is no benchmark."""
    if not (checkout / "benchmark" / "command" / "arguments.py").is_file():
        return complain(
            "the benchmark is not part of the installed package: get the sources, and run `make bench` there"
        )
    if str(checkout) not in sys.path:
        sys.path.append(str(checkout))
    return int(importlib.import_module("benchmark.command.arguments").main(arguments))
