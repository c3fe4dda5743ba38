"""A yes or no that is no better than a coin is unsure; masses are compared in kg; a list is as on a drawing."""

from __future__ import annotations

from pathlib import Path

import pytest

from querycad import EmbeddedRuntime, Model
from querycad_answering.confidence import OTHER_CLASS
from querycad_contracts import AnswerType, Status

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def flange(runtime: EmbeddedRuntime) -> Model:
    return runtime.open(EXAMPLES / "flange.step")


@pytest.mark.parametrize(
    ("question", "value"),
    [
        ("Is it heavier than 1 kg in steel?", True),
        ("Is it lighter than 500 g in steel?", False),
        ("Does it weigh less than 20 lb in aluminium?", True),
    ],
)
def test_masses_are_compared_in_their_own_units(flange: Model, question: str, value: bool) -> None:
    reply = flange.ask(question)
    assert reply.answer is not None
    assert reply.answer.value is value
    assert " kg" in reply.understood_as
    assert "mm" not in reply.understood_as


def test_a_mass_without_a_density_is_compared_with_nothing(flange: Model) -> None:
    reply = flange.ask("Is it heavier than 1 kg?")
    assert reply.failure is not None
    assert "density" in reply.failure.message


def test_a_yes_or_no_that_passes_over_a_part_is_unsure(flange: Model) -> None:
    reply = flange.ask("Are the bolt holes deeper than 10 mm, as the propeller is?")
    assert reply.status is not Status.ANSWERED
    assert reply.confidence is None or reply.confidence <= OTHER_CLASS


def test_a_yes_or_no_has_to_be_likelier_than_a_coin(flange: Model) -> None:
    for question in (
        "Are the holes all the same depth?",
        "Is the groove wider than 3 mm?",
        "Are the bolt holes threaded?",
    ):
        reply = flange.ask(question, least_confidence=0.6)
        assert reply.answer is not None
        assert reply.answer.type is AnswerType.BOOLEAN
        assert reply.confidence is not None
        assert (reply.status is Status.ANSWERED) == (reply.confidence >= 0.8)


def test_a_list_is_as_on_a_drawing(flange: Model) -> None:
    assert flange.ask("List all holes.").text.startswith(
        "8x Ø16 THRU, counterbore Ø26 depth 8 (hole-1..3, hole-5, hole-7..10); 2x Ø8.5"
    )
    assert flange.ask("Which holes are there on top?").text.startswith("hole-1, hole-2")


def test_numbers_on_each_side_are_told_side_by_side(flange: Model) -> None:
    reply = flange.ask("How many holes are on each side?", least_confidence=0.0)
    assert reply.answer is not None
    assert reply.answer.value == ["top: 11", "bottom: 11"]


def test_which_of_two_is_told_by_its_words(flange: Model) -> None:
    assert flange.ask("Which is deeper, hole 1 or the groove?").text == "hole-1"
    assert flange.ask("Which is deeper, the bore or the groove?").text == "bore"


def test_a_screw_that_fits_is_told_by_its_name(runtime: EmbeddedRuntime) -> None:
    sheet = runtime.open(EXAMPLES / "sheet_metal.step")
    reply = sheet.ask("What screw fits through the four holes in the base plate?")
    assert reply.answer is not None
    assert (reply.answer.type, reply.answer.value) == (AnswerType.TEXT, "M4")
    assert reply.text == "M4 (4.5 mm: clears M4 (medium))"
    plain = sheet.ask("What is the diameter of the four holes in the base plate?")
    assert plain.text == "4.5 mm (each of 4)"


def test_what_is_light_is_told_in_grams(flange: Model) -> None:
    assert flange.ask("What does it weigh at 0.1 g/cm3?").text.endswith(" g")
    assert flange.ask("What does it weigh in steel?").text.endswith(" kg")
    assert flange.ask("What does it weigh at 0.1 g/cm3 in ounces?").text.endswith(" ounces")
