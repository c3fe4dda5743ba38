"""What is known of models and jobs, in Redis: the web process reads and adds (`State`), the workers finish (`Ledger`).

    querycad:model:<id>     hash: resource (ModelResource as uploaded), outcome (TaskOutcome[ModelSummary])
    querycad:job:<id>       hash: task (QuestionTask), created, attempts, started, record (AnswerRecord), finished
    querycad:asked:<id>     list: ids of the jobs about a model, the newest first
    querycad:events:<id>    stream: what happened to a model or job so far, the field `event`

An outcome or a record is written once: whoever comes second changes nothing.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable
from datetime import UTC, datetime
from enum import StrEnum
from typing import Any, cast

from redis import Redis
from redis.asyncio import Redis as AsyncRedis

from querycad_contracts import (
    AnswerRecord,
    Failure,
    Job,
    JobStatus,
    ModelResource,
    ModelStatus,
    ModelSummary,
    QuestionTask,
    TaskFailureKind,
    TaskOutcome,
)

DAY_S = 24 * 3600
READ_S = 5.0
"""A wait on a stream is cut into pieces, so that it ends soon after its client has gone."""


Streams = list[tuple[str, list[tuple[str, dict[str, str]]]]]
"""What XREAD answers: of each stream its key, of each entry its id and fields."""


class Event(StrEnum):
    """What happens to a model or a job."""

    ADDED = "added"
    RUNNING = "running"
    DONE = "done"


def model_key(model: str) -> str:
    """Where is the model's hash?"""
    return f"querycad:model:{model}"


def job_key(job: str) -> str:
    """Where is the job's hash?"""
    return f"querycad:job:{job}"


def asked_key(model: str) -> str:
    """Where is the list of the jobs about a model?"""
    return f"querycad:asked:{model}"


def events_key(subject: str) -> str:
    """Where is the stream of what happens to a model or job?"""
    return f"querycad:events:{subject}"


def model_of(fields: dict[str, str]) -> ModelResource | None:
    """The model that a hash tells of; None when there is none."""
    if "resource" not in fields:
        return None
    resource = ModelResource.model_validate_json(fields["resource"])
    if "outcome" not in fields:
        return resource
    outcome = TaskOutcome[ModelSummary].model_validate_json(fields["outcome"])
    if outcome.failure is None:
        return resource.model_copy(update={"status": ModelStatus.READY, "summary": outcome.value})
    category = "bad_input" if outcome.failure.kind is TaskFailureKind.FILE else "internal"
    failure = Failure(category=category, message=outcome.failure.message, retryable=outcome.failure.retryable)
    return resource.model_copy(update={"status": ModelStatus.FAILED, "failure": failure})


def job_of(fields: dict[str, str]) -> Job | None:
    """The job that a hash tells of; None when there is none."""
    if "task" not in fields:
        return None
    task = QuestionTask.model_validate_json(fields["task"])
    record = fields.get("record")
    waits = JobStatus.RUNNING if "started" in fields else JobStatus.QUEUED
    return Job(
        id=task.job,
        model=task.model,
        question=task.question,
        unit=task.unit,
        status=JobStatus.DONE if record else waits,
        created=datetime.fromisoformat(fields["created"]),
        finished=datetime.fromisoformat(fields["finished"]) if "finished" in fields else None,
        record=AnswerRecord.model_validate_json(record) if record else None,
    )


def now() -> str:
    """The time in UTC, ISO 8601."""
    return datetime.now(UTC).isoformat()


class State:
    """For the web process: never blocks it."""

    def __init__(self, redis: AsyncRedis, answers_days: int) -> None:
        self._redis = redis
        self._kept_s = answers_days * DAY_S

    async def alive(self, *keys: str) -> list[bool]:
        """Which of the keys are there? Raises RedisError when Redis does not answer."""
        return [value is not None for value in await self._redis.mget(keys)]

    async def add_model(self, resource: ModelResource) -> bool:
        """Keeps a new model; False when it was there already."""
        new = await self._redis.hsetnx(model_key(resource.id), "resource", resource.model_dump_json())
        return bool(new)

    async def forget_outcome(self, model: str) -> None:
        """Makes a model unread again, before its file is read anew."""
        await self._redis.hdel(model_key(model), "outcome")
        await self._redis.delete(events_key(model))

    async def forget_model(self, model: str) -> None:
        """Drops a model that could not be put on the queue."""
        await self._redis.delete(model_key(model), events_key(model))

    async def model(self, model: str) -> ModelResource | None:
        """What is known of the model? None when it was never uploaded."""
        return model_of(await self._hash(model_key(model)))

    async def add_job(self, task: QuestionTask) -> Job:
        """Keeps a new job."""
        fields = {"task": task.model_dump_json(), "created": now()}
        async with self._redis.pipeline() as pipe:
            pipe.hset(job_key(task.job), mapping=cast("Any", fields))
            pipe.expire(job_key(task.job), self._kept_s)
            pipe.lpush(asked_key(task.model), task.job)
            pipe.expire(asked_key(task.model), self._kept_s)
            pipe.xadd(events_key(task.job), {"event": Event.ADDED.value})
            pipe.expire(events_key(task.job), self._kept_s)
            await pipe.execute()
        return cast("Job", job_of(fields))

    async def forget_job(self, task: QuestionTask) -> None:
        """Drops a job that could not be put on the queue."""
        async with self._redis.pipeline() as pipe:
            pipe.delete(job_key(task.job), events_key(task.job))
            pipe.lrem(asked_key(task.model), 1, task.job)
            await pipe.execute()

    async def job(self, job: str) -> Job | None:
        """What is known of the job? None when there is none, or not any more."""
        return job_of(await self._hash(job_key(job)))

    async def record(self, job: str) -> str | None:
        """The job's AnswerRecord as it was written; None while there is none."""
        return await cast("Awaitable[str | None]", self._redis.hget(job_key(job), "record"))

    async def done(self, subject: str, timeout_s: float) -> bool:
        """Is the model or job done, after at most so many seconds?"""
        loop, last = asyncio.get_running_loop(), "0"
        deadline = loop.time() + timeout_s
        while True:
            left_s = deadline - loop.time()
            block_ms = max(1, int(min(left_s, READ_S) * 1e3))
            answer = await self._redis.xread({events_key(subject): last}, block=block_ms)
            for _, entries in cast("Streams", answer or []):
                for last, fields in entries:  # noqa: B007 - where to read on
                    if fields["event"] == Event.DONE.value:
                        return True
            if left_s <= 0:
                return False

    async def _hash(self, key: str) -> dict[str, str]:
        return await cast("Awaitable[dict[str, str]]", self._redis.hgetall(key))


class Ledger:
    """For the workers: finishes what the web process began."""

    def __init__(self, redis: Redis, answers_days: int) -> None:
        self._redis = redis
        self._kept_s = answers_days * DAY_S

    def model(self, model: str) -> ModelResource | None:
        """What is known of the model? None when it was never uploaded."""
        return model_of(cast("dict[str, str]", self._redis.hgetall(model_key(model))))

    def finish_model(self, model: str, outcome: TaskOutcome[Any]) -> None:
        """Keeps what came of reading the model's file."""
        if self._redis.hsetnx(model_key(model), "outcome", outcome.model_dump_json()):
            self._redis.xadd(events_key(model), {"event": Event.DONE.value})

    def job(self, job: str) -> Job | None:
        """What is known of the job? None when there is none, or not any more."""
        return job_of(cast("dict[str, str]", self._redis.hgetall(job_key(job))))

    def begin_job(self, job: str) -> int:
        """Notes that somebody works on it; how often was it begun?"""
        with self._redis.pipeline() as pipe:
            pipe.hincrby(job_key(job), "attempts", 1)
            pipe.hset(job_key(job), "started", now())
            pipe.xadd(events_key(job), {"event": Event.RUNNING.value})
            return int(pipe.execute()[0])

    def wait_job(self, job: str) -> None:
        """Notes that it waits again, without fault of its own."""
        with self._redis.pipeline() as pipe:
            pipe.hincrby(job_key(job), "attempts", -1)
            pipe.hdel(job_key(job), "started")
            pipe.execute()

    def finish_job(self, job: str, record: AnswerRecord) -> None:
        """Keeps the answer, and tells who waits for it."""
        if self._redis.hsetnx(job_key(job), "record", record.model_dump_json()):
            with self._redis.pipeline() as pipe:
                pipe.hset(job_key(job), "finished", now())
                pipe.expire(job_key(job), self._kept_s)
                pipe.xadd(events_key(job), {"event": Event.DONE.value})
                pipe.expire(events_key(job), self._kept_s)
                pipe.execute()
