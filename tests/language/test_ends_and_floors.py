"""Ends that parts lie at, floors and corners as points, neighbours, and which way something is turned."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure, PartQuery, Side
from querycad_language.forms import Angle, Boundary, Distance, Form, Get, Reduce, Several, Towards, Which, queries
from querycad_language.readings.reader import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def targets(question: str) -> list[PartQuery]:
    return [query for form in forms(question) for query in queries(form)]


@pytest.mark.parametrize("place", ["at the left end", "on the left end of the spindle", "near the left end"])
def test_what_is_at_an_end_is_the_one_farthest_out_there_and_not_what_is_seen_from_there(place: str) -> None:
    found = [query for query in targets(f"How deep is the keyway {place}?") if query.noun == "keyway"]
    assert any(query.ends == (Side.LEFT,) and not query.sides for query in found)
    seen = [query for query in targets("How deep is the keyway on the left?") if query.noun == "keyway"]
    assert any(query.sides == (Side.LEFT,) for query in seen)


@pytest.mark.parametrize("words", ["to the right of", "directly to the right of"])
def test_what_lies_beside_another_part_is_no_side_of_it(words: str) -> None:
    found = [query for query in targets(f"How wide is the groove {words} the lug?") if query.noun == "groove"]
    assert any(place.relation == "right" and place.what for query in found for place in query.places)


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("Where is the bottom centre of the blind bore?", Measure.FLOOR_CENTER),
        ("Where is the middle of the floor of the keyway?", Measure.FLOOR_CENTER),
        ("The minimum corner of the bounding box?", Measure.MIN_CORNER),
        ("The bounding box maximum?", Measure.MAX_CORNER),
        ("Unit normal of the largest face?", Measure.NORMAL),
    ],
)
def test_points_and_directions_have_names_of_their_own(question: str, measure: Measure) -> None:
    assert any(isinstance(form, Get) and form.measures == (measure,) for form in forms(question))


def test_neighbours_are_two_of_all_and_no_group_of_two() -> None:
    found = [form for form in forms("The distance between two adjacent lugs?") if isinstance(form, Distance)]
    every = [form.first for form in found if form.second == "each other"]
    assert every
    assert all(isinstance(first, PartQuery) and first.count is None for first in every)


@pytest.mark.parametrize(
    ("question", "every"),
    [
        ("How far is the lug from the axis of the bore?", False),
        ("What remains between the lug and the groove?", False),
        ("How far is it from one lug to the next?", True),
        ("The lug spacing?", True),
        ("How far is it from each of the two lugs to the other?", True),
    ],
)
def test_one_of_two_places_is_not_apart_from_its_own_kind(question: str, every: bool) -> None:
    found = [form.first for form in forms(question) if isinstance(form, Distance) and form.second == "each other"]
    assert any(isinstance(first, PartQuery) and first.noun == "lug" for first in found) is every


@pytest.mark.parametrize(("whose", "border"), [("the groove", False), ("a slot", False), ("the plate", True)])
def test_the_edge_of_a_cut_is_no_border_of_the_model(whose: str, border: bool) -> None:
    found = forms(f"How far is the nearest edge of {whose} from the lug?")
    ends = [end for form in found if isinstance(form, Distance) for end in (form.first, form.second)]
    assert (Boundary(None) in ends) is border
    nouns = {end.noun for end in ends if isinstance(end, PartQuery)}
    assert {"lug", whose.split()[1]} <= nouns


def test_a_long_arm_and_a_short_arm_are_no_directions() -> None:
    def several(question: str) -> bool:
        return any(isinstance(form, Several) for form in forms(question))

    assert several("What is the spacing of the lugs, the long way and the short way?")
    assert not several("How far apart are the two lugs, one on the long arm and one on the short arm?")


def test_an_angular_spacing_is_no_distance() -> None:
    found = forms("The angular spacing of neighbouring lugs?")
    assert any(isinstance(form, Angle) for form in found)
    assert not any(isinstance(form, Distance) for form in found)


def test_the_rim_of_what_is_no_cut_is_an_edge() -> None:
    found = [form for form in forms("How far is the keyway from the rim of the lid?") if isinstance(form, Distance)]
    assert any(Boundary(None) in (form.first, form.second) for form in found)
    cut = [form for form in forms("How far is the lug from the rim of the slot?") if isinstance(form, Distance)]
    assert not any(Boundary(None) in (form.first, form.second) for form in cut)


def test_the_first_one_from_an_end_is_the_nearest() -> None:
    found = forms("How far is it from the left end to the first lug?")
    assert any(isinstance(form, Distance) and form.reduce is Reduce.SMALLEST for form in found)


@pytest.mark.parametrize(
    "question",
    [
        "Which way does the keyway open?",
        "Which face of the spindle carries the keyway?",
        "I need the side of the spindle where the keyway is.",
    ],
)
def test_a_side_may_be_asked_for_in_many_ways(question: str) -> None:
    found = [form for form in forms(question) if isinstance(form, Towards)]
    assert any(form.target.noun == "keyway" and "open" not in form.target.adjectives for form in found)


def test_a_noun_may_be_missing_at_the_end() -> None:
    (which, *_) = [form for form in forms("Which lug is wider, the left or the right?") if isinstance(form, Which)]
    assert which.words == ("left lug", "right lug")


def test_the_width_of_what_is_turned_is_axial_beside_its_diameter_too() -> None:
    found = [form.measures for form in forms("Diameter and width of that collar?") if isinstance(form, Get)]
    assert (Measure.DIAMETER, Measure.AXIAL_EXTENT) in found


def test_what_stands_behind_from_and_to_is_where_a_length_begins_and_ends() -> None:
    found = [one for one in read("Height of the hub from the seat to the far rim?") if one.features.get("led") == 1.0]
    first = [one.form.first for one in found if isinstance(one.form, Distance)]
    assert {query.noun for query in first if isinstance(query, PartQuery)} == {"seat"}


@pytest.mark.parametrize(
    "end", ["the nearest end of the rail", "the nearest rail end", "the end of the rail nearest to it"]
)
def test_the_nearer_of_two_ends_may_be_said_in_many_ways(end: str) -> None:
    found = [form.second for form in forms(f"How far is the dowel from {end}?") if isinstance(form, Distance)]
    ends = [one for one in found if isinstance(one, Boundary) and one.axis is not None and one.of is not None]
    assert any(one.of.noun == "rail" and not one.of.ranks for one in ends if one.of is not None)


def test_the_end_next_to_another_part_is_not_the_nearer_one() -> None:
    found = [
        form.second
        for form in forms("How far is the dowel from the end of the rail next to the lug?")
        if isinstance(form, Distance)
    ]
    assert not any(isinstance(one, Boundary) and one.axis is not None for one in found)


@pytest.mark.parametrize(
    "question", ["What is the angular spacing of the lugs?", "What is the angle between neighbouring lugs?"]
)
def test_an_angle_from_one_to_the_next_is_none_of_a_single_part(question: str) -> None:
    asked = forms(question)
    assert any(isinstance(form, Angle) and form.first.noun == "lug" for form in asked)
    single = [form for form in asked if isinstance(form, Get) and form.measures == (Measure.ANGLE,)]
    assert all(form.target is None or form.target.noun != "lug" for form in single)


def test_the_angle_of_slots_is_their_own() -> None:
    asked = [form for form in forms("What is the angle of the slots?") if isinstance(form, Get)]
    assert any(form.target is not None and form.target.noun == "slot" for form in asked)
