"""What of a request is seen from outside: its id, one line in the log, its share of the metrics."""

from __future__ import annotations

import logging
import re
import time
from uuid import uuid4

from prometheus_client import CollectorRegistry, Counter, Histogram
from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from querycad_api.problems import problem_response
from querycad_contracts import Problem, working_for

REQUEST_ID = "X-Request-ID"
_GIVEN = re.compile(rb"[A-Za-z0-9._-]{1,64}")
_PROBES = ("/livez", "/readyz", "/metrics")
_FLAW = Problem(title="Internal error", status=500, detail="the request failed; the log says why, under its id")

log = logging.getLogger("querycad_api.access")


class HttpMetrics:
    """How many requests, and how long they took, by method and route."""

    def __init__(self, registry: CollectorRegistry) -> None:
        self._requests = Counter(
            "querycad_http_requests", "Answered HTTP requests.", ("method", "route", "status"), registry=registry
        )
        self._seconds = Histogram(
            "querycad_http_request_seconds",
            "From a request's arrival to the end of its response.",
            ("method", "route"),
            registry=registry,
        )

    def note(self, method: str, route: str, status: int, seconds: float) -> None:
        """Counts one request."""
        self._requests.labels(method, route, str(status)).inc()
        self._seconds.labels(method, route).observe(seconds)


class Observe:
    """ASGI middleware: the request's id is its client's, if it is fit, or made here; the response tells it."""

    def __init__(self, app: ASGIApp, metrics: HttpMetrics) -> None:
        self._app = app
        self._metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Lets the request pass, and notes what came of it; a flaw of ours is a problem with the request's id, too."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        given = next((value for name, value in scope["headers"] if name == b"x-request-id"), b"")
        request = given.decode() if _GIVEN.fullmatch(given) else uuid4().hex
        status, begun, start = 500, False, time.perf_counter()

        async def noting(message: Message) -> None:
            nonlocal status, begun
            if message["type"] == "http.response.start":
                status, begun = message["status"], True
                MutableHeaders(scope=message)[REQUEST_ID] = request
            await send(message)

        with working_for(request):
            try:
                await self._app(scope, receive, noting)
            except Exception:
                if begun:
                    raise
                log.exception("a request failed")
                await problem_response(_FLAW)(scope, receive, noting)
            finally:
                self._note(scope, status, time.perf_counter() - start)

    def _note(self, scope: Scope, status: int, seconds: float) -> None:
        route = getattr(scope.get("route"), "path", "none")
        method = scope["method"] if route != "none" else "any"  # a client's inventions must not become series
        self._metrics.note(method, route, status, seconds)
        if scope["path"] not in _PROBES:
            told = {"method": scope["method"], "path": scope["path"], "status": status, "ms": round(seconds * 1e3, 1)}
            log.info("request", extra=told)
