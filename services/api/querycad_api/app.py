"""The HTTP interface: `python -m querycad_api.app`"""

from __future__ import annotations

import asyncio
import logging
import sys
import tempfile
from collections import Counter
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import httpx
import uvicorn
from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from prometheus_client import CollectorRegistry
from pydantic.json_schema import models_json_schema
from redis.asyncio import Redis
from starlette.middleware.cors import CORSMiddleware

from querycad_contracts import JobEvent, Problem
from querycad_contracts.infrastructure import file_store, keep_private, start_logging, start_tracing

from .accounts.gate import Gate
from .accounts.service import Access
from .connections import limits
from .dependencies import Application
from .jobs import endpoints as jobs
from .jobs.redelivery import redeliver
from .models import endpoints as models
from .models import geometry, parameters, programs
from .models.body_limit import BodyLimit
from .models.expiry import expire
from .ops import health, metrics, reference
from .ops.delivery import Compressed, Head, Tagged
from .ops.observability import REQUEST_ID, HttpMetrics, Observe
from .problems import (
    UPLOAD_PATH,
    ApiProblem,
    Malformed,
    NotAllowed,
    NotAsDocumented,
    NotAuthenticated,
    NotThere,
    TooManyRequests,
    add_handlers,
    responses,
)
from .questions import endpoints as questions
from .settings import ApiSettings
from .store.broker import Broker
from .store.state import READ_S, State
from .web.endpoints import pages

INTERFACE_VERSION = "1.0"
"""Of the interface, not of the program: the first number is the one in `/v1`."""
CONNECT_S = 2.0
SILENCE_S = 5.0
"""A store that says nothing for so long is away, though the connection may be open: the request is refused."""
CONNECTIONS = 1000
"""To Redis: one for each client that waits."""
GRACE_S = 10
"""What requests have to end when the process is told to."""
EXIT_BAD_INPUT = 2
GZIP_BYTES, GZIP_LEVEL = 2048, 5
"""What is smaller fits in two packets; a higher level takes three times as long for a tenth less."""

log = logging.getLogger(__name__)


def make_app(settings: ApiSettings) -> FastAPI:
    """The application; it connects when it starts."""
    app = FastAPI(
        title="QueryCAD",
        description="Ask a CAD model a question in plain language and get a precise, grounded answer. SI units.",
        version=INTERFACE_VERSION,
        lifespan=_connected,
        docs_url=None,  # FastAPI's own pages load scripts from elsewhere; `reference` has them here
        redoc_url=None,
        redirect_slashes=False,  # behind a proxy with TLS it would send clients, and their keys, to one without
        generate_unique_id_function=lambda route: route.name,
    )
    app.state.settings = settings
    app.state.registry = CollectorRegistry()
    _add_middleware(app, settings)
    start_tracing("querycad-api", settings.traces, app)
    add_handlers(app)
    for each in (models, geometry, programs, parameters, questions, jobs, metrics):
        app.include_router(each.router, responses=responses(NotAuthenticated, NotAllowed, TooManyRequests))
    for public in (health.router, reference.router, pages()):
        app.include_router(public)
    app.openapi = lambda: _openapi(app, settings.asks_for_keys)  # type: ignore[method-assign]
    return app


@asynccontextmanager
async def _connected(app: FastAPI) -> AsyncIterator[None]:
    """While the context lasts, the application is connected, and does what is done beside requests."""
    settings: ApiSettings = app.state.settings
    redis = Redis.from_url(
        settings.redis_url,
        decode_responses=True,
        max_connections=CONNECTIONS,
        socket_connect_timeout=CONNECT_S,
        socket_timeout=READ_S + SILENCE_S,
    )
    broker = Broker(settings.redis_url, redis)
    state = State(
        redis,
        settings.answers_days,
        settings.tenant_answers,
        settings.tenant_mib * 2**20,
        settings.tenant_answers_mib * 2**20,
    )
    application = app.state.application = Application(settings, state, broker, file_store(settings))
    app.state.access = Access(settings, redis)
    app.state.streams = Counter()
    beside = [asyncio.create_task(each) for each in (redeliver(application), expire(application))]
    token = settings.sandbox_token.get_secret_value()
    headers = {"Authorization": f"Bearer {token}"} if token else {}
    async with httpx.AsyncClient(base_url=settings.sandbox_url, headers=headers) as app.state.sandbox:
        yield
    for task in beside:
        task.cancel()
    await asyncio.gather(*beside, return_exceptions=True)
    broker.close()
    await redis.aclose()


def _add_middleware(app: FastAPI, settings: ApiSettings) -> None:
    """What every request passes through, the innermost first."""
    app.add_middleware(Tagged)
    app.add_middleware(Compressed, minimum_size=GZIP_BYTES, compresslevel=GZIP_LEVEL)
    app.add_middleware(BodyLimit, upload_path=UPLOAD_PATH, max_bytes=settings.upload_mib * 2**20)
    app.add_middleware(Gate)
    app.add_middleware(Head)
    if settings.origins:
        app.add_middleware(
            CORSMiddleware,
            allow_origins=settings.origins,
            allow_methods=["GET", "POST", "DELETE"],
            allow_headers=[
                *("Authorization", "Content-Type", "Prefer", "Idempotency-Key", "Last-Event-ID", REQUEST_ID),
                *("If-None-Match", "Range", "If-Range"),
            ],
            expose_headers=[
                *("Location", "Link", "Preference-Applied", "Retry-After", REQUEST_ID),
                *("ETag", "Accept-Ranges", "Content-Range"),
            ],
        )
    app.add_middleware(Observe, metrics=HttpMetrics(app.state.registry))


def _openapi(app: FastAPI, asks_for_keys: bool) -> dict[str, Any]:
    """The interface's description, with every error as the problem that it is, and keys where they are asked for."""
    if app.openapi_schema is None:
        schema = get_openapi(title=app.title, version=app.version, description=app.description, routes=app.routes)
        schemas = schema["components"]["schemas"]
        for framework_own in ("HTTPValidationError", "ValidationError"):
            schemas.pop(framework_own, None)
        wanted = [(Problem, "serialization"), (JobEvent, "serialization")]
        _, described = models_json_schema(wanted, ref_template="#/components/schemas/{model}")  # type: ignore[arg-type]
        for name, described_schema in described["$defs"].items():
            schemas.setdefault(name, described_schema)
        schemas["Body_upload_model"]["additionalProperties"] = False  # a form with many fields is refused unread
        for path in schema["paths"].values():
            for operation in path.values():
                _document_problems(operation)
                if "security" in operation and not asks_for_keys:
                    operation["security"].append({})  # as OpenAPI says that it may be left out
        events = schema["paths"]["/v1/jobs/{job_id}/events"]["get"]["responses"]["200"]["content"]["text/event-stream"]
        events["itemSchema"]["properties"]["data"] |= {
            "contentMediaType": "application/json",
            "contentSchema": {"$ref": "#/components/schemas/JobEvent"},
        }
        app.openapi_schema = schema
    return app.openapi_schema


def _document_problems(operation: dict[str, Any]) -> None:
    """Says what a request is told that is not as documented: see `problems`, where it is decided."""
    documented: dict[str, Any] = operation["responses"]
    if documented.get("422", {}).get("description") == "Validation Error":  # FastAPI's own
        del documented["422"]
    places = {parameter["in"] for parameter in operation.get("parameters", ())}
    kinds: list[type[ApiProblem]] = [NotThere] * ("path" in places) + [Malformed] * bool(places & {"query", "header"})
    kinds += [NotAsDocumented] * ("requestBody" in operation)
    for status, entry in responses(*kinds).items():
        documented.setdefault(str(status), entry)


def main() -> None:
    """Serves until told to stop."""
    settings = ApiSettings.read()
    keep_private()
    start_logging("api", settings.log_format)
    if not settings.on_loopback and not settings.asks_for_keys:
        log.error("QUERYCAD_AUTH is off, and QUERYCAD_API_HOST is not loopback: everybody could read everything")
        sys.exit(EXIT_BAD_INPUT)
    # Starlette's copy of an upload goes where there is room for it: `/tmp` may be memory.
    settings.home.mkdir(parents=True, exist_ok=True)
    tempfile.tempdir = str(settings.home)
    uvicorn.run(
        make_app(settings),
        host=settings.api_host,
        port=settings.api_port,
        access_log=False,
        log_config=None,
        timeout_graceful_shutdown=GRACE_S,
        **limits(settings.api_connections, settings.api_address_connections),
    )


if __name__ == "__main__":
    main()
