"""A file's kind is told by its first bytes."""

from __future__ import annotations

import gzip
import struct

import pytest

from querycad_contracts import FileKind, file_kind, is_3mf

HEADS = [
    (b"ISO-10303-21;", FileKind.STEP),
    (b"\xef\xbb\xbf\r\n ISO-10303-21;", FileKind.STEP),
    (gzip.compress(b"ISO-10303-21;", mtime=0), FileKind.GZIP),
    (b"PK\x03\x04rest", FileKind.ZIP),
    (b" " * 72 + b"S      1\n", FileKind.IGES),
    (b"the start section of some program".ljust(72) + b"S0000001\n", FileKind.IGES),
    (b"DBRep_DrawableShape\n\nCASCADE Topology V1", FileKind.BREP),
    (b"\nCASCADE Topology V3, (c) Open Cascade", FileKind.BREP),
    (b"solid cube\nfacet normal 0 0 1\n", FileKind.STL),
    (b"solid of nothing\nendsolid\n", FileKind.STL),
    (b"solid state physics\n", None),
    (b"solid and binary".ljust(80) + b"\x01\0\0\0" + bytes(50), FileKind.STL),
    (b"a header".ljust(80) + b"\x02\0\0\0" + struct.pack("<12fH", 0, 0, 1, *range(9), 0) * 2, FileKind.STL),
    (b"a header".ljust(80) + b"\x02\0\0\0" + struct.pack("<12fH", 0, 0, 9, *range(9), 0) * 2, None),
    (bytes(4096), None),
    (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(range(256)) * 8, None),
    (b"# a mesh\nmtllib a.mtl\no part\nv 1.0 -2 3e-4\n", FileKind.OBJ),
    (b"v 1 2\nvery short\n", None),
    (b"<html>", None),
    (b"", None),
]


@pytest.mark.parametrize(("head", "kind"), HEADS)
def test_the_first_bytes_tell_the_kind(head: bytes, kind: FileKind | None) -> None:
    assert file_kind(head) is kind
    if kind is not None:
        assert kind.is_packed == (kind in (FileKind.GZIP, FileKind.ZIP))


def test_an_archive_is_3mf_by_what_is_in_it() -> None:
    assert is_3mf(["[Content_Types].xml", "3D/3dmodel.model"])
    assert not is_3mf(["part.step", "word/document.xml"])
    assert [kind for kind in FileKind if kind.is_mesh] == [FileKind.STL, FileKind.OBJ, FileKind.THREE_MF]
