"""The sandbox as a service: `python -m querycad_sandbox.service`

`POST /runs` takes a RunRequest and answers 200 with a RunOutcome, however the program ended: an HTTP error says that it
could not be run at all. Problems are `application/problem+json`.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager

import uvicorn
from pydantic import ValidationError
from redis.asyncio import Redis
from redis.exceptions import RedisError
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from querycad_contracts import Health, Problem, RunOutcome, RunRequest, TaskFailureKind

from .remote import Caller, QueueCaller, RemoteSegCad, SegCadFailed, SegCadUnavailable
from .sandbox import Sandbox
from .settings import SandboxSettings

BODY_BYTES = 2**20
"""Far over the longest program that is run."""
REDIS_S = 2.0

log = logging.getLogger(__name__)


def make_app(settings: SandboxSettings, call: Caller | None = None) -> Starlette:
    """The service; `call` stands in for the queue."""
    runs = _Runs(settings, call)
    routes = [
        Route("/runs", runs.run, methods=["POST"]),
        Route("/livez", _alive),
        Route("/readyz", runs.ready),
    ]
    return Starlette(routes=routes, lifespan=runs.lifespan)


class _Runs:
    def __init__(self, settings: SandboxSettings, call: Caller | None) -> None:
        self._settings = settings
        self._call = call or QueueCaller(settings.redis_url)
        self._sandbox = Sandbox(workers=settings.sandbox_runs)
        self._threads = ThreadPoolExecutor(settings.sandbox_runs, thread_name_prefix="run")
        self._redis = Redis.from_url(settings.redis_url, socket_timeout=REDIS_S, socket_connect_timeout=REDIS_S)
        self._warm = False

    @asynccontextmanager
    async def lifespan(self, _: Starlette) -> AsyncIterator[None]:
        """Starts the interpreter's processes, and ends them."""
        await asyncio.to_thread(self._sandbox.warm)
        self._warm = True
        yield
        self._warm = False
        self._threads.shutdown(wait=True, cancel_futures=True)
        self._sandbox.close()
        if isinstance(self._call, QueueCaller):
            self._call.close()
        await self._redis.aclose()

    async def run(self, request: Request) -> Response:
        """`POST /runs`: what comes of the program?"""
        body = await _body(request)
        if body is None:
            return _problem(413, "Request too large", f"a request has at most {BODY_BYTES:,} bytes")
        try:
            asked = RunRequest.model_validate_json(body)
        except ValidationError as error:
            lines = tuple(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors())
            return _problem(422, "Not a run request", errors=lines)
        try:
            loop = asyncio.get_running_loop()
            outcome = await loop.run_in_executor(self._threads, self._run, asked)
        except SegCadUnavailable as error:
            return _problem(503, "SegCAD unavailable", str(error), retryable=True)
        except SegCadFailed as error:
            status = 422 if error.failure.kind is TaskFailureKind.FILE else 502
            return _problem(status, "SegCAD failed", error.failure.message, retryable=error.failure.retryable)
        except Exception:
            log.exception("a run failed")
            return _problem(500, "Internal error", "the program could not be run", retryable=True)
        return Response(outcome.model_dump_json(), media_type="application/json")

    def _run(self, asked: RunRequest) -> RunOutcome:
        segcad = RemoteSegCad(asked.model, self._call, self._settings)
        return self._sandbox.run(asked.code, segcad, asked.limits, asked.expects)

    async def ready(self, _: Request) -> Response:
        """`GET /readyz`: can programs be run now?"""
        try:
            broker = bool(await self._redis.ping())
        except (RedisError, OSError):
            broker = False
        health = Health(ready=self._warm and broker, checks={"broker": broker, "interpreter": self._warm})
        return Response(health.model_dump_json(), 200 if health.ready else 503, media_type="application/json")


async def _alive(_: Request) -> Response:
    """`GET /livez`: does the process answer?"""
    return Response(Health(ready=True).model_dump_json(), media_type="application/json")


async def _body(request: Request) -> bytes | None:
    body = bytearray()
    async for chunk in request.stream():
        body += chunk
        if len(body) > BODY_BYTES:
            return None
    return bytes(body)


def _problem(
    status: int, title: str, detail: str = "", errors: tuple[str, ...] = (), retryable: bool = False
) -> Response:
    problem = Problem(title=title, status=status, detail=detail, errors=errors, retryable=retryable)
    return Response(problem.model_dump_json(), status, media_type="application/problem+json")


def main() -> None:
    """Serves until told to stop; SIGTERM lets running programs end."""
    settings = SandboxSettings.read()
    uvicorn.run(
        make_app(settings),
        host=settings.sandbox_host,
        port=settings.sandbox_port,
        access_log=False,
        timeout_graceful_shutdown=10,
    )


if __name__ == "__main__":
    main()
