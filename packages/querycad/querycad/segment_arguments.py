"""The arguments of `querycad segment`. Imports nothing that a user of other commands would wait for."""

from __future__ import annotations

import argparse
import sys

EXIT_BAD_INPUT = 2


def add_segment(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Adds the command."""
    parser = commands.add_parser("segment", help="draw how the vision path looks for a phrase, stage by stage")
    parser.add_argument("file", metavar="FILE", help="a STEP file")
    parser.add_argument("phrase", metavar="PHRASE", help="what to look for, such as 'logo'")
    parser.add_argument("--out", required=True, metavar="DIR", help="folder for the pictures")
    parser.add_argument("--views", type=int, choices=(6, 8), default=6, help="6 sides or 8 corners (default: 6)")
    parser.add_argument("--size", type=_size, default=(1920, 1080), metavar="WxH", help="pixels (default: 1920x1080)")
    parser.add_argument("--shaded", action="store_true", help="show the networks light on the faces' colours")
    parser.add_argument("--box-threshold", type=float, default=0.30, metavar="S", help="least score (default: 0.30)")
    parser.add_argument(
        "--known", action="store_true", help="boxes and masks from recognised parts instead of the networks; flat only"
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    if options.known and options.shaded:
        print("querycad: --known reads the flat colours: not together with --shaded", file=sys.stderr)
        return EXIT_BAD_INPUT
    from .segment import segment  # here, so that `querycad --help` needs no service

    return segment(options)


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal() and 64 <= min(int(width), int(height)) <= 8192):
        raise argparse.ArgumentTypeError("such as 1920x1080")
    return int(width), int(height)
