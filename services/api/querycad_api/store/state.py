"""What is known of models and jobs, for the web process: it reads, adds, cancels and deletes, and never blocks.

The workers' side is `ledger`; where everything is kept is told in `keyspace`. An outcome or a record is written once:
whoever comes second changes nothing.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import cast

from redis.asyncio import Redis
from redis.asyncio.lock import Lock

from querycad_contracts import (
    AnswerRecord,
    Job,
    JobEvent,
    JobEventKind,
    JobsPage,
    ModelResource,
    ModelsPage,
    ModelStatus,
    QuestionTask,
    Queue,
    ReadingStage,
    TaskName,
    stage_key,
)
from querycad_contracts.infrastructure import task_message

from .keyspace import (
    DAY_S,
    PENDING,
    READING,
    TOTALS,
    UNREAD,
    entry,
    finished,
    job_of,
    key_of,
    model_of,
    now,
    task_of,
)
from .scripts import ADD_JOBS, ADD_MODEL, FINISH_JOB, FORGET_BYTES, RESERVE

READ_S = 5.0
"""A wait on a stream is cut into pieces, so that it ends soon after its client has gone."""
LOCK_S = 60.0
"""A process that dies while it holds a lock does not hold it for longer."""
LOST_S = 10.0
"""A job that nobody has begun by then is looked at: its message may have been lost with who took it off the queue."""
READ_AGAIN_S = 30.0
"""The same for a file that is being read."""
AGAIN_S = 60.0
DUE_AT_ONCE = 100
LOOKED_AT = 200
"""Who waits behind so many tasks is told no place."""
OPEN_S = DAY_S
"""A question that is open for longer was lost with the store: it does not count against its key."""

Streams = list[tuple[str, list[tuple[str, dict[str, str]]]]]
"""What XREAD answers: of each stream its key, of each entry its id and fields."""


@dataclass(frozen=True, slots=True)
class Once:
    """What a request with an idempotency key asked for, and the jobs that it was given."""

    fingerprint: str
    jobs: tuple[str, ...]


class TooMuchStored(Exception):
    """The tenant's files, and what is read of them, would be more than it may have."""


class State:
    """Raises RedisError when Redis does not answer."""

    def __init__(
        self,
        redis: Redis,
        answers_days: int,
        answers: int = 20_000,
        stored_bytes: int = 20 * 2**30,
        answer_bytes: int = 2**30,
    ) -> None:
        """What is kept for a tenant at most: `answers` in number, bytes of files and of what was read, of answers."""
        self._redis = redis
        self._kept_s = answers_days * DAY_S
        self._answers, self._stored_bytes, self._answer_bytes = answers, stored_bytes, answer_bytes
        self._reserve = redis.register_script(RESERVE)
        self._add_model = redis.register_script(ADD_MODEL)
        self._add = redis.register_script(ADD_JOBS)
        self._finish = redis.register_script(FINISH_JOB)
        self._forget_bytes = redis.register_script(FORGET_BYTES)

    async def alive(self, *keys: str) -> list[str | None]:
        """What do those say that are there? None where one is not."""
        return [None if value is None else str(value) for value in await self._redis.mget(keys)]

    async def totals(self, *queues: str) -> tuple[dict[str, float], dict[str, int]]:
        """The workers' counters, and how many tasks wait in each queue."""
        async with self._redis.pipeline() as pipe:
            pipe.hgetall(TOTALS)
            for queue in queues:
                pipe.llen(queue)
            counters, *lengths = await pipe.execute()
        return {name: float(value) for name, value in counters.items()}, dict(zip(queues, lengths, strict=True))

    def files_of(self, model: str) -> Lock:
        """Held while the files of this content are put in place or removed; other processes wait."""
        return Lock(self._redis, f"querycad:lock:{model}", timeout=LOCK_S, blocking_timeout=LOCK_S)

    # Models

    async def add_model(self, tenant: str, resource: ModelResource) -> bool:
        """Keeps a new model; False when it was there already. Raises TooMuchStored."""
        keys = [
            key_of("model", tenant, resource.id),
            key_of("models", tenant),
            key_of("owners", resource.id),
            key_of("sizes", tenant),
        ]
        time, size = resource.created.timestamp(), UNREAD * resource.size_bytes
        added = await self._add_model(
            keys, [resource.model_dump_json(), resource.id, time, size, tenant, self._stored_bytes]
        )
        if added < 0:
            raise TooMuchStored
        return bool(added)

    async def owned(self, model: str) -> bool:
        """Has any tenant a model with this content?"""
        return bool(await self._redis.exists(key_of("owners", model)))

    async def failed_models(self, before: datetime) -> list[tuple[str, str]]:
        """Which models, and whose, were uploaded before then and could not be read? Tenant and id."""
        found = []
        async for key in self._redis.scan_iter(key_of("models", "*"), count=1000):
            tenant = str(key).removeprefix(key_of("models", ""))
            ids = cast("list[str]", await self._redis.zrangebyscore(key, 0, before.timestamp()))
            for model in ids:
                outcome = await cast(
                    "Awaitable[str | None]", self._redis.hget(key_of("model", tenant, model), "outcome")
                )
                if outcome and json.loads(outcome).get("failure"):
                    found.append((tenant, model))
        return found

    async def forget_outcome(self, tenant: str, model: str) -> None:
        """Makes a model unread again, before its file is read anew."""
        await self._redis.hdel(key_of("model", tenant, model), "outcome")
        await self._redis.delete(key_of("events", tenant, model))

    async def forget_model(self, tenant: str, model: str) -> bool:
        """Drops a model; is it now nobody's, so that its files may go?"""
        async with self._redis.pipeline() as pipe:
            pipe.delete(key_of("model", tenant, model), key_of("events", tenant, model), key_of("asked", tenant, model))
            pipe.zrem(key_of("models", tenant), model)
            pipe.hdel(key_of("sizes", tenant), model)
            pipe.zrem(READING, f"{tenant}:{model}")
            pipe.srem(key_of("owners", model), tenant)
            pipe.scard(key_of("owners", model))
            return not (await pipe.execute())[-1]

    async def knows_model(self, tenant: str, model: str) -> bool:
        """Did the tenant upload it? Without reading all that is known of it."""
        return bool(await self._redis.hexists(key_of("model", tenant, model), "resource"))

    async def model(self, tenant: str, model: str) -> ModelResource | None:
        """What is known of the model? None when the tenant never uploaded it."""
        return model_of(await self._hash(key_of("model", tenant, model)))

    async def progress(self, model: str) -> tuple[ReadingStage | None, int | None]:
        """Of a file that is not read yet: the stage that it is at, and how many are before it in the queue."""
        stage = cast("str | None", await self._redis.get(stage_key(model)))
        if stage is not None:
            return ReadingStage(stage), None
        return None, await self.ahead(Queue.INGEST, model)

    async def ahead(self, queue: Queue, ident: str) -> int | None:
        """How many tasks wait before the one whose message tells of this id? None when it is not near the front.

        Workers take from the right. A message's headers tell the task's id, or begin of its arguments: the model.
        """
        waiting = await cast("Awaitable[list[str]]", self._redis.lrange(queue.value, -LOOKED_AT, -1))
        return next((place for place, message in enumerate(reversed(waiting)) if ident in message), None)

    async def models(self, tenant: str, offset: int, limit: int) -> ModelsPage:
        """Which models has the tenant? The newest first."""
        ids, total = await self._page(key_of("models", tenant), offset, limit)
        found = [model_of(fields) for fields in await self._hashes([key_of("model", tenant, each) for each in ids])]
        return ModelsPage(items=tuple(each for each in found if each is not None), total=total)

    async def model_done(self, tenant: str, model: str, timeout_s: float) -> bool:
        """Has the model's file been read, after at most so many seconds?"""
        return await self._done(key_of("events", tenant, model), timeout_s)

    # Jobs

    async def reserve(self, tasks: Sequence[QuestionTask], at_most: int) -> bool:
        """Counts the tasks as open questions of their API key; False, and nothing counted, when that is too many."""
        time = now().timestamp()
        return bool(
            await self._reserve(
                [key_of("open", tasks[0].key)], [time, time - OPEN_S, at_most, *(task.job for task in tasks)]
            )
        )

    async def add_jobs(self, tasks: Sequence[QuestionTask]) -> tuple[Job, ...]:
        """Keeps new jobs about one model and puts them on the queue: all of them, or none if there is no such model."""
        tenant, model, time = tasks[0].tenant, tasks[0].model, now()
        number = time.timestamp()
        queued = entry(JobEvent(kind=JobEventKind.QUEUED, at=time))["event"]
        texts = [task.model_dump_json() for task in tasks]
        keys = [key_of("model", tenant, model), key_of("asked", tenant, model), PENDING, TaskName.QUESTION.queue.value]
        keys += key_of("answers", tenant), key_of("bytes", tenant)
        times = (time.isoformat(), number, number + LOST_S, self._kept_s, number - self._kept_s)
        arguments: list[str | float] = [*times, queued, self._answers, self._answer_bytes]
        for task, text in zip(tasks, texts, strict=True):
            keys += key_of("job", task.job), key_of("events", task.job)
            arguments += task.job, text, task_message(TaskName.QUESTION, task, task.job)
        if not await self._add(keys, arguments):
            return ()
        return tuple(cast("Job", job_of({"task": text, "created": time.isoformat()})) for text in texts)

    async def forget_jobs(self, tasks: Sequence[QuestionTask]) -> None:
        """Drops jobs: of a deleted model, or because they could not be put on the queue."""
        async with self._redis.pipeline() as pipe:
            for task in tasks:
                pipe.delete(key_of("job", task.job), key_of("events", task.job))
                pipe.delete(key_of("done", task.job), key_of("said", task.job))
                pipe.zrem(key_of("asked", task.tenant, task.model), task.job)
                pipe.zrem(key_of("answers", task.tenant), task.job)
                pipe.zrem(key_of("open", task.key), task.job)
                pipe.zrem(PENDING, task.job)
                await self._forget_bytes([key_of("bytes", task.tenant)], [task.job], client=pipe)
            await pipe.execute()

    async def job(self, tenant: str, job: str) -> Job | None:
        """What is known of the job? None when the tenant has none of this id, or not any more."""
        fields = await self._hash(key_of("job", job))
        task = task_of(fields)
        return job_of(fields) if task is not None and task.tenant == tenant else None

    async def task(self, job: str) -> QuestionTask | None:
        """What was asked? None when it is not known any more."""
        return task_of(await self._hash(key_of("job", job)))

    async def jobs(self, tenant: str, model: str, offset: int, limit: int) -> JobsPage:
        """What was asked about the model? The newest first."""
        ids, total = await self._page(key_of("asked", tenant, model), offset, limit)
        hashes = await self._hashes([key_of("job", each) for each in ids])
        found = await asyncio.to_thread(lambda: [job_of(fields) for fields in hashes])  # a page may have 100 MB
        return JobsPage(items=tuple(each for each in found if each is not None), total=total)

    async def tasks_about(self, tenant: str, model: str) -> tuple[QuestionTask, ...]:
        """All that was asked about the model."""
        ids, _ = await self._page(key_of("asked", tenant, model), 0, 0)
        found = [task_of(fields) for fields in await self._hashes([key_of("job", each) for each in ids])]
        return tuple(each for each in found if each is not None)

    async def record(self, job: str) -> str | None:
        """The job's AnswerRecord as it was written; None while there is none."""
        return await cast("Awaitable[str | None]", self._redis.hget(key_of("job", job), "record"))

    async def end_job(self, task: QuestionTask, record: AnswerRecord) -> bool:
        """Ends a job from outside; False when it was done already."""
        return bool(await self._finish(*finished(task, record, self._kept_s)))

    async def job_done(self, job: str, timeout_s: float) -> bool:
        """Is the job done, after at most so many seconds?"""
        return await self._done(key_of("done", job), timeout_s)

    async def events(self, job: str, after: str) -> AsyncIterator[tuple[str, JobEvent]]:
        """What happens to the job, as it happens, after the event of that id ('0': from the start), up to `done`."""
        key, last = key_of("events", job), after
        while True:
            entries = await self._read(key, last, READ_S)
            for last, fields in entries:
                event = JobEvent.model_validate_json(fields["event"])
                if event.kind is JobEventKind.DONE:
                    record = await self.record(job)
                    event = event.model_copy(
                        update={"record": AnswerRecord.model_validate_json(record) if record else None}
                    )
                yield last, event
                if event.kind is JobEventKind.DONE:
                    return
            if not entries and await self.told(job, last):
                return

    async def told(self, job: str, after: str) -> bool:
        """Is there nothing more to tell of the job after the event of that id, now or later?"""
        newest = cast("list[tuple[str, dict[str, str]]]", await self._redis.xrevrange(key_of("events", job), count=1))
        if not newest:  # its model was deleted
            return True
        number, fields = newest[0]
        return fields["kind"] == JobEventKind.DONE.value and _order(number) <= _order(after)

    async def once(self, tenant: str, key: str, wanted: Once) -> Once:
        """What is done for this idempotency key? `wanted` itself, unless the key was used within the last day."""
        data = json.dumps([wanted.fingerprint, wanted.jobs])
        if await self._redis.set(key_of("once", tenant, key), data, nx=True, ex=DAY_S):
            return wanted
        kept = await self._redis.get(key_of("once", tenant, key))
        if kept is None:  # it ended between the two
            return wanted
        fingerprint, jobs = json.loads(kept)
        return Once(fingerprint, tuple(jobs))

    # What was lost

    async def reading(self, tenant: str, model: str, task: str) -> None:
        """Notes that the model's file is to be read, by the task of this id."""
        async with self._redis.pipeline() as pipe:
            pipe.zadd(READING, {f"{tenant}:{model}": now().timestamp() + READ_AGAIN_S})
            pipe.delete(stage_key(model))
            pipe.hset(key_of("model", tenant, model), "ingest", task)
            await pipe.execute()

    async def ingest_of(self, tenant: str, model: str) -> str | None:
        """The id of the task that reads the model's file, while it does."""
        fields = await self._hash(key_of("model", tenant, model))
        return fields.get("ingest") if "outcome" not in fields else None

    async def turn(self, name: str, seconds: float) -> bool:
        """Is it this process's turn to do what is done once in so many seconds by all processes together?"""
        return bool(await self._redis.set(f"querycad:turn:{name}", 1, nx=True, px=int(seconds * 1e3)))

    async def stalled_jobs(self, waiting: bool, started_s: float) -> list[QuestionTask]:
        """Which jobs does nobody seem to have? They are not looked at again for a minute.

        `waiting`: whether there are questions in the queue; a job may be among them then, for a minute.
        `started_s`: how long a question takes at the longest.
        """
        time = now().timestamp()
        ids = await self._due(PENDING, time)
        stalled = []
        for job, fields in zip(ids, await self._hashes([key_of("job", each) for each in ids]), strict=True):
            task = task_of(fields)
            if task is None or "record" in fields:
                await self._redis.zrem(PENDING, job)
                continue
            touched = float(fields.get("touched") or datetime.fromisoformat(fields["created"]).timestamp())
            patience_s = started_s if "started" in fields else AGAIN_S if waiting else LOST_S
            lost = abs(time - touched) >= patience_s  # what was touched later than now was so by another clock
            await self._redis.zadd(PENDING, {job: time + (AGAIN_S if lost else LOST_S)}, xx=True)
            if lost:
                stalled.append(task)
        return stalled

    async def stalled_models(self) -> list[tuple[str, ModelResource]]:
        """Which files, and whose, have been read for long, or does nobody read? Not looked at again for a while."""
        time = now().timestamp()
        stalled = []
        for each in await self._due(READING, time):
            tenant, _, model = each.partition(":")
            found = await self.model(tenant, model)
            if found is None or found.status is not ModelStatus.READING:
                await self._redis.zrem(READING, each)
                continue
            await self._redis.zadd(READING, {each: time + READ_AGAIN_S}, xx=True)
            stalled.append((tenant, found))
        return stalled

    async def _due(self, key: str, time: float) -> list[str]:
        """Members of a sorted set whose time has come, or is further away than any is put: the clock was moved."""
        async with self._redis.pipeline(transaction=False) as pipe:
            for first, last in ((0.0, time), (time + 2 * AGAIN_S, float("inf"))):
                pipe.zrangebyscore(key, first, last, start=0, num=DUE_AT_ONCE)
            due, moved = await pipe.execute()
        return [*due, *moved][:DUE_AT_ONCE]

    async def _done(self, stream: str, timeout_s: float) -> bool:
        """Is there an entry in a stream whose one entry tells that something is done?"""
        loop = asyncio.get_running_loop()
        deadline = loop.time() + timeout_s
        while True:
            left_s = deadline - loop.time()
            if await self._read(stream, "0", min(left_s, READ_S)):
                return True
            if left_s <= 0:
                return False

    async def _read(self, stream: str, after: str, timeout_s: float) -> list[tuple[str, dict[str, str]]]:
        answer = await self._redis.xread({stream: after}, block=max(1, int(timeout_s * 1e3)))
        return [each for _, entries in cast("Streams", answer or []) for each in entries]

    async def _page(self, key: str, offset: int, limit: int) -> tuple[list[str], int]:
        """Ids of a sorted set, the newest first, and how many there are; `limit` 0: all."""
        async with self._redis.pipeline() as pipe:
            pipe.zrevrange(key, offset, offset + limit - 1 if limit else -1)
            pipe.zcard(key)
            ids, total = await pipe.execute()
        return ids, total

    async def _hashes(self, keys: Sequence[str]) -> list[dict[str, str]]:
        async with self._redis.pipeline(transaction=False) as pipe:
            for key in keys:
                pipe.hgetall(key)
            return list(await pipe.execute())

    async def _hash(self, key: str) -> dict[str, str]:
        return await cast("Awaitable[dict[str, str]]", self._redis.hgetall(key))


def _order(number: str) -> tuple[int, ...]:
    """What the ids of a stream's entries are ordered by."""
    return tuple(map(int, number.split("-")))
