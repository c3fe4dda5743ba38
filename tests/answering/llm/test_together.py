"""Parser and language model on one question: who answers, who steps in, and what the record says of both."""

from __future__ import annotations

from typing import Any

import pytest
from tests.answering.llm.conftest import FakeModel, program
from tests.made import hole, view

from querycad_answering.answering import answer_question
from querycad_answering.llm import LlmSettings, LlmWriter
from querycad_answering.llm.messages import LlmBusy
from querycad_contracts import (
    AnswerOptions,
    AnswerRecord,
    AnswerType,
    Codegen,
    Expectation,
    Frame,
    Grounding,
    LlmOptions,
    Part,
    Program,
    RunOutcome,
    RunStatus,
    Status,
    Unit,
)

HOLE = hole(1)
FOUND = Grounding(description="hole", sides=None, parts=(HOLE,), understood=True)
QUESTION = "How many holes are there?"
COUNT = "solution = 1 * len(find_parts('hole'))"


def ask(
    model: FakeModel | None,
    codegen: Codegen | None = None,
    question: str = QUESTION,
    by_llm: Any = 4,
    by_parser: Any = 4,
    expect: Expectation | None = None,
    llm: LlmOptions | None = None,
    set_codegen: Codegen | None = None,
    *,
    parts: tuple[Part, ...] = (HOLE,),
    **settings: Any,
) -> AnswerRecord:
    """The record, where programs of the parser give one value and those of the language model another."""
    values = list(by_llm) if isinstance(by_llm, tuple) else [by_llm]

    def run(written: Program) -> RunOutcome:
        if written.codegen == "parser" and callable(by_parser):
            return RunOutcome(status=RunStatus.OK, value=by_parser(written), groundings=(FOUND,))
        value = by_parser if written.codegen == "parser" else values.pop(0) if len(values) > 1 else values[0]
        if isinstance(value, Exception):
            return RunOutcome(status=RunStatus.RAISED, message=str(value), groundings=(FOUND,))
        return RunOutcome(status=RunStatus.OK, value=value, groundings=(FOUND,))

    base = {"llm_base_url": "http://127.0.0.1:1/v1", "llm_model": "m"} if model is not None else {}
    writer = LlmWriter(LlmSettings.model_validate({**base, **settings, "codegen": set_codegen}), model)
    options = AnswerOptions(codegen=codegen, expect=expect, llm=llm)
    return answer_question(question, run, view(*parts), options=options, llm=writer)


def value_of(record: AnswerRecord) -> Any:
    return record.answer.value if record.answer is not None else None


def test_without_a_language_model_the_parser_answers_and_says_so() -> None:
    for codegen in (Codegen.LLM, Codegen.BOTH):
        record = ask(None, codegen)
        assert (record.codegen, value_of(record)) == ("parser", 4)
        assert "no language model is set up: the parser answered" in record.warnings
        assert record.attempts == ()
        assert record.tokens is None
    assert ask(None).warnings == ()


@pytest.mark.parametrize("setting", [Codegen.PARSER, None])
def test_who_writes_follows_the_caller_then_the_setting_then_what_there_is(setting: Codegen | None) -> None:
    assert len(ask(FakeModel(program(COUNT)), Codegen.LLM, set_codegen=setting).attempts) == 1
    asked_nothing = ask(FakeModel(program(COUNT)), set_codegen=setting)
    assert len(asked_nothing.attempts) == (0 if setting is Codegen.PARSER else 1)


def test_the_agent_writes_by_default_where_the_model_is_capable_and_not_where_it_is_not() -> None:
    """One that merely answers at an address, as a small local one does, is asked beside the parser."""
    record = ask(FakeModel(program(COUNT)), llm_capable=True)
    assert (record.codegen, record.agreement) == ("agent:m", None)
    record = ask(FakeModel(program(COUNT)))
    assert record.agreement is not None
    assert (record.codegen, record.agreement.programs) == ("parser", 2)
    assert ask(FakeModel(program(COUNT)), Codegen.BOTH, llm_capable=True).codegen == "parser"


def test_the_language_model_alone_answers_with_its_program() -> None:
    record = ask(FakeModel(program(COUNT)), Codegen.LLM, by_llm=5, by_parser=4)
    assert (record.codegen, record.code, value_of(record)) == ("llm:m", COUNT, 5)
    assert record.agreement is None
    assert list(record.timings_ms) == ["codegen", "llm", "run"]


@pytest.mark.parametrize("reply", [LlmBusy("the server answered 503"), "There are four."])
def test_the_parser_steps_in_for_a_language_model_that_fails(reply: Any) -> None:
    record = ask(FakeModel(reply), Codegen.LLM)
    assert (record.status, record.codegen, value_of(record)) == (Status.ANSWERED, "parser", 4)
    assert "the language model wrote no program that answers: the parser answered" in record.warnings
    if isinstance(reply, LlmBusy):
        assert "the server answered 503" in record.warnings
    else:
        assert [attempt.problem for attempt in record.attempts] == ["The reply holds no code block."] * 3


@pytest.mark.parametrize("codegen", [Codegen.LLM, Codegen.AGENT])
@pytest.mark.parametrize("reply", [program("solution = '\ud800'"), "ask: \ud800 which?", "\ud800"])
def test_half_a_character_in_a_reply_breaks_no_record(codegen: Codegen, reply: str) -> None:
    record = ask(FakeModel(reply), codegen)
    assert AnswerRecord.model_validate_json(record.model_dump_json()) == record


def test_what_neither_can_answer_fails_with_every_attempt_in_the_record() -> None:
    record = ask(FakeModel(program(COUNT)), Codegen.LLM, "Who painted it?", by_llm=ValueError("no"), llm_repairs=1)
    assert record.status is Status.FAILED
    assert record.failure is not None
    assert record.failure.message == "no"
    assert [attempt.problem for attempt in record.attempts] == ["no.", "no."]
    silent = ask(FakeModel(LlmBusy("away")), Codegen.LLM, "Who painted it?")
    assert silent.failure is not None
    assert silent.failure.category == "not_understood"


def test_a_question_that_only_the_language_model_understands_is_answered_by_it() -> None:
    record = ask(FakeModel(program(COUNT)), Codegen.BOTH, "Quid est numerus foraminum in parte?", by_llm=4)
    assert (record.codegen, value_of(record)) == ("llm:m", 4)


def test_both_agreeing_is_shown_as_confidence() -> None:
    record = ask(FakeModel(program(COUNT)), Codegen.BOTH)
    assert record.agreement is not None
    assert (record.agreement.agreeing, record.agreement.programs) == (2, 2)
    assert record.alternatives == ()


def test_both_disagreeing_shows_both_programs() -> None:
    record = ask(FakeModel(program(COUNT)), Codegen.BOTH, by_llm=5, parts=(hole(1), hole(2, 20)))
    assert record.agreement is not None
    assert (record.agreement.agreeing, record.agreement.programs) == (1, 2)
    assert (record.codegen, value_of(record)) == ("parser", 4)
    (other,) = record.alternatives
    assert (other.codegen, other.code, other.answer.value) == ("llm:m", COUNT, 5)
    assert "programs disagree: the program of the language model (llm:m) gives 5" in record.warnings


def test_a_parser_that_is_not_sure_gives_way() -> None:
    told: dict[str, float] = {}

    def another_each(written: Program) -> float:
        return told.setdefault(written.code, 0.01 + 0.001 * len(told))

    sizes = (hole(1), hole(2, 20, diameter=0.008), hole(3, -20, diameter=0.012))
    question = "What is the diameter of the hole?"
    reply = program("solution = find_parts('hole')[0].diameter")
    record = ask(FakeModel(reply), Codegen.BOTH, question, by_llm=0.005, by_parser=another_each, parts=sizes)
    assert (record.codegen, value_of(record)) == ("llm:m", 0.005)
    assert record.alternatives[0].codegen == "parser"
    assert record.alternatives[0].understood_as
    assert record.confidence is None


def test_samples_outvote_a_single_program() -> None:
    record = ask(FakeModel(program(COUNT)), Codegen.BOTH, by_llm=(5, 6, 5), by_parser=4, llm=LlmOptions(samples=3))
    assert value_of(record) == 5
    assert record.agreement is not None
    assert (record.agreement.agreeing, record.agreement.programs) == (2, 4)
    assert sorted(other.answer.value for other in record.alternatives) == [4, 6]


def test_a_model_that_is_not_allowed_is_a_bad_request() -> None:
    model = FakeModel(program(COUNT))
    record = ask(model, Codegen.LLM, llm=LlmOptions(model="another"))
    assert record.failure is not None
    assert record.failure.category == "bad_input"
    assert model.told == []


@pytest.mark.parametrize(
    ("expect", "reason"),
    [
        (Expectation(type=AnswerType.LENGTH), "of type 'length' is expected, but it is 'count'"),
        (Expectation(unit=Unit.METRE), "in unit 'm' is expected, but it is none"),
        (Expectation(frame=Frame.PART), "in frame 'part' is expected, but it is none"),
    ],
)
def test_what_the_caller_does_not_expect_is_an_error_and_no_answer(expect: Expectation, reason: str) -> None:
    record = ask(None, expect=expect)
    assert record.answer is None
    assert record.failure is not None
    assert record.failure.category == "unexpected"
    assert reason in record.failure.message


def test_what_the_caller_expects_comes_as_expected() -> None:
    lengths = ask(
        None,
        question="What is the radius of the hole?",
        by_parser=0.005,
        expect=Expectation(type=AnswerType.LENGTHS, unit=Unit.METRE),
    )
    assert (lengths.status, value_of(lengths)) == (Status.ANSWERED, [0.005])
    point = ask(
        None,
        question="Where is the hole?",
        by_parser=[0.1, 0.2, 0.3],
        expect=Expectation(type=AnswerType.POINT, unit=Unit.METRE, frame=Frame.MODEL),
    )
    assert point.answer is not None
    assert (point.answer.value, point.answer.frame) == ([0.1, 0.2, 0.3], Frame.MODEL)


def test_four_values_are_not_one() -> None:
    record = ask(
        None,
        question="What is the radius of the hole?",
        by_parser=[0.001, 0.002],
        expect=Expectation(type=AnswerType.LENGTH),
    )
    assert record.failure is not None
    assert "'length' is expected, but it is 'lengths': 1 mm, 2 mm" in record.failure.message


def test_time_spent_in_programs_is_not_the_language_models() -> None:
    record = ask(FakeModel(program(COUNT)), Codegen.BOTH)
    assert all(milliseconds >= 0 for milliseconds in record.timings_ms.values())
