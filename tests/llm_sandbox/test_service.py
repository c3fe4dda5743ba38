"""The sandbox's service: 200 however a program ended, a problem when it could not be run."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from querycad_contracts import ModelTask, RunOutcome, RunStatus, TaskFailure, TaskFailureKind, TaskName, TaskOutcome
from querycad_sandbox.app import BODY_BYTES, make_app
from querycad_sandbox.control import RunControl
from querycad_sandbox.remote import SegworkerUnavailable
from querycad_sandbox.settings import SandboxSettings

MODEL = "0123456789abcdef" * 4
NO_HOLES: dict[str, Any] = {
    "description": "hole",
    "sides": None,
    "parts": [],
    "understood": True,
    "message": "there are none",
}


class Queue:
    """Stands in for the queue: answers every call alike, or has no segworker."""

    def __init__(self) -> None:
        self.answer: dict[str, Any] | None = {"value": NO_HOLES, "failure": None}

    def __call__(self, name: TaskName, task: ModelTask, timeout_s: float, control: RunControl) -> str:
        if self.answer is None:
            raise SegworkerUnavailable("no segworker answered")
        return json.dumps(self.answer)


@pytest.fixture
def queue() -> Queue:
    return Queue()


@pytest.fixture
def client(queue: Queue, redis_url: str, serving: Any) -> Iterator[httpx.Client]:
    settings = SandboxSettings(redis_url=redis_url, sandbox_runs=2, sandbox_processes=1)
    with serving(make_app(settings, queue)) as client:
        yield client


def run(client: httpx.Client, code: str, **more: Any) -> Any:
    return client.post("/runs", json={"code": code, "model": MODEL, **more})


def test_a_program_runs_and_its_value_comes_back(client: httpx.Client) -> None:
    response = run(client, "solution = len(find_parts('hole'))")
    assert response.status_code == 200
    outcome = RunOutcome.model_validate_json(response.content)
    assert (outcome.status, outcome.value) == (RunStatus.OK, 0)
    assert outcome.groundings[0].message == "there are none"


@pytest.mark.parametrize(
    ("code", "status"),
    [
        ("solution = 1 / 0", RunStatus.RAISED),
        ("solution = open('/etc/passwd')", RunStatus.REFUSED),
        ("while True: pass", RunStatus.TIMED_OUT),
    ],
)
def test_a_program_s_own_failure_is_no_failure_of_the_service(
    client: httpx.Client, code: str, status: RunStatus
) -> None:
    response = run(client, code, limits={"duration_s": 0.2})
    assert response.status_code == 200
    assert response.json()["status"] == status


@pytest.mark.parametrize("body", [b"", b"[]", b'{"code": "solution = 1"}', b'{"code": 1, "model": "x", "more": 2}'])
def test_a_request_that_is_none_is_a_problem(client: httpx.Client, body: bytes) -> None:
    response = client.post("/runs", content=body)
    assert response.status_code == 422
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["errors"]


def test_a_request_that_is_too_long_is_refused(client: httpx.Client) -> None:
    assert run(client, "#" * BODY_BYTES).status_code == 413


def test_without_a_segworker_the_run_may_be_tried_again(client: httpx.Client, queue: Queue) -> None:
    queue.answer = None
    response = run(client, "solution = len(find_parts('hole'))")
    assert (response.status_code, response.json()["retryable"]) == (503, True)


def test_a_file_that_cannot_be_measured_is_not_the_service_s_fault(client: httpx.Client, queue: Queue) -> None:
    failure = TaskFailure(kind=TaskFailureKind.FILE, message="the CAD kernel could not measure this")
    queue.answer = TaskOutcome[None](failure=failure).model_dump(mode="json")
    response = run(client, "solution = shape.volume")
    assert (response.status_code, response.json()["detail"]) == (422, failure.message)


def test_it_is_ready_with_its_broker(client: httpx.Client) -> None:
    assert client.get("/livez").status_code == 200
    health = client.get("/readyz").json()
    assert (health["ready"], health["checks"]) == (True, {"broker": True, "interpreter": True, "walls": True})
    assert (health["walls"], health["missing"]) == ("required", [])


def test_it_says_which_layers_hold(client: httpx.Client) -> None:
    layers = client.get("/readyz").json()["layers"]
    assert layers["own_process"] is True
    assert layers.keys() >= {"landlock", "seccomp", "resource_limits", "unprivileged_user", "no_new_privileges"}


def test_it_is_alive_but_not_ready_without_its_broker(serving: Any) -> None:
    settings = SandboxSettings(redis_url="redis://127.0.0.1:1/0", sandbox_runs=2, sandbox_processes=1)
    with serving(make_app(settings, Queue())) as client:
        assert client.get("/livez").status_code == 200
        response = client.get("/readyz")
    assert response.status_code == 503
    assert response.json()["checks"] == {"broker": False, "interpreter": True, "walls": True}
