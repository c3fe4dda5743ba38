"""What is lost between a queue and a worker is sent again, and answered once."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from datetime import timedelta
from pathlib import Path
from typing import Any

import httpx
import pytest
from redis import Redis
from redis.asyncio import Redis as AsyncRedis
from tests.api.fakes import MODEL, STEP, FakeSandbox

from querycad_api.dependencies import Application
from querycad_api.jobs.redelivery import redeliver_once
from querycad_api.questions.tasks import Questions
from querycad_api.settings import ApiSettings
from querycad_api.store import keyspace
from querycad_api.store import state as keeping
from querycad_api.store.broker import Broker
from querycad_api.store.keyspace import DAY_S, PENDING, READING, key_of
from querycad_api.store.state import AGAIN_S, LOST_S, State
from querycad_contracts import QuestionTask
from querycad_contracts.infrastructure import FolderStore


def redelivered(settings: ApiSettings) -> None:
    async def once() -> None:
        async with AsyncRedis.from_url(settings.redis_url, decode_responses=True) as redis:
            broker = Broker(settings.redis_url, redis)
            state = State(redis, settings.answers_days)
            await redeliver_once(Application(settings, state, broker, FolderStore(Path(settings.home))))
            broker.close()

    asyncio.run(once())


def queued(redis: Redis, queue: str) -> list[str]:
    messages: Any = redis.lrange(queue, 0, -1)
    return [json.loads(message)["headers"]["id"] for message in messages]


def earlier(redis: Redis, job: str, seconds: float) -> None:
    """Lets time pass for a job."""
    created = QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))
    assert created.job == job
    redis.hset(key_of("job", job), "touched", float(redis.zscore(PENDING, job) or 0) - LOST_S - seconds)
    redis.zincrby(PENDING, -seconds, job)


@pytest.fixture
def job(client: httpx.Client, model: str, redis: Redis) -> str:
    """A job whose message went with a worker that was killed as it took it."""
    asked = client.post(f"/v1/models/{model}/questions", json={"question": "How many holes are there?"})
    redis.delete("questions")
    return str(asked.json()["id"])


def test_a_lost_question_is_sent_again_and_answered_once(
    settings: ApiSettings, redis: Redis, job: str, worker: Questions, sandbox: FakeSandbox
) -> None:
    redelivered(settings)
    assert queued(redis, "questions") == []  # it may still come
    earlier(redis, job, LOST_S + 1)
    redelivered(settings)
    redelivered(settings)
    assert queued(redis, "questions") == [job]
    task = QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))
    worker.answer(task)
    worker.answer(task)
    assert sandbox.runs == 1
    assert redis.zscore(PENDING, job) is None


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Callable[[float], None]:
    """Moves the clock of the process that looks, so many seconds from the true time."""

    def move(seconds: float) -> None:
        monkeypatch.setattr(keeping, "now", lambda: keyspace.now() + timedelta(seconds=seconds))

    return move


@pytest.mark.parametrize("moved_s", [-40 * DAY_S, -DAY_S, -600.0, 600.0, DAY_S])
def test_a_lost_question_is_found_whatever_becomes_of_the_clock(
    moved_s: float, settings: ApiSettings, redis: Redis, job: str, worker: Questions, clock: Callable[[float], None]
) -> None:
    """A clock that was put back left it until the time had come again."""
    for passed_s in (0.0, LOST_S + 1, AGAIN_S + 1, 2 * AGAIN_S + 1):
        clock(moved_s + passed_s)
        redelivered(settings)
    assert set(queued(redis, "questions")) == {job}
    task = QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))
    for _ in queued(redis, "questions"):
        worker.answer(task)
    kinds: Any = redis.xrange(f"querycad:events:{job}")
    assert [fields["kind"] for _, fields in kinds].count("done") == 1
    assert redis.zscore(PENDING, job) is None


@pytest.mark.parametrize("moved_s", [-40 * DAY_S, -DAY_S, 600.0])
def test_a_file_that_nobody_reads_is_found_whatever_becomes_of_the_clock(
    moved_s: float, client: httpx.Client, settings: ApiSettings, redis: Redis, clock: Callable[[float], None]
) -> None:
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    redis.delete("ingest")
    clock(moved_s)
    redelivered(settings)
    assert len(queued(redis, "ingest")) == 1


def test_a_question_that_may_be_in_the_queue_is_given_time(
    client: httpx.Client, settings: ApiSettings, redis: Redis, job: str
) -> None:
    other = client.post(f"/v1/models/{MODEL}/questions", json={"question": "How many slots are there?"}).json()["id"]
    earlier(redis, job, LOST_S + 1)
    redelivered(settings)
    assert queued(redis, "questions") == [other]
    earlier(redis, job, AGAIN_S + LOST_S)
    redelivered(settings)
    assert sorted(queued(redis, "questions")) == sorted([other, job])


def test_a_question_that_somebody_works_on_is_left_to_them(settings: ApiSettings, redis: Redis, job: str) -> None:
    redis.hset(key_of("job", job), "started", "2026-01-01T00:00:00+00:00")
    earlier(redis, job, settings.question_s)
    redelivered(settings)
    assert queued(redis, "questions") == []
    earlier(redis, job, 2.0 * settings.question_s)
    redelivered(settings)
    assert queued(redis, "questions") == [job]


def test_a_file_that_nobody_reads_is_sent_again(client: httpx.Client, settings: ApiSettings, redis: Redis) -> None:
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    redis.delete("ingest")
    redelivered(settings)
    assert queued(redis, "ingest") == []
    redis.zadd(READING, {f"local:{MODEL}": 1.0})
    redelivered(settings)
    assert len(queued(redis, "ingest")) == 1


def test_what_is_done_is_not_looked_at_any_more(
    settings: ApiSettings, redis: Redis, job: str, model: str, worker: Questions
) -> None:
    worker.answer(QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task"))))
    assert redis.zcard(PENDING) == 0
    assert redis.zcard(READING) == 0
