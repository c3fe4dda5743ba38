"""What is known of models and jobs, for the question workers: they finish what the web process began."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from typing import Any, cast

from redis import Redis

from querycad_contracts import (
    AnswerRecord,
    JobEvent,
    JobEventKind,
    ModelResource,
    ModelSummary,
    QuestionTask,
    RunStatus,
    TaskOutcome,
)

from .keyspace import (
    DAY_S,
    READING,
    entry,
    finished,
    key_of,
    model_of,
    now,
)
from .scripts import BEGIN_JOB, FINISH_JOB, FINISH_MODEL, WAIT_JOB

BUCKETS_S = (0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0)
"""Bounds of the histogram of how long questions take, from being accepted to being answered."""


SAID_S = 3600
"""A job is begun again minutes after it was interrupted, or not at all."""


@dataclass(frozen=True, slots=True)
class Begun:
    """A job that somebody works on: how often it was begun, when it was asked, and about what.

    `model` is None when it was deleted.
    """

    attempt: int
    created: datetime
    model: ModelResource | None

    @property
    def age_s(self) -> float:
        """How long ago was it asked?"""
        return (now() - self.created).total_seconds()


class JobTranscript:
    """What a language model said for one job: kept as long as the job may be begun again."""

    def __init__(self, redis: Redis, job: str) -> None:
        self._redis = redis
        self._key = key_of("said", job)

    def said(self) -> list[tuple[str, str]]:
        """Each request and its reply, in order."""
        kept = cast("list[str]", self._redis.lrange(self._key, 0, -1))
        return [(request, reply) for request, _, reply in (each.partition(" ") for each in kept)]

    def say(self, request: str, reply: str) -> None:
        """Adds one."""
        with self._redis.pipeline() as pipe:
            pipe.rpush(self._key, f"{request} {reply}")
            pipe.expire(self._key, SAID_S)
            pipe.execute()


class Ledger:
    """Raises RedisError when Redis does not answer."""

    def __init__(self, redis: Redis, answers_days: int) -> None:
        self._redis = redis
        self._kept_s = answers_days * DAY_S
        self._finish_model = redis.register_script(FINISH_MODEL)
        self._finish_job = redis.register_script(FINISH_JOB)
        self._begin_job = redis.register_script(BEGIN_JOB)
        self._wait_job = redis.register_script(WAIT_JOB)

    def finish_model(self, tenant: str, model: str, outcome: TaskOutcome[ModelSummary], uploaded: str = "") -> None:
        """Keeps what came of reading the model's file, if it is still the one `uploaded` then; empty: whichever."""
        keys = [key_of("model", tenant, model), key_of("events", tenant, model), READING, key_of("sizes", tenant)]
        kept_bytes = outcome.value.kept_bytes if outcome.value is not None else 0
        self._finish_model(keys, [outcome.model_dump_json(), f"{tenant}:{model}", uploaded, model, kept_bytes])

    def read_again(self, tenant: str, model: str) -> None:
        """Makes a model unread, whose file an api will have read anew within seconds."""
        with self._redis.pipeline() as pipe:
            pipe.hdel(key_of("model", tenant, model), "outcome")
            pipe.delete(key_of("events", tenant, model))
            pipe.zadd(READING, {f"{tenant}:{model}": now().timestamp()})
            pipe.execute()

    def begin_job(self, task: QuestionTask) -> Begun | None:
        """Notes that somebody works on it. None: it is done, or not there any more."""
        started = entry(JobEvent(kind=JobEventKind.STARTED, at=now()))["event"]
        keys = [key_of("job", task.job), key_of("events", task.job), key_of("model", task.tenant, task.model)]
        begun = self._begin_job(keys, [now().isoformat(), started, now().timestamp()])
        if not begun:
            return None
        attempt, created, *known = begun
        model = model_of({name: text for name, text in zip(("resource", "outcome"), known, strict=True) if text})
        return Begun(int(attempt), datetime.fromisoformat(created), model)

    def wait_job(self, job: str, message: str) -> None:
        """Notes that it waits again, without fault of its own."""
        waiting = entry(JobEvent(kind=JobEventKind.WAITING, at=now(), message=message))["event"]
        self._wait_job([key_of("job", job), key_of("events", job)], [waiting, now().timestamp(), message])

    def wrote(self, job: str, code: str, codegen: str) -> None:
        """Tells that a program has been written."""
        self._tell(job, JobEvent(kind=JobEventKind.PROGRAM, at=now(), code=code, codegen=codegen))

    def ran(self, job: str, outcome: RunStatus, message: str) -> None:
        """Tells how a program ended."""
        self._tell(job, JobEvent(kind=JobEventKind.RAN, at=now(), outcome=outcome, message=message))

    def transcript(self, job: str) -> JobTranscript:
        """What a language model said for the job until now."""
        return JobTranscript(self._redis, job)

    def finish_job(self, task: QuestionTask, record: AnswerRecord, took_s: float) -> None:
        """Keeps the answer, and tells who waits for it. `took_s`: since the question was accepted."""
        self._finish_job(*finished(task, record, self._kept_s, _times(record, took_s)))
        if record.attempts:
            self._redis.delete(key_of("said", task.job))

    def _tell(self, job: str, event: JobEvent) -> None:
        """Adds to the job's stream, if there is one: that of a deleted job is not begun anew."""
        self._redis.xadd(key_of("events", job), cast("Any", entry(event)), nomkstream=True)


def _times(record: AnswerRecord, took_s: float) -> dict[str, float]:
    """What one question adds to the counters of time."""
    buckets = {f"seconds_le:{bound:g}": 1.0 for bound in BUCKETS_S if took_s <= bound}
    return {"seconds": took_s, **buckets, **{f"step_ms:{step}": ms for step, ms in record.timings_ms.items()}}
