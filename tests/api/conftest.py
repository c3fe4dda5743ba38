"""The web process against a real store and empty queues; what workers would do is done by the tests."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from redis import Redis
from tests.api.fakes import MODEL, STEP, SUMMARY, FakeSandbox, FakeSegcad

from querycad_api.app import make_app
from querycad_api.questions.tasks import Questions
from querycad_api.settings import ApiSettings
from querycad_api.store.ledger import Ledger
from querycad_contracts import NO_ACCOUNTS, ModelSummary, TaskOutcome


@pytest.fixture
def settings(redis_url: str, tmp_path: Path) -> ApiSettings:
    return ApiSettings(redis_url=redis_url, home=tmp_path, upload_mib=1, wait_s=20, sandbox_url="http://127.0.0.1:1")


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


@pytest.fixture
def sandbox() -> FakeSandbox:
    return FakeSandbox()


@pytest.fixture
def worker(settings: ApiSettings, ledger: Ledger, sandbox: FakeSandbox) -> Questions:
    return Questions(settings, ledger, sandbox, FakeSegcad())  # type: ignore[arg-type]


@pytest.fixture
def model(client: httpx.Client, ledger: Ledger) -> str:
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    ledger.finish_model(NO_ACCOUNTS, MODEL, TaskOutcome[ModelSummary](value=SUMMARY))
    return MODEL
