"""The web process against a real store and empty queues; what workers would do is done by the tests."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from redis import Redis

from querycad_api.app import make_app
from querycad_api.settings import ApiSettings
from querycad_api.state import Ledger


@pytest.fixture
def settings(redis_url: str, tmp_path: Path) -> ApiSettings:
    return ApiSettings(redis_url=redis_url, home=tmp_path, upload_mib=1, wait_s=2, sandbox_url="http://127.0.0.1:1")


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
