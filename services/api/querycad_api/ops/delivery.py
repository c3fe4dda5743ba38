"""How responses are delivered, whichever endpoint they are of: HEAD, and tags by which clients ask for news."""

from __future__ import annotations

import hashlib
from http import HTTPStatus

from starlette.datastructures import Headers, MutableHeaders
from starlette.middleware.gzip import GZipMiddleware
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from querycad_api.problems import STREAM

REVALIDATED = "private, no-cache"
"""Of what may change, such as a job: it may be kept, and is asked for again by its tag."""


class Head:
    """ASGI middleware: HEAD is GET without the body (RFC 9110, 9.3.2). A stream has none: it would not end."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes the request on as GET, and keeps its body back."""
        if scope["type"] != "http" or scope["method"] != "HEAD" or scope["path"].endswith(STREAM):
            await self._app(scope, receive, send)
            return

        async def without_body(message: Message) -> None:
            if message["type"] == "http.response.body":
                message = {**message, "body": b""}
            await send(message)

        inner = {**scope, "method": "GET"}
        try:
            await self._app(inner, receive, without_body)
        finally:
            if "route" in inner:
                scope["route"] = inner["route"]  # who counts requests looks here


class Compressed(GZipMiddleware):
    """ASGI middleware: compresses for who takes it. A stream's head is not held back until its first event."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Compresses a response, unless it is a stream."""
        is_stream = scope["type"] == "http" and scope["path"].endswith(STREAM)
        await (self.app if is_stream else super().__call__)(scope, receive, send)


class Tagged:
    """ASGI middleware: JSON that is read gets a tag of its content; whoever has it already is told so, 304.

    What has a tag of its own, such as a file, keeps it. Weak tags: the same content may come compressed.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Holds the beginning of a response back until its tag is known."""
        if scope["type"] != "http" or scope["method"] != "GET" or scope["path"].endswith(STREAM):
            await self._app(scope, receive, send)
            return
        held: Message | None = None
        known = Headers(scope=scope).get("if-none-match", "")
        passed_over = False

        async def tagging(message: Message) -> None:
            nonlocal held, passed_over
            if message["type"] == "http.response.start":
                held = message
                return
            if held is not None:
                start, held = held, None
                headers = MutableHeaders(scope=start)
                if start["status"] == HTTPStatus.OK:
                    is_json = headers.get("content-type", "").startswith("application/json")
                    if "etag" not in headers and is_json and not message.get("more_body"):
                        digest = hashlib.sha256(message.get("body", b"")).hexdigest()[:32]
                        headers["ETag"] = f'W/"{digest}"'
                        headers.setdefault("Cache-Control", REVALIDATED)
                    if matches(known, headers.get("etag", "")):
                        start["status"] = HTTPStatus.NOT_MODIFIED.value
                        passed_over = True
                        for name in ("content-length", "content-type"):
                            del headers[name]
                await send(start)
            if message["type"] == "http.response.body" and passed_over:
                message = {**message, "body": b""}
            await send(message)

        await self._app(scope, receive, tagging)


def matches(known: str, tag: str) -> bool:
    """Does the client have the content with this tag? By weak comparison (RFC 9110, 13.1.2)."""
    wanted = {each.strip().removeprefix("W/") for each in known.split(",")}
    return bool(tag) and ("*" in wanted or tag.removeprefix("W/") in wanted)
