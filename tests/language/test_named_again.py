"""A size that another measure names, a part that was named before, and what has another: with parts drawn by seed."""

from __future__ import annotations

import pytest
from tests.language.test_constructions import filled, readings, targets

from querycad_contracts import Measure
from querycad_language.forms import Check, Count, Distance, Exists, Get, Plane, Which
from querycad_language.readings import read

NAMED_SIZES = {
    "How big is the {a} in diameter?": (Measure.DIAMETER,),
    "How large is the {a}, measured in width?": (Measure.WIDTH,),
    "How big is the {a} across its flats?": (Measure.ACROSS_FLATS,),
    "How many millimetres does the {a} measure in height?": (Measure.HEIGHT,),
    "I need the {a} size, width by height.": (Measure.WIDTH, Measure.HEIGHT),
    "Size of the {a}, length followed by depth?": (Measure.LENGTH, Measure.DEPTH),
    "What does the {a} measure from one end to the other?": (Measure.LENGTH,),
}


@pytest.mark.parametrize(("question", "measures"), NAMED_SIZES.items())
def test_a_size_is_what_a_measure_behind_it_names(question: str, measures: tuple[Measure, ...]) -> None:
    for said, a, _ in filled(question):
        forms = [one.form for one in readings(said) if isinstance(one.form, Get)]
        assert any(form.measures == measures and form.target and form.target.noun == a for form in forms), said


def test_sizes_are_no_measure_of_another_thing() -> None:
    form = read("How big is the lever, and what diameter has the bore?")[0].form
    assert isinstance(form, Get)
    assert form.measures != (Measure.DIAMETER,) or (form.target is not None and form.target.noun == "bore")


@pytest.mark.parametrize("question", ["{a}: {bb}, how many?", "The {a}: number of {bb}?", "{a}, {b} count?"])
def test_what_is_named_before_has_the_parts(question: str) -> None:
    for said, a, b in filled(question):
        counted = [one.form.target for one in readings(said) if isinstance(one.form, Count)]
        assert any(q.noun == b and [p.what and p.what.noun for p in q.places] == [a] for q in counted), said


def test_of_what_has_another_either_may_be_meant() -> None:
    for said, a, b in filled("The {a} has a {b}. How broad is it?"):
        assert any(place.what and place.what.noun == a for one in targets(said, b) for place in one.places), said
    for said, a, b in filled("One {a} has a {b}. How wide is this {a}?"):
        assert any(place.relation == "with" for one in targets(said, a) for place in one.places), (said, b)


@pytest.mark.parametrize(
    "question",
    [
        "Compare the {a} and the {b}. Which one is thicker?",
        "Is it the {a} or the {b} that has the greater thickness?",
        "Which has more thickness: the {a} or the {b}?",
    ],
)
def test_one_of_two_is_asked_for(question: str) -> None:
    for said, a, b in filled(question):
        form = next(one.form for one in readings(said) if isinstance(one.form, Which))
        assert form.words == (a, b), said
        assert isinstance(form.left, Get)
        assert form.left.measures == (Measure.THICKNESS,), said


@pytest.mark.parametrize("question", ["Do both {aa} have a {b}?", "Is there a {b} in each of the two {aa}?"])
def test_one_is_not_enough_for_both(question: str) -> None:
    for said, _, _ in filled(question):
        assert any(isinstance(one.form, Check) for one in readings(said)), said
        assert not any(isinstance(one.form, Exists) for one in readings(said)), said


@pytest.mark.parametrize("question", ["The overhang of the {a} beyond the {b}?", "Projection of the {a} from the {b}?"])
def test_an_overhang_is_of_a_part(question: str) -> None:
    for said, a, _ in filled(question):
        ends = [one.form.first for one in readings(said) if isinstance(one.form, Distance)]
        assert any(isinstance(end, Plane) and end.of.noun == a for end in ends), said


def test_what_is_said_behind_a_place_is_said_of_the_parts() -> None:
    query = targets("Are the holes of the rail stepped?", "hole") or targets(
        "The holes of the rail are stepped.", "hole"
    )
    assert all(not place.what.adjectives for one in query for place in one.places if place.what)
