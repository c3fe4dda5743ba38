"""Typed answers: the right type and shape from plain results, and text that people read."""

from __future__ import annotations

import math
from typing import Any

import pytest

from querycad_answering.typed import WrongAnswerType, typed_answer
from querycad_contracts import AnswerType, LengthUnit, Unit

T = AnswerType


@pytest.mark.parametrize(
    ("value", "expects", "text"),
    [
        (4, T.COUNT, "4"),
        (4.0, T.COUNT, "4"),
        (0.0055, T.LENGTH, "5.5 mm"),
        ([0.00125] * 4, T.LENGTHS, "1.25 mm (each of 4)"),
        ([0.016, 0.0085, 0.016], T.LENGTHS, "16 mm (each of 2), 8.5 mm"),
        ([], T.LENGTHS, "none"),
        ([0.001, -0.002, 1e-15], T.POINT, "(1, -2, 0) mm"),
        ([0.095, 0.171, 0.05], T.SIZE, "95 x 171 x 50 mm"),
        (2e-6, T.AREA, "2 mm²"),
        (3e-9, T.VOLUME, "3 mm³"),
        (math.pi / 4, T.ANGLE, "45°"),
        (True, T.BOOLEAN, "yes"),
        ([{"part": "hole-1"}], T.PARTS, "hole-1"),
        ("M5", T.TEXT, "M5"),
    ],
)
def test_a_value_of_the_expected_type_is_written_for_people(value: Any, expects: AnswerType, text: str) -> None:
    answer = typed_answer(value, expects)
    assert answer.type is expects
    assert answer.text == text


@pytest.mark.parametrize(("unit", "text"), [("mm", "25.4 mm"), ("m", "0.0254 m"), ("in", "1 in")])
def test_the_unit_changes_the_text_and_never_the_value(unit: str, text: str) -> None:
    answer = typed_answer(0.0254, T.LENGTH, LengthUnit(unit))
    assert (answer.value, answer.unit, answer.text) == (0.0254, Unit.METRE, text)


def test_several_equal_values_for_one_thing_are_one_value() -> None:
    answer = typed_answer([0.005, 0.005 + 1e-16], T.LENGTH)
    assert (answer.value, answer.type) == (0.005, T.LENGTH)


def test_several_different_values_for_one_thing_become_plural() -> None:
    answer = typed_answer([0.005, 0.006], T.LENGTH)
    assert (answer.value, answer.type) == ([0.005, 0.006], T.LENGTHS)


def test_one_point_is_no_list_of_three_lengths_and_a_plural_keeps_its_list() -> None:
    assert typed_answer([[0.0, 0.0, 1.0]], T.POINTS).value == [[0.0, 0.0, 1.0]]
    assert typed_answer([0.0, 0.0, 1.0], T.POINTS).value == [[0.0, 0.0, 1.0]]


@pytest.mark.parametrize(
    ("value", "expects"),
    [
        (None, T.LENGTH),
        ("long", T.LENGTH),
        (True, T.LENGTH),
        (math.nan, T.LENGTH),
        (math.inf, T.LENGTHS),
        (2.5, T.COUNT),
        (-1, T.COUNT),
        ([1.0, 2.0], T.POINT),
        ([1.0, "2", 3.0], T.SIZE),
        ({"part": "a", "face": 1}, T.PARTS),
        (1, T.BOOLEAN),
    ],
)
def test_a_value_of_another_type_is_refused_and_says_which_was_wanted(value: Any, expects: AnswerType) -> None:
    with pytest.raises(WrongAnswerType):
        typed_answer(value, expects)


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        (3, T.COUNT),
        (0.5, T.LENGTH),
        ([0.5, 0.6], T.LENGTHS),
        ([[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]], T.POINTS),
        (False, T.BOOLEAN),
        ("name", T.TEXT),
        ({"part": "hole-1"}, T.PARTS),
    ],
)
def test_without_an_expectation_the_type_follows_the_value(value: Any, kind: AnswerType) -> None:
    assert typed_answer(value, None).type is kind
