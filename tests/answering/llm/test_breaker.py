"""A language model that does not answer is left alone for a while, and the parser answers meanwhile."""

from __future__ import annotations

import pytest

from querycad_answering.judging import Verdict
from querycad_answering.llm.breaker import Breaker
from querycad_answering.llm.messages import LlmBusy, LlmRefused, LlmTooSlow, Message, Reply, TimeLimit
from querycad_answering.llm.settings import LlmSettings
from querycad_answering.llm.task import Task
from querycad_answering.llm.writer import LlmWriter
from querycad_contracts import Answer, AnswerType, LlmOptions, RunOutcome, RunStatus, Unit


class Clock:
    """Time as a test has it."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def test_it_opens_after_failures_in_a_row_and_one_try_decides_when_it_closes() -> None:
    clock = Clock()
    breaker = Breaker(2, 30.0, clock)
    for error in (LlmBusy("away"), None, LlmTooSlow("slow")):
        breaker.heard(error)
        breaker.check()
    breaker.heard(LlmBusy("away"))
    with pytest.raises(LlmBusy, match="failed 2 times in a row") as told:
        breaker.check()
    assert told.value.retry_after_s == 30.0
    clock.now += 31
    breaker.check()
    breaker.heard(LlmBusy("away"))
    with pytest.raises(LlmBusy):
        breaker.check()
    clock.now += 31
    breaker.heard(None)
    breaker.heard(LlmBusy("away"))
    breaker.check()


def test_what_a_server_refuses_does_not_count() -> None:
    breaker = Breaker(1, 30.0)
    breaker.heard(LlmRefused("wrong key"))
    breaker.check()


class Away:
    """A language model that cannot be reached."""

    def __init__(self) -> None:
        self.asked = 0
        self.error: Exception | None = LlmBusy("away")

    def reply(self, conversation: tuple[Message, ...], temperature: float, sample: int, deadline: TimeLimit) -> Reply:
        self.asked += 1
        if self.error is not None:
            raise self.error
        return Reply("```python\nsolution = len(find_parts('hole'))\n```")


def test_questions_share_what_is_known_of_a_model_and_other_models_are_asked_all_the_same() -> None:
    model = Away()
    settings = LlmSettings(llm_command="cat", llm_model="m", llm_models="n", llm_failures=2)
    writer = LlmWriter(settings, model)
    answer = Answer(value=1, type=AnswerType.COUNT, unit=Unit.NONE, text="1")
    came = RunOutcome(status=RunStatus.OK)
    task = Task("How many holes are there?", lambda _: came, lambda _, __: Verdict(answer=answer))
    errors = [str(writer.chosen(None).write(task).error) for _ in range(4)]
    assert (model.asked, errors[:2]) == (2, ["away", "away"])
    assert all("left alone" in error for error in errors[2:])
    other = writer.chosen(LlmOptions(model="n"))
    other._models["n"], model.error = model, None
    assert other.write(task).candidates
