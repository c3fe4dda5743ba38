"""How far something stands out or is set back, and from which end; what is left; and 'one' for a noun."""

from __future__ import annotations

import pytest
from tests.made import body, part, whole

from querycad_answering.programs import write
from querycad_answering.programs.meanings import options
from querycad_contracts import Measure, Part, PartQuery, Side
from querycad_language.forms import SHORTER, Boundary, Check, Distance, Form, Get, Plane, Towards
from querycad_language.readings.frames.distances import overhangs
from querycad_language.readings.question import Question
from querycad_language.readings.reader import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def planes(question: str) -> list[tuple[Side | None, str, Side | None, str]]:
    """Sides and nouns of the distances between two outer planes."""
    found = [parse.form for parse in overhangs(Question(question)) if isinstance(parse.form, Distance)]
    return [
        (one.first.side, one.first.of.noun, one.second.side, one.second.of.noun)
        for one in found
        if isinstance(one.first, Plane) and isinstance(one.second, Plane)
    ]


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("How far below the top face of the hub do the lugs end?", (Side.TOP, "lug", Side.TOP, "hub")),
        ("How far behind the front face of the hub does the lug end?", (Side.FRONT, "lug", Side.FRONT, "hub")),
    ],
)
def test_what_is_set_back_is_measured_from_the_side_that_it_is_set_back_from(
    question: str, expected: tuple[Side, str, Side, str]
) -> None:
    assert expected in planes(question)


@pytest.mark.parametrize("end", ["tip", "free end"])
def test_a_distance_may_begin_at_an_end(end: str) -> None:
    found = [form for form in forms(f"How far is the lug from the {end} of the spindle?") if isinstance(form, Distance)]
    assert any(isinstance(end, Plane) and end.of.noun == "spindle" for f in found for end in (f.first, f.second))


def test_a_left_end_is_on_the_left() -> None:
    found = [
        form for form in forms("How far is the lug from the left end of the spindle?") if isinstance(form, Distance)
    ]
    assert any(isinstance(end, Plane) and end.side is Side.LEFT for form in found for end in (form.first, form.second))


@pytest.mark.parametrize(
    ("question", "nouns"),
    [
        ("What is the distance from the left lug to the right one?", {"left lug", "right lug"}),
        ("How far is it from the largest lug to the smallest one?", {"lug"}),
    ],
)
def test_one_is_the_noun_that_was_told_apart_before(question: str, nouns: set[str]) -> None:
    found = [form for form in forms(question) if isinstance(form, Distance)]
    named = [
        {" ".join((*end.ends, end.noun)) for end in (form.first, form.second) if isinstance(end, PartQuery)}
        for form in found
    ]
    assert nouns in named


def test_feet_in_words_are_parts_and_in_digits_a_length() -> None:
    counted = [form.first for form in forms("How far apart are the two feet?") if isinstance(form, Distance)]
    assert any(isinstance(one, PartQuery) and (one.noun, one.count, one.sizes) == ("foot", 2, ()) for one in counted)
    told = [form.target for form in forms("How deep is the 2 feet slot?") if isinstance(form, Get)]
    assert any(target and target.sizes and target.sizes[0].low == pytest.approx(0.6096) for target in told)


@pytest.mark.parametrize(
    ("question", "draft"),
    [
        ("What is the angle of the cone?", False),
        ("What is the angle of the cone to the axis?", True),
        ("What angle does the cone make with the centre line?", True),
        ("What is the angle of the slot per side?", True),
    ],
)
def test_an_angle_to_the_axis_is_a_draft(question: str, draft: bool) -> None:
    asked = [form.measures for form in forms(question) if isinstance(form, Get)]
    assert ((Measure.DRAFT,) in asked) is draft


@pytest.mark.parametrize(("place", "whole"), [("pockets", False), ("ribs", True)])
def test_what_is_left_below_a_cut_is_not_the_whole_thickness(place: str, whole: bool) -> None:
    found = [form for form in forms(f"How thick is the lever below the {place}?") if isinstance(form, Get)]
    thick = [form.target for form in found if form.measures == (Measure.THICKNESS,)]
    assert any(target is not None and target.noun == "lever" and target.places for target in thick) is whole
    assert any(form.measures == (Measure.BOTTOM_THICKNESS,) for form in found)


def written(form: Form, *grounds: tuple[PartQuery, Part]) -> str:
    return write(form, {query: ((one,), 0) for query, one in grounds}, whole(extents=(0.1, 0.1, 0.1))).code


SCREW, NUT = PartQuery(noun="screw"), PartQuery(noun="nut")


@pytest.mark.parametrize(("nut_z", "up"), [(0.009, True), (-0.009, False)])
def test_of_two_ways_out_a_part_stands_out_by_the_shorter(nut_z: float, up: bool) -> None:
    """A screw beyond its nut by its end, and not by its head."""
    screw = body(1, "screw", extents=(0.01, 0.01, 0.04))
    nut = body(2, "nut", (0.0, 0.0, nut_z), extents=(0.016, 0.016, 0.008))
    code = written(Distance(Plane(None, SCREW), Plane(None, NUT)), (SCREW, screw), (NUT, nut))
    assert ("max(" in code, "min(" in code) == (up, not up)


def test_what_lies_within_the_other_along_its_length_stands_out_where_it_does() -> None:
    """A logo beyond its board by the face that it is raised from, and not by its ends."""
    logo = body(1, "logo", (0.0, 0.0, 0.0052), extents=(0.02, 0.01, 0.0004))
    board = body(2, "board", extents=(0.1, 0.06, 0.01))
    code = written(Distance(Plane(None, SCREW), Plane(None, NUT)), (SCREW, logo), (NUT, board))
    assert "center[2]" in code
    assert "center[0]" not in code


def test_from_a_plate_a_part_stands_out_along_the_thickness_of_the_plate() -> None:
    """A shelf on its back plate, though it is longest along the plate."""
    shelf = body(1, "shelf", (0.0, 0.03, 0.0), extents=(0.12, 0.05, 0.008))
    plate = part("wall-1", extents=(0.1, 0.01, 0.06))
    form = Distance(Plane(None, SCREW), Plane(None, NUT))
    grounds = {SCREW: ((shelf,), 0), NUT: ((plate,), 0)}
    codes = [write(form, grounds, whole(extents=(0.1, 0.1, 0.1)), option).code for option in (0, 1)]
    assert ["center[1]" in code for code in codes] == [False, True]


@pytest.mark.parametrize(
    ("question", "side"),
    [("the lug farthest to the right", Side.RIGHT), ("the lug farthest from the right side", Side.LEFT)],
)
def test_what_is_farthest_to_a_side_is_not_what_is_farthest_from_it(question: str, side: Side) -> None:
    found = [form.target for form in forms(f"How deep is {question}?") if isinstance(form, Get)]
    assert [rank.side for rank in (found[0].ranks if found[0] else ())] == [side]


@pytest.mark.parametrize(
    ("question", "told"),
    [("Is the lug on the left or on the right?", True), ("Is the lug thicker at the left or at the right?", False)],
)
def test_a_side_is_not_told_where_a_comparison_is_asked_for(question: str, told: bool) -> None:
    assert any(isinstance(form, Towards) for form in forms(question)) is told


@pytest.mark.parametrize(
    ("question", "checks"),
    [
        ("Do the pins stick out beyond the lever?", True),
        ("Does the hub project past the lug?", True),
        ("How far do the pins stick out beyond the lever?", False),
        ("Does the bore come out at the lug?", False),
    ],
)
def test_whether_something_stands_out_is_a_yes_or_no(question: str, checks: bool) -> None:
    found = [form.left for form in forms(question) if isinstance(form, Check)]
    assert any(isinstance(left, Distance) and left.mode == "beyond" for left in found) is checks


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("How many degrees does the lug lean from the vertical?", Measure.DRAFT),
        ("What angle does the bore have to the z axis?", Measure.DRAFT),
        ("By how many degrees is the bore tilted above the horizontal?", Measure.INCLINATION),
    ],
)
def test_an_angle_is_measured_from_what_is_named(question: str, measure: Measure) -> None:
    first = next(form for form in forms(question) if isinstance(form, Get))
    assert first.measures == (measure,)


def test_daylight_is_a_gap() -> None:
    gaps = [
        form for form in forms("How much daylight is there between the lug and the hub?") if isinstance(form, Distance)
    ]
    assert gaps[0].mode in ("surfaces", "usual")


def measures(question: str) -> list[Measure]:
    """The single measures that its readings ask for."""
    return [form.measures[0] for form in forms(question) if isinstance(form, Get) and len(form.measures) == 1]


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("Included angle of the lug's taper?", Measure.INCLUDED_ANGLE),
        ("How wide is the lug across the corners?", Measure.ACROSS_CORNERS),
        ("Width of the lug over two opposite flats?", Measure.ACROSS_FLATS),
        ("How thick is the spindle, face to face?", Measure.AXIAL_EXTENT),
        ("How long is the slot, centre to centre?", Measure.CENTRE_LENGTH),
        ("The lug goes in how far?", Measure.DEPTH),
        ("What is the dedendum circle diameter?", Measure.ROOT_DIAMETER),
        ("What is the centreline radius of the tube?", Measure.CENTRELINE_RADIUS),
        ("What does the lever measure across?", Measure.DIAMETER),
        ("How big is the lug across?", Measure.DIAMETER),
    ],
)
def test_what_a_length_or_an_angle_is_taken_across_names_its_measure(question: str, measure: Measure) -> None:
    assert measure in measures(question)


@pytest.mark.parametrize(
    "question",
    [
        "How wide is the groove between the lug and the rear diameter?",
        "How deep is the lug, under the full width of the lever?",
        "How thick is the lever, across the long side of the lug?",
    ],
)
def test_a_measure_that_only_says_where_is_not_asked_for_as_well(question: str) -> None:
    assert not [form for form in forms(question) if isinstance(form, Get) and len(form.measures) > 1]


def test_two_measures_that_are_both_asked_for_stand_together() -> None:
    found = [form.measures for form in forms("How wide is the lug, and how deep is it?") if isinstance(form, Get)]
    assert (Measure.WIDTH, Measure.DEPTH) in found


def test_the_floor_of_a_cut_is_its_bottom_plane() -> None:
    found = [form for form in forms("How far is the spindle from the floor of the slot?") if isinstance(form, Distance)]
    planes = [end for form in found for end in (form.first, form.second) if isinstance(end, Plane)]
    assert (Side.BOTTOM, "slot") in [(plane.side, plane.of.noun) for plane in planes]


def test_how_deep_below_and_how_high_above_are_distances_of_no_two_alike() -> None:
    for question in ("How deep below the rim do the two lugs lie?", "How high above the base are the two lugs?"):
        named = [one.form for one in read(question) if "distance" in one.features and isinstance(one.form, Distance)]
        assert named
        assert all(form.second != "each other" for form in named)


def test_the_width_across_is_the_shorter_side() -> None:
    across = forms("What is the spacing of the lugs across the width of the lever?")
    assert any(isinstance(form, Distance) and form.axis == SHORTER for form in across)


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("How wide is the dovetail groove at its mouth?", Measure.MOUTH_WIDTH),
        ("What width does the keyway have at the bottom?", Measure.BOTTOM_WIDTH),
        ("How large is the radius on the outside of the bends?", Measure.OUTER_RADIUS),
    ],
)
def test_a_measure_at_the_mouth_or_outside_is_one_of_its_own(question: str, measure: Measure) -> None:
    assert any(isinstance(form, Get) and form.measures == (measure,) for form in forms(question))


def test_a_root_circle_is_that_of_the_gear_and_a_curved_slots_radius_that_of_its_middle_line() -> None:
    gear = part("gear-1", radii=(0.04, 0.035), radius=0.04, diameter=0.08)
    assert options(Measure.ROOT_DIAMETER, gear)[0] == ("2 * min({0}.radii)", "own")
    slot = part("cutout-1", center_length=0.07, angle=1.0)
    assert options(Measure.CENTRELINE_RADIUS, slot)[0][0] == "{0}.center_length / {0}.angle"


@pytest.mark.parametrize(
    ("question", "adjective"),
    [("How wide are the keyways on the outside?", "outer"), ("Slots in the inside: depth?", "inner")],
)
def test_what_is_on_the_outside_is_outer(question: str, adjective: str) -> None:
    targets = [form.target for form in forms(question) if isinstance(form, Get) and form.target is not None]
    assert any(adjective in target.adjectives for target in targets)


def test_where_an_axis_pierces_a_face_is_an_opening() -> None:
    found = forms("Where does the axis of the bore pierce the top face?")
    assert any(isinstance(form, Get) and form.measures == (Measure.OPENING,) for form in found)


def test_what_stands_out_of_a_face_does_so_of_what_has_it() -> None:
    def beyond(question: str) -> set[tuple[str, str]]:
        found = [form for form in forms(question) if isinstance(form, Distance)]
        ends = [(form.first, form.second) for form in found]
        return {(a.of.noun, b.of.noun) for a, b in ends if isinstance(a, Plane) and isinstance(b, Plane)}

    assert ("lug", "web") in beyond("How far does the end face of the lug stand above the adjacent face of the web?")
    assert ("lug", "pad") in beyond("How far does the lug stick out past the pad's surface?")
    assert ("lug", "web") not in beyond("How far does the lug stick out beyond the inner face of the web?")
    assert ("lug", "floor") in beyond("How far does the lug stick out beyond the floor of the pocket?")


@pytest.mark.parametrize(
    ("question", "form"),
    [
        (
            "What is the radius on the inside of the bend?",
            Get((Measure.INNER_RADIUS,), PartQuery(noun="bend", words=("bend",), definite=True)),
        ),
        (
            "How far below the rim does the lug stand?",
            Distance(Plane(Side.TOP, PartQuery(noun="lug", words=("lug",), definite=True)), Boundary(Side.TOP)),
        ),
    ],
)
def test_the_inside_of_a_bend_and_the_rim_of_the_whole_are_meant_by_themselves(question: str, form: Form) -> None:
    assert form in forms(question)


def test_a_diagonal_between_parts_is_their_distance() -> None:
    found = [one for one in forms("What is the diagonal between two opposite lugs?") if isinstance(one, Distance)]
    assert any(one.mode == "centers" and one.second == "each other" for one in found)
    assert not any(isinstance(one, Distance) for one in forms("What is the diagonal of the lug?"))
