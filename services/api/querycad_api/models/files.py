"""Takes an uploaded file: its head is looked at, its content hashed while it is copied into the store."""

from __future__ import annotations

import hashlib
import os
import tempfile
import unicodedata
from pathlib import Path, PurePosixPath
from typing import BinaryIO

from querycad_api.problems import FileTooLarge, NotStepFile
from querycad_contracts import StorageSettings

CHUNK_BYTES = 2**20
NAME_CHARS = 120
"""Longest file name kept; it is only shown."""

_HEAD_BYTES = 4096
_MAGIC = b"ISO-10303-21"
_BOM = b"\xef\xbb\xbf"


def check_head(head: bytes) -> None:
    """Raises NotStepFile for what cannot be a STEP file; whether it is a good one is for the segworker to say."""
    if not head:
        raise NotStepFile("the file is empty")
    if not head.removeprefix(_BOM).lstrip().startswith(_MAGIC):
        raise NotStepFile("not a STEP file: it does not begin with ISO-10303-21")


def keep_upload(upload: BinaryIO, store: StorageSettings, max_bytes: int) -> tuple[str, int]:
    """Puts the file into the store; its SHA-256 and size in bytes. Raises FileTooLarge and NotStepFile.

    The file appears under its name all at once, and on disk: once a model is accepted, its file is not lost.
    """
    head = upload.read(_HEAD_BYTES)
    check_head(head)
    store.home.mkdir(parents=True, exist_ok=True)
    digest, size = hashlib.sha256(), 0
    handle, name = tempfile.mkstemp(prefix="upload-", dir=store.home)
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
            os.fsync(target.fileno())
        sha256 = digest.hexdigest()
        kept = store.upload(sha256)
        kept.parent.mkdir(parents=True, exist_ok=True)
        unfinished.chmod(0o644)  # mkstemp's 0600 would shut out a segworker of another user
        unfinished.replace(kept)
    finally:
        unfinished.unlink(missing_ok=True)
    return sha256, size


def shown_name(given: str | None) -> str:
    """Under which name is the file shown? Without folders and control characters, of bounded length."""
    base = PurePosixPath((given or "").replace("\\", "/")).name
    printable = "".join(char for char in base if unicodedata.category(char)[0] != "C")
    return printable[-NAME_CHARS:] or "model.step"
