"""Files that segworkers make of models, as responses: pictures and triangles. What has a name there never changes."""

from __future__ import annotations

import asyncio
import hashlib
import os
import re
from collections.abc import Iterator, Mapping
from http import HTTPStatus
from pathlib import Path
from typing import Any, BinaryIO

from fastapi.responses import Response, StreamingResponse

from querycad_api.dependencies import Services
from querycad_api.ops.delivery import matches
from querycad_api.problems import RangeNotSatisfiable, ServiceUnavailable, responses
from querycad_contracts import ModelTask, TaskName, TaskOutcome
from querycad_contracts.infrastructure import compressed_name

from .service import called

DRAW_S = 60.0
CHUNK_BYTES = 2**18
KEPT = "private, max-age=31536000, immutable"
"""Of what is made of a file's content alone: its address has the content's hash (RFC 8246)."""
COMPRESSED = ("model/gltf-binary",)
"""What segworkers write compressed as well; a PNG file is compressed as it is."""

_FILE_NAME = TaskOutcome[str]
_BINARY = {"schema": {"type": "string", "format": "binary"}}
_RANGE = re.compile(r"bytes=(\d{0,18})-(\d{0,18})")


def _documented(what: str, media_type: str) -> dict[int | str, dict[str, Any]]:
    content = {media_type: _BINARY}
    return responses(RangeNotSatisfiable) | {
        200: {"description": f"{what}. `ETag`, `Cache-Control: immutable`.", "content": content},
        206: {"description": "The bytes that `Range` asks for.", "content": content},
        304: {"description": "The client has it, by `If-None-Match`."},
    }


PNG = _documented("The picture", "image/png")
GLB = _documented("The model", "model/gltf-binary")


async def drawn(
    services: Services, name: TaskName, task: ModelTask, media_type: str, asked: Mapping[str, str]
) -> Response:
    """The file that a segworker makes, or has made before. Raises as `called` does.

    `asked` are the request's headers; a range of the file may be asked for.
    """
    made = await called(services, name, task, _FILE_NAME, DRAW_S)
    path = await asyncio.to_thread(services.files.fetch, made)
    try:
        if path is not None:
            tag = hashlib.sha256(made.encode()).hexdigest()[:32]
            takes_packed = media_type in COMPRESSED and "gzip" in asked.get("accept-encoding", "")
            packed = await asyncio.to_thread(services.files.fetch, compressed_name(made)) if takes_packed else None
            return await asyncio.to_thread(whole, path, media_type, tag, asked, packed)
    except FileNotFoundError:
        pass
    raise ServiceUnavailable("the file was made, and is gone again; try again in a moment")


def whole(path: Path, media_type: str, tag: str, asked: Mapping[str, str], packed: Path | None = None) -> Response:
    """The file as a response, or the one range of it that is asked for (RFC 9110, 14).

    `packed` is the same file compressed by gzip, for a client that takes that; a range is always of the plain file.
    The file is open already: its model may be deleted meanwhile. Raises FileNotFoundError and RangeNotSatisfiable.
    """
    etag = f'"{tag}"'
    headers = {"ETag": etag, "Cache-Control": KEPT, "Accept-Ranges": "bytes"}
    if packed is not None and "range" not in asked:
        path = packed
        headers |= {"ETag": f"W/{etag}", "Content-Encoding": "gzip"}
    if media_type in COMPRESSED:
        headers["Vary"] = "Accept-Encoding"
    file = path.open("rb")
    size = os.fstat(file.fileno()).st_size
    wanted = _range(asked, etag, size)
    if matches(asked.get("if-none-match", ""), etag):
        file.close()
        return Response(status_code=HTTPStatus.NOT_MODIFIED, headers=headers)
    first, end = wanted or (0, size)
    if first >= end and wanted is not None:
        file.close()
        raise RangeNotSatisfiable(size)
    if wanted is not None:
        headers["Content-Range"] = f"bytes {first}-{end - 1}/{size}"
    headers["Content-Length"] = str(end - first)
    status = HTTPStatus.OK if wanted is None else HTTPStatus.PARTIAL_CONTENT
    return StreamingResponse(_chunks(file, first, end), status, headers, media_type)


def _range(asked: Mapping[str, str], etag: str, size: int) -> tuple[int, int] | None:
    """From which byte, and before which? None: the whole file, as for several ranges or one of another file."""
    found = _RANGE.fullmatch(asked.get("range", "").strip())
    if found is None or found.groups() == ("", "") or asked.get("if-range", etag) != etag:
        return None
    first, last = found.groups()
    if not first:  # so many at the end
        return max(0, size - int(last)), size
    return int(first), min(size, int(last) + 1) if last else size


def _chunks(file: BinaryIO, first: int, end: int) -> Iterator[bytes]:
    with file:
        file.seek(first)
        while first < end and (chunk := file.read(min(CHUNK_BYTES, end - first))):
            first += len(chunk)
            yield chunk
