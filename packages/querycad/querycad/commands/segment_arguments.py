"""The arguments of `querycad segment`. Imports nothing that a user of other commands would wait for."""

from __future__ import annotations

import argparse

from .outcomes import complain


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
    numbers = parser.add_argument_group("numbers of the stages", "S is a share of 1")
    numbers.add_argument(
        "--azimuth", type=float, default=1.0, metavar="DEG", help="turn of the side views (default: 1)"
    )
    numbers.add_argument(
        "--color-seed", type=int, default=0, metavar="N", help="which face has which colour (default: 0)"
    )
    numbers.add_argument("--elevation", type=float, default=45.0, metavar="DEG", help="of corner views (default: 45)")
    numbers.add_argument(
        "--face-share", type=_share, default=0.05, metavar="S", help="masked, for a face to count (default: 0.05)"
    )
    numbers.add_argument(
        "--largest-mask",
        type=_share,
        default=0.45,
        metavar="S",
        help="of the model, for a mask to stay (default: 0.45)",
    )
    numbers.add_argument(
        "--covered", type=_share, default=0.50, metavar="S", help="by smaller masks, for one to stay (default: 0.50)"
    )
    numbers.add_argument(
        "--join-neighbours",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="one part of finds that meet along an edge, where no view shows them apart (default: yes; published: no)",
    )
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = (
        "examples:\n  querycad segment part.step logo --out build/logo\n"
        "  querycad segment part.step hole --out build/holes --known"
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    if options.known and options.shaded:
        return complain("--known reads the flat colours: not together with --shaded")
    from .segment import segment  # here, so that `querycad --help` needs no service

    return segment(options)


def _share(text: str) -> float:
    value = float(text)
    if not 0 <= value <= 1:
        raise argparse.ArgumentTypeError("must be between 0 and 1")
    return value


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal() and 64 <= min(int(width), int(height)) <= 8192):
        raise argparse.ArgumentTypeError("such as 1920x1080")
    return int(width), int(height)
