"""What restricts parts: directions, halves, sides that stand alone, exceptions, several lacks; and numbers of parts."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure, PartQuery, Side
from querycad_language.forms import LONGEST, Count, Distance, Every, Form, Get, Reduce, Towards, queries
from querycad_language.phrases import noun_phrase
from querycad_language.readings.reader import read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def counted(question: str) -> PartQuery:
    return next(form.target for form in forms(question) if isinstance(form, Count))


@pytest.mark.parametrize(
    "question",
    [
        "How many lugs run along Z?",
        "How many lugs have their axis parallel to the z axis?",
        "Number of lugs whose centre line is parallel to Z",
    ],
)
def test_a_direction_restricts_what_is_counted(question: str) -> None:
    assert counted(question).adjectives == ("z parallel",)


def test_a_direction_of_a_length_is_the_length_s() -> None:
    assert not counted("How many lugs are longer than 5 mm in z direction?").adjectives
    assert all(not query.adjectives for form in forms("How long is the lug along z?") for query in queries(form))


@pytest.mark.parametrize(
    "question",
    ["How many lugs are in the left half?", "left half only: lug count", "How many left half lugs are there?"],
)
def test_a_half_is_where_they_lie_and_no_side_that_they_are_seen_from(question: str) -> None:
    assert any("left half" in form.target.adjectives for form in forms(question) if isinstance(form, Count))
    assert all(not form.target.sides for form in forms(question) if isinstance(form, Count) and form.target.adjectives)


@pytest.mark.parametrize(
    "question", ["number of lugs, underside only", "bottom: how many lugs", "Count the -Z side lugs."]
)
def test_a_side_may_stand_alone(question: str) -> None:
    assert any(form.target.sides == (Side.BOTTOM,) for form in forms(question) if isinstance(form, Count))


def test_seen_from_none_of_the_sides() -> None:
    query = counted("How many holes are not drilled from the top or the bottom?")
    assert query.unseen == (Side.TOP, Side.BOTTOM)
    assert "horizontal" in counted("How many holes come in from the side?").adjectives


@pytest.mark.parametrize(
    "question",
    [
        "Forget the largest one, how many lugs remain?",
        "How many lugs are there, not counting the largest?",
        "Number of lugs minus the largest",
    ],
)
def test_what_is_left_out_is_an_exception(question: str) -> None:
    excluded = [form.target.excluded for form in forms(question) if isinstance(form, Count) and form.target.excluded]
    assert excluded
    assert all(one.ranks for one in excluded[0])


@pytest.mark.parametrize(
    "question",
    [
        "How many holes have neither a counterbore nor a thread?",
        "How many holes are without counterbore and without thread?",
    ],
)
def test_several_attributes_may_be_lacking(question: str) -> None:
    lacking = [form.target.lacking for form in forms(question) if isinstance(form, Count)]
    assert any(len(one) == 2 for one in lacking)


def test_all_are_as_the_second_phrase_says() -> None:
    every = next(form for form in forms("Are all holes 5 mm through holes?") if isinstance(form, Every))
    assert every.target.sizes == ()
    assert [size.low for size in every.among.sizes] == [0.005]


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("What percentage of the bounding box is material here?", Measure.FILL),
        ("What is the area on which it stands, the footprint?", Measure.STANDING_AREA),
    ],
)
def test_measures_of_the_whole(question: str, measure: Measure) -> None:
    assert any(
        isinstance(form, Get) and form.measures == (measure,) and form.target is None for form in forms(question)
    )


@pytest.mark.parametrize(
    "question", ["The lug - which side?", "Name the side carrying the lug.", "Tell me the side on which the lug is."]
)
def test_which_side_is_asked_in_many_forms(question: str) -> None:
    assert any(isinstance(form, Towards) and not form.seen for form in forms(question))


@pytest.mark.parametrize(
    "question", ["On which side of the plate is the lug?", "Which side of the rib does the lug sit on?"]
)
def test_the_side_of_one_part_is_where_the_other_is(question: str) -> None:
    assert {form.target.noun for form in forms(question) if isinstance(form, Towards)} == {"lug"}


def test_the_side_that_something_is_open_on_is_that_of_its_inside() -> None:
    asked = [form.target.noun for form in forms("On which side is the box open?") if isinstance(form, Towards)]
    assert "inside" in asked


@pytest.mark.parametrize("unit", ["mm", "inches", "cm", "centimetres", "square centimetres"])
def test_the_unit_that_is_asked_for_is_no_place(unit: str) -> None:
    found = [query for form in forms(f"What is the height of the lug in {unit}?") for query in queries(form)]
    assert all(not query.places and query.noun == "lug" for query in found)


def test_which_ones_is_no_question_of_its_own() -> None:
    plain = forms("Do any lugs share the same axis?")
    assert forms("Do any lugs share the same axis, and which ones?")[0] == plain[0]
    assert forms("Do any lugs share the same axis? Which?")[0] == plain[0]


def test_what_is_left_below_is_a_thickness() -> None:
    assert any(isinstance(form, Distance | Get) for form in forms("What is left below the slot?"))
    assert any(
        isinstance(form, Get) and Measure.BOTTOM_THICKNESS in form.measures
        for form in forms("What is left below the slot?")
    )


@pytest.mark.parametrize(
    "question",
    [
        "How many lugs are there, the big one included?",
        "How many lugs are there (the middle ones counted too)?",
        "lug count, counting the tapped ones",
    ],
)
def test_what_counts_as_well_restricts_nothing_and_is_not_passed_over(question: str) -> None:
    reading = next(reading for reading in read(question) if isinstance(reading.form, Count))
    assert isinstance(reading.form, Count)
    assert not reading.form.target.adjectives
    assert not reading.form.target.ranks
    assert {kind for kind, _ in reading.skipped} <= {"chatter"}


def test_what_is_included_owns_no_measure() -> None:
    asks = [form for form in forms("Overall thickness of it, including the rib?") if isinstance(form, Get)]
    assert asks
    assert all(form.target is None and form.overall for form in asks)
    behind = next(one for one in read("How long is this lever overall?") if isinstance(one.form, Get))
    assert "overall_part" in behind.features
    over_all = next(one for one in read("Length of the lever incl. the pin") if isinstance(one.form, Get))
    assert "overall_part" in over_all.features


def test_holes_opposite_each_other_are_the_two_furthest_apart() -> None:
    across = [form for form in forms("How far apart are two lugs opposite each other?") if isinstance(form, Distance)]
    assert any(form.second == "each other" and form.reduce is Reduce.LARGEST for form in across)


def test_an_adverb_alone_names_an_axis() -> None:
    found = forms("Lengthwise, how far apart are the lugs?")
    assert any(isinstance(form, Distance) and form.axis == LONGEST for form in found)


def test_what_is_not_counted_is_none_of_the_place_that_stands_before_it() -> None:
    found = counted("How many lugs are on the rib, not counting the tapped lug?")
    assert [query.noun for query in found.excluded] == ["lug"]
    assert not any(place.what and place.what.excluded for place in found.places)


def test_an_axis_leads_to_an_end_and_a_part_to_the_left_is_seen_there() -> None:
    ends = [form for form in forms("spindle axis to the top face of the lever") if isinstance(form, Distance)]
    assert ends
    assert not any(query.sides for form in ends for query in queries(form))
    places = [form for form in forms("Where is the centre of the lug to the left?") if isinstance(form, Get)]
    assert any(query.sides == (Side.LEFT,) for form in places for query in queries(form))


def test_what_is_not_counted_is_left_out_and_what_is_named_alone_is_asked_for() -> None:
    assert counted("How many lugs are there, not counting the tapped ones?").excluded
    assert any(query.noun == "lug" for form in forms("Is a lug included?") for query in queries(form))


def test_this_points_to_the_model_in_the_first_sentence_alone() -> None:
    first, later = "How many lugs has this lever?", "The lever has a rib. How thick is this rib?"
    assert any(query.deictic for query in _all(first))
    assert not any(query.deictic for query in _all(later))


def _all(question: str) -> list[PartQuery]:
    """The queries of all readings, with those inside."""
    found = [query for form in forms(question) for query in queries(form)]
    return [*found, *(place.what for query in found for place in query.places if place.what is not None)]


def test_around_the_edge_of_a_part_is_on_it_and_around_the_part_is_not() -> None:
    on, about = (noun_phrase(f"lugs around {what}").places for what in ("the edge of the hub", "the hub"))
    assert [place.relation for place in (*on, *about)] == ["of", "around"]


def test_the_part_that_is_so_is_one_of_several_and_the_part_is_the_whole() -> None:
    assert noun_phrase("the part that is 30 mm long").noun == "part"
    assert noun_phrase("the part").noun == "object"


@pytest.mark.parametrize(
    ("phrase", "size", "count"),
    [("the 25 lug", 0.025, None), ("the 25 lugs", None, 25), ("25 lug", None, 25), ("the 13.5 bores", 0.0135, None)],
)
def test_a_number_before_one_part_is_its_size_in_mm(phrase: str, size: float | None, count: int | None) -> None:
    query = noun_phrase(phrase)
    assert ([one.low for one in query.sizes], query.count) == ([size] if size else [], count)


def test_across_the_corners_is_a_measure_and_in_the_corners_a_place() -> None:
    across = next(form for form in forms("How much does the nut measure across the corners?") if isinstance(form, Get))
    assert (across.measures, across.target) == ((Measure.ACROSS_CORNERS,), noun_phrase("the nut"))
    assert noun_phrase("lugs in the corners").adjectives == ("corner",)


@pytest.mark.parametrize("words", ["left to right", "front to back"])
def test_from_one_side_to_the_other_is_a_direction(words: str) -> None:
    assert noun_phrase(f"the lug {words}").sides == ()
    assert noun_phrase(f"the lug on the {words.split(maxsplit=1)[0]}").sides != ()


@pytest.mark.parametrize(
    "question",
    ["How many lugs are both open and deeper than 4 mm?", "Count the lugs that are open and deeper than 4 mm."],
)
def test_two_restrictions_may_share_a_both(question: str) -> None:
    (lugs,) = {counted(question)}
    assert lugs.adjectives == ("open",)
    assert [size.low for size in lugs.sizes] == [0.004]


@pytest.mark.parametrize("question", ["Number of slots in the largest length?", "How many slots at max width?"])
def test_those_of_the_largest_size_are_counted(question: str) -> None:
    assert [rank.most for rank in counted(question).ranks] == [True]


@pytest.mark.parametrize("question", ["Lugs chamfered?", "Lugs countersunk?"])
def test_what_is_said_of_parts_with_a_question_mark_is_answered_by_yes_or_no(question: str) -> None:
    assert not any(isinstance(form, Count | Get) for form in forms(question))


def test_the_distance_of_the_closest_ones_is_the_smallest_of_all() -> None:
    asked = [form for form in forms("How far apart are the two closest lugs?") if isinstance(form, Distance)]
    assert {form.reduce for form in asked if form.second == "each other"} == {Reduce.SMALLEST}
