"""The file that a command is about, read here or by a service; what is wrong with it is one line."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from querycad.settings import model_store
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.model import Artefacts, ModelStore

from .outcomes import complain_of

if TYPE_CHECKING:
    from querycad.model import Model

OpenModel: TypeAlias = "Callable[[Callable[[str], None]], Model]"
"""Opens the file that is asked about, and tells the stages of reading it. Raises FileProblem."""


def read(file: str) -> Artefacts | None:
    """What is kept of the file. None where it cannot be read, which has been said then."""
    try:
        return ingest(Path(file), ModelStore(model_store()))
    except FileProblem as problem:
        complain_of(file, problem)
        return None


def with_model(options: argparse.Namespace, work: Callable[[Model], int]) -> int:
    """Does the work with the model in `options.file`, which `options.server` reads where one is named.

    Returns the exit code of the work, or that of a file that cannot be read.
    """

    def opened(open_model: OpenModel) -> int:
        try:
            return work(open_model(lambda _stage: None))
        except FileProblem as problem:
            return complain_of(options.file, problem)

    if options.server:
        from .server import on_server  # here: no HTTP client is loaded where nothing is sent

        return on_server(options, opened)
    from querycad.runtime import EmbeddedRuntime

    with EmbeddedRuntime() as runtime:
        return opened(lambda progress: runtime.open(options.file, progress=progress))
