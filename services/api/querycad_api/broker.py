"""Puts tasks on the queues, by name."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable
from typing import Any, cast

from celery import Celery
from kombu.exceptions import OperationalError
from redis.asyncio import Redis as AsyncRedis
from redis.exceptions import RedisError

from querycad_contracts import IngestTask, ModelTask, QuestionTask, Queue, TaskName, reply_key

from .problems import ServiceUnavailable

CONNECT_S = 2


class Broker:
    """For the web process: every method lets it go on while Redis is talked to. Raises ServiceUnavailable."""

    def __init__(self, redis_url: str, redis: AsyncRedis) -> None:
        self._redis = redis
        self._app = Celery("querycad_api.web", broker=redis_url, set_as_current=False)
        self._app.conf.update(
            broker_transport_options={"socket_connect_timeout": CONNECT_S, "max_retries": 1},
            task_publish_retry_policy={"max_retries": 1, "interval_start": 0.1},
        )

    async def ingest(self, task: IngestTask) -> None:
        """Has an uploaded file read; the question workers are told what came of it."""
        follow = {"model": task.model}
        await self._send(
            TaskName.INGEST,
            task,
            Queue.INGEST,
            link=self._app.signature(TaskName.MODEL_READ.value, kwargs=follow, queue=Queue.QUESTIONS.value),
            link_error=self._app.signature(TaskName.MODEL_LOST.value, kwargs=follow, queue=Queue.QUESTIONS.value),
        )

    async def question(self, task: QuestionTask) -> None:
        """Has a question answered."""
        await self._send(TaskName.QUESTION, task, Queue.QUESTIONS)

    async def call(self, name: TaskName, task: ModelTask, timeout_s: float) -> Any:
        """What does a segworker say to this, as JSON data?"""
        sent = await self._send(name, task, Queue.SEGCAD, expires=timeout_s)
        waiting = self._redis.blpop([reply_key(sent)], timeout_s)
        reply = await cast("Awaitable[tuple[str, str] | None]", waiting)
        if reply is None:
            raise ServiceUnavailable("no segworker answered; try again in a moment")
        return json.loads(reply[1])

    async def _send(self, name: TaskName, task: ModelTask, queue: Queue, **options: Any) -> str:
        """Puts the task on the queue; its id."""
        payload = task.model_dump(mode="json")
        try:
            sent = await asyncio.to_thread(
                self._app.send_task, name.value, args=[payload], queue=queue.value, ignore_result=True, **options
            )
        except (OperationalError, RedisError) as error:
            raise ServiceUnavailable("the queue cannot be reached; try again in a moment") from error
        return str(sent.id)

    def close(self) -> None:
        """Closes the connections."""
        self._app.close()
