"""OpenTelemetry traces, an option: one trace a request, through api, queues, sandbox and segworkers.

Off, nothing of OpenTelemetry is imported. On (`QUERYCAD_TRACES=1`), the extra `traces` has to be installed; where spans
go is told by OpenTelemetry's own variables, such as OTEL_EXPORTER_OTLP_ENDPOINT. The sandbox, which can send nothing
anywhere, has no spans: it hands the trace that a run belongs to on to the segworkers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from contextvars import ContextVar
from typing import Any, Final

_CONTEXT: Final = {"traceparent": re.compile(r"[0-9a-f]{2}(-[0-9a-f]+){3}"), "tracestate": re.compile(r"[ -~]{1,512}")}
"""The headers of W3C Trace Context, and what may be in them."""

_SPANS: Final[list[Callable[[dict[str, str]], None]]] = []
"""What writes the open span into headers; none in a process that has no spans."""
_CARRIED: ContextVar[Mapping[str, str]] = ContextVar("querycad_trace", default={})  # noqa: B039 - never changed


def carry_trace(headers: Mapping[str, str]) -> None:
    """Notes in this context to which trace all that is done now belongs, as an HTTP request's headers tell it."""
    _CARRIED.set({name: value for name in _CONTEXT if _CONTEXT[name].fullmatch(value := headers.get(name, ""))})


def carried_trace() -> dict[str, str]:
    """With which headers is the trace handed on? The open span's where this process has spans; none without a trace."""
    headers = dict(_CARRIED.get())
    for inject in _SPANS:
        inject(headers)
    return headers


def start_tracing(service: str, wanted: bool, app: Any) -> None:
    """Traces a web service: its requests, the tasks that it sends, the requests that it makes."""
    if not wanted:
        return
    from opentelemetry.instrumentation.asgi import OpenTelemetryMiddleware
    from opentelemetry.instrumentation.threading import ThreadingInstrumentor

    _export(service)
    ThreadingInstrumentor().instrument()  # tasks are sent, and programs run, in threads
    app.add_middleware(OpenTelemetryMiddleware, excluded_urls="livez,readyz,metrics")


def start_worker_tracing(service: str, wanted: bool) -> None:
    """Traces a Celery worker: its tasks, and the requests and tasks that they lead to."""
    if not wanted:
        return
    from celery.signals import worker_process_init

    # after the fork: what exports spans is a thread
    worker_process_init.connect(lambda **_: _export(service), weak=False)


def _export(service: str) -> None:
    from opentelemetry import trace
    from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
    from opentelemetry.instrumentation.celery import CeleryInstrumentor
    from opentelemetry.instrumentation.httpx import HTTPXClientInstrumentor
    from opentelemetry.propagate import inject
    from opentelemetry.sdk.resources import Resource
    from opentelemetry.sdk.trace import TracerProvider
    from opentelemetry.sdk.trace.export import BatchSpanProcessor

    provider = TracerProvider(resource=Resource.create({"service.name": service}))
    provider.add_span_processor(BatchSpanProcessor(OTLPSpanExporter()))
    trace.set_tracer_provider(provider)
    _SPANS[:] = [inject]
    CeleryInstrumentor().instrument()  # type: ignore[no-untyped-call]
    HTTPXClientInstrumentor().instrument()
