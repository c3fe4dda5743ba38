"""The sandbox over HTTP.

`POST /runs`        takes a RunRequest and answers 200 with a RunOutcome, however the program ended; an HTTP error says
                    that it could not be run at all. With `Accept: text/event-stream` it answers with a RunEvent for
                    each thing that happens, the outcome last. Who hangs up cancels.
`DELETE /runs/{id}` cancels a run; its outcome, where it is waited for, is `cancelled`.
`GET /livez`, `GET /readyz`

Problems are `application/problem+json`.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager
from contextvars import copy_context
from hmac import compare_digest

from pydantic import ValidationError
from redis.asyncio import Redis
from redis.exceptions import RedisError
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse
from starlette.routing import Route

from querycad_contracts import (
    Health,
    Problem,
    ProblemError,
    RunEnded,
    RunEvent,
    RunFailed,
    RunOutcome,
    RunRequest,
    RunStarted,
    TaskFailureKind,
    working_for,
)
from querycad_contracts.infrastructure import Walls, WallsMissing, carry_trace

from .control import RunControl
from .remote import Caller, QueueCaller, RemotePartFinder, SegworkerFailed, SegworkerUnavailable
from .sandbox import Sandbox
from .settings import LOOPBACK, SandboxSettings

BODY_BYTES = 2 * 2**20
"""Over the longest program that any limit lets run, as JSON."""
QUEUED = 8
"""Runs that may wait for their turn, for each that may be under way; more are asked to come again."""
REDIS_S = 2.0
JSON = "application/json"
SIGN_OF_LIFE_S = 15.0
"""Between two lines of a stream, so that nothing between here and the client takes it for dead."""

log = logging.getLogger(__name__)


class SandboxHealth(Health):
    """The service's health, and which walls stand around what it runs."""

    layers: dict[str, bool]
    walls: Walls
    missing: tuple[str, ...]
    """Walls that are not up; with `walls` available, programs run without them."""


class NotRun(Exception):
    """The program could not be run; `problem` says why."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.detail or problem.title)
        self.problem = problem


def make_app(
    settings: SandboxSettings, call: Caller | None = None, service_layers: dict[str, bool] | None = None
) -> Starlette:
    """The service; `call` stands in for the queue, `service_layers` are the walls around this process itself."""
    runs = _Runs(settings, call, service_layers or {})
    routes = [
        Route("/runs", runs.post, methods=["POST"]),
        Route("/runs/{run}", runs.delete, methods=["DELETE"]),
        Route("/livez", _alive),
        Route("/readyz", runs.ready),
    ]
    return Starlette(routes=routes, lifespan=runs.lifespan)


class _Runs:
    def __init__(self, settings: SandboxSettings, call: Caller | None, service_layers: dict[str, bool]) -> None:
        self._settings = settings
        self._call = call or QueueCaller(settings.redis_url)
        self._sandbox = Sandbox(settings.sandbox_processes, settings.walls)
        self._threads = ThreadPoolExecutor(settings.sandbox_runs, thread_name_prefix="run")
        self._redis = Redis.from_url(settings.redis_url, socket_timeout=REDIS_S, socket_connect_timeout=REDIS_S)
        self._service_layers = service_layers
        self._under_way: dict[str, RunControl] = {}
        self._warm = False

    @asynccontextmanager
    async def lifespan(self, _: Starlette) -> AsyncIterator[None]:
        """Starts the interpreter's processes, and ends them."""
        try:
            await asyncio.to_thread(self._sandbox.warm)
            self._warm = self._walled()
        except WallsMissing as error:
            log.error("%s", error)
        for name, holds in self._layers().items():
            log.log(logging.INFO if holds else logging.WARNING, "layer %s: %s", name, "holds" if holds else "missing")
        yield
        self._warm = False
        for control in list(self._under_way.values()):  # they had the time that uvicorn gives requests to end
            control.cancel()
        self._threads.shutdown(wait=True, cancel_futures=True)
        self._sandbox.close()
        if isinstance(self._call, QueueCaller):
            self._call.close()
        await self._redis.aclose()

    async def post(self, request: Request) -> Response:
        """`POST /runs`: what comes of the program?"""
        body = None if (refused := self._refused(request)) else await _body(request)
        if body is None:
            too_large = Problem(title="Request too large", status=413, detail=f"at most {BODY_BYTES:,} bytes")
            return refused or _problem(too_large)
        try:
            asked = RunRequest.model_validate_json(body)
        except ValidationError as error:
            detail = "; ".join(f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors())
            told = tuple(ProblemError.in_body(each["loc"], each["msg"]) for each in error.errors())
            return _problem(Problem(title="Not a run request", status=422, detail=detail, errors=told))
        carry_trace(request.headers)
        if not self._walled():
            detail = f"walls are not up: {', '.join(self._missing())}"
            return _problem(Problem(title="Walls missing", status=503, detail=detail, retryable=True))
        if asked.run in self._under_way:
            return _problem(Problem(title="Run exists", status=409, detail=f"run {asked.run} is under way"))
        if len(self._under_way) >= (1 + QUEUED) * self._settings.sandbox_runs:
            return _problem(Problem(title="Busy", status=503, detail="too many runs; try again", retryable=True))
        if "text/event-stream" in request.headers.get("accept", ""):
            return StreamingResponse(
                self._events(asked), media_type="text/event-stream", headers={"Cache-Control": "no-store"}
            )
        try:
            outcome = await self._watched(asked, request)
        except NotRun as error:
            return _problem(error.problem)
        return Response(outcome.model_dump_json(), media_type="application/json", headers={"Run-Id": asked.run})

    def _refused(self, request: Request) -> Response | None:
        """Why may this request run nothing? A page of a browser, another site's name, no token, no JSON."""
        token = self._settings.sandbox_token.get_secret_value()
        given = request.headers.get("authorization", "").removeprefix("Bearer ")
        if token and not compare_digest(given.encode(), token.encode()):
            return _problem(Problem(title="No valid token", status=401, detail="send the sandbox's token"))
        if "origin" in request.headers:
            return _problem(Problem(title="Not allowed", status=403, detail="requests from browsers are refused"))
        if not token and request.url.hostname not in LOOPBACK:
            return _problem(Problem(title="Not allowed", status=403, detail="without a token, for this machine alone"))
        sent = request.headers.get("content-type", JSON).partition(";")[0].strip().lower()
        if request.method == "POST" and sent != JSON:
            return _problem(Problem(title="Unsupported media type", status=415, detail=f"the body must be {JSON}"))
        return None

    async def delete(self, request: Request) -> Response:
        """`DELETE /runs/{run}`: 204; 404 when no such run is under way."""
        if refused := self._refused(request):
            return refused
        control = self._under_way.get(request.path_params["run"])
        if control is None:
            return _problem(Problem(title="No such run", status=404, detail="it has ended, or never began"))
        await asyncio.to_thread(control.cancel)
        return Response(status_code=204)

    async def _watched(self, asked: RunRequest, request: Request) -> RunOutcome:
        """What comes of the program; a client that hangs up cancels it. Raises NotRun."""
        control = RunControl()
        run = asyncio.ensure_future(self._run(asked, control))
        gone = asyncio.ensure_future(request.receive())
        await asyncio.wait({run, gone}, return_when=asyncio.FIRST_COMPLETED)
        gone.cancel()
        if not run.done():
            await asyncio.to_thread(control.cancel)
        return await run

    async def _events(self, asked: RunRequest) -> AsyncIterator[str]:
        """What happens in the run, as server-sent events; a client that hangs up cancels it."""
        happened: asyncio.Queue[RunEvent] = asyncio.Queue()
        loop = asyncio.get_running_loop()

        def hear(event: RunEvent) -> None:
            loop.call_soon_threadsafe(happened.put_nowait, event)

        control = RunControl(hear)
        run = asyncio.ensure_future(self._run(asked, control))
        run.add_done_callback(lambda done: happened.put_nowait(_last(done)))
        try:
            yield _line(RunStarted(run=asked.run))
            while True:
                try:
                    event = await asyncio.wait_for(happened.get(), SIGN_OF_LIFE_S)
                except TimeoutError:
                    yield ": still running\n\n"
                    continue
                yield _line(event)
                if isinstance(event, RunEnded | RunFailed):
                    return
        finally:
            if not run.done():
                loop.run_in_executor(None, control.cancel)

    async def _run(self, asked: RunRequest, control: RunControl) -> RunOutcome:
        """Runs the program in a thread of its own. Raises NotRun."""
        self._under_way[asked.run] = control
        loop = asyncio.get_running_loop()
        try:
            return await loop.run_in_executor(self._threads, copy_context().run, self._run_here, asked, control)
        except asyncio.CancelledError:
            control.cancel()
            raise
        except SegworkerUnavailable as error:
            raise NotRun(
                Problem(title="Segworker unavailable", status=503, detail=str(error), retryable=True)
            ) from error
        except SegworkerFailed as error:
            statuses = {TaskFailureKind.FILE: 422, TaskFailureKind.NOT_READ: 409}
            status = statuses.get(error.failure.kind, 502)
            problem = Problem(title="Segworker failed", status=status, detail=error.failure.message)
            raise NotRun(problem.model_copy(update={"retryable": error.failure.retryable})) from error
        except Exception as error:
            log.exception("a run failed")
            problem = Problem(title="Internal error", status=500, detail="the program could not be run", retryable=True)
            raise NotRun(problem) from error
        finally:
            self._under_way.pop(asked.run, None)

    def _run_here(self, asked: RunRequest, control: RunControl) -> RunOutcome:
        with working_for(asked.request):
            finder = RemotePartFinder(asked.model, self._call, self._settings, control, asked.grounding)
            outcome = self._sandbox.run(asked.code, finder, asked.limits, asked.expects, control, asked.check)
            told = {"run": asked.run, "status": outcome.status.value, "ms": outcome.duration_ms}
            log.info("run done", extra=told)
            return outcome

    def _layers(self) -> dict[str, bool]:
        return {**self._sandbox.layers, **{f"service_{name}": holds for name, holds in self._service_layers.items()}}

    def _missing(self) -> tuple[str, ...]:
        """Walls that are not up. Of the service's own, Landlock: its interpreters become nobody where it stays root."""
        own = () if self._service_layers.get("landlock", True) else ("service_landlock",)
        return (*self._sandbox.missing, *own)

    def _walled(self) -> bool:
        """May programs be run?"""
        return self._settings.walls is Walls.AVAILABLE or not self._missing()

    async def ready(self, _: Request) -> Response:
        """`GET /readyz`: can programs be run now, and behind which walls?"""
        try:
            broker = bool(await self._redis.ping())
        except (RedisError, OSError):
            broker = False
        checks = {"broker": broker, "interpreter": self._warm, "walls": self._walled()}
        health = SandboxHealth(
            ready=all(checks.values()),
            checks=checks,
            layers=self._layers(),
            walls=self._settings.walls,
            missing=self._missing(),
        )
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


def _last(run: asyncio.Future[RunOutcome]) -> RunEvent:
    """The event that ends a stream."""
    error = None if run.cancelled() else run.exception()
    if error is None and not run.cancelled():
        return RunEnded(outcome=run.result())
    stopped = Problem(title="Internal error", status=500, detail="the run was stopped", retryable=True)
    return RunFailed(problem=error.problem if isinstance(error, NotRun) else stopped)


def _line(event: RunEvent) -> str:
    return f"event: {event.kind}\ndata: {event.model_dump_json()}\n\n"


def _problem(problem: Problem) -> Response:
    return Response(problem.model_dump_json(), problem.status, media_type="application/problem+json")
