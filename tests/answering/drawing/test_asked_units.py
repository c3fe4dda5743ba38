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
        ("mass in pounds", "0.45359237 kg", "1 lb"),
        ("How many grams does it weigh?", "0.2955 kg", "295.5 g"),
        ("volume in litres", "2500000 mm³", "2.5 l"),
        ("How many cubic centimeters is it?", "1500 mm³", "1.5 cm³"),
        ("area in square feet", "92903.04 mm²", "1 ft²"),
        ("length in feet", "304.8 mm (each of 2)", "1 ft (each of 2)"),
        ("range in microns", "5 to 26 mm", "5000 to 26000 µm"),
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
