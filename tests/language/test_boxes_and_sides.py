"""Boxes that a part fits into, sides with most parts, extremes that are asked for together, and pairs far apart."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure
from querycad_language.forms import Count, Distance, Exists, Form, Reduce, Towards, Uniform
from querycad_language.readings import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


@pytest.mark.parametrize(
    "question",
    [
        "Which side has the most slots?",
        "On which face are most slots?",
    ],
)
def test_the_side_with_most_parts(question: str) -> None:
    towards = next(form for form in forms(question) if isinstance(form, Towards) and form.seen == "most")
    assert towards.target.noun == "slot"
    assert not any(isinstance(form, Count) for form in forms(question))


@pytest.mark.parametrize(
    ("question", "reduce"),
    [
        ("What is the distance between the two largest slots?", Reduce.ONE),
    ],
)
def test_a_pair_is_looked_for_among_all(question: str, reduce: Reduce) -> None:
    distance = next(form for form in forms(question) if isinstance(form, Distance) and form.second == "each other")
    assert distance.reduce is reduce
    count = getattr(distance.first, "count", None)
    assert (count is None) == (reduce is not Reduce.ONE)


@pytest.mark.parametrize(
    "question", ["lugs, yes or no?", "has_lug: true or false?", "I want to know if ribs exist in it."]
)
def test_whether_there_is_one_in_few_words(question: str) -> None:
    assert any(isinstance(form, Exists) for form in forms(question))


@pytest.mark.parametrize(
    "question", ["lugs all one size?", "Is there just one size of rib?", "Are all ribs of one size?"]
)
def test_one_size_for_all(question: str) -> None:
    assert any(isinstance(form, Uniform) for form in forms(question))


def test_faces_without_a_word_more_are_all_faces() -> None:
    assert forms("How many faces does it have?")[0] == next(
        form for form in forms("faces: how many?") if isinstance(form, Count) and form.measure is Measure.FACE_COUNT
    )
