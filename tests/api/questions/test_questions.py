"""A question's way: accepted as a job, answered by a worker, told to who waits, never lost."""

from __future__ import annotations

import json
import threading
import time
from typing import Any

import httpx
import pytest
from redis import Redis
from tests.api.fakes import MODEL, STEP, SUMMARY, FakeSandbox

from querycad_api.questions.sandbox import RunRefused, SandboxUnavailable
from querycad_api.questions.tasks import ATTEMPTS, RETRIES, Questions
from querycad_api.settings import ApiSettings
from querycad_api.store.keyspace import key_of
from querycad_api.store.ledger import Ledger
from querycad_api.worker import make_app
from querycad_contracts import (
    NO_ACCOUNTS,
    AnswerRecord,
    DescribeTask,
    Description,
    Failure,
    FailureCategory,
    Job,
    ModelSummary,
    QuestionTask,
    Status,
    TaskFailure,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
)


def ask(client: httpx.Client, model: str, question: str = "How many holes are there?", **headers: str) -> Any:
    return client.post(f"/v1/models/{model}/questions", json={"question": question}, headers=headers)


def task_of(redis: Redis, job: str) -> QuestionTask:
    return QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))


def test_a_question_is_accepted_as_a_job(client: httpx.Client, model: str, redis: Redis) -> None:
    response = ask(client, model)
    assert response.status_code == 202
    job = response.json()
    assert (job["status"], job["record"]) == ("queued", None)
    assert client.get(response.headers["location"]).json() == {**job, "ahead": 0}
    assert redis.llen("questions") == 1


def test_an_answered_job_holds_the_record(client: httpx.Client, model: str, redis: Redis, worker: Questions) -> None:
    job = ask(client, model).json()["id"]
    assert worker.answer(task_of(redis, job)) is None
    found = client.get(f"/v1/jobs/{job}").json()
    assert found["status"] == "done"
    record = AnswerRecord.model_validate(found["record"])
    assert (record.status, record.answer.value if record.answer else None) == (Status.ANSWERED, 0)
    assert list(record.timings_ms) == ["model", "codegen", "run"]
    assert record.warnings == ("it was tilted", "there is no hole")


def test_who_waits_gets_what_the_job_tells_later(
    client: httpx.Client, model: str, redis: Redis, worker: Questions
) -> None:
    def answer_once_asked() -> None:
        until = time.monotonic() + 10
        while not redis.llen("questions") and time.monotonic() < until:
            time.sleep(0.02)
        (key,) = redis.scan_iter("querycad:job:*")
        worker.answer(task_of(redis, str(key).rpartition(":")[2]))

    later = threading.Thread(target=answer_once_asked)
    later.start()
    response = ask(client, model, Prefer="wait=20")
    later.join()
    assert response.status_code == 200
    assert response.headers["preference-applied"] == "wait=20"
    job = client.get(response.headers["location"]).json()
    assert Job.model_validate_json(response.content).model_dump_json() == response.text
    assert response.json() == job


def test_a_wait_that_is_not_met_leaves_the_job_to_be_asked_for(client: httpx.Client, model: str) -> None:
    response = ask(client, model, Prefer="wait=1")
    assert (response.status_code, response.json()["status"]) == (202, "queued")


def test_a_job_is_answered_once(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, sandbox: FakeSandbox, ledger: Ledger
) -> None:
    task = task_of(redis, ask(client, model).json()["id"])
    worker.answer(task)
    first = client.get(f"/v1/jobs/{task.job}").json()
    worker.answer(task)
    assert sandbox.runs == 1
    record = AnswerRecord.model_validate(first["record"])
    ledger.finish_job(task, record.model_copy(update={"question": "another"}), 1.0)
    assert client.get(f"/v1/jobs/{task.job}").json() == first


def test_a_question_waits_for_its_model(
    client: httpx.Client, redis: Redis, worker: Questions, sandbox: FakeSandbox, ledger: Ledger
) -> None:
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    task = task_of(redis, ask(client, MODEL).json()["id"])
    for retries in range(10):
        again_s = worker.answer(task, retries)
        assert again_s is not None
        assert 0 < again_s <= 1
    assert client.get(f"/v1/jobs/{task.job}").json()["status"] == "queued"
    ledger.finish_model(NO_ACCOUNTS, MODEL, TaskOutcome[ModelSummary](value=SUMMARY))
    assert worker.answer(task, 11) is None
    assert client.get(f"/v1/jobs/{task.job}").json()["record"]["status"] == "answered"


def test_a_question_about_an_unreadable_file_fails_as_the_file_did(
    client: httpx.Client, redis: Redis, worker: Questions, ledger: Ledger
) -> None:
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    failure = TaskFailure(kind=TaskFailureKind.FILE, message="it has no geometry")
    ledger.finish_model(NO_ACCOUNTS, MODEL, TaskOutcome[ModelSummary](failure=failure))
    task = task_of(redis, ask(client, MODEL).json()["id"])
    worker.answer(task)
    record = client.get(f"/v1/jobs/{task.job}").json()["record"]
    assert (record["status"], record["failure"]["category"]) == ("failed", "bad_input")
    assert record["failure"]["message"] == "it has no geometry"


def test_a_question_that_is_not_understood_fails_with_that(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, sandbox: FakeSandbox
) -> None:
    task = task_of(redis, ask(client, model, "Who wrote this song?").json()["id"])
    worker.answer(task)
    assert client.get(f"/v1/jobs/{task.job}").json()["record"]["failure"]["category"] == "not_understood"
    assert sandbox.runs == 0


def test_a_question_that_kills_its_workers_is_given_up(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, ledger: Ledger
) -> None:
    task = task_of(redis, ask(client, model).json()["id"])
    for _ in range(ATTEMPTS):
        ledger.begin_job(task)
    assert worker.answer(task) is None
    failure = client.get(f"/v1/jobs/{task.job}").json()["record"]["failure"]
    assert (failure["category"], failure["message"]) == (
        "internal",
        "abandoned after 2 workers crashed while answering this",
    )


def test_a_sandbox_that_is_away_is_waited_for_and_then_given_up(
    client: httpx.Client, model: str, redis: Redis, worker: Questions, sandbox: FakeSandbox
) -> None:
    sandbox.error = SandboxUnavailable("away")
    task = task_of(redis, ask(client, model).json()["id"])
    assert [worker.answer(task, retries) is not None for retries in range(RETRIES + 1)] == [True] * RETRIES + [False]
    failure = client.get(f"/v1/jobs/{task.job}").json()["record"]["failure"]
    assert (failure["category"], failure["retryable"]) == ("internal", True)


@pytest.mark.parametrize(
    ("error", "category"),
    [
        (RunRefused(Failure(category=FailureCategory.BAD_INPUT, message="the kernel crashed")), "bad_input"),
        (RuntimeError("a flaw"), "internal"),
    ],
)
def test_whatever_happens_a_job_ends_with_a_record(
    client: httpx.Client,
    model: str,
    redis: Redis,
    worker: Questions,
    sandbox: FakeSandbox,
    error: Exception,
    category: str,
) -> None:
    sandbox.error = error
    task = task_of(redis, ask(client, model).json()["id"])
    assert worker.answer(task) is None
    record = client.get(f"/v1/jobs/{task.job}").json()["record"]
    assert record["failure"]["category"] == category
    assert "a flaw" not in record["failure"]["message"]


def test_an_ingest_that_was_stopped_is_a_failed_model(client: httpx.Client, settings: ApiSettings) -> None:
    client.post("/v1/models", files={"file": ("box.step", STEP)})
    app = make_app(settings)
    app.tasks[TaskName.MODEL_LOST.value].apply(["some-task"], {"model": MODEL, "tenant": NO_ACCOUNTS, "uploaded": ""})
    found = client.get(f"/v1/models/{MODEL}").json()
    assert (found["status"], found["failure"]["retryable"]) == ("failed", True)
    app.close()


@pytest.mark.parametrize(
    "body", [b"", b"[]", b"{}", b'{"question": ""}', b'{"question": "x", "unit": "furlong"}', b'{"question": 1}']
)
def test_what_is_no_question_is_a_problem(client: httpx.Client, model: str, body: bytes) -> None:
    response = client.post(f"/v1/models/{model}/questions", content=body, headers={"Content-Type": "application/json"})
    assert response.status_code == 422
    assert response.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("body", [b"{", b'{"question": "x"', b'{"question": "\xff"}', b"[" * 100_000])
def test_what_is_no_json_is_malformed(client: httpx.Client, model: str, body: bytes) -> None:
    response = client.post(f"/v1/models/{model}/questions", content=body, headers={"Content-Type": "application/json"})
    assert (response.status_code, response.headers["content-type"]) == (400, "application/problem+json")


def test_a_question_as_large_as_a_file_is_refused(client: httpx.Client, model: str) -> None:
    for body in (b" " * 3 * 2**20, (b" " * 2**16 for _ in range(48))):  # its length is declared, and not
        response = client.post(f"/v1/models/{model}/questions", content=body)
        assert response.status_code == 413
        assert response.headers["content-type"] == "application/problem+json"
        assert response.json()["type"] == "urn:querycad:problem:too-large"


def test_a_question_about_an_unknown_model_is_refused(client: httpx.Client, redis: Redis) -> None:
    assert ask(client, MODEL).status_code == 404
    assert redis.llen("questions") == 0


def test_a_picture_of_what_is_not_there_is_not_found(client: httpx.Client, model: str) -> None:
    job = ask(client, model).json()["id"]
    for path in (f"{model}/answers/{job}", f"{model}/answers/{'0' * 32}", f"{'0' * 64}/answers/{job}"):
        response = client.get(f"/v1/models/{path}/picture")
        assert response.status_code == 404
        assert response.headers["content-type"] == "application/problem+json"


def test_a_description_is_made_by_a_question_worker(worker: Questions) -> None:
    outcome = worker.described(DescribeTask(model=MODEL, summary=SUMMARY))
    assert outcome.value is not None
    assert outcome.value.text.startswith("box: one body, 6 faces, 100 x 200 x 300 mm")
    assert "it was tilted" in outcome.value.text


def test_a_description_without_a_sandbox_says_so(worker: Questions, sandbox: FakeSandbox) -> None:
    sandbox.error = SandboxUnavailable("away")
    failure = worker.described(DescribeTask(model=MODEL, summary=SUMMARY)).failure
    assert failure is not None
    assert failure.retryable


def test_who_waits_for_a_description_is_told(client: httpx.Client, model: str, redis: Redis, worker: Questions) -> None:
    told = worker.described(DescribeTask(model=MODEL, summary=SUMMARY))

    def work() -> None:
        taken = redis.brpop(["questions"], 5)
        assert isinstance(taken, tuple)
        worker.reply(json.loads(taken[1])["headers"]["id"], told)

    thread = threading.Thread(target=work)
    thread.start()
    response = client.get(f"/v1/models/{model}/description")
    thread.join()
    assert (response.status_code, told.value) == (200, Description.model_validate(response.json()))
