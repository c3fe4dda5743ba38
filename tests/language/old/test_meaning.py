"""From words to meaning, apart from the Python that is written for it."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from querycad_contracts import Side
from querycad_language.old import parse, understand
from querycad_language.old.meaning import (
    Aligned,
    Bound,
    Boundary,
    ByDistance,
    ByMeasure,
    Calculate,
    Centered,
    Compare,
    Count,
    Distance,
    Every,
    Exists,
    Get,
    Measure,
    NounClass,
    Operation,
    Origin,
    Parts,
    Phrase,
    Placed,
    Query,
    Rank,
    Reduce,
    Relation,
    Seen,
    Selection,
    Uniform,
    Whole,
    descriptions,
)

HOLE = Phrase("hole", NounClass.HOLE)
HOLES = Phrase("hole", NounClass.HOLE, plural=True)
SHAFT = Selection((Phrase("shaft", NounClass.AXIAL),))
TOP = (Side.TOP,)


def meaning(question: str) -> Query:
    return understand(question)[0]


def holes(*filters: object, sides: tuple[Side, ...] = (), ranks: tuple[Rank, ...] = ()) -> Selection:
    return Selection((Phrase("hole", NounClass.HOLE, True, sides, filters, ranks),))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("How many holes are on the top?", Count(holes(sides=TOP))),
        ("How many different radii do the holes have?", Count(Selection((HOLES,)), Measure.RADIUS)),
        ("Is there a shaft?", Exists(SHAFT)),
        ("What is the diameter of the shaft?", Get((Measure.DIAMETER,), SHAFT)),
        ("How high is the object?", Get((Measure.HEIGHT,), Whole())),
        ("What is the total depth of the holes?", Get((Measure.DEPTH,), Selection((HOLES,)), Reduce.TOTAL)),
        ("What is the second smallest hole depth?", Get((Measure.DEPTH,), Selection((HOLE,)), Reduce.SMALLEST, 2)),
        ("Do all holes have the same depth?", Uniform(Measure.DEPTH, Selection((HOLES,)))),
        ("Are all holes visible from the top?", Every(Selection((HOLES,)), (Seen(Side.TOP, True),))),
        ("Which holes are on the top?", Parts(holes(sides=TOP))),
        (
            "How high is the object without the shaft?",
            Calculate(Operation.MINUS, Get((Measure.HEIGHT,), Whole()), Get((Measure.HEIGHT,), SHAFT)),
        ),
        (
            "Is the shaft thicker than 10 mm?",
            Compare(Get((Measure.DIAMETER,), SHAFT), Relation.MORE, 0.01),
        ),
        (
            "Is the shaft parallel to the rib?",
            Aligned(SHAFT, Selection((Phrase("rib", NounClass.OTHER),)), 0.0),
        ),
    ],
)
def test_a_question_has_its_meaning(question: str, expected: Query) -> None:
    assert meaning(question) == expected


@pytest.mark.parametrize(
    ("clause", "condition"),
    [
        ("with a radius of 2 mm", Bound(Measure.RADIUS, Relation.EQUAL, 0.002)),
        ("with a radius of at least 2 mm", Bound(Measure.RADIUS, Relation.AT_LEAST, 0.002)),
        ("with a radius of 2 mm or more", Bound(Measure.RADIUS, Relation.AT_LEAST, 0.002)),
        ("with a radius between 2 and 3 mm", Bound(Measure.RADIUS, Relation.BETWEEN, 0.002, 0.003)),
        ("of about 2 mm in diameter", Bound(Measure.DIAMETER, Relation.ABOUT, 0.002)),
        ("smaller than 2 mm", Bound(Measure.DIAMETER, Relation.LESS, 0.002)),
        ("that are not deeper than 2 mm", Bound(Measure.DEPTH, Relation.AT_MOST, 0.002)),
        ("which are 2 mm deep", Bound(Measure.DEPTH, Relation.EQUAL, 0.002)),
        ("deeper than the shaft", Bound(Measure.DEPTH, Relation.MORE, Get((Measure.DEPTH,), SHAFT))),
        (
            "with the same diameter as the shaft",
            Bound(Measure.DIAMETER, Relation.EQUAL, Get((Measure.DIAMETER,), SHAFT)),
        ),
        ("above the middle", Placed(2, Relation.MORE, Whole())),
        ("whose centre is left of the centre of the object", Placed(0, Relation.LESS, Whole())),
        ("below the shaft", Placed(2, Relation.LESS, SHAFT)),
        ("in the right half", Placed(0, Relation.MORE, Whole())),
        ("centred in x and z direction", Centered((0, 2))),
        ("in the middle of the object", Centered()),
        ("not visible from the top", Seen(Side.TOP, False)),
    ],
)
def test_a_clause_is_a_filter(clause: str, condition: object) -> None:
    found = meaning(f"How many holes {clause} are there?")
    assert isinstance(found, Count)
    assert found.target == holes(condition)


@pytest.mark.parametrize(
    ("phrase", "rank"),
    [
        ("the largest hole", Rank(ByMeasure(Measure.OUTER_RADIUS), True)),
        ("the smallest hole", Rank(ByMeasure(Measure.INNER_RADIUS), False)),
        ("the second deepest hole", Rank(ByMeasure(Measure.DEPTH), True, 2)),
        ("the hole with the smallest depth", Rank(ByMeasure(Measure.DEPTH), False)),
        ("the hole closest to the shaft", Rank(ByDistance(SHAFT), False)),
        ("the hole farthest from the origin", Rank(ByDistance(Origin()), True)),
        ("the hole nearest to the edge", Rank(ByDistance(None), False)),
    ],
)
def test_a_superlative_is_a_rank(phrase: str, rank: Rank) -> None:
    found = meaning(f"How deep is {phrase}?")
    assert isinstance(found, Get)
    assert isinstance(found.target, Selection)
    assert found.target.phrases[0].ranks == (rank,)


@pytest.mark.parametrize(
    ("words", "sides"),
    [
        ("visible from the top", "top"), ("on the top surface", "top"), ("from above", "top"),
        ("on the upper side", "top"), ("in the top of the shape", "top"), ("at the bottom", "bottom"),
        ("on the underside", "bottom"), ("seen from below", "bottom"), ("visible from behind", "back"),
        ("on the rear", "back"), ("in the front view", "front"), ("on the left-hand side", "left"),
        ("shown from the right", "right"), ("seen when looking from the right", "right"),
        ("on the top or the bottom", "top bottom"), ("visible from the left and the right", "left right"),
        ("on the front, left or back side", "front left back"),
    ],
)  # fmt: skip
def test_sides_are_found_in_all_their_forms(words: str, sides: str) -> None:
    found = meaning(f"How many holes {words} are there?")
    assert isinstance(found, Count)
    phrase = replace(found.target.phrases[0], stands=False)
    assert Selection((phrase,)) == holes(sides=tuple(Side(side) for side in sides.split()))


def test_a_top_that_is_no_side_is_none() -> None:
    found = meaning("What is the tip of the shaft?")
    assert isinstance(found, Get)
    assert found.target == SHAFT
    assert meaning("How far is the shaft from the top of the object?") == Distance(SHAFT, Boundary(Side.TOP), True)


@pytest.mark.parametrize(
    ("question", "description"),
    [
        ("How many blind holes are there?", "blind hole"),
        ("How many holes with a ring are on the top?", "hole with ring"),
        ("How many holes without a thread are there?", "hole without thread"),
        ("How many of the holes are threaded?", "threaded hole"),
        ("What is the size of the octagonal base plate?", "octagonal base plate"),
        ("What is the diameter of the M5 hole?", "m5 hole"),
        ("What is the radius of the inner cylinder?", "inner cylinder"),
        ("How many parts are there?", "body"),
        ("Is the circular part on the bottom visible?", "circular part"),
        ("How many plates with a hole in the center are there?", "plate with hole in center"),
    ],
)
def test_what_is_said_of_kind_and_shape_stays_in_the_description(question: str, description: str) -> None:
    assert list(descriptions(meaning(question))) == [description]


def test_adjectives_may_share_their_noun() -> None:
    assert list(descriptions(meaning("How many blind and through holes are there?"))) == ["blind hole", "through hole"]


@pytest.mark.parametrize(
    ("question", "reading"),
    [
        ("How deep are the holes?", "own axis"),
        ("Where is the hole?", "centre"),
        ("How far is the shaft from the pocket?", "gap"),
        ("How far apart are the two holes?", "between their centres"),
        ("What is the radius of the largest hole?", "widest step"),
        ("How many holes have a diameter of 5?", "millimetres"),
        ("What is the spacing of the holes?", "smallest distance"),
        ("How many holes are in the flange?", "centre lies in"),
        ("How many holes are about 5 mm deep?", "10 percent"),
    ],
)
def test_a_reading_that_was_chosen_is_noted(question: str, reading: str) -> None:
    assert any(reading in note for note in parse(question).notes), parse(question).notes


def test_perpendicular_is_a_right_angle() -> None:
    found = meaning("Are the two shafts perpendicular?")
    assert isinstance(found, Aligned)
    assert math.isclose(found.angle, math.pi / 2)
