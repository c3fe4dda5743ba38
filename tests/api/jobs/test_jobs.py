"""A job from outside: its steps as they happen, called off, listed, asked for twice, deleted with its model."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from redis import Redis
from tests.api.fakes import MODEL, STEP, SUMMARY, FakeSandbox

from querycad_api.questions.tasks import Questions
from querycad_api.settings import ApiSettings
from querycad_api.store.keyspace import key_of
from querycad_api.store.ledger import Ledger
from querycad_contracts import NO_ACCOUNTS, AnswerRecord, ModelSummary, QuestionTask, TaskOutcome
from querycad_contracts.infrastructure import models_name, picture_name, upload_name

QUESTION = "How many holes are there?"


def ask(client: httpx.Client, model: str, question: str = QUESTION, **headers: str) -> Any:
    return client.post(f"/v1/models/{model}/questions", json={"question": question}, headers=headers)


def ask_many(client: httpx.Client, model: str, questions: list[str], **headers: str) -> Any:
    body = {"questions": [{"question": each} for each in questions]}
    return client.post(f"/v1/models/{model}/questions/batch", json=body, headers=headers)


def task_of(redis: Redis, job: str) -> QuestionTask:
    return QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))


def queued(redis: Redis) -> list[str]:
    messages: Any = redis.lrange("questions", 0, -1)
    return [json.loads(message)["headers"]["id"] for message in messages]


def in_time(response: httpx.Response) -> Iterator[str]:
    """The response's lines; signs of life alone are not waited for."""
    deadline = time.monotonic() + 20
    for line in response.iter_lines():
        assert time.monotonic() < deadline
        yield line


def events(client: httpx.Client, job: str, **headers: str) -> list[tuple[str, str, dict[str, Any]]]:
    """Id, kind and data of all events of a job that is done."""
    with client.stream("GET", f"/v1/jobs/{job}/events", headers=headers) as response:
        assert response.status_code == 200
        assert response.headers["content-type"].startswith("text/event-stream")
        text = "\n".join(in_time(response))
    blocks = [block for block in text.split("\n\n") if "data: " in block]
    rows = [dict(row.split(": ", 1) for row in block.splitlines()) for block in blocks]
    return [(row["id"], row["event"], json.loads(row["data"])) for row in rows]


def test_every_step_of_a_question_is_an_event(
    client: httpx.Client, model: str, redis: Redis, worker: Questions
) -> None:
    job = ask(client, model).json()["id"]
    worker.answer(task_of(redis, job))
    told = events(client, job)
    assert [kind for _, kind, _ in told] == ["queued", "started", "program", "ran", "done"]
    assert "find_parts" in told[2][2]["code"]
    assert told[3][2]["outcome"] == "ok"
    assert AnswerRecord.model_validate(told[-1][2]["record"]).answer is not None
    assert told[-1][2]["record"] == client.get(f"/v1/jobs/{job}").json()["record"]


def test_who_comes_back_is_told_only_what_came_after(
    client: httpx.Client, model: str, redis: Redis, worker: Questions
) -> None:
    job = ask(client, model).json()["id"]
    worker.answer(task_of(redis, job))
    told = events(client, job)
    assert events(client, job, **{"Last-Event-ID": told[2][0]}) == told[3:]
    assert client.get(f"/v1/jobs/{job}/events", headers={"Last-Event-ID": "yesterday"}).status_code == 400


def test_who_was_told_all_need_not_come_back(client: httpx.Client, model: str, redis: Redis, worker: Questions) -> None:
    job = ask(client, model).json()["id"]
    path, later = f"/v1/jobs/{job}/events", f"{10**15}-0"
    worker.answer(task_of(redis, job))
    *_, before, (last, kind, _) = events(client, job)
    assert kind == "done"
    for after in (last, later):
        response = client.get(path, headers={"Last-Event-ID": after})
        assert (response.status_code, response.content) == (204, b"")
    assert [number for number, _, _ in events(client, job, **{"Last-Event-ID": before[0]})] == [last]


def test_a_question_that_waits_says_so_once(
    client: httpx.Client, redis: Redis, ledger: Ledger, worker: Questions
) -> None:
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    job = ask(client, MODEL).json()["id"]
    assert [worker.answer(task_of(redis, job), tries) is None for tries in range(4)] == [False] * 4
    ledger.finish_model(NO_ACCOUNTS, MODEL, TaskOutcome[ModelSummary](value=SUMMARY))
    worker.answer(task_of(redis, job))
    assert [kind for _, kind, _ in events(client, job)] == ["queued", "started", "waiting", "program", "ran", "done"]


def test_events_come_as_they_happen(client: httpx.Client, model: str, redis: Redis, worker: Questions) -> None:
    job = ask(client, model).json()["id"]
    kinds = []
    answering = threading.Thread(target=worker.answer, args=(task_of(redis, job),))
    with client.stream("GET", f"/v1/jobs/{job}/events") as response:
        for line in in_time(response):
            if line.startswith("event: "):
                kinds.append(line.removeprefix("event: "))
                if kinds == ["queued"]:
                    answering.start()
    answering.join()
    assert kinds == ["queued", "started", "program", "ran", "done"]


def test_events_of_a_job_that_is_not_there_are_a_problem(client: httpx.Client) -> None:
    response = client.get(f"/v1/jobs/{'0' * 32}/events")
    assert (response.status_code, response.headers["content-type"]) == (404, "application/problem+json")


def test_a_cancelled_question_ends_so_and_is_not_answered_any_more(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, sandbox: FakeSandbox
) -> None:
    job = ask(client, model).json()["id"]
    found = client.post(f"/v1/jobs/{job}/cancel").json()
    assert (found["status"], found["record"]["failure"]["category"]) == ("done", "cancelled")
    assert worker.answer(task_of(redis, job)) is None
    assert sandbox.runs == 0
    assert client.get(f"/v1/jobs/{job}").json() == found
    assert client.post(f"/v1/jobs/{job}/cancel").status_code == 409


def test_an_answer_that_comes_after_the_cancelling_is_dropped(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, sandbox: FakeSandbox
) -> None:
    job = ask(client, model).json()["id"]

    sandbox.before = lambda: client.post(f"/v1/jobs/{job}/cancel")
    worker.answer(task_of(redis, job))
    assert client.get(f"/v1/jobs/{job}").json()["record"]["failure"]["category"] == "cancelled"
    assert [kind for _, kind, _ in events(client, job)][-1] == "done"


def test_several_questions_are_asked_at_once(client: httpx.Client, model: str, redis: Redis, worker: Questions) -> None:
    asked = [QUESTION, "What is the height of the part?", QUESTION]
    response = ask_many(client, model, asked)
    assert response.status_code == 202
    jobs = response.json()["items"]
    assert [job["question"] for job in jobs] == asked
    assert sorted(queued(redis)) == sorted(job["id"] for job in jobs)
    for job in jobs:
        worker.answer(task_of(redis, job["id"]))
    assert {client.get(f"/v1/jobs/{job['id']}").json()["status"] for job in jobs} == {"done"}


@pytest.mark.parametrize("body", [{"questions": []}, {"questions": [{"question": ""}]}, {"questions": "x"}, {}])
def test_no_questions_are_not_as_documented(client: httpx.Client, model: str, body: dict[str, Any]) -> None:
    assert client.post(f"/v1/models/{model}/questions/batch", json=body).status_code == 422


def test_the_history_of_a_model_comes_in_pages_the_newest_first(client: httpx.Client, model: str) -> None:
    ids = [ask(client, model, f"How many holes of size {number} are there?").json()["id"] for number in range(5)]
    pages = [client.get(f"/v1/models/{model}/answers?offset={at}&limit=2").json() for at in (0, 2, 4, 6)]
    assert {page["total"] for page in pages} == {5}
    assert [job["id"] for page in pages for job in page["items"]] == ids[::-1]


def test_a_request_with_the_same_idempotency_key_is_done_once(client: httpx.Client, model: str, redis: Redis) -> None:
    key = {"Idempotency-Key": "mine-1"}
    first, second = ask(client, model, **key), ask(client, model, **key)
    assert first.json() == second.json()
    assert len(queued(redis)) == 1
    other = ask(client, model, "How many slots are there?", **key)
    assert (other.status_code, other.json()["title"]) == (422, "Idempotency key reused")
    assert ask(client, model, **{"Idempotency-Key": "mine-2"}).json()["id"] != first.json()["id"]


def test_several_questions_with_one_idempotency_key_are_the_same_jobs_again(
    client: httpx.Client, model: str, redis: Redis
) -> None:
    first = ask_many(client, model, [QUESTION, QUESTION], **{"Idempotency-Key": "k"}).json()
    assert ask_many(client, model, [QUESTION, QUESTION], **{"Idempotency-Key": "k"}).json() == first
    assert len(queued(redis)) == 2


def test_what_a_dying_process_left_half_done_is_done_when_the_request_comes_again(
    client: httpx.Client, model: str, redis: Redis
) -> None:
    key = {"Idempotency-Key": "k"}
    job = ask(client, model, **key).json()["id"]
    redis.delete("questions", key_of("job", job))  # it died before it kept the job
    assert ask(client, model, **key).json()["id"] == job
    assert queued(redis) == [job]
    redis.delete("questions")  # it died before it put the job on the queue, a while ago
    redis.hset(key_of("job", job), "created", "2026-01-01T00:00:00+00:00")
    assert ask(client, model, **key).json()["id"] == job
    assert queued(redis) == [job]


def test_a_deleted_model_is_gone_with_all_that_is_about_it(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, settings: ApiSettings, sandbox: FakeSandbox
) -> None:
    done, waiting = (ask(client, model).json()["id"] for _ in range(2))
    tasks = [task_of(redis, each) for each in (done, waiting)]
    worker.answer(tasks[0])
    for name in (picture_name(done), f"{models_name(model)}/v1/model.json"):
        (settings.home / name).parent.mkdir(parents=True, exist_ok=True)
        (settings.home / name).write_text("x")
    assert (settings.home / upload_name(model)).exists()
    response = client.delete(f"/v1/models/{model}")
    assert (response.status_code, response.content) == (204, b"")
    for path in (f"models/{model}", f"jobs/{done}", f"jobs/{waiting}", f"models/{model}/answers"):
        assert client.get(f"/v1/{path}").status_code == 404
    assert not [path for path in settings.home.rglob("*") if path.is_file()]
    runs = sandbox.runs
    worker.answer(tasks[1])
    assert sandbox.runs == runs
    left = {str(key) for key in redis.scan_iter("querycad:*")} - {"querycad:totals"}
    assert left == set()
    assert client.delete(f"/v1/models/{model}").status_code == 404


def test_what_a_worker_finds_out_about_a_deleted_model_brings_nothing_back(
    client: httpx.Client, redis: Redis, ledger: Ledger
) -> None:
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    client.delete(f"/v1/models/{MODEL}")
    ledger.finish_model("local", MODEL, TaskOutcome[ModelSummary](value=SUMMARY))
    assert client.get(f"/v1/models/{MODEL}").status_code == 404
    assert not redis.exists(key_of("owners", MODEL))


def test_models_come_in_pages_the_newest_first(client: httpx.Client) -> None:
    ids = [
        client.post("/v1/models", files={"file": ("box.step", STEP + b" " * number)}).json()["id"]
        for number in range(3)
    ]
    pages = [client.get(f"/v1/models?offset={at}&limit=2").json() for at in (0, 2)]
    assert [model["id"] for page in pages for model in page["items"]] == ids[::-1]
    assert {page["total"] for page in pages} == {3}


@pytest.mark.parametrize("path", ["models", f"models/{MODEL}/answers", f"models/{MODEL}/parts"])
@pytest.mark.parametrize("query", ["limit=0", "limit=1001", "offset=-1", "limit=x"])
def test_a_page_that_cannot_be_is_a_problem(client: httpx.Client, model: str, path: str, query: str) -> None:
    response = client.get(f"/v1/{path}?{query}")
    assert (response.status_code, response.headers["content-type"]) == (400, "application/problem+json")
    assert response.json()["errors"][0]["parameter"] == query.partition("=")[0]


def test_a_queued_question_tells_how_many_are_before_it(
    client: httpx.Client, model: str, redis: Redis, worker: Questions
) -> None:
    first, second = (ask(client, model).json()["id"] for _ in range(2))
    assert [client.get(f"/v1/jobs/{job}").json()["ahead"] for job in (first, second)] == [0, 1]
    worker.answer(task_of(redis, first))
    assert client.get(f"/v1/jobs/{first}").json()["ahead"] is None
