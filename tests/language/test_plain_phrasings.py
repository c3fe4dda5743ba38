"""Plain phrasings: the side, end, section or circle that a measure is of, extents with their ends, per part."""

from __future__ import annotations

from typing import Any

import pytest
from tests.made import part

from querycad_answering.programs.meanings import options
from querycad_contracts import Measure, PartQuery, Side
from querycad_language.forms import LONGEST, SHORTER, Boundary, Combine, Count, Distance, Get, Plane
from querycad_language.readings import Reading, read
from querycad_language.tokens import tokenize


def gets(question: str) -> list[tuple[Measure, PartQuery | None]]:
    """The measures that are read, each with whose it is."""
    forms = (reading.form for reading in read(question))
    return [(form.measures[0], form.target) for form in forms if isinstance(form, Get) and len(form.measures) == 1]


def of(question: str, measure: Measure) -> list[str]:
    """What that measure is asked of: its noun, then the nouns of its places."""
    targets = [target for asked, target in gets(question) if asked is measure]
    return [" of ".join((t.noun, *(p.what.noun for p in t.places if p.what))) if t else "" for t in targets]


def skipped(reading: Reading) -> list[str]:
    return [word for _, word in reading.skipped]


@pytest.mark.parametrize(
    ("question", "measure", "expected"),
    [
        ("What is the inner length of the tank?", Measure.LENGTH, "inside of tank"),
        ("internal height?", Measure.HEIGHT, "inside"),
        ("Which inner width has the keyway?", Measure.WIDTH, "keyway"),
        ("What is the outside width of the tank?", Measure.WIDTH, "tank"),
        ("What is the outer width of the channel?", Measure.WIDTH, ""),
    ],
)
def test_what_is_hollow_has_its_extents_twice(question: str, measure: Measure, expected: str) -> None:
    assert expected in of(question, measure)


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("How long is the middle section of the spindle?", ("middle",)),
    ],
)
def test_a_section_is_told_by_its_diameter_or_by_where_it_is(question: str, expected: tuple[str, ...]) -> None:
    assert any(target is not None and target.adjectives == expected for _, target in gets(question))


@pytest.mark.parametrize(
    ("question", "measure", "expected"),
    [
        ("What is the top diameter of the spigot?", Measure.DIAMETER, "face of spigot"),
        ("What is the radius at the bottom of the spigot?", Measure.RADIUS, "face of spigot"),
        ("What diameter is left at the bottom of the ring groove?", Measure.DIAMETER, "ring groove"),
        ("What is the inner diameter of the lever?", Measure.DIAMETER, "bore of lever"),
        ("outer radius?", Measure.RADIUS, "outer cylinder"),
        ("What is the outer bend radius?", Measure.OUTER_RADIUS, "bend"),
        ("What is the wall thickness of the tank?", Measure.THICKNESS, "wall"),
        ("On which diameter are the studs?", Measure.DIAMETER, "bolt circle of stud"),
        ("Which diameter has the circle on which the studs stand?", Measure.DIAMETER, "bolt circle of stud"),
    ],
)
def test_a_measure_is_of_the_end_the_side_or_the_circle_that_is_told(
    question: str, measure: Measure, expected: str
) -> None:
    assert expected in of(question, measure)


def test_edges_that_are_rounded_are_corners() -> None:
    rounded = [t for m, t in gets("Which radius do the upright edges of the lever have?") if m is Measure.RADIUS and t]
    assert any((t.noun, t.adjectives) == ("corner", ("upright",)) for t in rounded)
    assert not any(t.noun == "corner" for _, t in gets("How far is the lug from the upper edge?") if t)


def test_from_end_to_end_is_no_part_of_a_name() -> None:
    best = min(read("How long is the spindle end to end?"), key=lambda reading: len(reading.skipped))
    assert isinstance(best.form, Get)
    assert best.form.target is not None
    assert (best.form.target.noun, best.form.overall, skipped(best)) == ("spindle", True, [])


@pytest.mark.parametrize(
    ("question", "first", "second"),
    [
        ("Which wall remains between the keyway and the nearest edge?", "keyway", Boundary(None)),
        ("What is the distance of the lugs from the front edge?", "lug", Boundary(Side.FRONT)),
        ("How far are the lugs from the lever?", "lug", "lever"),
        ("How long is the link from the pin to the lug?", "pin", "lug"),
    ],
)
def test_a_distance_leads_away_from_what_is_named(question: str, first: str, second: Any) -> None:
    found = [r.form for r in read(question) if isinstance(r.form, Distance) and isinstance(r.form.first, PartQuery)]
    ends = [(form.first.noun, getattr(form.second, "noun", form.second)) for form in found if not form.first.sides]  # type: ignore[union-attr]
    assert (first, second) in ends


def test_a_vertical_distance_is_taken_along_z() -> None:
    forms = [r.form for r in read("What is the vertical distance between the lug and the bore?")]
    assert any(isinstance(form, Distance) and form.axis == 2 for form in forms)
    lying = [r.form for r in read("Which spacing have the vertical drill holes?")]
    assert not any(isinstance(form, Distance) and form.axis == 2 for form in lying)


def test_so_many_in_each_is_a_share() -> None:
    forms = [reading.form for reading in read("How many lugs are on each lever?")]
    assert any(isinstance(form, Combine) and form.operation == "per" for form in forms)
    assert not any(isinstance(form, Count) and form.target.places for form in forms)


def test_names_in_the_plural_are_no_measures() -> None:
    assert "cog" in {t.noun for _, t in gets("What is the height of the cogs?") if t}


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("ext. dia. of the lug", ["external", "diameter", "of", "the", "lug"]),
        ("Ext dia?", ["external", "diameter", "?"]),
        ("The wall thk. Is it 3?", ["the", "wall", "thickness", ".", "is", "it", "3", "?"]),
    ],
)
def test_abbreviations_of_drawings_end_no_sentence(question: str, expected: list[str]) -> None:
    assert [token.word for token in tokenize(question)] == expected


def test_a_gears_module_and_pitch_circle_come_from_its_teeth() -> None:
    gear = part("gear-1", radii=(0.039, 0.03225), count=24)
    assert options(Measure.MODULE, gear)[0][0] == "(max({0}.radii) - min({0}.radii)) / 2.25"
    assert options(Measure.PITCH_DIAMETER, gear)[0][1] == "own"


def test_a_length_from_end_to_end_is_no_distance() -> None:
    assert not any(isinstance(r.form, Distance) for r in read("The slots: overall length end to end?"))


@pytest.mark.parametrize(
    ("question", "measure", "expected"),
    [
        ("How wide is the idler?", Measure.AXIAL_EXTENT, "idler"),
        ("Face width of the sprocket?", Measure.AXIAL_EXTENT, "sprocket"),
        ("What is the thickness of the wall of the spigot?", Measure.WALL_THICKNESS, "spigot"),
        ("R at the top of the lugs", Measure.RADIUS, "rounded end of lug"),
        ("What is the inside diameter of the tank?", Measure.DIAMETER, "inner cylinder of tank"),
        ("Clearance diameter of the dowel holes?", Measure.DIAMETER, "dowel hole"),
        ("Total keyway depth?", Measure.DEPTH, "keyway"),
    ],
)
def test_a_measure_of_a_part_that_is_told_by_another(question: str, measure: Measure, expected: str) -> None:
    assert expected in of(question, measure)


def test_a_plate_is_no_wider_along_its_axis() -> None:
    assert all(measure is not Measure.AXIAL_EXTENT for measure, _ in gets("How wide is the lug?"))


def distances_of(question: str) -> list[Distance]:
    return [reading.form for reading in read(question) if isinstance(reading.form, Distance)]


@pytest.mark.parametrize(
    ("question", "axis"),
    [
        ("What is the hole spacing along the bracket?", LONGEST),
        ("What is the hole spacing across the lever?", SHORTER),
        ("What is the hole spacing along the rib?", None),
    ],
)
def test_along_a_product_is_along_its_longest_side(question: str, axis: int | None) -> None:
    assert distances_of(question)[0].axis == axis


def test_the_clearance_under_a_part_reaches_down_to_the_ground() -> None:
    form = distances_of("What is the clearance under the handle?")
    assert any(isinstance(one.first, Plane) and one.second == Boundary(Side.BOTTOM) for one in form)


def test_what_is_on_a_side_is_told_by_the_word_before_the_noun_alone() -> None:
    (target, *_) = (t for _, t in gets("How wide are the side slots?") if t)
    assert target.adjectives == ("side",)
    assert not any(t.adjectives for _, t in gets("How wide are the slots on each side?") if t)
