"""Puts tasks on the queues, by name."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Sequence
from typing import TypeVar, cast
from uuid import uuid4

from celery import Celery, Signature
from kombu.exceptions import OperationalError
from redis.asyncio import Redis as AsyncRedis
from redis.exceptions import RedisError

from querycad_api.problems import ModelUnreadable, ServiceUnavailable
from querycad_contracts import (
    IngestTask,
    ModelResource,
    ModelTask,
    QuestionTask,
    Queue,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    queue_of,
    reply_key,
)
from querycad_contracts.infrastructure import task_message

from .keyspace import ModelStale, uploaded
from .state import READ_S

CONNECT_S = 2
STOP_SIGNAL = "SIGUSR1"
"""Celery's signal of a passed time limit: the task's process raises SoftTimeLimitExceeded, and lives on."""

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

    async def ingest(self, resource: ModelResource, tenant: str, task_id: str, anew: bool = False) -> None:
        """Has an uploaded file read; the question workers are told what came of it. `stop` takes the task's id."""
        task = IngestTask(model=resource.id, file_name=resource.file_name, anew=anew)
        follow = {"model": resource.id, "tenant": tenant, "uploaded": uploaded(resource)}
        try:
            await asyncio.to_thread(
                self._app.send_task,
                TaskName.INGEST.value,
                args=[task.model_dump(mode="json")],
                queue=TaskName.INGEST.queue.value,
                task_id=task_id,
                ignore_result=True,
                link=self._follow(TaskName.MODEL_READ, follow),
                link_error=self._follow(TaskName.MODEL_LOST, follow),
            )
        except (OperationalError, RedisError) as error:
            raise _unreachable() from error

    async def questions(self, tasks: Sequence[QuestionTask]) -> None:
        """Has questions answered."""
        messages = [task_message(TaskName.QUESTION, task, task.job) for task in tasks]
        if messages:
            await self._put(TaskName.QUESTION.queue, *messages)

    async def stop(self, tasks: Sequence[str]) -> None:
        """Has what is done for jobs, or files, that are not wanted any more stopped, if it was begun. Never raises."""
        if not tasks:
            return
        try:
            await asyncio.to_thread(self._app.control.revoke, list(tasks), terminate=True, signal=STOP_SIGNAL)
        except (OperationalError, RedisError):
            return  # what is answered for nothing is passed over when it is done

    async def call(self, name: TaskName, task: ModelTask, value: type[TaskOutcome[T]], timeout_s: float) -> T:
        """What does a worker say to this? Raises ModelUnreadable and ModelStale too."""
        sent = uuid4().hex
        await self._put(queue_of(name, task), task_message(name, task, sent, timeout_s))
        reply = await self._reply(sent, timeout_s)
        if reply is None:
            raise ServiceUnavailable("no worker answered; try again in a moment")
        outcome = value.model_validate_json(reply)
        if outcome.failure is not None and outcome.failure.kind is TaskFailureKind.NOT_READ:
            raise ModelStale(outcome.failure.message)
        if outcome.failure is not None and outcome.failure.kind is TaskFailureKind.FILE:
            raise ModelUnreadable(outcome.failure.message)
        if outcome.value is None:
            raise ServiceUnavailable("the worker could not do this; its log says why")
        return outcome.value

    async def _reply(self, task: str, timeout_s: float) -> str | None:
        """What did the worker leave? Waited for in pieces, so that a store that says nothing is told from it."""
        loop = asyncio.get_running_loop()
        deadline = loop.time() + timeout_s
        while (left_s := deadline - loop.time()) > 0:
            waiting = self._redis.blpop([reply_key(task)], min(left_s, READ_S))
            if (reply := await cast("Awaitable[tuple[str, str] | None]", waiting)) is not None:
                return reply[1]
        return None

    def _follow(self, name: TaskName, arguments: dict[str, str]) -> Signature:
        """What is to be done after a task."""
        return self._app.signature(name.value, kwargs=arguments, queue=name.queue.value)

    async def _put(self, queue: Queue, *messages: str) -> None:
        try:
            await self._redis.lpush(queue.value, *messages)
        except RedisError as error:
            raise _unreachable() from error

    def close(self) -> None:
        """Closes the connections."""
        self._app.close()


def _unreachable() -> ServiceUnavailable:
    return ServiceUnavailable("the queue cannot be reached; try again in a moment")
