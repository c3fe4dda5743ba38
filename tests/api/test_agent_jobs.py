"""A job of an agent that is called off in the middle, and one that goes on where it was interrupted.

That there are no holes is doubted: the program comes a second time, and then stands.
"""

from __future__ import annotations

import os
import shlex
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler
from pathlib import Path
from typing import Any

import httpx
import pytest
from celery.exceptions import SoftTimeLimitExceeded
from redis import Redis
from tests.answering.llm.conftest import Script, program, said, scripted
from tests.api.fakes import FakeSandbox, FakeSegcad
from tests.api.jobs.test_jobs import events, task_of
from tests.api.test_stopping import WITHIN_S, SlowSandbox, segworker, slow, until

from querycad_api.questions.tasks import Questions
from querycad_api.settings import ApiSettings
from querycad_api.store.keyspace import key_of
from querycad_api.store.ledger import Ledger

__all__ = ["scripted", "segworker", "slow"]  # the fixtures

LOOK = said(program("print(shape.name)"))
ANSWER = said(program("solution = len(parts(kind='hole'))"))
KEY = "sk-secret-of-the-worker"
BODY = {"question": "How many holes are there?", "codegen": "agent"}


class Held:
    """An endpoint's reply that does not come; notes when who waits for it has hung up."""

    def __init__(self) -> None:
        self.begun = threading.Event()
        self.hung_up = threading.Event()

    def __call__(self, handler: BaseHTTPRequestHandler) -> None:
        self.begun.set()
        handler.connection.settimeout(WITHIN_S)
        if handler.connection.recv(1, socket.MSG_PEEK) == b"":
            self.hung_up.set()


@contextmanager
def working(settings: ApiSettings, slow: SlowSandbox, log: Path, **more: str) -> Iterator[Path]:
    """A worker with one process; its log."""
    slow.answers = True
    environment = os.environ | {
        "QUERYCAD_REDIS_URL": settings.redis_url,
        "QUERYCAD_SANDBOX_URL": f"http://127.0.0.1:{slow.server_port}",
        "QUERYCAD_QUESTION_PROCESSES": "1",
        **{f"QUERYCAD_{name.upper()}": value for name, value in more.items()},
    }
    with log.open("wb") as out:
        process = subprocess.Popen(
            [sys.executable, "-m", "querycad_api.worker"], env=environment, stderr=out, stdout=out
        )
    try:
        yield log
    finally:
        process.terminate()
        try:
            process.wait(30)
        finally:
            process.kill()
            process.wait()


def submitted(client: httpx.Client, model: str) -> str:
    return str(client.post(f"/v1/models/{model}/questions", json=BODY).json()["id"])


def done(client: httpx.Client, job: str) -> Any:
    return until(lambda: (found := client.get(f"/v1/jobs/{job}").json())["status"] == "done" and found["record"])


def test_an_agent_is_stopped_in_the_middle_of_its_conversation(
    client: httpx.Client,
    model: str,
    settings: ApiSettings,
    slow: SlowSandbox,
    segworker: object,
    scripted: Callable[[Script], str],
    tmp_path: Path,
) -> None:
    held = Held()
    script = Script([LOOK, held, ANSWER])
    with working(settings, slow, tmp_path / "log", llm_base_url=scripted(script), llm_api_key=KEY) as log:
        first = submitted(client, model)
        assert held.begun.wait(WITHIN_S), log.read_text()
        client.post(f"/v1/jobs/{first}/cancel").raise_for_status()
        assert held.hung_up.wait(WITHIN_S), log.read_text()
        asked = len(script.bodies)
        record = done(client, submitted(client, model))  # the same process goes on to the next
        assert (record["codegen"], record["answer"]["value"]) == ("agent", 0)
        assert len(script.bodies) == asked + 2
        kinds = [kind for _, kind, _ in events(client, first)]
        assert kinds == ["queued", "started", "program", "ran", "done"]
        assert client.get(f"/v1/jobs/{first}").json()["record"]["failure"]["category"] == "cancelled"
        assert "exited" not in log.read_text()
        assert KEY not in log.read_text() + client.get(f"/v1/jobs/{first}").text
        assert all(headers["authorization"] == f"Bearer {KEY}" for headers in script.headers)


def test_a_command_in_a_models_place_ends_with_its_job(
    client: httpx.Client, model: str, settings: ApiSettings, slow: SlowSandbox, segworker: object, tmp_path: Path
) -> None:
    mark = tmp_path / "pid"
    code = f"import os, time; open({str(mark)!r}, 'w').write(str(os.getpid())); time.sleep(100)"
    command = shlex.join([sys.executable, "-c", code])
    with working(settings, slow, tmp_path / "log", llm_command=command) as log:
        job = submitted(client, model)
        until(lambda: mark.exists() and mark.read_text())
        began = time.monotonic()
        client.post(f"/v1/jobs/{job}/cancel").raise_for_status()
        until(lambda: not Path(f"/proc/{mark.read_text()}").exists())
        assert time.monotonic() - began < 10, log.read_text()


def test_an_interrupted_job_goes_on_where_it_was(
    client: httpx.Client,
    model: str,
    redis: Redis,
    settings: ApiSettings,
    ledger: Ledger,
    scripted: Callable[[Script], str],
) -> None:
    """Another worker takes it up: what the language model said is said again without it being asked."""
    script = Script([LOOK, ANSWER])
    with_llm = settings.model_copy(update={"llm_base_url": scripted(script), "llm_model": "m"})
    sandbox = FakeSandbox()

    def interrupted() -> None:
        if sandbox.runs == 2:
            raise SoftTimeLimitExceeded

    def worker() -> Questions:
        return Questions(with_llm, ledger, sandbox, FakeSegcad())  # type: ignore[arg-type]

    sandbox.before = interrupted
    job = submitted(client, model)
    assert worker().answer(task_of(redis, job)) == 0.0
    assert client.get(f"/v1/jobs/{job}").json()["status"] != "done"
    assert len(script.bodies) == 2
    assert redis.llen(key_of("said", job)) == 2
    worker().answer(task_of(redis, job))
    record = client.get(f"/v1/jobs/{job}").json()["record"]
    assert (record["codegen"], record["answer"]["value"], len(record["attempts"])) == ("agent:m", 0, 3)
    assert len(script.bodies) == 3
    assert not redis.exists(key_of("said", job))
    kinds = [kind for _, kind, _ in events(client, job)]
    before, after = ["program", "ran", "program"], ["program", "ran"]
    assert kinds == ["queued", "started", *before, "waiting", *after * 4, "done"]


def test_what_was_said_for_one_job_is_not_said_for_another(
    client: httpx.Client,
    model: str,
    redis: Redis,
    settings: ApiSettings,
    ledger: Ledger,
    scripted: Callable[[Script], str],
) -> None:
    script = Script([ANSWER])
    with_llm = settings.model_copy(update={"llm_base_url": scripted(script), "llm_model": "m"})
    worker = Questions(with_llm, ledger, FakeSandbox(), FakeSegcad())  # type: ignore[arg-type]
    for asked in (2, 4):
        worker.answer(task_of(redis, submitted(client, model)))
        assert len(script.bodies) == asked


@pytest.mark.parametrize("codegen", ["llm", "agent"])
def test_one_connection_serves_the_questions_of_a_worker(
    client: httpx.Client,
    model: str,
    redis: Redis,
    settings: ApiSettings,
    ledger: Ledger,
    scripted: Callable[[Script], str],
    codegen: str,
) -> None:
    """What a server refused of the first question is not sent with the second."""
    refusal = Script([refused, ANSWER])
    with_llm = settings.model_copy(update={"llm_base_url": scripted(refusal), "llm_capable": True})
    worker = Questions(with_llm, ledger, FakeSandbox(), FakeSegcad())  # type: ignore[arg-type]
    for _ in range(2):
        posted = client.post(f"/v1/models/{model}/questions", json={**BODY, "codegen": codegen})
        worker.answer(task_of(redis, posted.json()["id"]))
    assert ["tools" in body for body in refusal.bodies][:2] == [True, False]
    assert len(refusal.bodies) > 2
    assert not any("tools" in body for body in refusal.bodies[2:])


def refused(handler: BaseHTTPRequestHandler) -> None:
    content = b'{"error": "this model does not support tools"}'
    handler.send_response(400)
    handler.send_header("Content-Length", str(len(content)))
    handler.end_headers()
    handler.wfile.write(content)
