"""Lengths along an axis, circles that parts stand on, boxes, lists of kinds, numbers that are compared, bare inches."""

from __future__ import annotations

import pytest

from querycad_answering.drawing.meaning import describe
from querycad_contracts import Measure, PartQuery, Relation
from querycad_language.describe import plural_of
from querycad_language.forms import Check, Count, Distance, Exists, Form, Get, Reduce, Which, queries
from querycad_language.readings.reader import read
from querycad_language.tokens import tokenize

PIN, BORE = (PartQuery(noun=noun, words=(noun,), definite=True) for noun in ("pin", "bore"))


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


@pytest.mark.parametrize(
    ("question", "relation", "number"),
    [
        ("Are there more than 8 lugs?", Relation.MORE, 8.0),
        ("Are there at least four blind lugs?", Relation.AT_LEAST, 4.0),
        ("Are there fewer than 5 lugs?", Relation.LESS, 5.0),
        ("Does the lever have more than 2 ribs?", Relation.MORE, 2.0),
    ],
)
def test_a_number_of_parts_is_compared_and_never_passed_over(question: str, relation: Relation, number: float) -> None:
    found = forms(question)
    checks = [form for form in found if isinstance(form, Check)]
    assert [(form.relation, form.low) for form in checks[:1]] == [(relation, number)]
    assert isinstance(checks[0].left, Count)
    assert not any(isinstance(form, Exists) and form.target.count for form in found)
    assert "mm" not in describe(checks[0])


def test_a_number_without_a_comparison_asks_whether_there_are_so_many() -> None:
    assert any(isinstance(form, Exists) and form.target.count == 8 for form in forms("Are there 8 lugs?"))


@pytest.mark.parametrize(
    "words", ["along its axis", "in axial direction", "axially", "along its bore", "along the spindle"]
)
def test_along_its_axis_is_the_axial_extent(words: str) -> None:
    measures = [form.measures for form in forms(f"How wide is the ring {words}?") if isinstance(form, Get)]
    assert (Measure.AXIAL_EXTENT,) in measures
    assert (Measure.AXIAL_EXTENT,) not in [
        f.measures for f in forms("How wide is the ring along y?") if isinstance(f, Get)
    ]


def test_on_what_diameter_parts_are_arranged_asks_for_their_circle() -> None:
    def nouns(question: str) -> set[str]:
        return {query.noun for form in forms(question) for query in queries(form)}

    assert "bolt circle" in nouns("On what diameter are the studs arranged?")
    assert "bolt circle" not in nouns("What diameter do the studs have?")


def test_three_sizes_of_one_part_are_asked_together() -> None:
    asked = [form.measures for form in forms("Give width, depth and height of the lug") if isinstance(form, Get)]
    assert (Measure.WIDTH, Measure.DEPTH, Measure.HEIGHT) in asked
    assert (Measure.SIZE,) not in [f.measures for f in forms("Give width and depth of the lug") if isinstance(f, Get)]


@pytest.mark.parametrize(
    ("question", "kinds"),
    [
        ("How many lugs, ribs and slots are there?", ("rib", "slot")),
        ("How many lugs and ribs are there?", ("rib",)),
        ("How many lugs are there, and where?", ()),
    ],
)
def test_kinds_of_a_list_are_counted_together(question: str, kinds: tuple[str, ...]) -> None:
    targets = [form.target for form in forms(question) if isinstance(form, Count)]
    assert kinds in [
        tuple(other.noun for query in (target, *target.also) for other in query.also) for target in targets
    ]


@pytest.mark.parametrize(
    ("text", "metres"),
    [("Ø.250 lugs", 0.00635), ("Ø0.250 lugs", 0.00025), ("Ø5 lugs", 0.005), ("Ø2 lugs, in inches", 0.0508)],
)
def test_less_than_an_inch_is_written_without_a_zero(text: str, metres: float) -> None:
    """ASME Y14.5: millimetres below one have the zero."""
    assert next(token.value for token in tokenize(text) if token.measure) == pytest.approx(metres)


def test_plurals_that_no_rule_gives() -> None:
    assert [plural_of(noun) for noun in ("foot", "tooth", "boss", "cavity", "lug")] == [
        "feet", "teeth", "bosses", "cavities", "lugs",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("question", "measure", "relation", "value", "said"),
    [
        ("Is the volume less than 500 cm3?", Measure.VOLUME, Relation.LESS, 5e-4, "less than 500000 mm³"),
        ("Is the surface area over 2 m²?", Measure.AREA, Relation.MORE, 2.0, "more than 2e+06 mm²"),
        ("Is the lug's area at least 3 in2?", Measure.AREA, Relation.AT_LEAST, 3 * 0.0254**2, "at least 1935.48 mm²"),
        (
            "Is the angle of the cone less than 30 degrees?",
            Measure.ANGLE,
            Relation.LESS,
            0.5235987755982988,
            "than 30°",
        ),
    ],
)
def test_areas_volumes_and_angles_are_compared(
    question: str, measure: Measure, relation: Relation, value: float, said: str
) -> None:
    checks = [form for form in forms(question) if isinstance(form, Check) and isinstance(form.left, Get)]
    assert (measure,) in [form.left.measures for form in checks if isinstance(form.left, Get)]
    assert {form.relation for form in checks} == {relation}
    assert [form.low for form in checks] == pytest.approx([value] * len(checks))
    assert said in describe(checks[0])


def test_an_area_is_a_size_that_parts_have() -> None:
    asked = [query for form in forms("How many faces are larger than 5 cm²?") for query in queries(form)]
    assert {size.measure for query in asked for size in query.sizes} == {Measure.AREA}
    assert [size.low for query in asked for size in query.sizes] == pytest.approx([5e-4] * len(asked))


@pytest.mark.parametrize(
    ("question", "first", "second"),
    [
        ("Is the lever taller than it is wide?", Measure.HEIGHT, Measure.WIDTH),
        ("Is the part longer than wide?", Measure.LENGTH, Measure.WIDTH),
        ("Is the bore deeper than it is wide?", Measure.DEPTH, Measure.WIDTH),
    ],
)
def test_a_part_is_compared_with_itself(question: str, first: Measure, second: Measure) -> None:
    pairs = {
        (form.left.measures, form.low.measures, form.left.target == form.low.target)
        for form in forms(question)
        if isinstance(form, Check) and isinstance(form.left, Get) and isinstance(form.low, Get)
    }
    assert pairs == {((first,), (second,), True)}


@pytest.mark.parametrize(
    ("question", "measure", "relation"),
    [
        ("Which is longer, the spindle or the lever?", Measure.LENGTH, Relation.MORE),
        ("What has the smaller diameter, lug 3 or lug 5?", Measure.DIAMETER, Relation.LESS),
        ("Is the lug or the rib higher?", Measure.HEIGHT, Relation.MORE),
    ],
)
def test_the_one_of_two_that_has_more_is_asked_for(question: str, measure: Measure, relation: Relation) -> None:
    found = [(form.left, form.relation) for form in forms(question) if isinstance(form, Which)]
    assert [(left.measures, said) for left, said in found if isinstance(left, Get)] == [((measure,), relation)]


def test_more_than_a_size_is_not_one_of_two() -> None:
    assert not any(isinstance(form, Which) for form in forms("Is the lug or the rib higher than 5 mm?"))


def test_what_compares_numbers_is_not_passed_over() -> None:
    skipped = [
        reading.skipped for reading in read("Are there more lugs than ribs?") if isinstance(reading.form, Exists)
    ]
    assert all(("comparison", "more") in words and ("comparison", "than") in words for words in skipped)


def test_the_least_distance_of_a_part_is_that_of_all_such_parts() -> None:
    asked = [form for form in forms("smallest distance from a lug to the edge") if isinstance(form, Distance)]
    assert any(isinstance(one.first, PartQuery) and one.first.plural for one in asked)
    one_lug = [form for form in forms("distance from the lug to the edge") if isinstance(form, Distance)]
    assert not any(isinstance(one.first, PartQuery) and one.first.plural for one in one_lug)


def test_where_asks_for_the_place_that_is_named() -> None:
    asked = [form.measures for form in forms("Where is the tip of the spindle?") if isinstance(form, Get)]
    assert asked[0] == (Measure.TIP,)
    assert (Measure.POSITION,) not in asked


@pytest.mark.parametrize(
    "question", ["How deep is the deepest lug or rib?", "Are there many lugs and ribs?", "more than 4 lugs or ribs?"]
)
def test_what_compares_no_two_things_asks_for_none_of_them(question: str) -> None:
    found = forms(question)
    assert not any(isinstance(form, Which) for form in found)
    assert not any(isinstance(form, Check) and isinstance(form.low, Count) for form in found)


@pytest.mark.parametrize(
    "question",
    [
        "Diametral clearance of the pin and the bore?",
        "How much play has the pin in the bore, on diameter?",
    ],
)
def test_a_clearance_on_diameter_is_that_of_what_runs_in_another(question: str) -> None:
    assert Distance(PIN, BORE, "on diameter") in forms(question)


@pytest.mark.parametrize("words", ["both sides together", "in total", "altogether"])
def test_the_play_of_both_sides_is_one_sum(words: str) -> None:
    found = forms(f"How much play is there between the lug and the hub, {words}?")
    assert any(isinstance(form, Distance) and form.reduce is Reduce.TOTAL for form in found)
