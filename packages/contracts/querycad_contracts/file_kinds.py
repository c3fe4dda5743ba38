"""What kind of CAD file is it? By its first bytes: a suffix may be wrong."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterable
from enum import StrEnum

HEAD_BYTES = 4096
"""So much of a file tells its kind."""
BOM = b"\xef\xbb\xbf"
_IGES = re.compile(rb"[^\r\n]{72}S[ 0]{6}1")
"""The first line of an IGES file: 72 columns of text, the letter of the start section, a number of seven places."""
_OBJ = re.compile(rb"^v(?:[ \t]{1,20}[-+]?[\d.][^\s]{0,40}){3}", re.MULTILINE)
"""A vertex of an OBJ file: a letter and three numbers."""
_STL_FACET = re.compile(rb"^\s{0,80}(?:facet\s{1,20}normal|endsolid)\b", re.MULTILINE | re.IGNORECASE)
_STL_RECORD = struct.Struct("<12fH")
_LARGEST = 1e20
"""Of a coordinate: what is no mesh has larger ones among its first hundred, unless it is made to."""


class FileKind(StrEnum):
    """A kind of file that can be read."""

    STEP = "STEP"
    IGES = "IGES"
    BREP = "BREP"
    """The CAD kernel's own text format. It declares no unit: millimetres, as its programs have it."""
    STL = "STL"
    OBJ = "OBJ"
    THREE_MF = "3MF"
    """A ZIP archive by its first bytes; its directory tells (`three_mf`)."""
    GZIP = "gzip"
    ZIP = "zip"
    """Packed, as .stpz and .stpZ are: one CAD file in it."""

    @property
    def is_mesh(self) -> bool:
        """Does it hold triangles, to which faces are fitted?"""
        return self in (FileKind.STL, FileKind.OBJ, FileKind.THREE_MF)

    @property
    def is_packed(self) -> bool:
        """Is another file in it?"""
        return self in (FileKind.GZIP, FileKind.ZIP)


def file_kind(head: bytes) -> FileKind | None:
    """Of a file that begins with these bytes; None: no kind that can be read."""
    text = head.removeprefix(BOM).lstrip()
    if text.startswith(b"ISO-10303-21"):
        return FileKind.STEP
    if head.startswith(b"\x1f\x8b"):
        return FileKind.GZIP
    if head.startswith(b"PK\x03\x04"):
        return FileKind.ZIP
    if text.startswith((b"DBRep_DrawableShape", b"CASCADE Topology")):
        return FileKind.BREP
    if _IGES.match(head):
        return FileKind.IGES
    if b"\x00" not in head:
        if text[:5].lower() == b"solid" and _STL_FACET.search(text):
            return FileKind.STL
        return FileKind.OBJ if _OBJ.search(text) else None
    return FileKind.STL if _is_binary_stl(head) else None


def no_kind(head: bytes) -> str:
    """Why can a file that begins with these bytes not be read, of which `file_kind` gives no kind? One sentence."""
    return f"not a STEP file: {_looks_like(head)}"


def _looks_like(head: bytes) -> str:
    text = head[:512].removeprefix(BOM).lstrip()
    if head.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "it is encoded as UTF-16; save it as plain text first"
    if text[:1] == b"<":
        return "it is an HTML or XML document"
    if text.startswith(b"solid"):
        return "it begins like an STL file, and holds no facet"
    if b"\x00" in head:
        return "it holds binary data"
    return "it does not begin with ISO-10303-21; nor is it IGES, BREP, a mesh or an archive"


def is_3mf(names: Iterable[str]) -> bool:
    """Is an archive with files of these names a 3MF?"""
    return any(name.lower().startswith("3d/") and name.lower().endswith(".model") for name in names)


def _is_binary_stl(head: bytes) -> bool:
    """It has no mark of its own: after 84 bytes come triangles, each a normal no longer than 1 and three corners."""
    count = int.from_bytes(head[80:84], "little")
    records = [*_STL_RECORD.iter_unpack(head[84 : 84 + (len(head) - 84) // 50 * 50])][:count]
    return bool(records) and all(
        not x * x + y * y + z * z > 1.1 and not any(abs(each) > _LARGEST for each in corners)
        for x, y, z, *corners, _ in records
    )
