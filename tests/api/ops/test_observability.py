"""What is seen from outside: ids that lead through all logs, metrics, the page."""

from __future__ import annotations

import json
import logging
import re
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families
from redis import Redis
from starlette.exceptions import HTTPException
from tests.api.fakes import MODEL, FakeSandbox

from querycad_api.app import make_app
from querycad_api.questions.tasks import Questions
from querycad_api.settings import ApiSettings
from querycad_api.store.keyspace import key_of
from querycad_contracts import IngestTask, QuestionTask, current_request, working_for
from querycad_contracts.infrastructure import LogFormat, start_logging


@pytest.fixture
def fresh_logging() -> Iterator[None]:
    root = logging.getLogger()
    handlers, level = root.handlers[:], root.level
    yield
    root.handlers[:], root.level = handlers, level
    logging.captureWarnings(False)


def answered(client: httpx.Client, redis: Redis, worker: Questions, question: str) -> str:
    job: str = client.post(f"/v1/models/{MODEL}/questions", json={"question": question}).json()["id"]
    worker.answer(QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task"))))
    return job


def metrics(client: httpx.Client) -> dict[tuple[str, tuple[tuple[str, str], ...]], float]:
    families = text_string_to_metric_families(client.get("/metrics").text)
    return {
        (each.name, tuple(sorted(each.labels.items()))): each.value for family in families for each in family.samples
    }


def test_a_request_has_the_id_that_its_client_gives_it(client: httpx.Client, model: str, redis: Redis) -> None:
    headers = {"X-Request-ID": "from-metawizard.17"}
    response = client.post(f"/v1/models/{model}/questions", json={"question": "?"}, headers=headers)
    assert response.headers["x-request-id"] == "from-metawizard.17"
    task = QuestionTask.model_validate_json(str(redis.hget(key_of("job", response.json()["id"]), "task")))
    assert task.request == "from-metawizard.17"


@pytest.mark.parametrize("given", ["", "a b", "x" * 65, 'a"b', "a\tb"])
def test_a_request_whose_id_is_not_fit_gets_another(client: httpx.Client, given: str) -> None:
    found = client.get("/livez", headers={"X-Request-ID": given}).headers["x-request-id"]
    assert re.fullmatch(r"[0-9a-f]{32}", found)


def test_problems_have_an_id_too(client: httpx.Client) -> None:
    assert client.get("/v1/nothing").headers["x-request-id"]


def test_a_flaw_is_a_problem_whose_id_leads_to_its_cause_in_the_log(
    settings: ApiSettings, serving: Any, caplog: pytest.LogCaptureFixture
) -> None:
    app = make_app(settings)

    @app.get("/flawed")
    async def flawed() -> None:
        raise ZeroDivisionError("of ours")

    with serving(app) as client:
        response = client.get("/flawed", headers={"X-Request-ID": "r-7"})
        assert metrics(client)[
            ("querycad_http_requests_total", (("method", "GET"), ("route", "/flawed"), ("status", "500")))
        ]
    assert (response.status_code, response.headers["content-type"]) == (500, "application/problem+json")
    assert response.headers["x-request-id"] == "r-7"
    assert "of ours" not in response.text
    (told,) = [each for each in caplog.records if each.exc_info]
    assert isinstance(told.exc_info and told.exc_info[1], ZeroDivisionError)


@pytest.mark.parametrize("flaw", [OSError(28, "No space left on device"), HTTPException(400)])
def test_a_full_disk_is_no_fault_of_the_request(settings: ApiSettings, serving: Any, flaw: Exception) -> None:
    app = make_app(settings)

    @app.get("/full")
    async def full() -> None:
        if isinstance(flaw, HTTPException):  # as FastAPI tells what went wrong while it read a body
            raise flaw from OSError(28, "No space left on device")
        raise flaw

    with serving(app) as client:
        response = client.get("/full")
    assert (response.status_code, response.json()["title"]) == (507, "Disk full")
    assert response.json()["retryable"] is True
    assert int(response.headers["retry-after"]) > 0


def test_what_is_done_for_a_request_has_its_id() -> None:
    assert IngestTask(model=MODEL, file_name="a").request == ""
    with working_for("abc"):
        assert IngestTask(model=MODEL, file_name="a").request == "abc"
    assert current_request() == ""


def test_a_log_line_is_one_json_object_with_the_requests_id(
    fresh_logging: None, capsys: pytest.CaptureFixture[str]
) -> None:
    start_logging("api", LogFormat.JSON)
    with working_for("r-1"):
        logging.getLogger("some.where").info("two\nlines", extra={"job": "j"})
    try:
        raise ValueError("broken")
    except ValueError:
        logging.getLogger("x").exception("it failed")
    first, second = map(json.loads, capsys.readouterr().err.splitlines())
    wanted = {"service": "api", "request": "r-1", "message": "two\nlines", "level": "info", "job": "j"}
    assert wanted.items() <= first.items()
    assert "ValueError: broken" in second["error"]


def test_a_log_line_for_people_says_the_same(fresh_logging: None, capsys: pytest.CaptureFixture[str]) -> None:
    start_logging("api")
    with working_for("r-1"):
        logging.getLogger("some.where").warning("slow", extra={"ms": 12})
    assert re.search(r"WARNING r-1 some\.where: slow ms=12$", capsys.readouterr().err.strip())


def test_requests_and_questions_are_counted(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, sandbox: FakeSandbox
) -> None:
    before = metrics(client)
    assert before["querycad_waiting_tasks", (("queue", "ingest"),)] == 1
    for question in ("How many holes are there?", "How many holes are there?", "Who wrote this song?"):
        answered(client, redis, worker, question)
    found = metrics(client)
    assert found["querycad_questions_total", (("failure", ""), ("status", "answered"))] == 2
    assert found["querycad_questions_total", (("failure", "not_understood"), ("status", "failed"))] == 1
    assert found["querycad_question_seconds_count", ()] == 3
    assert found["querycad_question_seconds_bucket", (("le", "60"),)] <= 3
    asked = (("method", "POST"), ("route", "/v1/models/{model_id}/questions"), ("status", "202"))
    assert found["querycad_http_requests_total", asked] == 3


def test_what_clients_invent_makes_no_series(client: httpx.Client) -> None:
    for path in ("/a", "/b", "/v1/models/x/y/z"):
        client.get(path)
    client.request("BREW", "/pot")
    labels = [labels for name, labels in metrics(client) if name == "querycad_http_requests_total"]
    assert {dict(each)["route"] for each in labels} <= {"none", "/metrics"}
    assert {dict(each)["method"] for each in labels} <= {"any", "GET"}


@pytest.mark.parametrize("form", LogFormat)
def test_what_a_client_sends_neither_begins_a_line_of_the_log_nor_steers_a_terminal(
    form: LogFormat, fresh_logging: None, capsys: pytest.CaptureFixture[str]
) -> None:
    start_logging("api", form)
    path = "/v1/models/größe\n2026 INFO forged\r\x1b[31m\x7f\x85\u2028\u202e"
    logging.getLogger("test").info("no file %s", path, extra={"path": path})
    try:
        raise ValueError(path)
    except ValueError:
        logging.getLogger("test").exception("failed")
    lines = capsys.readouterr().err.removesuffix("\n").split("\n")
    assert all(line.isprintable() for line in lines)
    assert not any(line.startswith("2026 INFO forged") for line in lines[:2])
    assert "größe\\n2026 INFO forged\\r\\u001b[31m" in lines[0]
    if form is LogFormat.JSON:
        assert [json.loads(line).get("path") for line in lines] == [path, None]
