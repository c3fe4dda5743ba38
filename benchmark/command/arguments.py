"""The arguments of `querycad bench`. Imports nothing that a user of other commands would wait for."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from querycad_contracts.infrastructure import processors

SET_UP = ("codegen", "grounding", "views", "box_threshold", "prompt_examples")
"""The fields of `SystemOptions` that have arguments of the same name."""

EXIT_CODES = """exit code: 0 done, and nothing is below the floor; 1 a set is below its floor;
2 bad input, no benchmark, or no such system or service; 130 interrupted"""

if TYPE_CHECKING:
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]


def main(arguments: Sequence[str]) -> int:
    """Does what the command line says, less `querycad bench`; returns the exit code."""
    options = _parser().parse_args(arguments)
    return int(options.run(options))


def _parser() -> argparse.ArgumentParser:
    bench = argparse.ArgumentParser(
        prog="querycad bench",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog=EXIT_CODES,
        description="Without a command: asks all questions of ./benchmark and, where present, ../shared/cad-qa-dev, "
        "and fails when the score is below the recorded floor.",
    )
    bench.add_argument(
        "--record", action="store_true", help="keep the score: trend, summary, and the floor where higher"
    )
    _add_common(bench, out="build/bench")
    bench.set_defaults(run=_run, bench="all")
    inner = bench.add_subparsers(metavar="COMMAND")
    _add_run(inner)
    _add_score(inner)
    _add_ablate(inner)
    _add_compare(inner)
    _add_perf(inner)
    _add_service(inner)
    _add_networks(inner)
    return bench


def _add_run(commands: Commands) -> None:
    run = commands.add_parser("run", help="ask all questions of a benchmark folder")
    run.add_argument("folder", metavar="DIR", help="holds <set>/<id>/cad.step …, or questions/*.json")
    _add_models(run)
    run.add_argument("--resume", action="store_true", help="do not ask again what OUT has results of")
    _add_common(run, out="bench-results", has_pictures=True)
    run.set_defaults(run=_run, bench="run")


def _add_score(commands: Commands) -> None:
    score = commands.add_parser("score", help="score the answers of another system")
    score.add_argument("folder", metavar="DIR", help="the benchmark folder")
    _add_models(score)
    score.add_argument("answers", metavar="ANSWERS", help="a JSON file, or a folder of <set>/<id>/answers.txt")
    score.add_argument("--out", metavar="DIR", default="bench-results", help="where results go (default: %(default)s)")
    score.add_argument("--overrides", metavar="FILE", help="classes of failure by hand (default: OUT/overrides.json)")
    score.set_defaults(run=_run, bench="score")


def _add_ablate(commands: Commands) -> None:
    ablate = commands.add_parser("ablate", help="run a benchmark once for every value of an option, one table")
    ablate.add_argument("folder", metavar="DIR", help="the benchmark folder")
    _add_models(ablate)
    ablate.add_argument("--option", metavar="NAME", help="the option that varies, such as codegen (default: each)")
    ablate.add_argument("--values", nargs="+", metavar="VALUE", help="its values (default: the usual ones)")
    ablate.add_argument("--resume", action="store_true", help="do not ask again what OUT has results of")
    _add_common(ablate, out="bench-ablation")
    ablate.set_defaults(run=_run, bench="ablate")


def _add_compare(commands: Commands) -> None:
    compare = commands.add_parser("compare", help="which answers did a change fix, which did it break?")
    compare.add_argument("before", metavar="A", help="results.json of a run, or its folder")
    compare.add_argument("after", metavar="B", help="results.json of another run, or its folder")
    _add_summaries(compare)
    compare.set_defaults(run=_run, bench="compare")


def _add_perf(commands: Commands) -> None:
    perf = commands.add_parser("perf", help="measure speed, each figure against a baseline in the same run")
    perf.add_argument("models", nargs="*", metavar="FILE", help="STEP files (default: those in examples/)")
    perf.add_argument("--questions", type=_positive, default=200, metavar="N", help="questions asked (default: 200)")
    perf.add_argument("--repeat", type=_positive, default=3, metavar="N", help="readings of each file (default: 3)")
    perf.add_argument(
        "--only",
        type=lambda text: tuple(text.split(",")),
        default=(),
        metavar="PART,…",
        help="of: questions, sandbox, ingest, memory, recognition, rendering, faces, workers (default: all)",
    )
    perf.add_argument(
        "--limit", type=_positive, default=600, metavar="S", help="begin no figure after so long (default: 600 s)"
    )
    perf.add_argument("--out", metavar="FILE.json", help="write the figures there")
    perf.add_argument("--plots", metavar="DIR", help="draw the figures there, as PNG files; needs matplotlib")
    perf.set_defaults(run=_run, bench="perf")


def _add_service(commands: Commands) -> None:
    service = commands.add_parser("service", help="measure the service over HTTP, and kill its processes under load")
    service.add_argument("model", nargs="?", default="examples/flange.step", metavar="FILE", help="a STEP file")
    service.add_argument("--questions", type=_positive, default=200, metavar="N", help="of each kind (default: 200)")
    service.add_argument("--chaos", type=int, default=500, metavar="N", help="questions under load (default: 500)")
    service.add_argument("--out", metavar="FILE.json", help="write the figures there")
    service.set_defaults(run=_run, bench="service")


def _add_networks(commands: Commands) -> None:
    networks = commands.add_parser("networks", help="measure the detector and the segmenter of the vision path")
    networks.add_argument("--weights", metavar="DIR", help="their weights (default: QUERYCAD_HOME/weights)")
    networks.add_argument("--boxes", type=_positive, default=20, metavar="N", help="in one view (default: 20)")
    networks.add_argument("--repeat", type=_positive, default=3, metavar="N", help="times (default: 3)")
    networks.set_defaults(run=_run, bench="networks")


def _add_common(parser: argparse.ArgumentParser, out: str, *, has_pictures: bool = False) -> None:
    parser.add_argument("--out", metavar="DIR", default=out, help="where results go (default: %(default)s)")
    parser.add_argument(
        "--jobs", type=_positive, default=processors(), metavar="N", help="models at a time (default: cores)"
    )
    system = parser.add_mutually_exclusive_group()
    system.add_argument("--system", metavar="MODULE:CLASS", help="measure another system through this adapter")
    system.add_argument("--server", metavar="URL", help="measure a running service; its key is in QUERYCAD_API_KEY")
    _add_summaries(parser)
    parser.add_argument("--junit", metavar="FILE", help="write every question as a test in JUnit's form")
    parser.add_argument(
        "--timeout", type=_positive, metavar="S", help="of one question (default: 60 s; 600 s with vision or a model)"
    )
    parser.add_argument(
        "--pictures",
        action=argparse.BooleanOptionalAction,
        default=has_pictures,
        help=f"put pictures of what was found into the report (default: {'yes' if has_pictures else 'no'})",
    )
    parser.add_argument(
        "--reuse-models", action="store_true", help="use models read before; without it every file is read anew"
    )
    parser.add_argument("--overrides", metavar="FILE", help="classes of failure by hand (default: OUT/overrides.json)")
    _add_set_up(parser)


def _add_summaries(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--markdown", metavar="FILE", help="add a summary in Markdown to this file")


def _add_set_up(parser: argparse.ArgumentParser) -> None:
    """The options of `SystemOptions`; not given is its default."""
    group = parser.add_argument_group("how the system is set up")
    group.add_argument("--codegen", choices=("parser", "llm", "both"), help="who writes programs (default: parser)")
    group.add_argument(
        "--grounding", choices=("geometry", "vision", "fused"), help="what turns words into parts (default: geometry)"
    )
    group.add_argument("--views", choices=("6", "8"), help="looked at by vision (default: 6)")
    group.add_argument(
        "--box-threshold", type=_share, metavar="SHARE", help="score that vision's boxes must exceed (default: 0.30)"
    )
    group.add_argument(
        "--prompt-examples", choices=("0", "3", "nearest"), help="shown to a language model (default: nearest)"
    )


def _share(text: str) -> float:
    value = float(text)
    if not 0 < value < 1:
        raise argparse.ArgumentTypeError("must be between 0 and 1")
    return value


def _add_models(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--models", metavar="DIR", help="where the STEP files of questions/*.json are")


def _positive(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("must be 1 or more")
    return value


def _run(options: argparse.Namespace) -> int:
    from .commands import bench  # here, so that `querycad --help` needs no service

    return bench(options)
