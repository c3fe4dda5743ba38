"""Stops a request that is too large or too slow while it arrives, before it fills memory, disk or connections."""

from __future__ import annotations

import asyncio
import time

from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from querycad_api.problems import ApiProblem, FileTooLarge, TooLarge, TooSlow, WrongMediaType, problem_response

FORM_BYTES = 64 * 1024
"""What a multipart form adds to its file, generously."""

OTHER_BYTES = 1024 * 1024
"""Of what is no upload: a question has some dozen bytes."""

PAUSE_S = 20.0
"""Longest silence in the middle of a body."""

BYTES_PER_S = 4096
"""How fast a body must arrive on average, apart from one pause."""


class BodyLimit:
    """ASGI middleware: an upload, a multipart form, has at most `max_bytes`, any other body `OTHER_BYTES`."""

    def __init__(self, app: ASGIApp, upload_path: str, max_bytes: int) -> None:
        self._app = app
        self._upload_path = upload_path
        self._upload_bytes = max_bytes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuses by the declared length, and counts what arrives when none is declared."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = dict(scope["headers"])
        coded = headers.get(b"content-encoding", b"identity").decode("latin-1").strip().lower()
        if coded != "identity":  # it would be read as if it were none
            problem = WrongMediaType("a body must not be compressed").problem()
            await problem_response(problem, {"Accept-Encoding": "identity"})(scope, receive, send)
            return
        form = headers.get(b"content-type", b"").lstrip().lower().startswith(b"multipart/form-data")
        is_upload = scope["path"] == self._upload_path and form
        accepted = self._upload_bytes if is_upload else OTHER_BYTES
        max_bytes = accepted + FORM_BYTES
        kind: type[ApiProblem] = FileTooLarge if is_upload else TooLarge
        refused = kind(f"at most {accepted // 2**20} MiB are accepted")
        declared = headers.get(b"content-length", b"0")
        if declared.isdigit() and int(declared) > max_bytes:
            await problem_response(refused.problem())(scope, receive, send)
            return
        arrived, complete, start = 0, False, 0.0

        async def counted() -> Message:
            nonlocal arrived, complete, start
            if complete:
                return await receive()  # it waits for the client to go
            start = start or time.monotonic()  # who begins to read late has let nobody wait
            left_s = PAUSE_S + arrived / BYTES_PER_S - (time.monotonic() - start)
            try:
                message = await asyncio.wait_for(receive(), min(PAUSE_S, max(left_s, 0.0)))
            except TimeoutError:
                slow = TooSlow(f"the body must arrive at {BYTES_PER_S} bytes/s or faster")
                raise HTTPException(408, str(slow)) from slow
            arrived += len(message.get("body", b""))
            complete = not message.get("more_body", False)
            if arrived > max_bytes:
                raise HTTPException(413, str(refused)) from refused  # no other kind gets out of FastAPI's reading
            return message

        await self._app(scope, counted, send)
