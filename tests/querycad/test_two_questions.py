"""Two questions in one are asked one after the other; what asks two measures of one part stays one question."""

from __future__ import annotations

from pathlib import Path

import pytest

from querycad import EmbeddedRuntime, Model
from querycad_contracts import AnswerType

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def housing(runtime: EmbeddedRuntime) -> Model:
    return runtime.open(EXAMPLES / "housing.step")


def test_numbers_of_both_are_one_list_and_the_program_gives_it(housing: Model) -> None:
    reply = housing.ask("How many cooling fins are there and how thick are they?")
    assert reply.answer is not None
    assert (reply.answer.type, reply.answer.value) == (AnswerType.NUMBERS, [6, pytest.approx(0.004)])
    assert reply.text == "6; 4 mm (each of 6)"
    assert reply.code is not None
    assert housing.run(reply.code).value == reply.answer.value
    assert reply.understood_as.count(";") == 1


@pytest.mark.parametrize(
    ("question", "value"),
    [
        ("How many cooling fins are there and how thick is each?", 0.004),
        ("How many cooling fins are there and what is their pitch?", 0.009),
        ("How many cooling fins does it have, and what is their spacing?", 0.009),
    ],
)
def test_the_second_half_may_lean_on_the_parts_of_the_first(housing: Model, question: str, value: float) -> None:
    assert housing.ask(question).value == [6, pytest.approx(value)]


def test_what_is_no_number_is_told_in_words(housing: Model) -> None:
    reply = housing.ask("What is the diameter of the cylinder bores, and where are they?")
    assert reply.answer is not None
    assert reply.answer.type is AnswerType.TEXTS
    assert reply.answer.value[0] == "56 mm (each of 3)"
    assert reply.code is None


def test_the_less_sure_half_says_how_sure_both_are(housing: Model) -> None:
    halves = [
        housing.ask(one).confidence for one in ("How many cooling fins are there?", "How thick are the cooling fins?")
    ]
    both = housing.ask("How many cooling fins are there and how thick are the cooling fins?")
    assert both.confidence == min(one for one in halves if one is not None)


@pytest.mark.parametrize("question", ["How long and how wide is the block?", "How wide and how high is it?"])
def test_two_measures_of_one_part_are_one_question(housing: Model, question: str) -> None:
    assert ";" not in housing.ask(question).text


def test_a_half_without_an_answer_leaves_the_other_alone(housing: Model) -> None:
    reply = housing.ask("How many cooling fins are there and how heavy is the propeller?")
    assert ";" not in reply.text
