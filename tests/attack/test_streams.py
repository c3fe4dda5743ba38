"""Streams that are held open: so many of a job, and no more."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from tests.api.fakes import MODEL, STEP

from querycad_api.app import make_app
from querycad_api.jobs import endpoints
from querycad_api.jobs.endpoints import JOB_STREAMS
from querycad_api.settings import ApiSettings


@pytest.fixture
def client(redis_url: str, tmp_path: Path, serving: Any) -> Iterator[httpx.Client]:
    settings = ApiSettings(redis_url=redis_url, home=tmp_path, sandbox_url="http://127.0.0.1:1")
    with serving(make_app(settings)) as client:
        yield client


def test_a_job_has_so_many_streams_and_one_that_ends_makes_room(client: httpx.Client) -> None:
    client.post("/v1/models", files={"file": ("a.step", STEP)})
    job = client.post(f"/v1/models/{MODEL}/questions", json={"question": "How many holes?"}).json()["id"]
    path = f"/v1/jobs/{job}/events"
    with contextlib.ExitStack() as streams:
        for _ in range(JOB_STREAMS):
            assert streams.enter_context(client.stream("GET", path)).status_code == 200
        refused = client.get(path)
        assert (refused.status_code, refused.headers["content-type"]) == (429, "application/problem+json")
        assert int(refused.headers["retry-after"]) > 0
    for _ in range(50):  # the service learns of the ends when it next looks
        with client.stream("GET", path) as again:
            if again.status_code == 200:
                return
        time.sleep(0.1)
    raise AssertionError("streams that were left still count")


def test_a_key_has_so_many_streams_of_all_its_jobs(client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(endpoints, "KEY_STREAMS", 3)
    client.post("/v1/models", files={"file": ("a.step", STEP)})
    jobs = [
        client.post(f"/v1/models/{MODEL}/questions", json={"question": f"How many holes of {number} mm?"}).json()["id"]
        for number in range(4)
    ]
    with contextlib.ExitStack() as streams:
        for job in jobs[:3]:
            assert streams.enter_context(client.stream("GET", f"/v1/jobs/{job}/events")).status_code == 200
        assert client.get(f"/v1/jobs/{jobs[3]}/events").status_code == 429
