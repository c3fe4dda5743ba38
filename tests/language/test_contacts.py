"""Which bodies touch, carry or hold which, and which holes take a screw."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure
from querycad_language.forms import Check, Count, Form, Get, Parts
from querycad_language.readings import read


def first(question: str) -> Form:
    return read(question)[0].form


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
    depths = first("What is the total depth of the grooves?")
    assert isinstance(depths, Get)
    assert depths.reduce == "each"
    lengths = first("What is the total length of the grooves?")
    assert isinstance(lengths, Get)
    assert lengths.reduce == "total"


def test_how_much_parts_do_is_no_number_of_them() -> None:
    assert not any(isinstance(r.form, Count) for r in read("How much do the two straps overlap?"))
    assert any(isinstance(r.form, Count) for r in read("How much straps are there?"))  # as one asks who learns English
    assert any(isinstance(r.form, Count) for r in read("Overlapping straps?"))


def test_degrees_are_compared_with_an_angle() -> None:
    form = next(r.form for r in read("Is every bend 90 degrees?") if isinstance(r.form, Check))
    assert isinstance(form.left, Get)
    assert form.left.measures == (Measure.ANGLE,)
