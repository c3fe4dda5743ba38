"""What is said apart from what it belongs to: places before the question, parts in the sentence before it."""

from __future__ import annotations

import pytest

from querycad_answering.drawing.meaning import describe
from querycad_contracts import Measure, PartQuery, Relation
from querycad_language.forms import Angle, Boundary, Check, Count, Distance, Every, Form, Get, Plane, Towards, queries
from querycad_language.phrases import places_of
from querycad_language.readings import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def asked(question: str) -> list[tuple[Measure, PartQuery]]:
    return [(form.measures[0], form.target) for form in forms(question) if isinstance(form, Get) and form.target]


def distances(question: str) -> list[Distance]:
    return [form for form in forms(question) if isinstance(form, Distance)]


@pytest.mark.parametrize(
    ("question", "relation", "holder"),
    [
        ("On the spindle, how long is that keyway?", "on", "spindle"),
        ("In the sleeve there is a keyway. How long is it?", "in", "sleeve"),
        ("Between the two lugs: how long is that keyway?", "between", "lug"),
    ],
)
def test_a_place_before_the_question_is_where_the_parts_are(question: str, relation: str, holder: str) -> None:
    found = [query for form in forms(question) for query in queries(form) if query.noun == "keyway"]
    assert any(what.noun == holder for query in found for _, what in places_of(query, relation))


@pytest.mark.parametrize("question", ["The radius of the spindle's corners?", "The radius of the lever's corners?"])
def test_corners_that_something_has_are_parts_of_it(question: str) -> None:
    assert any(target.noun == "corner" and places_of(target, "of") for _, target in asked(question))


@pytest.mark.parametrize("verb", ["milled", "cut"])
def test_how_far_something_goes_into_another_part_is_its_depth(verb: str) -> None:
    found = asked(f"How far into the spindle are the keyways {verb}?")
    assert any(measure is Measure.DEPTH and target.noun == "keyway" for measure, target in found)


@pytest.mark.parametrize(
    ("question", "number"), [("Are there no keyways in the lever?", 0.0), ("Does the lever have three lugs?", 3.0)]
)
def test_a_stated_number_is_compared(question: str, number: float) -> None:
    found = [form for form in forms(question) if isinstance(form, Check) and isinstance(form.left, Count)]
    assert any(form.relation is Relation.EQUAL and form.low == number for form in found)


def test_a_stated_angle_is_compared_with_that_of_two_parts() -> None:
    checks = [form for form in forms("Is the angle between the two levers 80 degrees?") if isinstance(form, Check)]
    found = next(form for form in checks if isinstance(form.left, Angle))
    assert isinstance(found.left, Angle)
    assert not found.left.first.sizes
    assert describe(found) == "whether the angle between the 2 levers is 80°"


@pytest.mark.parametrize(
    "question", ["The lever has a drilling. Is it threaded?", "There is a drilling: is it tapped?"]
)
def test_what_is_asked_of_it_is_asked_of_what_was_named_before(question: str) -> None:
    named = [query for form in forms(question) for query in queries(form)]
    assert any(query.noun == "drilling" and "threaded" in query.adjectives for query in named)
    assert any(isinstance(form, Every) for form in forms("The lever has a drilling. Does it go right through?"))


@pytest.mark.parametrize(
    "words", ["How wide is it from the lug to the keyway?", "How thick is it between lug and slit?"]
)
def test_how_wide_it_is_from_one_to_the_other_is_a_distance(words: str) -> None:
    assert any(form.mode == "surfaces" for form in distances(words))


def test_the_outside_of_a_part_is_its_outer_wall() -> None:
    ends = [form.second for form in distances("How far is it from the drilling to the outside of the sleeve?")]
    assert any(isinstance(end, PartQuery) and end.noun == "outer cylinder" for end in ends)
    assert Boundary(None) in ends


def test_the_pocket_floor_is_the_floor_of_the_pocket() -> None:
    ends = [end for form in distances("How far is the pocket floor from the lug?") for end in (form.first, form.second)]
    assert any(isinstance(end, Plane) and end.of.noun == "pocket" for end in ends)


@pytest.mark.parametrize("words", ["Which end is the lug on?", "Which lever side has the lug?"])
def test_which_end_it_is_on_asks_for_a_side(words: str) -> None:
    assert any(isinstance(form, Towards) for form in forms(words))


@pytest.mark.parametrize("words", ["cross-sectional area", "area of the cross section"])
def test_a_cross_section_has_an_area(words: str) -> None:
    assert (Measure.CROSS_SECTION_AREA, "lever") in [
        (m, t.noun) for m, t in asked(f"What is the {words} of the lever?")
    ]


def test_both_of_two_exceptions_are_left_out() -> None:
    counted = forms("How many slots are there besides the keyway and the slit?")
    (found, *_) = [form for form in counted if isinstance(form, Count)]
    assert {one.noun for one in found.target.excluded} == {"keyway", "slit"}
