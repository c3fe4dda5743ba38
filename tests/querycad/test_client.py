"""The client waits, tries again where that does no harm, and says what the service said."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import httpx
import pytest

from querycad import client as module
from querycad.client import Client, ServerProblem, ServerUnreachable
from querycad_contracts import AnswerRecord, Job, JobStatus, LengthUnit, Problem, Status

MODEL, JOB = "a" * 64, "b" * 32
RECORD = AnswerRecord(
    question="?", status=Status.ANSWERED, answer=None, code=None, codegen=None, parts=(), timings_ms={}, warnings=()
)
QUEUED = Job.model_validate(
    {"id": JOB, "model": MODEL, "question": "?", "unit": "mm", "status": "queued", "created": "2026-01-01T00:00:00Z"}
)
DONE = QUEUED.model_copy(update={"record": RECORD, "status": JobStatus.DONE})
AWAY = Problem(title="Service unavailable", status=503, detail="away", retryable=True)


def json(body: AnswerRecord | Job | Problem, status: int = 200) -> httpx.Response:
    return httpx.Response(status, content=body.model_dump_json(), headers={"Content-Type": "application/json"})


def client(*answers: httpx.Response | Exception) -> tuple[Client, list[httpx.Request]]:
    left, requests = list(answers), []

    def answer(request: httpx.Request) -> httpx.Response:
        requests.append(request)
        following = left.pop(0)
        if isinstance(following, Exception):
            raise following
        return following

    return Client("http://service", httpx.MockTransport(answer)), requests


@pytest.fixture(autouse=True)
def no_pause(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PAUSE_S", 0.0)


def test_an_answer_that_is_there_in_time_takes_one_request() -> None:
    with (made := client(json(RECORD)))[0] as asking:
        assert asking.ask(MODEL, "?", LengthUnit.IN) == RECORD
    (request,) = made[1]
    assert request.headers["prefer"] == f"wait={module.WAIT_S}"
    assert request.url.path == f"/v1/models/{MODEL}/questions"
    assert b'"unit":"in"' in request.content


def test_an_answer_that_takes_longer_is_waited_for() -> None:
    with (made := client(json(QUEUED, 202), json(QUEUED), json(DONE)))[0] as asking:
        assert asking.ask(MODEL, "?") == RECORD
    assert [request.url.path for request in made[1][1:]] == [f"/v1/jobs/{JOB}"] * 2


def test_waiting_ends() -> None:
    with client(json(QUEUED))[0] as asking, pytest.raises(TimeoutError):
        asking.wait(JOB, 0.0)


@pytest.mark.parametrize("trouble", [lambda: json(AWAY, 503), lambda: httpx.ConnectError("refused")])
def test_a_request_that_changes_nothing_is_tried_again(trouble: Callable[[], httpx.Response | Exception]) -> None:
    with (made := client(trouble(), trouble(), json(DONE)))[0] as asking:
        assert asking.wait(JOB) == RECORD
    assert len(made[1]) == 3


def test_a_question_is_not_asked_twice() -> None:
    with (made := client(json(AWAY, 503)))[0] as asking, pytest.raises(ServerProblem, match="away"):
        asking.ask(MODEL, "?")
    assert len(made[1]) == 1


def test_trouble_that_stays_is_told() -> None:
    with client(*[httpx.ConnectError("refused")] * 5)[0] as asking, pytest.raises(ServerUnreachable, match="refused"):
        asking.model(MODEL)


def test_a_refusal_tells_why() -> None:
    problem = Problem(title="No such model", status=404, detail="upload its file first")
    with client(json(problem, 404))[0] as asking, pytest.raises(ServerProblem) as refused:
        asking.model(MODEL)
    assert refused.value.problem == problem


@pytest.mark.parametrize("status", [200, 404, 500])
def test_an_answer_of_some_other_server_is_no_answer(status: int) -> None:
    strange = httpx.Response(status, text="<html>It works!</html>")
    with client(strange)[0] as asking, pytest.raises(ServerUnreachable, match="not as a QueryCAD service"):
        asking.model(MODEL)


def test_a_file_that_is_not_there_is_not_uploaded(tmp_path: Path) -> None:
    with client()[0] as asking, pytest.raises(FileNotFoundError):
        asking.upload(tmp_path / "none.step")
