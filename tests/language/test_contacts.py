"""Which bodies touch, carry or hold which, and which holes take a screw."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure
from querycad_language.forms import Check, Form, Get, Parts, Touching, queries
from querycad_language.readings import read


def first(question: str) -> Form:
    return read(question)[0].form


@pytest.mark.parametrize(
    ("question", "noun", "other", "held"),
    [
        ("Which discs does the spindle touch?", "disc", "spindle", False),
        ("Which plates are touched by the pins?", "plate", "pin", False),
        ("What do the bolts hold together?", "body", "bolt", True),
        ("What is held by the bolts?", "body", "bolt", True),
        ("What is the spacer in contact with?", "body", "spacer", False),
        ("Which plate rests on the columns?", "plate", "column", False),
        ("Which pins hold the cover?", "pin", "cover", False),
        ("What fastens the cover?", "screw", "cover", False),
    ],
)
def test_bodies_are_asked_for_by_what_they_touch(question: str, noun: str, other: str, held: bool) -> None:
    found = [one.form for one in read(question) if isinstance(one.form, Touching)]
    assert [(form.target.noun, form.other.noun, form.held) for form in found][:1] == [(noun, other, held)]


@pytest.mark.parametrize(
    "question",
    ["What is the height of the column that carries the shelf?", "State the number of nuts which hold the rim."],
)
def test_what_a_body_carries_may_only_say_which_one_it_is(question: str) -> None:
    assert not any(isinstance(one.form, Touching) for one in read(question))


@pytest.mark.parametrize(
    "question", ["Which bores are M7?", "Which bores take an M7 bolt?", "Which bores would an M7 bolt fit?"]
)
def test_holes_are_told_by_the_screws_that_they_take(question: str) -> None:
    form = first(question)
    assert isinstance(form, Parts)
    assert form.target.threads == ("m7",)


def test_a_sum_is_of_any_measure_and_a_total_of_what_adds_up() -> None:
    sums = first("What is the sum of the diameters of the pins?")
    totals = first("What is the total diameter of the pins?")
    assert isinstance(sums, Get)
    assert sums.reduce == "total"
    assert isinstance(totals, Get)
    assert totals.reduce == "each"


def test_a_body_is_named_by_what_it_has() -> None:
    for question in ("Which body has the keyway?", "Which part carries the keyway?"):
        named = [form for form in (one.form for one in read(question)) if isinstance(form, Get)]
        placed = [form.target.places for form in named if form.measures == (Measure.NAME,) and form.target is not None]
        assert any(
            place.relation == "with" and place.what and place.what.noun == "keyway" for (place,) in filter(None, placed)
        )
    walls = [one.form for one in read("Which wall carries the window?") if isinstance(one.form, Get)]
    assert not any(form.target and form.target.places for form in walls)  # a side is asked for


def test_one_that_is_asked_for_may_be_several() -> None:
    form = next(r.form for r in read("Which disc touches the spindle?") if isinstance(r.form, Touching))
    assert form.target.plural


def test_what_does_not_touch_is_what_is_left() -> None:
    asked = (r.form for r in read("Which discs do not touch the spindle?") if isinstance(r.form, Touching))
    assert [(form.target.noun, form.negated) for form in asked][:1] == [("disc", True)]


def test_an_order_may_be_said_behind_the_noun() -> None:
    form = next(r.form for r in read("What is the third largest disc by volume?") if list(queries(r.form)))
    (query,) = queries(form)
    assert [(rank.nth, rank.measure) for rank in query.ranks] == [(3, Measure.VOLUME)]


def test_degrees_are_compared_with_an_angle() -> None:
    form = next(r.form for r in read("Is every bend 90 degrees?") if isinstance(r.form, Check))
    assert isinstance(form.left, Get)
    assert form.left.measures == (Measure.ANGLE,)
