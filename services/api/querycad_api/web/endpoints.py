"""`/`: a page to see a model and ask about it. It uses the interface as any other client does.

Its sources lie in `web/` at the top of the repository; `make setup` builds them into `dist` beside this module.
"""

from __future__ import annotations

import gzip
import mimetypes
from dataclasses import dataclass
from pathlib import Path

from fastapi import APIRouter, Request, Response

BUILT = Path(__file__).parent / "dist"
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' blob: data:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_HEADERS = {
    "Content-Security-Policy": _POLICY,
    "Referrer-Policy": "no-referrer",
    "Vary": "Accept-Encoding",
    "X-Content-Type-Options": "nosniff",
}
_NAMED_BY_CONTENT = {"Cache-Control": "public, max-age=31536000, immutable"}
_ASKED_FOR_AGAIN = {"Cache-Control": "no-cache"}
_MISSING = b"""<!doctype html>
<html lang="en"><title>QueryCAD</title>
<h1>The page is not built</h1>
<p>The service answers, but its page is not here. <code>make web</code> builds it, and says what stands in the way.
<p>The interface is described at <a href="openapi.json">openapi.json</a>.
"""


@dataclass(frozen=True, slots=True)
class _File:
    """What is sent for a file of the page."""

    body: bytes
    gzipped: bytes
    media_type: str
    caching: dict[str, str]


def pages(built: Path = BUILT) -> APIRouter:
    """The page and the files that it is made of, read once; a page that says so where it was not built."""
    router = APIRouter(include_in_schema=False)
    index = built / "index.html"
    assets = {path.name: _read(path, _NAMED_BY_CONTENT) for path in sorted(built.glob("assets/*"))}
    page = _read(index, _ASKED_FOR_AGAIN) if index.exists() else _File(_MISSING, b"", "text/html", _ASKED_FOR_AGAIN)

    @router.get("/")
    async def get_page(request: Request) -> Response:
        """The page."""
        return _sent(page, request)

    @router.get("/assets/{name}")
    async def get_asset(name: str, request: Request) -> Response:
        """What it looks like and does."""
        return _sent(assets[name], request) if name in assets else Response(status_code=404)

    return router


def _read(path: Path, caching: dict[str, str]) -> _File:
    body = path.read_bytes()
    media_type = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
    return _File(body, gzip.compress(body, mtime=0), media_type, caching)


def _sent(file: _File, request: Request) -> Response:
    zipped = bool(file.gzipped) and "gzip" in request.headers.get("accept-encoding", "").lower()
    encoding = {"Content-Encoding": "gzip"} if zipped else {}
    body = file.gzipped if zipped else file.body
    return Response(body, headers={**_HEADERS, **file.caching, **encoding}, media_type=file.media_type)
