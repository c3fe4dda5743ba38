"""Traces are an option: off, nothing of it is loaded; on, spans go where OpenTelemetry's variables say."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextvars import copy_context
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from querycad_contracts.infrastructure import carried_trace, carry_trace

OFF = """
import sys
from querycad_api.app import make_app
from querycad_api.settings import ApiSettings
from querycad_api import worker
make_app(ApiSettings()), worker.make_app(ApiSettings())
print("opentelemetry.exporter" in sys.modules, "opentelemetry.instrumentation" in sys.modules)
"""
ON = """
import asyncio, httpx
from opentelemetry import trace
from querycad_api.app import make_app
from querycad_api.settings import ApiSettings

async def ask() -> None:
    transport = httpx.ASGITransport(make_app(ApiSettings(traces=True)))
    async with httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1") as client:
        await client.get("/page.css", headers={"traceparent": "00-" + "a" * 32 + "-" + "b" * 16 + "-01"})
        await client.get("/livez")

asyncio.run(ask())
trace.get_tracer_provider().force_flush()
"""


@pytest.fixture
def collector() -> Iterator[tuple[str, list[bytes]]]:
    """Address of something that takes spans, and what it was sent."""
    taken: list[bytes] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            taken.append(self.rfile.read(int(self.headers["Content-Length"])))
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_: object) -> None:
            pass

    with HTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}", taken
        server.shutdown()


def run(code: str, **variables: str) -> str:
    command = [sys.executable, "-c", code]
    return subprocess.run(
        command, env=os.environ | variables, capture_output=True, text=True, check=True, timeout=60
    ).stdout


def test_off_nothing_of_it_is_loaded() -> None:
    assert run(OFF).split() == ["False", "False"]


def test_a_request_is_a_span_of_its_callers_trace(collector: tuple[str, list[bytes]]) -> None:
    from opentelemetry.proto.collector.trace.v1.trace_service_pb2 import ExportTraceServiceRequest

    endpoint, taken = collector
    run(ON, OTEL_EXPORTER_OTLP_ENDPOINT=endpoint, OTEL_EXPORTER_OTLP_COMPRESSION="none")
    exported = [ExportTraceServiceRequest.FromString(body) for body in taken]
    resources = [resource for each in exported for resource in each.resource_spans]
    spans = [span for resource in resources for scope in resource.scope_spans for span in scope.spans]
    named = {(item.key, item.value.string_value) for each in resources for item in each.resource.attributes}
    assert ("service.name", "querycad-api") in named
    served = [span for span in spans if span.kind == span.SPAN_KIND_SERVER]
    assert len(served) == 1  # a probe is no request worth a span
    assert served[0].trace_id.hex() == "a" * 32


def test_a_task_that_was_sent_with_a_carried_trace_is_of_that_trace() -> None:
    from celery.app.task import Context
    from opentelemetry.instrumentation.celery import celery_getter
    from opentelemetry.propagate import extract
    from opentelemetry.trace import get_current_span

    given = {"traceparent": f"00-{'a' * 32}-{'b' * 16}-01", "tracestate": "some=1", "cookie": "secret"}
    sent = copy_context().run(carried, given)
    assert sent.keys() == {"traceparent", "tracestate"}
    found = get_current_span(extract(Context(sent), getter=celery_getter)).get_span_context()
    assert (f"{found.trace_id:032x}", f"{found.span_id:016x}") == ("a" * 32, "b" * 16)


def test_what_is_no_trace_is_not_carried() -> None:
    assert carried_trace() == {}
    assert copy_context().run(carried, {"traceparent": "a\nb", "tracestate": ""}) == {}


def carried(headers: dict[str, str]) -> dict[str, str]:
    carry_trace(headers)
    return carried_trace()
