"""What a request may say of how its question is answered, on its way through the service."""

from __future__ import annotations

from typing import Any

import httpx
import pytest
from redis import Redis
from tests.answering.llm.conftest import Script, program, said, scripted
from tests.api.fakes import FakeSandbox, FakeSegcad

from querycad_api.questions.tasks import Questions
from querycad_api.settings import ApiSettings
from querycad_api.store.keyspace import key_of
from querycad_api.store.ledger import Ledger
from querycad_contracts import AnswerRecord, AnswerType, Codegen, QuestionTask

__all__ = ["scripted"]  # the fixture

QUESTION = "How many holes are there?"


def ask(client: httpx.Client, model: str, **options: Any) -> httpx.Response:
    return client.post(f"/v1/models/{model}/questions", json={"question": QUESTION, **options})


def answered(client: httpx.Client, redis: Redis, worker: Questions, response: httpx.Response) -> AnswerRecord:
    job = response.json()["id"]
    worker.answer(QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task"))))
    return AnswerRecord.model_validate(client.get(f"/v1/jobs/{job}").json()["record"])


def test_the_options_of_a_request_reach_the_worker(client: httpx.Client, model: str, redis: Redis) -> None:
    options = {"codegen": "both", "expect": {"type": "count"}, "llm": {"samples": 3}}
    job = ask(client, model, **options).json()["id"]
    task = QuestionTask.model_validate_json(str(redis.hget(key_of("job", job), "task")))
    assert task.codegen is Codegen.BOTH
    assert task.expect is not None
    assert task.expect.type is AnswerType.COUNT
    assert task.llm is not None
    assert task.llm.samples == 3


@pytest.mark.parametrize(
    "options",
    [
        {"codegen": "oracle"},
        {"expect": {"type": "colour"}},
        {"expect": {"unit": "mm"}},
        {"llm": {"base_url": "http://stranger.example/v1"}},
        {"llm": {"api_key": "x"}},
        {"llm": {"samples": 1000}},
    ],
)
def test_options_that_there_are_not_are_refused(client: httpx.Client, model: str, options: dict[str, Any]) -> None:
    assert ask(client, model, **options).status_code == 422


def test_an_unexpected_answer_is_a_failure(client: httpx.Client, model: str, redis: Redis, worker: Questions) -> None:
    record = answered(client, redis, worker, ask(client, model, expect={"type": "length"}))
    assert record.answer is None
    assert record.failure is not None
    assert record.failure.category == "unexpected"


def test_the_services_own_language_model_is_asked_with_the_models_facts(
    client: httpx.Client, model: str, redis: Redis, ledger: Ledger, settings: ApiSettings, scripted: Any
) -> None:
    script = Script([said(program('solution = len(find_parts("hole"))'))])
    with_llm = settings.model_copy(update={"llm_base_url": scripted(script), "llm_model": "m"})
    worker = Questions(with_llm, ledger, FakeSandbox(), FakeSegcad())  # type: ignore[arg-type]
    record = answered(client, redis, worker, ask(client, model))
    assert record.agreement is not None
    assert (record.agreement.agreeing, record.agreement.programs) == (2, 2)
    assert "0.1 x 0.2 x 0.3 m" in script.bodies[0]["messages"][0]["content"]
