"""The arguments of a run on the command line. Imports nothing that a user of other commands would wait for."""

from __future__ import annotations

import argparse


def add_run_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of a run, whatever the model comes from; what is not given is as `RunLimits` says."""
    parser.add_argument("program", metavar="PROGRAM.py", help="the program; - reads it from standard input")
    parser.add_argument("--expects", metavar="TYPE", help="type of the wanted value, such as length or count")
    parser.add_argument("--seconds", type=float, metavar="S", help="time that the program may compute")
    parser.add_argument("--memory", type=int, metavar="MIB", help="memory that the program may use")
    shown = parser.add_mutually_exclusive_group()
    shown.add_argument("--json", action="store_true", help="print the whole outcome as one JSON object")
    shown.add_argument("--events", action="store_true", help="print a JSON object a line for each thing that happens")
