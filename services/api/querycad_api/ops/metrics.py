"""`/metrics`: what Prometheus reads.

Requests are counted by each api process. Questions are counted in the store, by all question workers together, so that
one api tells of all of them: of several apis, take the maximum and not the sum.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from fastapi import APIRouter, Request, Response
from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily, Metric
from prometheus_client.registry import Collector

from querycad_api.accounts.dependencies import OperatorDep
from querycad_api.dependencies import Application
from querycad_api.problems import ServiceUnavailable, responses
from querycad_api.store.ledger import BUCKETS_S
from querycad_contracts import Queue

router = APIRouter(tags=["health"])


@router.get(
    "/metrics",
    response_class=Response,
    responses={
        **responses(ServiceUnavailable),
        200: {"description": "Prometheus' text format.", "content": {"text/plain": {"schema": {"type": "string"}}}},
    },
)
async def get_metrics(request: Request, _operator: OperatorDep) -> Response:
    """How many requests and questions, how long they took, how many wait."""
    application: Application = request.app.state.application
    totals, waiting = await application.state.totals(*(queue.value for queue in Queue))
    registry: CollectorRegistry = request.app.state.registry
    shared = CollectorRegistry()
    shared.register(_Shared(totals, waiting))
    return Response(generate_latest(registry) + generate_latest(shared), media_type=CONTENT_TYPE_LATEST)


class _Shared(Collector):
    """What is counted in the store."""

    def __init__(self, totals: dict[str, float], waiting: dict[str, int]) -> None:
        self._totals = totals
        self._waiting = waiting

    def collect(self) -> Iterator[Metric]:
        """The metrics."""
        questions = CounterMetricFamily("querycad_questions", "Questions that are done.", labels=["status", "failure"])
        steps = CounterMetricFamily("querycad_step_seconds", "Time that questions' steps took.", labels=["step"])
        done = 0.0
        for name, value in sorted(self._totals.items()):
            kind, _, rest = name.partition(":")
            if kind == "questions":
                status, _, failure = rest.partition(":")
                questions.add_metric([status, failure], value)
                done += value if failure != "cancelled" else 0.0
            elif kind == "step_ms":
                steps.add_metric([rest], value / 1e3)
        yield questions
        yield steps
        known = defaultdict(float, self._totals)
        buckets = [(f"{bound:g}", known[f"seconds_le:{bound:g}"]) for bound in BUCKETS_S]
        yield HistogramMetricFamily(
            "querycad_question_seconds",
            "From a question's acceptance to its answer.",
            buckets=[*buckets, ("+Inf", done)],
            sum_value=known["seconds"],
        )
        tasks = GaugeMetricFamily("querycad_waiting_tasks", "Tasks that no worker has taken yet.", labels=["queue"])
        for queue, length in self._waiting.items():
            tasks.add_metric([queue], length)
        yield tasks
