"""What lies in the middle of several parts, sizes that parts do not have, and arithmetic that is passed over."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure, PartQuery, Relation, SizeFilter
from querycad_language.forms import Check, Count, Distance, Get
from querycad_language.readings.reader import read


@pytest.mark.parametrize(
    ("question", "mode"),
    [
        ("Is the port in the middle of the four studs?", "amid"),
        ("Is the port in the middle of the lid?", "centers"),
    ],
)
def test_what_lies_in_the_middle_of_several_parts_lies_in_that_of_all(question: str, mode: str) -> None:
    checks = [reading.form.left for reading in read(question) if isinstance(reading.form, Check)]
    assert {left.mode for left in checks if isinstance(left, Distance)} & {"amid", "centers"} == {mode}


@pytest.mark.parametrize("question", ["How many studs that are not 6 mm?", "How many studs which are not 6 mm thick?"])
def test_a_size_may_be_denied(question: str) -> None:
    counts = [reading.form for reading in read(question) if isinstance(reading.form, Count)]
    (size,) = next(form.target.sizes for form in counts if form.target.sizes)
    assert (size.relation, size.low) == (Relation.UNEQUAL, 0.006)


def test_a_size_that_is_not_denied_is_that_size() -> None:
    counts = [reading.form for reading in read("How many studs that are 6 mm?") if isinstance(reading.form, Count)]
    assert any(form.target.sizes == (SizeFilter(low=0.006),) for form in counts)


@pytest.mark.parametrize("question", ["What is half the width of the lid?", "Width of the lid squared?"])
def test_words_of_arithmetic_are_not_passed_over_in_silence(question: str) -> None:
    for reading in read(question):
        if isinstance(reading.form, Get) and reading.form.measures == (Measure.WIDTH,):
            assert "skip_comparison" in reading.features


def test_half_of_a_part_is_no_arithmetic() -> None:
    readings = read("How wide is the upper half of the lid?")
    assert any("skip_comparison" not in reading.features for reading in readings)


@pytest.mark.parametrize(
    ("question", "two"),
    [("What is the stud spacing of the lid?", False), ("What is the stud spacing from the lid?", True)],
)
def test_the_spacing_of_parts_of_another_is_no_distance_between_the_two(question: str, two: bool) -> None:
    distances = [reading.form for reading in read(question) if isinstance(reading.form, Distance)]
    assert any(form.second == "each other" for form in distances)
    assert any(isinstance(form.first, PartQuery) and isinstance(form.second, PartQuery) for form in distances) is two


@pytest.mark.parametrize(("question", "alone"), [("What are the stud heights?", False), ("And the stud?", True)])
def test_where_every_word_is_read_no_reading_takes_the_part_alone(question: str, alone: bool) -> None:
    assert any("named_only" in one.features for one in read(question)) is alone


@pytest.mark.parametrize(
    ("question", "bodies"),
    [("Is this an assembly?", True), ("Is it one body?", True), ("Are studs used anywhere in this assembly?", False)],
)
def test_whether_it_is_one_body_or_several_is_their_number(question: str, bodies: bool) -> None:
    checked = [one.form.left for one in read(question) if isinstance(one.form, Check)]
    assert any(isinstance(left, Count) and left.target.noun == "body" for left in checked) is bodies
