"""Quotas: what one tenant can make the service keep, and for how long."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import httpx
import pytest
from redis import Redis
from redis.asyncio import Redis as AsyncRedis
from tests.api.fakes import MODEL, STEP, SUMMARY
from tests.made import hole

from querycad_api.app import make_app
from querycad_api.dependencies import Application
from querycad_api.models.expiry import drop_failed
from querycad_api.settings import ApiSettings
from querycad_api.store.broker import Broker
from querycad_api.store.keyspace import RECORD_BYTES, UNREAD, bounded, key_of
from querycad_api.store.ledger import Ledger
from querycad_api.store.state import State
from querycad_contracts import (
    NO_ACCOUNTS,
    AnswerRecord,
    Failure,
    FailureCategory,
    Job,
    ModelSummary,
    QuestionTask,
    TaskFailure,
    TaskFailureKind,
    TaskOutcome,
)
from querycad_contracts.infrastructure import file_store
from querycad_segworker import tasks
from querycad_segworker.model import Artefacts, ModelStore
from querycad_segworker.settings import SegworkerSettings


@pytest.fixture
def settings(redis_url: str, tmp_path: Path) -> ApiSettings:
    return ApiSettings(
        redis_url=redis_url,
        home=tmp_path,
        upload_mib=2,
        tenant_mib=UNREAD,
        tenant_answers=3,
        tenant_answers_mib=1,
        sandbox_url="http://127.0.0.1:1",
    )


@pytest.fixture
def client(settings: ApiSettings, serving: Any) -> Iterator[httpx.Client]:
    with serving(make_app(settings)) as client:
        yield client


@pytest.fixture
def redis(settings: ApiSettings) -> Iterator[Redis]:
    with Redis.from_url(settings.redis_url, decode_responses=True) as redis:
        yield redis


@pytest.fixture
def ledger(redis: Redis, settings: ApiSettings) -> Ledger:
    return Ledger(redis, settings.answers_days)


def upload(client: httpx.Client, content: bytes) -> httpx.Response:
    return client.post("/v1/models", files={"file": ("a.step", content)})


def stored(home: Path) -> int:
    return sum(path.stat().st_size for path in (home / "files").rglob("*") if path.is_file())


def test_more_than_a_tenants_quota_is_refused_and_not_kept(client: httpx.Client, settings: ApiSettings) -> None:
    piece = STEP + b" " * 400_000
    taken = [upload(client, piece + b" " * n) for n in range(3)]
    assert [each.status_code for each in taken] == [202, 202, 507]
    problem = taken[-1].json()
    assert (problem["title"], problem["retryable"]) == ("Storage quota reached", False)
    assert f"{UNREAD} MiB" in problem["detail"]
    assert stored(settings.home) <= 2**20
    assert not list(settings.home.glob("upload-*"))
    assert upload(client, piece).status_code in (200, 202)  # what is there already is no more
    client.delete(f"/v1/models/{taken[0].json()['id']}")
    assert upload(client, piece + b"  ").status_code == 202


def test_what_is_read_of_a_tenants_files_counts_towards_its_quota(client: httpx.Client, ledger: Ledger) -> None:
    assert upload(client, STEP).status_code == 202
    read = SUMMARY.model_copy(update={"kept_bytes": UNREAD * 2**20 - len(STEP)})
    ledger.finish_model(NO_ACCOUNTS, MODEL, TaskOutcome[ModelSummary](value=read))
    assert client.get(f"/v1/models/{MODEL}").json()["summary"]["kept_bytes"] == read.kept_bytes
    refused = upload(client, STEP + b" ")
    assert refused.status_code == 507
    assert "what is read of them" in refused.json()["detail"]
    client.delete(f"/v1/models/{MODEL}")
    assert upload(client, STEP + b" ").status_code == 202


def test_what_is_not_read_yet_is_counted_for_what_will_be_read_of_it(client: httpx.Client, ledger: Ledger) -> None:
    piece = STEP + b" " * 700_000
    model = upload(client, piece).json()["id"]
    assert upload(client, piece + b" ").status_code == 507
    failure = TaskFailure(kind=TaskFailureKind.FILE, message="the file is damaged")
    ledger.finish_model(NO_ACCOUNTS, model, TaskOutcome[ModelSummary](failure=failure))
    assert upload(client, piece + b" ").status_code == 202


def test_a_file_that_another_tenant_has_is_not_removed_when_it_is_too_much_for_one(settings: ApiSettings) -> None:
    async def both() -> tuple[bool, bool]:
        async with AsyncRedis.from_url(settings.redis_url, decode_responses=True) as redis:
            state = State(redis, 30)
            await redis.sadd("querycad:owners:" + "c" * 64, "other")
            return await state.owned("c" * 64), await state.owned("d" * 64)

    assert asyncio.run(both()) == (True, False)


def test_the_oldest_answers_of_a_tenant_go_and_what_is_open_stays(
    client: httpx.Client, redis: Redis, ledger: Ledger, settings: ApiSettings
) -> None:
    upload(client, STEP)
    ledger.finish_model(NO_ACCOUNTS, MODEL, TaskOutcome[ModelSummary](value=SUMMARY))

    def ask() -> str:
        return Job.model_validate_json(
            client.post(f"/v1/models/{MODEL}/questions", json={"question": "How many?"}).content
        ).id

    first = [ask() for _ in range(3)]
    for job in first:
        redis.hset(key_of("job", job), "record", AnswerRecord.cancelled("How many?").model_dump_json())
    assert [client.get(f"/v1/jobs/{job}").status_code for job in first] == [200] * 3  # as many as are kept: none goes
    redis.delete(key_of("answers", NO_ACCOUNTS), key_of("asked", NO_ACCOUNTS, MODEL))
    opened = ask()
    done = [ask() for _ in range(4)]
    for job in done:
        redis.hset(key_of("job", job), "record", AnswerRecord.cancelled("How many?").model_dump_json())
    last = ask()
    kept = [job for job in (opened, *done, last) if client.get(f"/v1/jobs/{job}").status_code == 200]
    assert kept == [opened, *done[-2:], last]  # three, and what is open among the oldest
    assert redis.zcard(key_of("answers", NO_ACCOUNTS)) == 4
    assert len(client.get(f"/v1/models/{MODEL}/answers").json()["items"]) == 4


def test_answers_of_a_tenant_are_bounded_in_bytes_and_the_oldest_go(
    client: httpx.Client, redis: Redis, ledger: Ledger, settings: ApiSettings
) -> None:
    upload(client, STEP)
    ledger.finish_model(NO_ACCOUNTS, MODEL, TaskOutcome[ModelSummary](value=SUMMARY))

    def answered(size: int) -> str:
        asked = client.post(f"/v1/models/{MODEL}/questions", json={"question": "How many?"})
        job = Job.model_validate_json(asked.content).id
        record = AnswerRecord.cancelled("How many?").model_copy(update={"warnings": ("w" * size,)})
        task = QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))
        ledger.finish_job(task, record, 0.1)
        return job

    first, second = answered(700_000), answered(600_000)
    assert client.get(f"/v1/jobs/{first}").status_code == 200  # until more is asked
    third = answered(10)
    assert [client.get(f"/v1/jobs/{job}").status_code for job in (first, second, third)] == [404, 200, 200]
    assert redis.zrange(key_of("asked", NO_ACCOUNTS, MODEL), 0, -1) == [second, third]  # nothing is left of the first
    assert not list(redis.scan_iter(f"*{first}*"))
    kept = redis.hgetall(key_of("bytes", NO_ACCOUNTS))
    assert set(kept) == {"sum", second, third}
    assert 600_000 < int(kept["sum"]) == int(kept[second]) + int(kept[third]) < 2**20
    client.delete(f"/v1/models/{MODEL}")
    assert not redis.exists(key_of("bytes", NO_ACCOUNTS))


def test_a_record_is_bounded_in_size() -> None:
    small = AnswerRecord.cancelled("How many?")
    assert AnswerRecord.model_validate_json(bounded(small)) == small
    for large in (
        small.model_copy(update={"warnings": ("w" * 2 * RECORD_BYTES,)}),
        AnswerRecord.failed("q" * 2 * RECORD_BYTES, Failure(category=FailureCategory.INTERNAL, message="m")),
    ):
        text = bounded(large)
        assert len(text) <= RECORD_BYTES
        assert "bytes that are kept" in text


def test_a_record_about_a_thousand_parts_keeps_their_faces() -> None:
    holes = [hole(n, x=n * 9.7, faces=tuple(range(10 * n, 10 * n + 10))) for n in range(1500)]
    record = AnswerRecord.cancelled("How many holes?").model_copy(update={"parts": tuple(holes)})
    assert AnswerRecord.model_validate_json(bounded(record)) == record


def test_files_that_could_not_be_read_go_after_some_days(
    client: httpx.Client, settings: ApiSettings, ledger: Ledger
) -> None:
    bad, good = upload(client, STEP + b" ").json()["id"], upload(client, STEP).json()["id"]
    failure = TaskFailure(kind=TaskFailureKind.FILE, message="the file is damaged")
    ledger.finish_model(NO_ACCOUNTS, bad, TaskOutcome[ModelSummary](failure=failure))
    ledger.finish_model(NO_ACCOUNTS, good, TaskOutcome[ModelSummary](value=SUMMARY))

    async def dropped(days: float) -> int:
        async with AsyncRedis.from_url(settings.redis_url, decode_responses=True) as redis:
            broker = Broker(settings.redis_url, redis)
            application = Application(settings, State(redis, 30), broker, file_store(settings))
            try:
                return await drop_failed(application, datetime.now(UTC) - timedelta(days=days))
            finally:
                broker.close()

    assert asyncio.run(dropped(1)) == 0
    assert asyncio.run(dropped(-1)) == 1
    assert [client.get(f"/v1/models/{each}").status_code for each in (bad, good)] == [404, 200]
    assert stored(settings.home) == len(STEP)


def test_views_of_a_model_in_all_sizes_do_not_fill_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tasks, "DRAWN", 3)
    settings = SegworkerSettings(home=tmp_path)
    cache = tasks.ModelCache(settings)
    store = ModelStore(settings.models)
    store.folder(MODEL).mkdir(parents=True)
    (store.folder(MODEL) / "model.json").write_text("{}")
    settings.upload(MODEL).parent.mkdir(parents=True)
    settings.upload(MODEL).write_text("x")

    def draw(_: Artefacts, path: Path) -> None:
        path.write_text("x")

    for n in range(6):
        made = cache.made_of(MODEL, f"top-{n}.png", draw)
        os.utime(tmp_path / made, (1e9 + n, 1e9 + n))
    assert sorted(path.name for path in (store.folder(MODEL) / "drawn").iterdir()) == [
        f"top-{n}.png" for n in (3, 4, 5)
    ]
