"""The segworker's process: takes tasks from the queues. `python -m querycad_segworker.worker`

Processes, not threads: the CAD kernel is not thread safe, and only processes can be stopped when their time is up.
A task is acknowledged when it is done, so that one whose worker died is done by another; after `ATTEMPTS` of these it
is given up. What comes of a call is left in a list that its caller takes it from: Celery's own way of telling results
gives up for good when Redis is away for a while.
"""

from __future__ import annotations

import json
import logging
import os
import sys
import threading
from collections.abc import Callable, Sequence
from typing import Any, cast

from celery import Celery, Task
from celery.exceptions import SoftTimeLimitExceeded
from celery.signals import worker_process_init
from redis import Redis
from redis.backoff import ExponentialBackoff
from redis.exceptions import RedisError
from redis.retry import Retry

from querycad_contracts import (
    Queue,
    ReadingStage,
    TaskFailure,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    reply_key,
    stage_key,
)
from querycad_contracts.infrastructure import WallsMissing, keep_private
from querycad_contracts.infrastructure.workers import REPLY_S, STORE_PAUSE_S, worker_app

from .kernel_process import ONE_THREAD, missing_walls, must_be_up, start_host
from .settings import SegworkerSettings
from .tasks import Tasks, make_tasks

ATTEMPTS = 2
"""A file that has taken its worker with it twice will do so again."""
CALL_S = 90
"""Seconds after which a call is stopped: over the 60 that the kernel has for one measurement."""
INGEST_MARGIN_S = 20
"""What an ingest may take beside the kernel's work: its child is stopped and its artefacts are kept."""
STORE_TRIES = 50
"""A worker waits for a store that is away: what it found out would be lost otherwise."""
DEATHS_S = 24 * 3600
STAGE_S = 600
"""A stage is told for longer than any lasts, and no longer than anybody asks."""

SERVED = tuple(name for name in TaskName if name.queue is not Queue.QUESTIONS)

log = logging.getLogger("querycad_segworker.worker")  # it is run as __main__

Work = Callable[[dict[str, Any]], str]


def make_app(settings: SegworkerSettings, missing: Sequence[str] = ()) -> Celery:
    """The Celery application with every task of a segworker; `missing` are walls that it does without."""
    redis = Redis.from_url(settings.redis_url)  # these connect when they are used, in each process anew
    patience = Retry(ExponentialBackoff(cap=STORE_PAUSE_S), STORE_TRIES)
    replies = Redis.from_url(settings.redis_url, retry=patience)
    queues = [Queue(name.strip()) for name in settings.segworker_queues.split(",")]
    ingest_limit_s = settings.ingest_s + INGEST_MARGIN_S
    app: Celery = worker_app(
        "querycad_segworker",
        settings,
        queues,
        processes=settings.segworker_processes,
        memory_mib=settings.segworker_memory_mib,
        longest_s=ingest_limit_s,
        store_tries=STORE_TRIES,
        missing_walls=missing,
    )
    process = _Process(settings, lambda model, stage: _tell_stage(redis, model, stage))
    for name in SERVED:
        limit_s = ingest_limit_s if name is TaskName.INGEST else CALL_S
        run = _task(name, process.work(name), replies)
        app.task(run, bind=True, name=name.value, time_limit=limit_s, shared=False)  # not with other applications
    if Queue.INGEST in queues:
        worker_process_init.connect(_load_kernel, weak=False)
    return app


class _Process:
    """The tasks of this process, made after the fork, when the first one is called."""

    def __init__(self, settings: SegworkerSettings, told: Callable[[str, ReadingStage], None]) -> None:
        self._settings = settings
        self._told = told
        self._table: dict[TaskName, Work] | None = None

    def work(self, name: TaskName) -> Work:
        def call(payload: dict[str, Any]) -> str:
            if self._table is None:
                tasks: Tasks = make_tasks(self._settings, self._told)
                self._table = tasks.table()
            return self._table[name](payload)

        return call


def _task(name: TaskName, work: Work, redis: Redis) -> Callable[[Task, dict[str, Any]], dict[str, Any] | None]:
    """The task as Celery does it: an ingest hands its outcome to what follows it, a call leaves it to who called."""

    def run(self: Task, payload: dict[str, Any]) -> dict[str, Any] | None:
        if name is not TaskName.INGEST and redis.exists(reply_key(self.request.id)):
            return None  # who called has gone, or a worker that died has answered
        again = bool(self.request.delivery_info.get("redelivered"))
        try:
            outcome = _given_up() if again and _deaths(redis, self.request.id) >= ATTEMPTS else _worked(work, payload)
        except Exception:
            if name is TaskName.INGEST:  # Celery tells what follows it
                raise
            log.exception("%s failed", name.value)
            outcome = _flawed()  # at once: who called would wait for nothing
        if name is TaskName.INGEST:
            return cast("dict[str, Any]", json.loads(outcome))
        with redis.pipeline(transaction=False) as pipe:
            pipe.rpush(reply_key(self.request.id), outcome)
            pipe.expire(reply_key(self.request.id), REPLY_S)
            pipe.execute()
        return None

    return run


def _tell_stage(redis: Redis, model: str, stage: ReadingStage) -> None:
    """Tells which stage of reading a file begins. It is only shown: a store that is away is passed over."""
    try:
        redis.set(stage_key(model), stage.value, ex=STAGE_S)
    except RedisError:
        log.info("stage %s is not told: the store does not answer", stage.value)


def _worked(work: Work, payload: dict[str, Any]) -> str:
    """The outcome. What is stopped since its model was deleted ends at once; if another was meant, it begins anew."""
    try:
        return work(payload)
    except SoftTimeLimitExceeded:
        log.info("stopped")
        return work(payload)


def _deaths(redis: Redis, task: str) -> int:
    """How often was the task begun again, this time included? It was when its worker died."""
    key = f"querycad:deaths:{task}"
    with redis.pipeline() as pipe:
        pipe.incr(key)
        pipe.expire(key, DEATHS_S)
        return int(pipe.execute()[0])


def _given_up() -> str:
    failure = TaskFailure(kind=TaskFailureKind.FILE, message=f"abandoned after {ATTEMPTS} workers crashed on this file")
    return TaskOutcome[None](failure=failure).model_dump_json()


def _flawed() -> str:
    failure = TaskFailure(kind=TaskFailureKind.INTERNAL, message="this could not be done; the segworker's log says why")
    return TaskOutcome[None](failure=failure).model_dump_json()


def _load_kernel(**_: object) -> None:
    """Has the CAD kernel loaded before the first file comes; a process that takes longer to start would be killed."""
    threading.Thread(target=start_host, daemon=True).start()


def main() -> None:
    """Works until it is told to stop; SIGTERM lets running tasks end. It ends at once where walls are missing."""
    keep_private()
    settings = SegworkerSettings.read()
    for variable, one in ONE_THREAD.items():
        os.environ.setdefault(variable, one)
    name = "+".join(sorted(settings.segworker_queues.replace(" ", "").split(",")))
    missing = missing_walls()
    try:
        must_be_up(missing)
    except WallsMissing as error:
        sys.exit(f"querycad_segworker: {error}")
    make_app(settings, missing).worker_main(
        ["worker", "--loglevel=INFO", "--without-gossip", "--without-mingle", f"--hostname={name}@%h"]
    )


if __name__ == "__main__":
    main()
