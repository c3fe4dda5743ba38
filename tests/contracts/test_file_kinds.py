"""A file's kind is told by its first bytes."""

from __future__ import annotations

import gzip

import pytest

from querycad_contracts import FileKind, file_kind

HEADS = [
    (b"ISO-10303-21;", FileKind.STEP),
    (b"\xef\xbb\xbf\r\n ISO-10303-21;", FileKind.STEP),
    (gzip.compress(b"ISO-10303-21;"), FileKind.GZIP),
    (b"PK\x03\x04rest", FileKind.ZIP),
    (b" " * 72 + b"S      1\n", FileKind.IGES),
    (b"the start section of some program".ljust(72) + b"S0000001\n", FileKind.IGES),
    (b"DBRep_DrawableShape\n\nCASCADE Topology V1", FileKind.BREP),
    (b"\nCASCADE Topology V3, (c) Open Cascade", FileKind.BREP),
    (b"solid cube\nfacet normal 0 0 1\n", None),
    (b"<html>", None),
    (b"", None),
]


@pytest.mark.parametrize(("head", "kind"), HEADS)
def test_the_first_bytes_tell_the_kind(head: bytes, kind: FileKind | None) -> None:
    assert file_kind(head) is kind
    if kind is not None:
        assert kind.is_packed == (kind in (FileKind.GZIP, FileKind.ZIP))
