"""`/docs` and `/redoc`: the interface's description to read and to try. All that the pages load is served here."""

from __future__ import annotations

import base64
import hashlib
import re
from importlib.resources import files

from fastapi import APIRouter, Response
from fastapi.openapi.docs import get_redoc_html, get_swagger_ui_html

from querycad_api.problems import NotThere

TITLE = "QueryCAD"
DESCRIBED = "openapi.json"
_TYPES = {
    "swagger-ui-bundle.js": "text/javascript",
    "swagger-ui.css": "text/css",
    "redoc.standalone.js": "text/javascript",
    "favicon.png": "image/png",
}
_FOLDER = files("fastapi_offline") / "static"
"""Swagger UI and ReDoc as that package brings them, of a version that the lock pins."""

router = APIRouter(include_in_schema=False)


@router.get("/docs")
async def swagger_ui() -> Response:
    """To try the interface."""
    page = get_swagger_ui_html(
        openapi_url=DESCRIBED,
        title=TITLE,
        swagger_js_url="docs/swagger-ui-bundle.js",
        swagger_css_url="docs/swagger-ui.css",
        swagger_favicon_url="docs/favicon.png",
    )
    return _page(bytes(page.body))


@router.get("/redoc")
async def redoc() -> Response:
    """To read about the interface."""
    page = get_redoc_html(
        openapi_url=DESCRIBED,
        title=TITLE,
        redoc_js_url="docs/redoc.standalone.js",
        redoc_favicon_url="docs/favicon.png",
        with_google_fonts=False,
    )
    return _page(bytes(page.body))


@router.get("/docs/{name}")
async def asset(name: str) -> Response:
    """What the pages load."""
    if name not in _TYPES:
        raise NotThere("the reference has no such file")
    headers = {"Cache-Control": "public, max-age=86400", "X-Content-Type-Options": "nosniff"}
    return Response((_FOLDER / name).read_bytes(), headers=headers, media_type=_TYPES[name])


def _page(html: bytes) -> Response:
    """The page, which may load what is here and run the one script that is written in it."""
    scripts = re.findall(rb"<script>(.*?)</script>", html, re.DOTALL)
    hashes = (base64.b64encode(hashlib.sha256(script).digest()).decode() for script in scripts)
    policy = "; ".join(
        (
            "default-src 'self'",
            " ".join(("script-src 'self'", *(f"'sha256-{each}'" for each in hashes))),
            "style-src 'self' 'unsafe-inline'",  # both write styles into the page
            "img-src 'self' data:",
            "worker-src 'self' blob:",
            "frame-ancestors 'none'",
        )
    )
    headers = {"Content-Security-Policy": policy, "Cache-Control": "no-cache", "X-Content-Type-Options": "nosniff"}
    return Response(html, headers=headers, media_type="text/html")
