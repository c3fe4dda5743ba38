"""The HTTP interface: `python -m querycad_api.app`"""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import httpx
import uvicorn
from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from redis.asyncio import Redis

from querycad_contracts import Problem

from . import health
from .broker import Broker
from .dependencies import Services
from .jobs import endpoints as jobs
from .models import endpoints as models
from .models.limit import BodyLimit
from .problems import PROBLEM_SCHEMA, add_handlers
from .questions import endpoints as questions
from .settings import ApiSettings
from .state import State

INTERFACE_VERSION = "1.0"
"""Of the interface, not of the program: the first number is the one in `/v1`."""
CONNECT_S = 2.0
CONNECTIONS = 1000
"""To Redis: one for each client that waits."""


def make_app(settings: ApiSettings) -> FastAPI:
    """The application; it connects when it starts."""

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        redis = Redis.from_url(
            settings.redis_url,
            decode_responses=True,
            max_connections=CONNECTIONS,
            socket_connect_timeout=CONNECT_S,
            socket_timeout=None,
        )
        broker = Broker(settings.redis_url, redis)
        app.state.services = Services(settings, State(redis, settings.answers_days), broker)
        async with httpx.AsyncClient(base_url=settings.sandbox_url) as app.state.sandbox:
            yield
        broker.close()
        await redis.aclose()

    app = FastAPI(
        title="QueryCAD",
        description="Ask a CAD model a question in plain language and get a precise, grounded answer. SI units.",
        version=INTERFACE_VERSION,
        lifespan=lifespan,
        docs_url=None,  # these pages load scripts from elsewhere
        redoc_url=None,
        generate_unique_id_function=lambda route: route.name,
    )
    app.add_middleware(BodyLimit, upload_path="/v1/models", max_bytes=settings.upload_mib * 2**20)
    add_handlers(app)
    for each in (models, questions, jobs, health):
        app.include_router(each.router)
    app.openapi = lambda: _openapi(app)  # type: ignore[method-assign]
    return app


def _openapi(app: FastAPI) -> dict[str, Any]:
    """The interface's description, with every error as the problem that it is."""
    if app.openapi_schema is None:
        schema = get_openapi(title=app.title, version=app.version, description=app.description, routes=app.routes)
        schemas = schema["components"]["schemas"]
        for framework_own in ("HTTPValidationError", "ValidationError"):
            schemas.pop(framework_own, None)
        schemas["Problem"] = Problem.model_json_schema(ref_template="#/components/schemas/{model}")
        for path in schema["paths"].values():
            for operation in path.values():
                _document_problems(operation["responses"])
        app.openapi_schema = schema
    return app.openapi_schema


def _document_problems(documented: dict[str, Any]) -> None:
    for status, entry in documented.items():
        if status == "422":
            entry["content"] = PROBLEM_SCHEMA
            if entry["description"] == "Validation Error":
                entry["description"] = "The request is not as documented."


def main() -> None:
    """Serves until told to stop."""
    settings = ApiSettings.read()
    uvicorn.run(
        make_app(settings),
        host=settings.api_host,
        port=settings.api_port,
        access_log=False,
        timeout_graceful_shutdown=10,
    )


if __name__ == "__main__":
    main()
