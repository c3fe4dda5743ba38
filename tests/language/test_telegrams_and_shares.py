"""Restrictions behind a comma, ranges, what is left out, both ends, shares, the model against its box, its mass."""

from __future__ import annotations

import pytest

from querycad_answering.drawing.meaning import describe
from querycad_contracts import Measure, PartQuery, Relation, Side
from querycad_language.forms import (
    AtBothEnds,
    Check,
    Combine,
    Count,
    Distance,
    Every,
    Form,
    Get,
    MassCentre,
    Origin,
    Towards,
    queries,
)  # fmt: skip
from querycad_language.phrases import noun_phrase
from querycad_language.readings.question import Question
from querycad_language.readings.reader import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def counted(question: str) -> PartQuery:
    return next(form.target for form in forms(question) if isinstance(form, Count))


@pytest.mark.parametrize(
    ("question", "measure", "relation", "low"),
    [
        ("Quantity of all keyways, depth > 7 mm", Measure.DEPTH, Relation.MORE, 0.007),
        ("How many lugs are there where the width is under 9 mm?", Measure.WIDTH, Relation.LESS, 0.009),
        ("How many of the slots go deeper than 7 mm?", Measure.DEPTH, Relation.MORE, 0.007),
        ("number of slots, width = 0.7 cm", Measure.WIDTH, Relation.EQUAL, 0.007),
    ],
)
def test_a_size_restricts_wherever_it_stands(question: str, measure: Measure, relation: Relation, low: float) -> None:
    (size,) = counted(question).sizes
    assert (size.measure, size.relation, size.low) == (measure, relation, low)


def test_a_size_behind_a_comma_without_a_relation_is_asked_of_another_part() -> None:
    assert not counted("How many slots, 5 mm lugs and ribs are there?").sizes


@pytest.mark.parametrize(
    "phrase", ["lugs from 4 mm up to and including 8 mm", "lugs of 4 mm through 8 mm", "lugs between 4 and 8 mm"]
)
def test_a_range_has_two_ends(phrase: str) -> None:
    (size,) = noun_phrase(phrase).sizes
    assert (size.relation, size.low, size.high) == (Relation.BETWEEN, 0.004, 0.008)


def test_both_ends_of_a_range_may_be_said_apart() -> None:
    sizes = counted("Count lugs that are at least 4 but at most 8 mm wide, nothing else.").sizes
    assert [(one.measure, one.relation, one.low) for one in sizes] == [
        (Measure.WIDTH, Relation.AT_LEAST, 0.004),
        (Measure.WIDTH, Relation.AT_MOST, 0.008),
    ]


@pytest.mark.parametrize(
    "question",
    ["Count the plain lugs, no chamfer no thread.", "Number of lugs, neither chamfered nor threaded"],
)
def test_what_parts_lack_may_stand_behind_a_comma(question: str) -> None:
    assert len(counted(question).lacking) == 2


@pytest.mark.parametrize(
    "question",
    [
        "Tell me the number of lugs that are smaller than the largest",
        "Leave out the largest lugs; what number of others is there?",
        "Besides the largest lug, how many lugs has it?",
        "How many lugs are there (the long ones, not the largest lugs)?",
    ],
)
def test_the_largest_may_be_left_out(question: str) -> None:
    excluded = [query for form in forms(question) if isinstance(form, Count) for query in form.target.excluded]
    assert any(query.ranks for query in excluded)


def test_the_larger_of_two_is_one_of_them() -> None:
    larger, largest = noun_phrase("the larger of the two lugs"), noun_phrase("the largest of the lugs")
    assert (larger.noun, larger.plural, largest.noun, largest.plural) == ("lug", False, "lug", False)
    assert larger.adjectives
    assert largest.ranks


def test_both_of_them_or_both_ends() -> None:
    (both,) = [form for form in forms("Does each lug have a slot?") if isinstance(form, Check)]
    assert isinstance(both.left, Count)
    assert both.relation is Relation.AT_LEAST
    assert isinstance(both.low, Count)
    assert both.low.target.noun == "lug"
    assert any(isinstance(form, AtBothEnds) for form in forms("Are there chamfers at both ends?"))
    assert not any(isinstance(form, AtBothEnds) for form in forms("Does the bore go through both sides?"))
    assert not any(isinstance(form, AtBothEnds) for form in forms("Are there chamfers at the end?"))


@pytest.mark.parametrize("question", ["Confirm that the lug is 8 mm wide.", "Confirm: the lug is 8 mm wide."])
def test_to_confirm_is_to_say_yes_or_no(question: str) -> None:
    assert Question(question).closed
    assert any(isinstance(form, Check) for form in forms(question))
    assert not Question("In order to confirm that it fits, tell me the width of the lug.").closed


def test_centred_along_a_side_is_no_distance_from_the_middle_there() -> None:
    (check,) = [form for form in forms("Is the lug centred across the width?") if isinstance(form, Check)]
    assert isinstance(check.left, Distance)
    assert check.left.axis is not None
    assert check.low == 0.0
    assert any(isinstance(form, Every) for form in forms("Is the lug central?"))


@pytest.mark.parametrize(
    "question",
    [
        "What is the depth to width ratio of the slot?",
        "Depth of the slot divided by its width?",
    ],
)
def test_a_ratio_may_be_named_behind_its_measures(question: str) -> None:
    ratio = next(form for form in forms(question) if isinstance(form, Combine))
    assert ratio.operation == "ratio"
    assert isinstance(ratio.left, Get)
    assert isinstance(ratio.right, Get)
    assert (*ratio.left.measures, *ratio.right.measures) == (Measure.DEPTH, Measure.WIDTH)


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("What share of the bounding box is taken up?", Measure.FILL),
        ("What volume gets milled away from a block of that size?", Measure.REMOVED),
        ("Corner to corner, how long is its bounding box?", Measure.DIAGONAL),
        ("x, y or z: which is its longest axis?", Measure.LONG_AXIS),
    ],
)
def test_the_model_is_compared_with_the_box_around_it(question: str, measure: Measure) -> None:
    assert any(form.measures == (measure,) for form in forms(question) if isinstance(form, Get))


def test_sides_without_such_parts() -> None:
    (towards,) = [form for form in forms("Which sides have no lugs?") if isinstance(form, Towards)]
    assert (towards.seen, len(towards.sides)) == ("none", len(Side))
    assert describe(towards).startswith("sides that none of the lugs")


def test_the_centre_of_mass_is_an_end_of_distances() -> None:
    middle, origin = (
        next(form for form in forms(f"How far is the centre of gravity from the {end}?") if isinstance(form, Distance))
        for end in ("middle of the bounding box", "origin")
    )
    assert (middle.first, middle.second) == (MassCentre(), None)
    assert (origin.first, origin.second) == (MassCentre(), Origin())


def test_what_was_cut_at_a_hole_has_a_measure_of_its_own() -> None:
    found = [
        form.target for form in forms("Diameter to which the lever's bores were countersunk?") if isinstance(form, Get)
    ]
    assert any(query is not None and query.noun == "countersink" for query in found)
    found = [form.target for form in forms("The bores are countersunk. How deep is the lug?") if isinstance(form, Get)]
    assert not any(query is not None and query.noun == "countersink" for query in found)


def test_both_diameters_are_the_inner_and_the_outer_one() -> None:
    both = (Measure.INNER_DIAMETER, Measure.OUTER_DIAMETER)
    assert any(f.measures == both for f in forms("The two diameters of the ring, inner and outer?") if type(f) is Get)
    assert not any(f.measures == both for f in forms("The inner diameters of the two rings?") if type(f) is Get)


def test_where_a_depth_begins_is_no_side_that_parts_are_seen_from() -> None:
    found = [form.target for form in forms("How deep is the slot, from the front face?") if isinstance(form, Get)]
    assert found[0] is not None
    assert not found[0].sides


def test_a_part_that_an_earlier_sentence_brings_up_is_known_by_that() -> None:
    readings = read("The lever has a slot. What is its width?")
    slot = next(r for r in readings if isinstance(r.form, Get) and r.form.target and r.form.target.noun == "slot")
    assert slot.features["introduced"] == 1.0
    other = next(r for r in readings if isinstance(r.form, Get) and r.form.target and r.form.target.noun == "lever")
    assert "introduced" not in other.features


def test_face_to_face_is_over_the_outsides_of_flanges_and_between_walls() -> None:
    over, between = (
        next(form for form in forms(f"What is the {words} the two flanges?") if isinstance(form, Distance))
        for words in ("face-to-face length over", "clear distance face to face between")
    )
    assert (over.mode, between.mode) == ("outsides", "surfaces")


def test_what_stands_in_brackets_asks_for_no_further_measure() -> None:
    found = forms("How thick is the lug (the flat of it, not counting the root radius)?")
    assert all(len(form.measures) == 1 for form in found if isinstance(form, Get))


def test_a_word_that_is_noun_and_adjective_is_a_noun_before_its_measure() -> None:
    assert any(
        form.measures == (Measure.OUTER_DIAMETER,) and form.target is not None and form.target.noun == "spotface"
        for form in forms("spotface outer diameter, please")
        if isinstance(form, Get)
    )
    assert noun_phrase("countersink lug").noun != "countersink"


def test_the_sides_of_a_size_are_what_is_asked_for() -> None:
    sides = (Measure.WIDTH, Measure.HEIGHT)
    found = forms("What is the size of the window, width first and then height?")
    assert any(form.measures == sides for form in found if isinstance(form, Get))
    assert not any(len(form.measures) > len(sides) for form in found if isinstance(form, Get))


def test_right_through_is_no_side() -> None:
    assert all(
        not query.ends and not query.sides
        for form in forms("Is the bore drilled right through to the other side?")
        for query in queries(form)
    )
