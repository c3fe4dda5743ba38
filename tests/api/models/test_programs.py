"""A caller's own program: sent to the sandbox as it is, with the service's limits, for a model of the caller's."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import httpx
import pytest
from tests.api.fakes import MODEL, STEP

from querycad_api.app import make_app
from querycad_api.models.programs import LIMITS
from querycad_api.settings import ApiSettings
from querycad_contracts import RunOutcome, RunRequest, RunStatus

CODE = "solution = len(parts(kind='hole'))"


class Sandbox:
    """Answers every run with the same, and keeps what it was sent."""

    def __init__(self) -> None:
        self.status, self.body = 200, RunOutcome(status=RunStatus.OK, value=3).model_dump_json()
        self.asked: list[RunRequest] = []
        made = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                made.asked.append(RunRequest.model_validate_json(self.rfile.read(int(self.headers["Content-Length"]))))
                self.send_response(made.status)
                self.send_header("Content-Length", str(len(made.body)))
                self.end_headers()
                self.wfile.write(made.body.encode())

            def log_message(self, *_: object) -> None:
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.thread = threading.Thread(target=self.server.serve_forever, daemon=True)
        self.thread.start()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.server.server_port}"


@pytest.fixture
def sandbox() -> Iterator[Sandbox]:
    made = Sandbox()
    yield made
    made.server.shutdown()
    made.server.server_close()
    made.thread.join()


@pytest.fixture
def client(redis_url: str, tmp_path: Path, sandbox: Sandbox, serving: Any) -> Iterator[httpx.Client]:
    settings = ApiSettings(redis_url=redis_url, home=tmp_path, sandbox_url=sandbox.url)
    with serving(make_app(settings)) as client:
        yield client


def test_a_program_is_run_in_the_sandbox_and_its_outcome_is_the_answer(
    client: httpx.Client, model: str, sandbox: Sandbox
) -> None:
    answer = client.post(f"/v1/models/{model}/programs", json={"code": CODE, "expects": "count"})
    assert answer.status_code == 200
    assert RunOutcome.model_validate_json(answer.content).value == 3
    (asked,) = sandbox.asked
    assert (asked.code, asked.model, asked.expects, asked.limits) == (CODE, model, "count", LIMITS)
    assert asked.check


def test_how_a_program_ends_is_no_error_of_the_request(client: httpx.Client, model: str, sandbox: Sandbox) -> None:
    sandbox.body = RunOutcome(status=RunStatus.REFUSED, message="line 1: no").model_dump_json()
    answer = client.post(f"/v1/models/{model}/programs", json={"code": "solution = nothing"})
    assert (answer.status_code, answer.json()["status"]) == (200, "refused")


@pytest.mark.parametrize(
    ("status", "sent", "answered", "title"),
    [
        (503, {"title": "Busy", "status": 503, "detail": "too many runs", "retryable": True}, 503, "too many runs"),
        (422, {"title": "Segworker failed", "status": 422, "detail": "the file is broken"}, 422, "the file is broken"),
        (500, "no problem at all", 503, "the sandbox does not answer"),
    ],
)
def test_what_could_not_be_run_says_why(
    client: httpx.Client, model: str, sandbox: Sandbox, status: int, sent: Any, answered: int, title: str
) -> None:
    sandbox.status, sandbox.body = status, json.dumps(sent)
    answer = client.post(f"/v1/models/{model}/programs", json={"code": CODE})
    assert (answer.status_code, answer.headers["content-type"]) == (answered, "application/problem+json")
    assert title in answer.json()["detail"]


@pytest.mark.parametrize("body", [{}, {"code": 3}, {"code": CODE, "limits": {}}])
def test_a_request_that_is_none_is_told_so_and_not_sent(
    client: httpx.Client, model: str, sandbox: Sandbox, body: dict[str, Any]
) -> None:
    assert client.post(f"/v1/models/{model}/programs", json=body).status_code == 422
    assert sandbox.asked == []


def test_a_model_that_is_not_there_or_not_read_runs_nothing(client: httpx.Client, sandbox: Sandbox) -> None:
    assert client.post(f"/v1/models/{MODEL}/programs", json={"code": CODE}).status_code == 404
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    assert client.post(f"/v1/models/{MODEL}/programs", json={"code": CODE}).status_code == 409
    assert sandbox.asked == []
