"""The steps of one question: what counts as answered, as not grounded and as failed."""

from __future__ import annotations

from typing import Any

import pytest
from tests.made import hole, view

from querycad_answering.answering import SURER, answer_question
from querycad_answering.confidence import AS_ONE
from querycad_contracts import AnswerRecord, Grounding, Part, Program, RunOutcome, RunStatus, Status
from querycad_language.readings.question import Question

HOLE = hole(1)


def grounding(*parts: Part, understood: bool = True, **more: Any) -> Grounding:
    return Grounding(description="hole", sides=None, parts=parts, understood=understood, **more)


def ask(question: str, **outcome: Any) -> AnswerRecord:
    def run(_: Program) -> RunOutcome:
        return RunOutcome(**{"status": RunStatus.OK, **outcome})

    return answer_question(question, run, view(hole(1)))


def test_an_answer_carries_its_parts_program_and_timings() -> None:
    record = ask("What is the radius of the hole?", value=0.005, groundings=(grounding(HOLE),), used_parts=("hole-1",))
    assert record.status is Status.ANSWERED
    assert record.answer is not None
    assert record.answer.value == 0.005
    assert record.parts == (HOLE,)
    assert record.code
    assert record.codegen == "parser"
    assert set(record.timings_ms) == {"codegen", "run"}


def test_json_keys_come_in_the_promised_order() -> None:
    record = ask("How many holes are there?", value=1, groundings=(grounding(HOLE),))
    keys = list(record.model_dump())
    assert keys[:8] == ["question", "status", "answer", "code", "codegen", "parts", "timings_ms", "warnings"]


def test_none_of_a_known_part_is_counted_as_zero_with_a_warning() -> None:
    record = ask("How many holes are there?", value=0, groundings=(grounding(message="the model has no 'hole'"),))
    assert record.status is Status.ANSWERED
    assert record.answer is not None
    assert record.answer.value == 0
    assert "the model has no 'hole'" in record.warnings


@pytest.mark.parametrize("outcome", [{"value": []}, {"value": None}, {"status": RunStatus.RAISED, "message": "empty"}])
def test_a_measure_of_a_part_that_is_not_there_is_not_grounded(outcome: dict[str, Any]) -> None:
    missing = grounding(message="the model has no 'hole'", nearest=("boss",))
    record = ask("What is the radius of the holes?", groundings=(missing,), **outcome)
    assert record.status is Status.NOT_GROUNDED
    assert record.failure is not None
    assert (record.failure.message, record.failure.nearest) == ("the model has no 'hole'", ("boss",))


def test_a_word_that_is_not_known_is_never_answered_whatever_the_program_returns() -> None:
    record = ask("How many holes are there?", value=7, groundings=(grounding(understood=False, message="unknown"),))
    assert record.status is Status.NOT_GROUNDED
    assert record.answer is None


@pytest.mark.parametrize(
    ("status", "category"),
    [
        (RunStatus.RAISED, "program"),
        (RunStatus.REFUSED, "program"),
        (RunStatus.TIMED_OUT, "limit"),
        (RunStatus.OUT_OF_MEMORY, "limit"),
    ],
)
def test_a_program_that_ends_badly_is_a_failure(status: RunStatus, category: str) -> None:
    record = ask("How many holes are there?", status=status, message="why", groundings=(grounding(HOLE),))
    assert record.status is Status.FAILED
    assert record.failure is not None
    assert (record.failure.category, record.failure.message) == (category, "why")


def test_a_result_of_the_wrong_type_is_a_failure_and_no_answer() -> None:
    record = ask("How many holes are there?", value=0.5, groundings=(grounding(HOLE),))
    assert record.status is Status.FAILED
    assert record.answer is None


@pytest.mark.parametrize("question", ["", "   ", "\n"])
def test_an_empty_question_runs_nothing(question: str) -> None:
    def never(_: Program) -> RunOutcome:
        raise AssertionError("a program was run")

    record = answer_question(question, never, view())
    assert record.status is Status.FAILED
    assert record.failure is not None
    assert record.failure.category == "bad_input"


@pytest.mark.parametrize(("less", "one"), [(2 * SURER, True), (0.7 * SURER, False)])
def test_what_is_much_surer_as_one_question_is_one(monkeypatch: pytest.MonkeyPatch, less: float, one: bool) -> None:
    question = "How deep is the hole, please?"
    found = {"value": 0.005, "groundings": (grounding(HOLE),), "used_parts": ("hole-1",)}
    plain = ask(question, **found)
    alone = plain.confidence or 0.0
    both = plain.model_copy(update={"confidence": alone - less})

    def clauses(asked: Question, _: object) -> tuple[str, ...]:
        return ("How deep is the hole?", "How wide is the hole?") if asked.text.question == question else ()

    monkeypatch.setattr("querycad_answering.answering.together", lambda *_: both)
    monkeypatch.setattr("querycad_answering.answering.clauses", clauses)
    record = ask(question, **found)
    assert record.confidence == pytest.approx(min(AS_ONE, alone) if one else alone - less)
