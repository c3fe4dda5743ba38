"""Stops a request that is too large while it arrives, before it fills memory or disk."""

from __future__ import annotations

from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from querycad_api.problems import ApiProblem, FileTooLarge, TooLarge, problem_response

FORM_BYTES = 64 * 1024
"""What a multipart form adds to its file, generously."""

OTHER_BYTES = 1024 * 1024
"""Of what is no upload: a question has some dozen bytes."""


class BodyLimit:
    """ASGI middleware: an upload has at most `max_bytes`, any other request's body `OTHER_BYTES`."""

    def __init__(self, app: ASGIApp, upload_path: str, max_bytes: int) -> None:
        self._app = app
        self._upload_path = upload_path
        self._upload_bytes = max_bytes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuses by the declared length, and counts what arrives when none is declared."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        is_upload = scope["path"] == self._upload_path
        accepted = self._upload_bytes if is_upload else OTHER_BYTES
        max_bytes = accepted + FORM_BYTES
        kind: type[ApiProblem] = FileTooLarge if is_upload else TooLarge
        problem = kind(f"at most {accepted // 2**20} MiB are accepted")
        declared = next((value for name, value in scope["headers"] if name == b"content-length"), b"0")
        if declared.isdigit() and int(declared) > max_bytes:
            await problem_response(problem.problem())(scope, receive, send)
            return
        arrived = 0

        async def counted() -> Message:
            nonlocal arrived
            message = await receive()
            arrived += len(message.get("body", b""))
            if arrived > max_bytes:
                raise HTTPException(413, str(problem)) from problem  # no other kind gets out of FastAPI's reading
            return message

        await self._app(scope, counted, send)
