"""What passes through or between, what is flush, spacings by level, ends and pieces of parts, and what was cut."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure, PartQuery, Relation, Side
from querycad_language.forms import (
    HORIZONTAL,
    LONGEST,
    SHORTER,
    VERTICAL,
    Check,
    Distance,
    Form,
    Get,
    Plane,
    Several,
    queries,
)
from querycad_language.phrases import places_of
from querycad_language.readings.reader import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def targets(question: str, measure: Measure) -> list[PartQuery]:
    """The parts that this measure is asked of."""
    found = [form for form in forms(question) if isinstance(form, Get) and form.measures == (measure,)]
    return [form.target for form in found if form.target is not None]


@pytest.mark.parametrize(
    ("question", "measure", "noun"),
    [
        ("Is the notch long enough for a 25 mm key?", Measure.LENGTH, "notch"),
        ("Is the eye big enough for an M10 bolt?", Measure.DIAMETER, "eye"),
        ("Would a 40 mm bar go through?", Measure.DIAMETER, "bore"),
    ],
)
def test_what_shall_fit_is_compared_with_what_it_goes_into(question: str, measure: Measure, noun: str) -> None:
    checks = [form for form in forms(question) if isinstance(form, Check) and form.relation is Relation.AT_LEAST]
    gets = [form.left for form in checks if isinstance(form.left, Get)]
    assert any(get.measures == (measure,) and get.target is not None and get.target.noun == noun for get in gets)


@pytest.mark.parametrize(
    "question", ["Would a 20 mm bar fit between the lugs?", "A block 30 mm wide: will it go between the lugs?"]
)
def test_what_shall_fit_between_is_compared_with_the_gap(question: str) -> None:
    checks = [form.left for form in forms(question) if isinstance(form, Check) and form.relation is Relation.AT_LEAST]
    assert any(isinstance(left, Distance) and left.second == "each other" for left in checks)


@pytest.mark.parametrize(
    ("question", "side"),
    [("Is the cap flush with the sleeve at the top?", Side.TOP), ("Does the pin lie flush with the plate?", None)],
)
def test_flush_parts_end_on_one_level(question: str, side: Side | None) -> None:
    levels = [form.left for form in forms(question) if isinstance(form, Check)]
    ends = [left.first for left in levels if isinstance(left, Distance)]
    assert any(isinstance(end, Plane) and end.side is side for end in ends)


@pytest.mark.parametrize(
    ("question", "axes"),
    [
        ("Horizontal and vertical spacing of the studs?", [HORIZONTAL, VERTICAL]),
        ("Spacing of the studs in the long direction and in the transverse direction?", [LONGEST, SHORTER]),
        ("Stud spacing left-right and up-down?", [0, 2]),
        ("What is the stud spacing, crosswise (y) and vertically (z)?", [1, 2]),
        ("What spacing do the studs have along the bolted edge and across?", [LONGEST, SHORTER]),
        ("What are the two distances of the studs, the longer first?", [LONGEST, SHORTER]),
    ],
)
def test_spacings_in_two_directions(question: str, axes: list[int]) -> None:
    several = [form.of for form in forms(question) if isinstance(form, Several)]
    assert axes in [[distance.axis for distance in of] for of in several]


def test_spacings_are_along_a_part_and_across_it() -> None:
    several = next(
        form for form in forms("Stud spacing, first along the slot, then across it?") if isinstance(form, Several)
    )
    along, across = (distance.axis for distance in several.of)
    assert isinstance(along, PartQuery)
    assert (along.noun, across) == ("slot", SHORTER)


def test_a_size_along_the_long_and_the_short_side_is_two_measures() -> None:
    sides = (Measure.LONG_SIDE, Measure.SHORT_SIDE)
    for question in ("How big is the flange, long way and short way?", "Spacer size? Long side, short side"):
        assert sides in {form.measures for form in forms(question) if isinstance(form, Get)}
    three = forms("What is the size of the flange: long way, short way, thickness?")
    assert sides not in {form.measures for form in three if isinstance(form, Get)}


def test_one_direction_alone_is_one_spacing() -> None:
    for question in ("How far apart are the studs along the slot?", "Spacing of the long studs along x?"):
        assert not [form for form in forms(question) if isinstance(form, Several)]


def test_a_word_that_commands_is_part_of_a_name_behind_a_number() -> None:
    query = next(queries(forms("How deep are the four return pins?")[0]))
    assert (query.count, query.plural) == (4, True)


@pytest.mark.parametrize(
    ("question", "axis"),
    [
        ("What is the horizontal distance between the lug and the pin?", HORIZONTAL),
        ("What is the height offset between the two spigots?", 2),
    ],
)
def test_a_distance_is_horizontal_or_one_of_heights(question: str, axis: int) -> None:
    assert any(isinstance(form, Distance) and form.axis == axis for form in forms(question))


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("Where is the middle of the sleeve's lower rim?", Measure.BOTTOM_END),
        ("Where's the middle of the left end face of the spindle?", Measure.LEFT_END),
        ("Give the centre of the outer edge of the spigot.", Measure.TIP),
    ],
)
def test_the_middle_of_a_rim_is_where_the_part_ends(question: str, measure: Measure) -> None:
    assert targets(question, measure)


def test_the_coordinates_of_the_middle_of_a_mouth_are_those_of_the_mouth() -> None:
    assert targets("What is the position of the middle of the mouth of the notch?", Measure.OPENING)
    assert [one.noun for one in targets("Where is the centre of the notch's opening?", Measure.OPENING)] == ["notch"]
    assert not targets("Where is the centre of the notch?", Measure.OPENING)


def test_what_a_viewer_sees_of_an_opening_is_its_mouth() -> None:
    assert targets("Where is the centre of the largest opening seen from the left?", Measure.OPENING)
    assert not targets("Where is the centre of the hole seen from the left?", Measure.OPENING)


def test_a_mouth_and_its_coordinates_are_one_point() -> None:
    asked = [form for form in forms("Where is the notch's mouth, as coordinates?") if isinstance(form, Get)]
    assert asked
    assert all(len(form.measures) == 1 for form in asked)


@pytest.mark.parametrize(
    ("place", "floor"),
    [("the notch's bottom", True), ("the bottom of the notch", True), ("the notch on the bottom", False)],
)
def test_the_middle_of_a_bottom_is_that_of_the_floor(place: str, floor: bool) -> None:
    assert bool(targets(f"Where is the centre of {place}?", Measure.FLOOR_CENTER)) is floor


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("How thick is the smallest-diameter disc?", Measure.DIAMETER),
        ("Depth of the smallest diameter bore?", Measure.DIAMETER),
    ],
)
def test_a_part_is_ranked_by_a_measure_before_its_noun(question: str, measure: Measure) -> None:
    ranks = [rank for form in forms(question) if isinstance(form, Get) and form.target for rank in form.target.ranks]
    assert any(rank.measure is measure for rank in ranks)


def test_the_upper_two_are_ranked_by_where_they_are() -> None:
    ends = [form.first for form in forms("How far apart are the upper two studs?") if isinstance(form, Distance)]
    ranks = [rank for end in ends if isinstance(end, PartQuery) for rank in end.ranks]
    assert any(rank.side is Side.TOP and rank.count == 2 for rank in ranks)


@pytest.mark.parametrize(
    "question", ["What is the point angle of the bore?", "Included angle at the bottom of the hole?"]
)
def test_the_point_angle_of_a_hole_is_that_of_its_conical_bottom(question: str) -> None:
    assert any(target.noun == "conical bottom" for target in targets(question, Measure.INCLUDED_ANGLE))


def test_the_included_angle_of_a_vee_is_that_of_its_flanks() -> None:
    found = [target.noun for target in targets("Which included angle does the vee have?", Measure.INCLUDED_ANGLE)]
    assert "vee" in found
    assert "conical bottom" not in found


@pytest.mark.parametrize(
    ("question", "measure", "cut"),
    [
        ("The bore is counterbored. How deep?", Measure.DEPTH, "counterbore"),
        ("The two holes have been countersunk on top. What diameter?", Measure.DIAMETER, "countersink"),
    ],
)
def test_what_a_statement_says_was_cut_is_asked_for(question: str, measure: Measure, cut: str) -> None:
    assert any(target.noun == cut and places_of(target) for target in targets(question, measure))


def test_a_flat_back_is_the_back_of_its_part() -> None:
    found = [form for form in forms("How far is the stud from the lid's flat back?") if isinstance(form, Distance)]
    assert any(isinstance(form.second, Plane) and form.second.side is Side.BACK for form in found)


def test_extents_along_axes_may_each_be_named() -> None:
    found = [form.measures for form in forms("Length along y, height along z?") if isinstance(form, Get)]
    assert (Measure.Y_EXTENT, Measure.Z_EXTENT) in found


def test_show_me_asks_for_no_height() -> None:
    assert not targets("Show me how far apart the two studs are.", Measure.HEIGHT)


def test_a_size_across_corners_is_no_size_across_flats() -> None:
    measures = [form.measures for form in forms("Hex size across corners?") if isinstance(form, Get)]
    assert measures[0] == (Measure.ACROSS_CORNERS,)


@pytest.mark.parametrize(
    "question",
    [
        "How much land is left between the keyway and the slot?",
        "What web is left between the floor of the counterbore and the slot?",
    ],
)
def test_what_is_left_between_two_cuts_is_a_distance_of_their_surfaces(question: str) -> None:
    found = [form for form in forms(question) if isinstance(form, Distance) and form.mode == "surfaces"]
    assert any(isinstance(form.second, PartQuery) for form in found)
