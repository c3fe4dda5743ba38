"""Files that segworkers make of models, as responses: pictures and triangles."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from fastapi.responses import Response, StreamingResponse
from pydantic import TypeAdapter

from querycad_api.dependencies import Services
from querycad_api.problems import ServiceUnavailable
from querycad_contracts import ModelTask, TaskName, TaskOutcome

DRAW_S = 60.0
CHUNK_BYTES = 2**18
_FILE_NAME = TypeAdapter(TaskOutcome[str])
_BINARY = {"schema": {"type": "string", "format": "binary"}}
PNG = {"description": "The picture.", "content": {"image/png": _BINARY}}
GLB = {"description": "The model.", "content": {"model/gltf-binary": _BINARY}}


async def drawn(services: Services, name: TaskName, task: ModelTask, media_type: str) -> Response:
    """The file that a segworker makes, or has made before. Raises ModelUnreadable and ServiceUnavailable."""
    made = await services.broker.call(name, task, _FILE_NAME, DRAW_S)
    path = await asyncio.to_thread(services.files.fetch, made)
    try:
        if path is not None:
            return await asyncio.to_thread(whole, path, media_type)
    except FileNotFoundError:
        pass
    raise ServiceUnavailable("the file was made, and is gone again; try again in a moment")


def whole(path: Path, media_type: str) -> Response:
    """The file as a response. It is open already: its model may be deleted meanwhile. Raises FileNotFoundError."""
    file = path.open("rb")
    size = os.fstat(file.fileno()).st_size
    return StreamingResponse(_chunks(file), media_type=media_type, headers={"Content-Length": str(size)})


def _chunks(file: BinaryIO) -> Iterator[bytes]:
    with file:
        while chunk := file.read(CHUNK_BYTES):
            yield chunk
