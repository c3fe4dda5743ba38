"""The arguments of `querycad models`. Imports nothing that a user of other commands would wait for."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]


def add_models(commands: Commands) -> None:
    """Adds `models` and its own commands."""
    models = commands.add_parser(
        "models",
        help="get the networks that find what geometry has no name for",
        description="The weights of the vision path lie under QUERYCAD_HOME/weights. Nothing is downloaded unless "
        "you run `pull`; without weights, geometry answers alone.",
    )
    inner = models.add_subparsers(dest="models", required=True, metavar="COMMAND")
    inner.add_parser("list", help="show which there are, and which are here")
    pull = inner.add_parser("pull", help="resume or start the download, and check it")
    pull.add_argument(
        "names", nargs="*", metavar="NAME", help="models of the list (default: one detector, one segmenter)"
    )
    source = pull.add_mutually_exclusive_group()
    source.add_argument("--mirror", metavar="URL", help="download from this address, which has the hub's paths")
    source.add_argument("--from", dest="folder", metavar="FOLDER", help="copy from a local folder instead")
    verify = inner.add_parser("verify", help="compare the files here with their SHA-256")
    verify.add_argument("names", nargs="*", metavar="NAME", help="models of the list (default: all that are here)")
    models.formatter_class = argparse.RawDescriptionHelpFormatter
    models.epilog = "examples:\n  querycad models list\n  querycad models pull\n  querycad models pull --from ~/weights"
    models.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    from .models import models  # here, so that `querycad --help` loads no networks

    return models(options)
