"""Answers in units beside those of lengths, and questions without them."""

from __future__ import annotations

import pytest

from querycad_answering.drawing.asked_units import in_asked_unit, without_asked_unit
from querycad_contracts import Answer, AnswerType, Unit


def answer(text: str) -> Answer:
    return Answer(value=1.0, type=AnswerType.NUMBER, unit=Unit.NONE, text=text)


@pytest.mark.parametrize(
    ("question", "text", "told"),
    [
        ("mass in pounds", "0.90718474 kg", "2 pounds"),
        ("How many grams does it weigh?", "0.2955 kg", "295.5 grams"),
        ("volume in litres", "2500000 mm³", "2.5 litres"),
        ("How many cubic centimeters is it?", "1500 mm³", "1.5 cubic centimeters"),
        ("area in square feet", "185806.08 mm²", "2 square feet"),
        ("length in feet", "609.6 mm (each of 2), 304.8 mm", "2 feet (each of 2), 1 feet"),
        ("range in microns", "5 to 26 mm", "5000 to 26000 microns"),
        ("size in feet", "304.8 x 609.6 x 914.4 mm", "1 x 2 x 3 feet"),
        ("Where is it, in feet?", "(0, -304.8, 609.6) mm", "(0, -1, 2) feet"),
        ("length in mm", "5 mm", "5 mm"),
        ("mass in pounds", "hole-4", "hole-4"),
        ("width in pounds", "5 mm", "5 mm"),
        ("thickness at 5 g", "5 mm", "5 mm"),
    ],
)
def test_the_text_is_in_the_unit_that_is_asked_for(question: str, text: str, told: str) -> None:
    assert in_asked_unit(question, answer(text)).text == told


@pytest.mark.parametrize(
    ("question", "plain"),
    [
        ("What is the mass of the lever in pounds?", "What is the mass of the lever?"),
        ("How many feet long is the lever?", "how long is the lever?"),
        ("How many grams does it weigh?", "how much does it weigh?"),
        ("How many litres is the lever?", "what volume is the lever?"),
        ("How many feet has the table?", "How many feet has the table?"),
        ("How many lugs are there?", "How many lugs are there?"),
    ],
)
def test_the_question_is_read_without_it(question: str, plain: str) -> None:
    assert without_asked_unit(question) == plain


def test_names_are_no_sizes() -> None:
    named = Answer(value=["Pin 5 mm"], type=AnswerType.TEXTS, unit=Unit.NONE, text="Pin 5 mm")
    assert in_asked_unit("names, and lengths in feet", named).text == "Pin 5 mm"
