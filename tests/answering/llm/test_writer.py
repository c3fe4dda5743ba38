"""A language model writes programs: checked before they run, sent back with what is wrong, every attempt recorded."""

from __future__ import annotations

from functools import partial
from typing import Any

import pytest
from tests.answering.llm.conftest import FakeModel, program

from querycad_answering.judging import judge
from querycad_answering.llm import LlmSettings, LlmWriter, Task, Written
from querycad_answering.llm.messages import LlmBusy, LlmTooSlow, Reply, Role
from querycad_contracts import (
    AnswerType,
    Evidence,
    Expectation,
    Grounding,
    MissingAttribute,
    Part,
    Program,
    RunOutcome,
    RunStatus,
    Side,
    TokenUse,
)

HOLE = Part(
    id="hole-1",
    kind="hole",
    label="hole",
    faces=(1,),
    center=(0, 0, 0),
    extents=(1, 1, 1),
    radius=0.005,
    evidence=Evidence(source="geometry", confidence=1, reason="made by hand"),
)
FOUND = Grounding(description="hole", sides=None, parts=(HOLE,), understood=True)
COUNT = "solution = len(find_parts('hole'))"


def ok(value: Any, *groundings: Grounding) -> RunOutcome:
    return RunOutcome(status=RunStatus.OK, value=value, groundings=groundings or (FOUND,))


def raised(message: str, *groundings: Grounding, lacking: str = "") -> RunOutcome:
    missing = MissingAttribute(part="a", attribute=lacking) if lacking else None
    return RunOutcome(status=RunStatus.RAISED, message=message, groundings=groundings, missing_attribute=missing)


def write(
    model: FakeModel,
    *outcomes: RunOutcome,
    question: str = "How many holes are there?",
    asked: AnswerType | None = None,
    expect: Expectation | None = None,
    **settings: Any,
) -> Written:
    left = list(outcomes)

    def run(code: Program) -> RunOutcome:
        return left.pop(0) if len(left) > 1 else left[0]

    expected = expect or Expectation()
    task = Task(question, run, partial(judge, expect=expected), expect=expected, asked=asked)
    given = {"llm_base_url": "http://127.0.0.1:1/v1", "llm_model": "m", **settings}
    return LlmWriter(LlmSettings.model_validate(given), model).write(task)


def test_a_program_that_answers_is_asked_for_once() -> None:
    model = FakeModel(Reply(program(COUNT), tokens=TokenUse(input=10, output=2)))
    written = write(model, ok(4))
    (candidate,) = written.candidates
    assert candidate.verdict.answer is not None
    assert candidate.verdict.answer.value == 4
    assert candidate.program.codegen == "llm:m"
    (attempt,) = written.attempts
    assert (attempt.code, attempt.answer, attempt.problem, attempt.tokens.input) == (COUNT, "4", "", 10)
    assert model.temperatures == [0.0]


@pytest.mark.parametrize(
    ("reply", "outcome", "said"),
    [
        ("There are four holes.", None, "holds no code block"),
        (Reply("```python\nsolution = find_parts('hole')", cut=True), None, "broke off"),
        (program("solution = 4"), None, "uses neither find_parts, parts, faces nor shape"),
        (program("solution = shape.width * 1000"), None, "leave it in metres"),
        (program(COUNT), raised("NameError: name 'x' is not defined"), "Only these names exist"),
        (program(COUNT), raised("AttributeError: part 'a' has no position", lacking="position"), "use .center"),
        (program(COUNT), RunOutcome(status=RunStatus.REFUSED, message="the result is not a finite number"), "finite"),
        (program(COUNT), RunOutcome(status=RunStatus.TIMED_OUT, message="the program ran out of time"), "out of time"),
        (program(COUNT), ok([]), "is not of type count: the question asks for a whole number"),
        (program(COUNT), ok([{"part": "hole-1"}]), "is not of type count"),
        (program(COUNT), ok(None), "is not of type count"),
    ],
)
def test_what_is_no_answer_goes_back_with_what_is_wrong(reply: Any, outcome: Any, said: str) -> None:
    model = FakeModel(reply, program(COUNT))
    written = write(model, *([outcome] if outcome else []), ok(4), asked=AnswerType.COUNT)
    assert written.candidates[0].verdict.answer is not None
    bad, good = written.attempts
    assert said in bad.problem
    assert bad.answer is None
    assert (good.problem, good.answer) == ("", "4")
    assert [message.role for message in model.told[1][-2:]] == [Role.ASSISTANT, Role.USER]
    assert said in model.told[1][-1].text
    assert model.told[1][: len(model.told[0])] == model.told[0]


def test_repairs_are_bounded_and_a_repeated_program_is_drawn_anew() -> None:
    model = FakeModel(program(COUNT))
    written = write(model, raised("ZeroDivisionError: division by zero"), llm_repairs=3)
    assert len(written.attempts) == 4
    assert written.candidates[0].verdict.failure is not None
    assert model.temperatures == [0.0, 0.0, 0.7, 0.7]


def test_only_the_last_failure_is_sent_back_so_that_prompts_stay_short() -> None:
    model = FakeModel(program("solution = 1"), program("solution = 2"), program(COUNT))
    write(model, ok(4), llm_repairs=2)
    assert len(model.told[1]) == len(model.told[2]) == len(model.told[0]) + 2


def test_an_endless_reply_is_sent_back_shortened() -> None:
    model = FakeModel(Reply("x = 1\n" * 5000, cut=True), program(COUNT))
    write(model, ok(4))
    assert len(model.told[1][-2].text) <= 2000


def test_a_part_that_the_question_names_and_is_not_known_is_never_guessed() -> None:
    unknown = Grounding(
        description="bananas",
        sides=None,
        parts=(),
        understood=False,
        message="'banana' is not known",
        nearest=("hole",),
    )
    model = FakeModel(program("solution = len(find_parts('bananas'))"), program(COUNT))
    written = write(model, raised("not grounded", unknown), ok(4), question="How many bananas are there?")
    assert len(written.attempts) == 1
    failure = written.candidates[0].verdict.failure
    assert failure is not None
    assert (failure.category, failure.nearest) == ("not_grounded", ("hole",))


def test_words_that_the_model_made_up_are_sent_back() -> None:
    made_up = Grounding(
        description="top hole thing", sides=None, parts=(), understood=False, message="'thing' is not known"
    )
    model = FakeModel(program("solution = len(find_parts('top hole thing'))"), program(COUNT))
    written = write(model, raised("not grounded", made_up), ok(4))
    assert "the question's own words" in written.attempts[0].problem
    assert written.attempts[1].answer == "4"


def test_a_measure_of_another_unit_is_sent_back() -> None:
    model = FakeModel(
        program("solution = find_parts('hole')[0].area"), program("solution = find_parts('hole')[0].depth")
    )
    written = write(model, ok(0.5), ok(0.02), asked=AnswerType.LENGTH)
    assert written.attempts[0].problem == (
        "The question asks for one length in metres, but the program computes one area in m2."
    )
    assert written.attempts[1].answer == "20 mm"


def test_a_count_is_no_length() -> None:
    model = FakeModel(program(COUNT), program("solution = find_parts('hole')[0].depth"))
    written = write(model, ok(1), ok(0.02), asked=AnswerType.LENGTH)
    assert "reads no measure" in written.attempts[0].problem
    assert written.attempts[1].answer == "20 mm"


def test_an_answer_of_another_type_than_was_thought_is_taken_in_the_end() -> None:
    model = FakeModel(program("solution = [p.id for p in find_parts('hole')]"))
    written = write(model, ok(["hole-1"]), asked=AnswerType.COUNT, llm_repairs=1)
    assert [attempt.answer for attempt in written.attempts] == [None, None]
    answer = written.candidates[0].verdict.answer
    assert answer is not None
    assert (answer.type, answer.value) == (AnswerType.TEXTS, ["hole-1"])


def test_what_the_caller_expects_is_told_and_never_given_up() -> None:
    model = FakeModel(program("solution = [p.id for p in find_parts('hole')]"))
    written = write(model, ok(["hole-1"]), expect=Expectation(type=AnswerType.LENGTH), llm_repairs=1)
    assert "one length in metres" in model.told[0][-1].text
    verdict = written.candidates[0].verdict
    assert verdict.answer is None
    assert verdict.failure is not None
    assert verdict.failure.category == "unexpected"


def test_a_doubted_program_is_sent_back_once_and_stands_when_it_comes_again() -> None:
    seen_from_top = "solution = len(find_parts('hole', sides=['top']))"
    model = FakeModel(program(seen_from_top))
    written = write(model, ok(4), asked=AnswerType.COUNT)
    first, second = written.attempts
    assert '"top"' in first.problem
    assert second.code == seen_from_top
    assert written.candidates[0].verdict.answer is not None
    assert model.temperatures == [0.0, 0.0]
    assert len(write(FakeModel(program(seen_from_top)), ok(4), asked=None).attempts) == 1  # words that nobody knows


def test_a_list_of_no_measures_is_doubted() -> None:
    depths = program("solution = [p.depth for p in find_parts('hole') if p.kind == 'pocket']")
    first, _ = write(FakeModel(depths), ok([]), question="How deep are the holes?", asked=AnswerType.LENGTHS).attempts
    assert "empty" in first.problem


def test_a_size_below_zero_is_doubted_and_a_coordinate_is_not() -> None:
    size = program("solution = shape.extents[2] - shape.extents[1]")
    first, _ = write(FakeModel(size), ok(-0.01), question="How high is it?", asked=AnswerType.LENGTH).attempts
    assert "negative" in first.problem
    coordinate = program("solution = shape.center[2]")
    (only,) = write(FakeModel(coordinate), ok(-0.01), question="At which z is it?", asked=AnswerType.LENGTH).attempts
    assert only.problem == ""


def test_a_repair_that_does_not_run_leaves_the_program_that_was_doubted() -> None:
    seen_from_top = "solution = len(find_parts('hole', sides=['top']))"
    model = FakeModel(program(seen_from_top), program("solution = len(find_parts('hole')) / 0"))
    written = write(model, ok(4), raised("ZeroDivisionError: division by zero"), asked=AnswerType.COUNT)
    assert [attempt.answer for attempt in written.attempts] == [None, None, None]
    assert written.candidates[0].program.code == seen_from_top


@pytest.mark.parametrize("error", [LlmBusy("the server answered 503"), LlmTooSlow("not in time")])
def test_a_call_that_fails_keeps_what_was_written_before(error: Any) -> None:
    model = FakeModel(program(COUNT), error)
    written = write(model, ok(4), llm_samples=3)
    assert len(written.candidates) == 1
    assert written.error is error


def test_samples_are_drawn_with_chance_and_repaired_each_by_itself() -> None:
    model = FakeModel(program(COUNT), "prose", program(COUNT), program(COUNT))
    written = write(model, ok(4), llm_samples=3, llm_repairs=1, llm_temperature=0.9)
    assert [attempt.sample for attempt in written.attempts] == [1, 2, 2, 3]
    assert model.temperatures == [0.0, 0.9, 0.9, 0.9]
    assert len(written.candidates) == 3


def test_a_side_that_does_not_exist_is_repaired_from_its_message() -> None:
    message = f"ValueError: no side is called 'upper': use {', '.join(Side)}"
    model = FakeModel(program("solution = len(find_parts('hole', sides=['upper']))"), program(COUNT))
    written = write(model, raised(message, FOUND), ok(4))
    assert "use top, bottom" in written.attempts[0].problem
