"""A question that runs is stopped when it is called off, in a real worker; its process goes on to the next."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import httpx
import pytest
from tests.api.fakes import NO_HOLE, FakeSegworker

from querycad_api.settings import ApiSettings
from querycad_contracts import RunOutcome, RunStatus

WITHIN_S = 60.0


class SlowSandbox(ThreadingHTTPServer):
    """Takes a run, and answers it when it is told to; notes when its client has hung up."""

    daemon_threads = True

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.begun = threading.Event()
        self.hung_up = threading.Event()
        self.answers = False


class Handler(BaseHTTPRequestHandler):
    server: SlowSandbox

    def do_POST(self) -> None:
        self.rfile.read(int(self.headers["Content-Length"]))
        if not self.server.answers:
            self.server.begun.set()
            if self.connection.recv(1) == b"":
                self.server.hung_up.set()
            return
        body = RunOutcome(status=RunStatus.OK, value=0, groundings=(NO_HOLE,)).model_dump_json().encode()
        self.send_response(200)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture
def slow() -> Iterator[SlowSandbox]:
    with SlowSandbox() as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


@pytest.fixture
def segworker(settings: ApiSettings) -> Iterator[FakeSegworker]:
    thread = FakeSegworker(settings.redis_url)
    thread.start()
    yield thread
    thread.stop()


@pytest.fixture
def real_worker(settings: ApiSettings, slow: SlowSandbox, segworker: FakeSegworker, tmp_path: Path) -> Iterator[Path]:
    """A worker with one process; its log."""
    environment = os.environ | {
        "QUERYCAD_REDIS_URL": settings.redis_url,
        "QUERYCAD_SANDBOX_URL": f"http://127.0.0.1:{slow.server_port}",
        "QUERYCAD_QUESTION_PROCESSES": "1",
        "QUERYCAD_CODEGEN": "parser",
    }
    log = tmp_path / "worker.log"
    with log.open("wb") as out:
        process = subprocess.Popen(
            [sys.executable, "-m", "querycad_api.worker"], env=environment, stderr=out, stdout=out
        )
    yield log
    process.terminate()
    process.wait(30)


def until(found: Callable[[], Any]) -> Any:
    deadline = time.monotonic() + WITHIN_S
    while not (value := found()):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    return value


def test_a_running_question_is_stopped_and_the_next_is_answered_by_the_same_process(
    client: httpx.Client, model: str, slow: SlowSandbox, real_worker: Path
) -> None:
    def ask() -> str:
        body = {"question": "How many holes are there?"}
        return str(client.post(f"/v1/models/{model}/questions", json=body).json()["id"])

    first = ask()
    assert slow.begun.wait(WITHIN_S), real_worker.read_text()
    slow.answers = True
    client.post(f"/v1/jobs/{first}/cancel").raise_for_status()
    assert slow.hung_up.wait(WITHIN_S), real_worker.read_text()
    second = ask()
    found = until(lambda: (job := client.get(f"/v1/jobs/{second}").json())["status"] == "done" and job)
    assert found["record"]["answer"]["value"] == 0
    assert client.get(f"/v1/jobs/{first}").json()["record"]["failure"]["category"] == "cancelled"
    assert "exited" not in real_worker.read_text()  # no process was lost over it
