"""Puts tasks on the queues, by name."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Sequence
from typing import Any, TypeVar, cast

from celery import Celery, Signature
from kombu.exceptions import OperationalError
from pydantic import TypeAdapter
from redis.asyncio import Redis as AsyncRedis
from redis.exceptions import RedisError

from querycad_contracts import (
    IngestTask,
    ModelTask,
    QuestionTask,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    reply_key,
)

from .problems import ModelUnreadable, ServiceUnavailable

CONNECT_S = 2
STOP_SIGNAL = "SIGUSR1"
"""Celery's signal of a passed time limit: the question's process raises SoftTimeLimitExceeded, and lives on."""

T = TypeVar("T")


class Broker:
    """For the web process: every method lets it go on while Redis is talked to. Raises ServiceUnavailable."""

    def __init__(self, redis_url: str, redis: AsyncRedis) -> None:
        self._redis = redis
        self._app = Celery("querycad_api.web", broker=redis_url, set_as_current=False)
        self._app.conf.update(
            broker_transport_options={"socket_connect_timeout": CONNECT_S, "max_retries": 1},
            task_publish_retry_policy={"max_retries": 1, "interval_start": 0.1},
        )

    async def ingest(self, task: IngestTask, tenant: str) -> None:
        """Has an uploaded file read; the question workers are told what came of it."""
        follow = {"model": task.model, "tenant": tenant}
        await self._send(
            TaskName.INGEST,
            task,
            link=self._follow(TaskName.MODEL_READ, follow),
            link_error=self._follow(TaskName.MODEL_LOST, follow),
        )

    async def questions(self, tasks: Sequence[QuestionTask]) -> None:
        """Has questions answered."""
        for task in tasks:
            await self._send(TaskName.QUESTION, task, task_id=task.job)

    async def stop(self, jobs: Sequence[str]) -> None:
        """Has what is done for jobs that were ended from outside stopped, if it was begun. Never raises."""
        if not jobs:
            return
        try:
            await asyncio.to_thread(self._app.control.revoke, list(jobs), terminate=True, signal=STOP_SIGNAL)
        except (OperationalError, RedisError):
            return  # what is answered for nothing is passed over when it is done

    async def call(self, name: TaskName, task: ModelTask, value: TypeAdapter[TaskOutcome[T]], timeout_s: float) -> T:
        """What does a segworker say to this? Raises ModelUnreadable too."""
        sent = await self._send(name, task, expires=timeout_s)
        waiting = self._redis.blpop([reply_key(sent)], timeout_s)
        reply = await cast("Awaitable[tuple[str, str] | None]", waiting)
        if reply is None:
            raise ServiceUnavailable("no segworker answered; try again in a moment")
        outcome = value.validate_python(json.loads(reply[1]))
        if outcome.failure is not None and outcome.failure.kind is TaskFailureKind.FILE:
            raise ModelUnreadable(outcome.failure.message)
        if outcome.value is None:
            raise ServiceUnavailable("the segworker could not do this; its log says why")
        return outcome.value

    def _follow(self, name: TaskName, arguments: dict[str, str]) -> Signature:
        """What is to be done after a task."""
        return self._app.signature(name.value, kwargs=arguments, queue=name.queue.value)

    async def _send(self, name: TaskName, task: ModelTask, **options: Any) -> str:
        """Puts the task on its queue; its id."""
        payload = task.model_dump(mode="json")
        try:
            sent = await asyncio.to_thread(
                self._app.send_task, name.value, args=[payload], queue=name.queue.value, ignore_result=True, **options
            )
        except (OperationalError, RedisError) as error:
            raise ServiceUnavailable("the queue cannot be reached; try again in a moment") from error
        return str(sent.id)

    def close(self) -> None:
        """Closes the connections."""
        self._app.close()
