"""What the question workers do once a segworker has read a file, or could not: they keep what came of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from celery import Celery

from querycad_api.store.ledger import Ledger
from querycad_contracts import ModelSummary, TaskFailure, TaskFailureKind, TaskName, TaskOutcome


def register(app: Celery, ledger: Callable[[], Ledger]) -> None:
    """Adds the tasks to a worker; `ledger` gives the one of the process that the task runs in."""

    def model_read(outcome: dict[str, Any], model: str, tenant: str, uploaded: str) -> None:
        ledger().finish_model(tenant, model, TaskOutcome[ModelSummary].model_validate(outcome), uploaded)

    def model_lost(_task_id: str, model: str, tenant: str, uploaded: str) -> None:
        failure = TaskFailure(
            kind=TaskFailureKind.INTERNAL, message="the file could not be read: its worker was stopped", retryable=True
        )
        ledger().finish_model(tenant, model, TaskOutcome[ModelSummary](failure=failure), uploaded)

    app.task(model_read, name=TaskName.MODEL_READ.value)
    app.task(model_lost, name=TaskName.MODEL_LOST.value)
