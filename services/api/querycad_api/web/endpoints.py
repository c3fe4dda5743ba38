"""`/`: a page to upload a model and ask about it. It uses the interface as any other client does."""

from __future__ import annotations

from importlib.resources import files

from fastapi import APIRouter, Response

_TYPES = {"index.html": "text/html", "page.css": "text/css", "page.js": "text/javascript"}
_FILES = {name: files(__package__).joinpath(name).read_bytes() for name in _TYPES}
_HEADERS = {
    "Content-Security-Policy": "default-src 'self'; img-src 'self' blob: data:; frame-ancestors 'none'",
    "Cache-Control": "no-cache",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}

router = APIRouter(include_in_schema=False)


@router.get("/")
async def page() -> Response:
    """The page."""
    return _file("index.html")


@router.get("/page.css")
async def page_style() -> Response:
    """How it looks."""
    return _file("page.css")


@router.get("/page.js")
async def page_script() -> Response:
    """What it does."""
    return _file("page.js")


def _file(name: str) -> Response:
    return Response(_FILES[name], headers=_HEADERS, media_type=_TYPES[name])
