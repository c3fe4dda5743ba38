"""Takes an uploaded file: its head is looked at, its content hashed while it is copied to disk."""

from __future__ import annotations

import hashlib
import os
import tempfile
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import BinaryIO

from querycad_api.problems import FileTooLarge, NotStepFile
from querycad_contracts import HEAD_BYTES, file_kind, no_kind

CHUNK_BYTES = 2**20
NAME_CHARS = 120
"""Longest file name kept; it is only shown."""


def check_head(head: bytes) -> None:
    """Raises NotStepFile for what can be no CAD file; whether it is a good one is for the segworker to say."""
    if not head:
        raise NotStepFile("the file is empty")
    if file_kind(head) is None:
        raise NotStepFile(no_kind(head))


@dataclass(frozen=True, slots=True)
class Received:
    """An upload that is on disk, and not yet under its name."""

    path: Path
    sha256: str
    size_bytes: int


@contextmanager
def received(upload: BinaryIO, home: Path, max_bytes: int) -> Iterator[Received]:
    """The upload as a file in `home`, gone afterwards unless it was moved. Raises FileTooLarge and NotStepFile."""
    head = upload.read(HEAD_BYTES)
    check_head(head)
    home.mkdir(parents=True, exist_ok=True)
    digest, size = hashlib.sha256(), 0
    handle, name = tempfile.mkstemp(prefix="upload-", dir=home)
    unfinished = Path(name)
    try:
        with os.fdopen(handle, "wb") as target:
            chunk = head
            while chunk:
                size += len(chunk)
                if size > max_bytes:
                    raise FileTooLarge(f"at most {max_bytes // 2**20} MiB are accepted")
                digest.update(chunk)
                target.write(chunk)
                chunk = upload.read(CHUNK_BYTES)
            target.flush()
            os.fsync(target.fileno())  # once a model is accepted, its file is not lost
        yield Received(unfinished, digest.hexdigest(), size)
    finally:
        unfinished.unlink(missing_ok=True)


def shown_name(given: str | None) -> str:
    """Under which name is the file shown? Without folders and control characters, of bounded length."""
    base = PurePosixPath((given or "").replace("\\", "/")).name
    printable = "".join(char for char in base if unicodedata.category(char)[0] != "C")
    return printable[-NAME_CHARS:] or "model.step"
