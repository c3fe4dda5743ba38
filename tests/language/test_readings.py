"""A question has readings: what they ask, which words they use, and what of the rest carries meaning."""

from __future__ import annotations

from typing import Any

import pytest

from querycad_answering.drawing.meaning import describe
from querycad_contracts import Measure, PartQuery, Relation, Side
from querycad_language.forms import (
    LONGEST,
    SHORTER,
    Angle,
    Boundary,
    Check,
    Combine,
    Count,
    Distance,
    Every,
    Exists,
    Form,
    Get,
    Parallel,
    Parts,
    Plane,
    Reduce,
    Several,
    Uniform,
    queries,
)
from querycad_language.readings import Reading, read


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def best(question: str) -> Reading:
    return read(question)[0]


@pytest.mark.parametrize(
    ("question", "kind"),
    [
        ("How many keys are there?", Count),
        ("Is there a slot?", Exists),
        ("What is the depth of the slot?", Get),
        ("How far apart are the slots?", Distance),
        ("What is the angle between the pin and the plate?", Angle),
        ("How much longer is the pin than the bolt?", Combine),
        ("Is the slot 25 mm wide?", Check),
        ("Are the two pins parallel?", Parallel),
        ("Is the slot blind?", Every),
        ("Which slots are deeper than 11 mm?", Parts),
        ("Do all slots have the same depth?", Uniform),
    ],
)
def test_every_form_is_among_the_readings_of_its_question(question: str, kind: type) -> None:
    assert any(isinstance(form, kind) for form in forms(question))


@pytest.mark.parametrize(
    ("question", "measures", "noun"),
    [
        ("Inner and outer diameter of the ring?", (Measure.INNER_DIAMETER, Measure.OUTER_DIAMETER), "ring"),
        ("What is the length by width of the slot?", (Measure.LENGTH, Measure.WIDTH), "slot"),
        ("What are the bores honed to?", (Measure.DIAMETER,), "bore"),
        ("Fork gap?", (Measure.WIDTH,), "gap"),
        ("What is the area of the underside?", (Measure.AREA,), "face"),
        ("How steep is the ramp?", (Measure.INCLINATION,), "ramp"),
        ("By how much does the bore lean?", (Measure.INCLINATION,), "bore"),
        ("How deep is the cell inside?", (Measure.DEPTH,), "cell"),
        ("What size hex key do the screws need?", (Measure.ACROSS_FLATS,), "screw"),
        ("Which way are the bolts inserted?", (Measure.APPROACH,), "bolt"),
        ("From which direction is the pin pushed in?", (Measure.APPROACH,), "pin"),
        ("In what direction is the port drilled?", (Measure.APPROACH,), "port"),
        ("Direction of approach of the bore?", (Measure.APPROACH,), "bore"),
        ("Which way does the port point?", (Measure.DIRECTION,), "port"),
        ("How much material stays under the bolt head?", (Measure.BOTTOM_THICKNESS,), "bolt head"),
        ("Which piece carries the slot?", (Measure.NAME,), "piece"),
        ("How wide is the groove round the rim?", (Measure.WIDTH,), "groove"),
        ("Blind hole depth, drill point excluded", (Measure.DEPTH,), "blind hole"),
        ("What axle goes in it?", (Measure.DIAMETER,), "axle hole"),
        ("What size dowel fits the flange?", (Measure.DIAMETER,), "flange"),
        ("Which way does the spigot point?", (Measure.DIRECTION,), "spigot"),
        (
            "The slot: width, depth at the wall, length over all?",
            (Measure.WIDTH, Measure.DEPTH, Measure.LENGTH),
            "slot",
        ),
        ("Window size, width by height", (Measure.WIDTH, Measure.HEIGHT), "window"),
        ("How thick is the wall around the bore?", (Measure.WALL_THICKNESS,), "bore"),
        ("What is the thickness of the top?", (Measure.THICKNESS,), "roof"),
        ("What is the floor thickness of the box?", (Measure.THICKNESS,), "floor"),
    ],
)
def test_measures_are_read_however_they_are_said(question: str, measures: tuple[Measure, ...], noun: str) -> None:
    assert any(
        isinstance(form, Get) and form.measures == measures and form.target is not None and form.target.noun == noun
        for form in forms(question)
    )


@pytest.mark.parametrize(
    ("question", "noun"),
    [
        ("There are two bores coming in from the left. How deep is the larger one?", "bore"),
        ("The hub overtops the ring. How high is it?", "hub"),
        ("A window cut in the wall. How long is it?", "window"),
        ("How many ribs run around the outside?", "rib"),
    ],
)
def test_verbs_and_adjectives_are_no_unknown_nouns(question: str, noun: str) -> None:
    named = {query.noun for form in forms(question) for query in queries(form)}
    assert noun in named
    assert not named & {"coming", "overtop", "cut", "outside"}


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("Spacing of the bolts in both directions", Several),
        ("What are the two spacings of the studs?", Several),
        ("Width over both lugs", "outsides"),
        ("Diagonal distance of the four studs", Reduce.LARGEST),
        ("How far is the pin from the hub's end face?", Plane),
        ("What is the angular offset between the key and the vane?", Angle),
    ],
)
def test_how_a_distance_is_taken_is_said_in_many_ways(question: str, expected: Any) -> None:
    found = forms(question)
    distances = [form for form in found if isinstance(form, Distance)]
    if isinstance(expected, type):
        ends = [end for form in distances for end in (form.first, form.second)]
        assert any(isinstance(one, expected) for one in (*found, *ends))
    else:
        assert any(expected in (form.mode, form.reduce) for form in distances)


def test_the_unit_of_the_answer_is_no_word_that_is_passed_over() -> None:
    assert best("How long is the slot in centimetres?").skipped == ()


def test_what_becomes_of_several_values_is_said_by_a_word_before_the_measure() -> None:
    for word, reduce in (("average", Reduce.MEAN), ("total", Reduce.TOTAL)):
        found = [form for form in forms(f"What is the {word} length of the slots?") if isinstance(form, Get)]
        assert any(form.reduce is reduce for form in found)


def test_several_measures_of_one_part_are_one_reading() -> None:
    form = best("width and depth of the slot").form
    assert isinstance(form, Get)
    assert form.measures == (Measure.WIDTH, Measure.DEPTH)


@pytest.mark.parametrize("question", ["slot depth?", "The slot: its depth?", "There is a slot. How deep is it?"])
def test_telegrams_brackets_and_pronouns_find_their_owner(question: str) -> None:
    asked = [form for form in forms(question) if isinstance(form, Get) and form.target is not None]
    assert any(
        form.target is not None and form.target.noun == "slot" and form.measures == (Measure.DEPTH,) for form in asked
    )


def test_courtesy_costs_nothing_and_what_carries_meaning_is_told() -> None:
    plain = best("What is the depth of the slot?")
    polite = best("Please, what is the depth of the slot? Thank you.")
    assert polite.form == plain.form
    assert not [kind for kind, _ in polite.skipped if kind not in ("chatter", "function", "courtesy")]
    odd = [
        reading for reading in read("What is the depth of the slot at 30 mm?") if ("number", "30 mm") in reading.skipped
    ]
    assert all(any(name.endswith("_number") for name in reading.features) for reading in odd)


def test_the_whole_model_is_a_reading_that_passes_over_the_part() -> None:
    whole = next(r for r in read("What is the depth of the slot?") if isinstance(r.form, Get) and r.form.target is None)
    assert ("noun", "slot") in whole.skipped


@pytest.mark.parametrize(
    ("question", "second"),
    [
        ("Do the bodies overlap?", "each other"),
        ("Is there any interference between the crank and the piston?", PartQuery),
        ("Does the crank collide with the piston?", PartQuery),
    ],
)
def test_an_overlap_is_asked_of_bodies_and_is_not_whether_there_are_any(question: str, second: Any) -> None:
    form = read(question)[0].form
    assert isinstance(form, Check)
    assert isinstance(form.left, Distance)
    assert form.left.mode == "overlap"
    assert form.left.second == second or isinstance(form.left.second, second)
    assert not any(isinstance(one, Exists) for one in forms(question))


def test_bodies_touch_where_nothing_is_between_their_surfaces() -> None:
    form = read("Do the gears touch each other?")[0].form
    assert isinstance(form, Check)
    assert isinstance(form.left, Distance)
    assert (form.left.mode, form.relation, form.low) == ("surfaces", Relation.AT_MOST, 0.0)


def test_a_named_material_stands_for_its_density() -> None:
    (form,) = [one for one in forms("What does the lever weigh in stainless steel?") if isinstance(one, Get)][:1]
    assert (form.measures, form.density) == ((Measure.MASS,), 7900.0)
    assert "7900 kg/m3" in describe(form)


@pytest.mark.parametrize("said", ["a density of -5 kg/m3", "0 g/cm3", "density=-7850 kg/m3"])
def test_what_is_not_above_0_is_no_density(said: str) -> None:
    assert {form.density for form in forms(f"What is the mass at {said}?") if isinstance(form, Get)} == {None}


@pytest.mark.parametrize("said", ["steel - 7850 kg/m3", "density: 7850 kg/m3", "7800-7850 kg/m3"])
def test_a_dash_before_a_density_is_no_minus(said: str) -> None:
    form = best(f"What is the mass, {said}?").form
    assert isinstance(form, Get)
    assert form.density == 7850.0


def test_a_stated_density_is_kept_for_the_mass() -> None:
    form = best("How much does it weigh at 2.7 g/cm3?").form
    assert isinstance(form, Get)
    assert [form.measures, form.density] == [(Measure.MASS,), pytest.approx(2700.0)]


def test_a_check_keeps_relation_and_value() -> None:
    form = next(form for form in forms("Is the slot deeper than 4 mm?") if isinstance(form, Check))
    assert [form.relation, form.low] == [Relation.MORE, pytest.approx(0.004)]


def test_no_words_no_readings() -> None:
    assert read("") == read("???") == read("   ") == []


@pytest.mark.parametrize(
    ("question", "text"),
    [
        ("How many blind slots are there?", "number of the blind slots"),
        ("What is the depth of the slot?", "depth of the slot"),
        ("Is there a slot?", "whether there are slots"),
    ],
)
def test_a_reading_is_told_in_plain_words(question: str, text: str) -> None:
    assert any(describe(form) == text for form in forms(question))


def test_every_reading_can_be_told_and_its_queries_are_listed_once() -> None:
    for question in ("How far is the slot from the left edge?", "How many slots and pockets are in the flange?"):
        for form in forms(question):
            assert describe(form)
            asked = list(queries(form))
            assert len(asked) == len({query.model_dump_json() for query in asked})


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("How many square centimetres are open in the slot?", Measure.AREA),
        ("How large is the slot in square millimetres?", Measure.AREA),
        ("How many cubic centimetres of iron are in it?", Measure.VOLUME),
        ("By how many degrees does the pin lean?", Measure.ANGLE),
        ("How many millimetres deep is the slot?", Measure.DEPTH),
        ("What does the crane lift, if it is iron of 7200 kg per cubic metre?", Measure.MASS),
    ],
)
def test_a_unit_says_what_is_asked_for(question: str, measure: Measure) -> None:
    assert any(isinstance(form, Get) and form.measures == (measure,) for form in forms(question))
    assert not any(isinstance(form, Count) for form in forms(question))


def test_how_many_feet_counts_feet() -> None:
    assert any(isinstance(form, Count) and form.target.noun == "foot" for form in forms("How many feet are there?"))


@pytest.mark.parametrize(
    ("question", "relation"),
    [
        ("Is there at least 10 mm between the slot and the pin?", Relation.AT_LEAST),
        ("Is the slot more than 3 mm from the pin?", Relation.MORE),
    ],
)
def test_a_distance_is_checked_against_a_number(question: str, relation: Relation) -> None:
    checks = [form for form in forms(question) if isinstance(form, Check) and isinstance(form.left, Distance)]
    assert [checks[0].relation, checks[0].high] == [relation, None]


def test_the_difference_of_two_measures_is_one_value() -> None:
    for question in (
        "What is the difference between the diameters of the pin and the slot?",
        "How much play does the pin have in the slot, as a difference of the diameters?",
        "By how much is the pin larger in diameter than the slot?",
    ):
        combined = [form for form in forms(question) if isinstance(form, Combine)]
        assert {form.left.measures for form in combined if isinstance(form.left, Get)} == {(Measure.DIAMETER,)}


def test_spacings_along_two_axes_are_two_values() -> None:
    for question in ("What spacing lengthwise and crosswise do the slots have?", "Slots: long and short spacing?"):
        several = next(form for form in forms(question) if isinstance(form, Several))
        assert [one.axis for one in several.of] == [LONGEST, SHORTER]


def test_a_relative_clause_restricts_whatever_its_verb() -> None:
    query = next(queries(best("What is the diameter of the pins which pass vertically through the plate?").form))
    assert [(place.relation, place.what and place.what.noun) for place in query.places] == [("through", "plate")]


def test_the_same_noun_again_may_mean_what_was_said_more_fully_before() -> None:
    found = forms("The foot has a blind slot. How wide is this slot?")
    assert any(
        isinstance(form, Get) and form.target is not None and "blind" in form.target.adjectives for form in found
    )


def test_a_point_and_a_length_are_not_asked_together_by_a_comma() -> None:
    assert not any(isinstance(form, Get) and len(form.measures) > 1 for form in forms("Slots in the cone tips, Ø?"))
    assert any(isinstance(form, Get) and len(form.measures) == 2 for form in forms("Length, width of the slot?"))


@pytest.mark.parametrize(
    ("question", "measures"),
    [
        ("Pin: Ø × L", (Measure.DIAMETER, Measure.LENGTH)),
        ("What are the extents of the slot in x, y and z?", (Measure.X_EXTENT, Measure.Y_EXTENT, Measure.Z_EXTENT)),
        ("What are the slot's x and y dimensions?", (Measure.X_EXTENT, Measure.Y_EXTENT)),
    ],
)
def test_several_measures_are_asked_by_letters_and_axes(question: str, measures: tuple[Measure, ...]) -> None:
    assert any(isinstance(form, Get) and form.measures == measures for form in forms(question))


@pytest.mark.parametrize(
    "question", ["How many pins are in the plate, the two dowel pins left out?", "No. of pins, dowel pin not counted"]
)
def test_what_is_left_out_may_stand_behind_a_comma(question: str) -> None:
    counted = next(form for form in forms(question) if isinstance(form, Count))
    assert [one.noun for one in counted.target.excluded] == ["dowel pin"]


def test_a_plural_measure_makes_its_compound_plural() -> None:
    form = best("Both slot widths, please.").form
    assert isinstance(form, Get)
    assert form.target is not None
    assert form.target.plural


def test_from_one_end_to_another_is_a_distance_though_a_dimension_is_named() -> None:
    found = forms("From the middle of the pin to the back end of the fork, that is the dimension I need.")
    assert any(isinstance(form, Distance) and isinstance(form.second, Plane) for form in found)


@pytest.mark.parametrize(
    "question", ["Tell me how deep the slot is.", "Check how deep this slot is", "I wonder how deep slot 2 is."]
)
def test_an_indirect_question_asks_the_same(question: str) -> None:
    form = best(question).form
    assert isinstance(form, Get)
    assert (form.measures, form.target and form.target.noun) == ((Measure.DEPTH,), "slot")


@pytest.mark.parametrize(
    "question",
    [
        "Check whether the slot is wider than 5 mm.",
        "Tell me if the slot is wider than 5 mm.",
        "The slot is wider than 5 mm, isn't it?",
        "Does the width of the slot exceed 5 mm?",
    ],
)
def test_yes_or_no_is_asked_in_many_forms(question: str) -> None:
    assert any(isinstance(form, Check) and form.relation is Relation.MORE for form in forms(question))
    values = [reading for reading in read(question) if isinstance(reading.form, Get)]
    assert all("value_for_yes_no" in reading.features for reading in values)


@pytest.mark.parametrize(
    "question",
    [
        "Can you check whether there is a slot?",
        "Is a slot present?",
        "Would I find a slot on this part?",
    ],
)
def test_whether_there_is_one_is_asked_in_many_forms(question: str) -> None:
    assert any(isinstance(form, Exists) and form.target.noun == "slot" for form in forms(question))


def test_any_one_is_enough_where_any_is_said() -> None:
    assert any(
        isinstance(form, Exists) and form.target.adjectives == ("blind",) for form in forms("Is any slot blind?")
    )
    assert not any(isinstance(form, Exists) and form.target.adjectives for form in forms("Is the slot blind?"))


@pytest.mark.parametrize(
    ("question", "adjectives", "lacking"),
    [
        ("How many slots go all the way through?", ("through",), ()),
        ("How many slots pass right through the part?", ("through",), ()),
        ("How many slots do not go through?", (), ("through",)),
        ("How many slots are open at both ends?", ("open at both ends",), ()),
        ("How many slots are through?", ("through",), ()),
        ("How many slots have a counterbore?", ("counterbored",), ()),
    ],
)
def test_what_goes_through_is_said_in_many_ways(
    question: str, adjectives: tuple[str, ...], lacking: tuple[str, ...]
) -> None:
    counted = next(form for form in forms(question) if isinstance(form, Count))
    assert (counted.target.adjectives, counted.target.lacking) == (adjectives, lacking)


def test_what_goes_through_a_lid_lies_in_it() -> None:
    counted = next(
        form for form in forms("How many slots are there that go through the lid?") if isinstance(form, Count)
    )
    assert [place.relation for place in counted.target.places] == ["through"]
    assert not counted.target.adjectives


@pytest.mark.parametrize(
    ("question", "reduce"),
    [
        ("What is the minimum slot depth?", Reduce.SMALLEST),
        ("Average slot depth?", Reduce.MEAN),
        ("maximum slot depth", Reduce.LARGEST),
    ],
)
def test_extremes_and_averages_are_those_of_several(question: str, reduce: Reduce) -> None:
    assert any(
        isinstance(form, Get) and form.reduce is reduce and form.target is not None and form.target.plural
        for form in forms(question)
    )


def test_a_superlative_may_stand_alone() -> None:
    form = best("Of all the slots, what is the depth of the longest?").form
    assert isinstance(form, Get)
    assert form.target is not None
    assert (form.target.noun, len(form.target.ranks)) == ("slot", 1)
    shown = next(form for form in forms("Which of the slots is the longest?") if isinstance(form, Parts))
    assert len(shown.target.ranks) == 1


def test_a_side_may_own_parts() -> None:
    counted = [form for form in forms("How many slots does the top have?") if isinstance(form, Count)]
    assert any(form.target.sides for form in counted)


def test_a_side_that_something_is_far_from_is_a_plane() -> None:
    distance = best("How far is the slot from the left side?").form
    assert isinstance(distance, Distance)
    assert isinstance(distance.second, Boundary)
    assert distance.second.side is Side.LEFT


@pytest.mark.parametrize(
    "question", ["How many degrees do the lugs lie apart?", "How far apart in degrees are the lugs?"]
)
def test_what_is_asked_in_degrees_is_an_angle(question: str) -> None:
    assert any(isinstance(form, Angle) for form in forms(question))
    assert not any(isinstance(form, Distance) for form in forms(question))


def test_what_is_stated_beside_a_question_is_not_asked() -> None:
    assert not any(isinstance(form, Uniform) for form in forms("Slot width, please? They are all equal, I guess"))
    assert any(isinstance(form, Uniform) for form in forms("Slots all equal?"))
