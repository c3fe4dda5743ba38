"""What kind of CAD file is it? By its first bytes: a suffix may be wrong."""

from __future__ import annotations

import re
from enum import StrEnum

HEAD_BYTES = 4096
"""So much of a file tells its kind."""
_BOM = b"\xef\xbb\xbf"
_IGES = re.compile(rb"[^\r\n]{72}S[ 0]{6}1")
"""The first line of an IGES file: 72 columns of text, the letter of the start section, a number of seven places."""


class FileKind(StrEnum):
    """A kind of file that can be read."""

    STEP = "STEP"
    IGES = "IGES"
    BREP = "BREP"
    """The CAD kernel's own text format. It declares no unit: millimetres, as its programs have it."""
    GZIP = "gzip"
    ZIP = "zip"
    """Packed, as .stpz and .stpZ are: one CAD file in it."""

    @property
    def is_packed(self) -> bool:
        """Is another file in it?"""
        return self in (FileKind.GZIP, FileKind.ZIP)


def file_kind(head: bytes) -> FileKind | None:
    """Of a file that begins with these bytes; None: no kind that can be read."""
    text = head.removeprefix(_BOM).lstrip()
    if text.startswith(b"ISO-10303-21"):
        return FileKind.STEP
    if head.startswith(b"\x1f\x8b"):
        return FileKind.GZIP
    if head.startswith(b"PK\x03\x04"):
        return FileKind.ZIP
    if text.startswith((b"DBRep_DrawableShape", b"CASCADE Topology")):
        return FileKind.BREP
    return FileKind.IGES if _IGES.match(head) else None
