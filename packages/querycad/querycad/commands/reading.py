"""The file that a command is about, read or known; what is wrong with it is one line."""

from __future__ import annotations

import sys
from pathlib import Path

from querycad.settings import model_store
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.model import Artefacts, ModelStore

EXIT_DONE, EXIT_BAD_INPUT = 0, 2


def read(file: str) -> Artefacts | None:
    """What is kept of the file. None where it cannot be read, which has been said then."""
    try:
        return ingest(Path(file), ModelStore(model_store()))
    except FileProblem as problem:
        complain(f"{file}: {problem}")
        return None


def complain(message: str) -> int:
    """Says what is wrong with the input; the exit code."""
    print(f"querycad: {message}", file=sys.stderr)
    return EXIT_BAD_INPUT
