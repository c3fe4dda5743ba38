"""Files in archives: one CAD file out of a .stpz or .zip, never more bytes than a file may have."""

from __future__ import annotations

import gzip
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from querycad_contracts import HEAD_BYTES, FileKind, file_kind
from querycad_segworker.errors import FileTooLarge, IncompleteFile, NotStep

from .archives import opened

CHUNK_BYTES = 2**20
MOST_MEMBERS = 1000
"""Members of an archive that are looked at."""


def unpack(path: Path, kind: FileKind, target: Path, max_bytes: int) -> None:
    """Writes the one CAD file that is in the archive to `target`.

    What an archive says of sizes is not believed: bytes are counted as they come, and at `max_bytes` it ends. Names of
    members are looked at, never written to. Raises FileTooLarge, IncompleteFile and NotStep.
    """
    if path.stat().st_size > max_bytes:
        raise FileTooLarge(f"the file has more than the {max_bytes / 2**20:.0f} MB that are read")
    try:
        with target.open("wb") as out:
            left = max_bytes
            for chunk in _gzip(path) if kind is FileKind.GZIP else _zip(path):
                left -= len(chunk)
                if left < 0:
                    raise FileTooLarge(f"unpacked, the file has more than the {max_bytes / 2**20:.0f} MB that are read")
                out.write(chunk)
    except (EOFError, zlib.error, gzip.BadGzipFile, zipfile.BadZipFile, NotImplementedError) as error:
        raise IncompleteFile(f"the file is compressed with {kind}, and damaged or cut short") from error
    with target.open("rb") as file:
        inner = file_kind(file.read(HEAD_BYTES))
    if inner is not None and inner.is_packed:
        raise NotStep("the file is an archive in an archive; unpack it first")


def _gzip(path: Path) -> Iterator[bytes]:
    with gzip.open(path) as file:
        yield from _chunks(file)


def _zip(path: Path) -> Iterator[bytes]:
    with opened(path) as archive:
        if len(archive.infolist()) > MOST_MEMBERS:
            raise NotStep(f"the archive holds {len(archive.infolist())} files; pack the CAD file alone")
        found = [each for each in archive.infolist() if not each.is_dir() and _kind(archive, each) is not None]
        if not found:
            raise NotStep("no CAD file that can be read is in the archive")
        if len(found) > 1:
            names = ", ".join(_shown(each.filename) for each in found[:5])
            raise NotStep(f"{len(found)} CAD files are in the archive: {names}; pack the one that is meant alone")
        with archive.open(found[0]) as file:
            yield from _chunks(file)


def _kind(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> FileKind | None:
    if member.flag_bits & 0x1:
        raise NotStep("the archive is encrypted; unpack it first")
    with archive.open(member) as file:
        return file_kind(file.read(HEAD_BYTES))


def _shown(name: str) -> str:
    return "".join(char if char.isprintable() else " " for char in name)[-80:]


def _chunks(file: IO[bytes] | gzip.GzipFile) -> Iterator[bytes]:
    while chunk := file.read(CHUNK_BYTES):
        yield chunk
