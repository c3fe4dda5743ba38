"""`querycad models`: which networks there are for the vision path, how they come here, whether they are right."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import httpx
from rich.console import Console
from rich.progress import BarColumn, DownloadColumn, TextColumn, TimeRemainingColumn, TransferSpeedColumn
from rich.progress import Progress as Bars
from rich.table import Table

from querycad.pull import Download, LocalFolder, Progress, PullFailed, Source, pull
from querycad.settings import weights_folder
from querycad_segworker.segcad.engines.weights import (
    HUB,
    Check,
    Model,
    Role,
    absence,
    check,
    default_models,
    known_models,
    present,
)

from .outcomes import EXIT_DONE, EXIT_FAILED, complain


def models(options: argparse.Namespace) -> int:
    """Does the command `options.models`; returns its exit code."""
    weights = weights_folder()
    if options.models == "list":
        return _list(weights)
    known = {model.name: model for model in known_models()}
    unknown = [name for name in options.names if name not in known]
    if unknown:
        return complain(f"no model is called {unknown[0]}; there are: {', '.join(known)}")
    chosen = tuple(known[name] for name in options.names)
    if options.models == "verify":
        return _verify(weights, chosen)
    return _pull(weights, chosen or default_models(), options)


def _list(weights: Path) -> int:
    """A table of the known models and of what else lies in the folder, and which two are used."""
    used = {role: next(present(weights, role), None) for role in Role}
    table = Table("model", "for", "size", "licence", "here", "what", title=str(weights), title_justify="left")
    for model in known_models():
        state = _state(weights, model) + (", used" if used[model.role] == weights / model.name else "")
        size = f"{model.size_mb:.0f} MB"
        table.add_row(model.name, model.role, size, model.licence, state, f"{model.note} ({model.repository})")
    known = {model.name for model in known_models()}
    for role in Role:
        for folder in present(weights, role):
            if folder.name not in known:
                state = "yes, used" if used[role] == folder else "yes"
                table.add_row(folder.name, role, "", "", state, "of your own")
    console = Console(highlight=False, width=None if sys.stdout.isatty() else 160)
    console.print(table)
    missing = absence(weights)
    if missing:
        print(missing)
    return EXIT_DONE


def _state(weights: Path, model: Model) -> str:
    there = [file for file in model.files if (weights / model.name / file.name).is_file()]
    return "yes" if len(there) == len(model.files) else f"{len(there)} of {len(model.files)} files" if there else "no"


def _verify(weights: Path, chosen: Sequence[Model]) -> int:
    """Reads every file of the models named, or of all that are here, and compares sums."""
    asked = chosen or [model for model in known_models() if _state(weights, model) != "no"]
    if not asked:
        print(f"no weights in {weights}: nothing to verify")
    failed = False
    for model in asked:
        for file in model.files:
            found = check(weights / model.name, file)
            failed |= found in (Check.WRONG, Check.ABSENT)
            print(f"{model.name}/{file.name}: {found}")
    return EXIT_FAILED if failed else EXIT_DONE


def _pull(weights: Path, chosen: Sequence[Model], options: argparse.Namespace) -> int:
    """Brings the models here, one after the other, with a bar on standard error where that is a terminal."""
    folder = Path(options.folder) if options.folder else None
    if folder is not None and not folder.is_dir():
        return complain(f"{folder}: no such folder")
    with httpx.Client() as client, _bars() as progress:
        source: Source = LocalFolder(folder) if folder else Download(client, options.mirror or HUB)
        for model in chosen:
            print(f"{model.name}: about {model.size_mb:.0f} MB, {model.licence}", flush=True)
            try:
                for name, found in pull(model, weights, source, progress):
                    print(f"  {name}: {found}", flush=True)
            except (PullFailed, OSError) as error:
                return complain(str(error), EXIT_FAILED)
    print(f"in {weights}")
    return EXIT_DONE


@contextmanager
def _bars() -> Iterator[Progress]:
    """A bar for each file while it comes."""
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), DownloadColumn(), TransferSpeedColumn())
    with Bars(
        *columns, TimeRemainingColumn(), console=console, transient=True, disable=not console.is_terminal
    ) as bars:
        tasks = {}

        def progress(name: str, done: int, total: int | None) -> None:
            if name not in tasks:
                tasks[name] = bars.add_task(name)
            bars.update(tasks[name], completed=done, total=total)

        yield progress
