"""ZIP archives of strangers: what it takes to look into one is bounded, whatever it says of itself."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from io import FileIO

from querycad_segworker.errors import NotStep

PIECE_BYTES = 2**20
"""Read at once at most. The directory of an archive is read in one piece: a thousand members need some 100 KB."""
METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
"""What CAD programs write. Python unpacks the others without a limit: 16 KB of them can be 20 GB at once."""


class _InPieces(FileIO):
    """A file of which no more than a piece is read at once."""

    def read(self, size: int | None = -1) -> bytes:
        """So many bytes, or all that are left. Raises NotStep."""
        wanted = os.fstat(self.fileno()).st_size - self.tell() if size is None or size < 0 else size
        if wanted > PIECE_BYTES:
            raise NotStep("the archive holds too many files; pack the CAD file alone")
        return super().read(wanted) or b""


@contextmanager
def opened(path: str | os.PathLike[str]) -> Iterator[zipfile.ZipFile]:
    """The archive, to read. Raises NotStep for one that holds too much or is packed in an unusual way, BadZipFile."""
    with _InPieces(path) as file, zipfile.ZipFile(file) as archive:
        if any(member.compress_type not in METHODS for member in archive.infolist()):
            raise NotStep("the archive is compressed with another method than deflate; pack the file anew")
        yield archive
