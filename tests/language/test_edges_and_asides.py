"""Edges of cuts, what is said of the order of values, what fits, and questions behind a statement."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure
from querycad_language.forms import Combine, Distance, Every, Form, Get, Several, Towards
from querycad_language.readings import Reading
from querycad_language.readings.reader import read


def first(question: str) -> Reading:
    return min(read(question), key=lambda one: len(one.skipped))


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


@pytest.mark.parametrize(
    "question",
    [
        "What is the distance from the edge of the bore to the shoulder?",
        "How far is the slot's rim from the rib?",
        "Distance between the outer edge of the groove and the lug?",
    ],
)
def test_from_the_edge_of_a_cut_is_from_its_surface(question: str) -> None:
    found = [form for form in forms(question) if isinstance(form, Distance) and form.second != "each other"]
    assert found
    assert found[0].mode == "surfaces"


def test_from_a_cut_itself_is_as_usual() -> None:
    found = next(form for form in forms("How far is the slot from the rib?") if isinstance(form, Distance))
    assert found.mode == "usual"


@pytest.mark.parametrize(
    "question",
    ["How much metal remains from the bore to the lug?", "Material left from the groove to the shoulder?"],
)
def test_what_is_left_from_one_to_another_is_left_between_them(question: str) -> None:
    found = next(form for form in forms(question) if isinstance(form, Distance))
    assert found.mode == "surfaces"


@pytest.mark.parametrize(
    ("question", "measures"),
    [
        ("What are the diameter and the depth of the socket, in that order?", (Measure.DIAMETER, Measure.DEPTH)),
        ("Diameters of the two journals, the left one first?", (Measure.DIAMETER,)),
    ],
)
def test_in_which_order_values_come_is_passed_over(question: str, measures: tuple[Measure, ...]) -> None:
    reading = first(question)
    assert isinstance(reading.form, Get)
    assert reading.form.measures == measures
    assert not [word for kind, word in reading.skipped if kind not in ("side", "chatter")]


@pytest.mark.parametrize(
    "question", ["Spacing of the studs along x, then along y?", "Pitch of the ribs along y and along z?"]
)
def test_along_one_axis_and_along_another_is_no_length(question: str) -> None:
    several = [form for form in forms(question) if isinstance(form, Several)]
    axes = [[one.axis for one in form.of] for form in several]
    assert [0, 1] in axes or [1, 2] in axes


@pytest.mark.parametrize(
    "question", ["The knob has a recess around the stem; depth of it?", "The jaw has a slot. Width of it?"]
)
def test_a_measure_behind_a_statement_is_no_yes_or_no(question: str) -> None:
    assert not any(isinstance(form, Every) for form in forms(question))
    assert isinstance(first(question).form, Get)


def test_what_differs_in_another_sentence_is_not_asked() -> None:
    found = forms("The two journals differ in length. What are their diameters?")
    assert any(isinstance(form, Get) and form.measures == (Measure.DIAMETER,) for form in found)
    assert all(isinstance(form, Combine) for form in forms("How much do the two journals differ in length?"))


@pytest.mark.parametrize("question", ["What pin does the hub take?", "Which rod does the clevis hold?"])
def test_what_a_part_takes_is_as_wide_as_the_hole_in_it(question: str) -> None:
    found = [form.target for form in forms(question) if isinstance(form, Get) and form.measures == (Measure.DIAMETER,)]
    assert any(target is not None and [place.relation for place in target.places] == ["in"] for target in found)


@pytest.mark.parametrize("question", ["Which way does the nozzle point?", "Towards which side does the lug face?"])
def test_a_verb_of_how_something_is_turned_is_understood(question: str) -> None:
    reading = next(reading for reading in read(question) if isinstance(reading.form, Towards))
    assert not reading.skipped


def test_which_axis_a_bore_follows_is_asked() -> None:
    for question in ("Which axis does the bore follow?", "Along which axis does the channel go, x or y?"):
        assert any(isinstance(form, Get) and form.measures == (Measure.LONG_AXIS,) for form in forms(question))
