"""What a verb says of parts, and what lies off a middle or between two parts, as the reader understands it."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure, PartQuery, Relation
from querycad_language.forms import Check, Distance, Every, Form, Get, Parallel, Plane
from querycad_language.readings import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def every(question: str) -> list[tuple[PartQuery, PartQuery]]:
    return [(form.target, form.among) for form in forms(question) if isinstance(form, Every)]


@pytest.mark.parametrize(
    ("question", "adjective"),
    [
        ("Does the drilling emerge on the far side?", "through both walls"),
        ("Does the bore pass through both walls of the lever?", "through both walls"),
        ("Does the cross hole go right through?", "through"),
        ("Does the keyway run from one end to the other?", "open at both ends"),
        ("Does the groove go right across the lever?", "open at both ends"),
    ],
)
def test_what_comes_out_elsewhere_goes_through(question: str, adjective: str) -> None:
    assert any(not target.adjectives and among.adjectives == (adjective,) for target, among in every(question))


def test_what_comes_out_at_a_side_is_seen_there_and_nothing_is_said_of_it_before() -> None:
    found = every("Does the slot in the cap come out at the bottom?")
    assert any(not target.sides and [*among.sides] == ["bottom"] for target, among in found)


@pytest.mark.parametrize("verb", ["break into", "open into", "run into"])
def test_what_breaks_into_another_part_touches_it(verb: str) -> None:
    checks = [form for form in forms(f"Does the drilling {verb} the slot?") if isinstance(form, Check)]
    assert any(
        isinstance(check.left, Distance) and check.left.mode == "surfaces" and check.relation is Relation.AT_MOST
        for check in checks
    )


@pytest.mark.parametrize(
    ("question", "line"),
    [("Are the three bores in line?", "row"), ("Are the two bores on one common axis?", "axis")],
)
def test_parts_in_line(question: str, line: str) -> None:
    assert any(isinstance(form, Parallel) and form.in_line == line for form in forms(question))


def test_both_sides_are_asked_of_both() -> None:
    checks = [form for form in forms("Does the pin stand proud of the lever on both sides?") if isinstance(form, Check)]
    assert any(isinstance(check.left, Distance) and check.left.mode == "beyond both" for check in checks)


def test_a_comparison_with_another_measure_takes_that_measure() -> None:
    checks = [form for form in forms("Is the bush as long as the block is deep?") if isinstance(form, Check)]
    assert any(isinstance(check.low, Get) and check.low.measures == (Measure.DEPTH,) for check in checks)


def test_tops_are_compared_with_the_top_of_what_they_lie_below() -> None:
    found = forms("By how much do the tops of the studs lie below the edge of the tray?")
    assert any(
        isinstance(form, Distance) and isinstance(form.first, Plane) and form.first.side == "top" for form in found
    )


def test_the_angle_of_a_drill_point_is_its_own() -> None:
    asked = [form for form in forms("What is the angle of the drill point in the hole?") if isinstance(form, Get)]
    assert any(form.target is not None and form.target.noun == "drill point" for form in asked)
    depth = [form for form in forms("How deep is the hole without the drill point?") if isinstance(form, Get)]
    assert all(form.target is None or form.target.noun != "drill point" for form in depth)


def test_half_way_between_two_is_as_far_from_both() -> None:
    checks = [form for form in forms("Is the hole midway between the rib and the slot?") if isinstance(form, Check)]
    assert any(isinstance(one.left, Distance) and isinstance(one.low, Distance) for one in checks)
