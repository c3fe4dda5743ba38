"""Every way to say it, with every part: constructions of English, filled in with parts that nothing was written for.

A construction that is only read with some nouns is a rule for those. Each is tried with several, drawn by seed.
"""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from querycad_contracts import PartQuery, Side
from querycad_language.describe import plural_of
from querycad_language.forms import Angle, Boundary, Distance, Get, Plane
from querycad_language.lexicon import lexicon
from querycad_language.readings import Reading, read
from querycad_language.readings.frames.anchors import WHOLE

PARTS = ("boss", "slot", "pocket", "rib", "groove", "lug", "flange", "hub", "pin", "hole")
FIRST = 6
"""So many readings are looked at: which of them is right the model decides."""


def filled(template: str, times: int = 4) -> Iterator[tuple[str, str, str]]:
    """The sentence with several pairs of parts: {a} and {b}, in the plural {aa} and {bb}."""
    dice = random.Random(template)
    for _ in range(times):
        a, b = dice.sample(PARTS, 2)
        said = template.format(a=a, b=b, aa=plural_of(a), bb=plural_of(b))
        yield said[0].upper() + said[1:], a, b


def readings(question: str) -> list[Reading]:
    return read(question, ())[:FIRST]


def targets(question: str, noun: str) -> list[PartQuery]:
    found = (getattr(reading.form, "target", None) for reading in readings(question))
    return [query for query in found if query is not None and query.noun == noun]


DISTANCES = (
    "How far is the {a} from the {b}?",
    "How far apart are the {a} and the {b}?",
    "The {a} and the {b}: how far apart?",
    "{a} to {b} distance?",
    "{a} to {b}?",
    "Centre distance {a} - {b}?",
    "How much material is between the {a} and the {b}?",
    "How close is the {a} to the {b}?",
    "What separates the {a} from the {b}, in mm?",
    "At what distance from the {b} is the {a}?",
    "Measured from the {b}, how far is the {a}?",
    "How wide is the gap between the {a} and the {b}?",
    "How much is the {a} offset from the {b}?",
    "How far in from the {b} is the {a}?",
)
LEAST = (
    "What is the thinnest web between the {a} and the {b}?",
    "Thinnest metal between the {a} and the {b}?",
    "How much material is left between the {a} and the {b} at its thinnest?",
    "Smallest wall thickness between the {a} and the {b}?",
)
TO_PLACES = {
    "How far is the {a} from the centre?": "second=None",
    "How far is the {a} from the middle of the part?": "second=None",
    "What is the wall between the {a} and outside?": "Boundary(side=None",
    "How far is the {a} from the longest side?": "Boundary(side=None",
    "How far from the left end does the {a} begin?": "mode='surfaces'",
    "What is the y distance between the two {aa}?": "axis=1",
    "At which distance from the shaft end does the {a} begin?": "Plane(side=None",
    "At what distance from the end does the {a} begin?": "mode='surfaces'",
    "How far is the {a} from the free end?": "Plane(side=None",
}
OF_THE_TWO = {
    "How far apart do the inside faces of both {aa} lie?": "second='each other', mode='surfaces'",
    "How far apart are the outer faces of the {aa}?": "second='each other', mode='outsides'",
    "What is the distance between the upper and the lower {aa}?": "Side.BOTTOM",
    "How far apart are the left and right {aa}?": "Side.RIGHT",
    "What is the distance between the upper {aa} and the lower {aa}?": "Side.BOTTOM",
}
COMPARISONS = {
    "Is the {a} wider than the {b}?": "Check",
    "Is the width of the {a} greater than that of the {b}?": "Check",
    "Is the {a} as wide as the {b}?": "Check",
    "Are the {a} and the {b} equally wide?": "Check",
    "Do the {a} and the {b} have the same width?": "Check",
    "Which is wider, the {a} or the {b}?": "Which",
    "Which one is wider: the {a} or the {b}?": "Which",
    "Of the {a} and the {b}, which is wider?": "Which",
    "How much wider is the {a} than the {b}?": "Combine",
    "By how much is the {a} wider than the {b}?": "Combine",
    "Width difference between {a} and {b}?": "Combine",
    "What is the difference in width between the {a} and the {b}?": "Combine",
    "What is the ratio between the widths of the {a} and the {b}?": "Combine",
    "What is the combined width of the {a} and the {b}?": "Combine",
    "Total width of {a} and {b}?": "Combine",
    "How wide are the {a} and the {b} together?": "Combine",
    "By how much does the width of the {a} exceed that of the {b}?": "Combine",
    "By how much do the {a} and the {b} differ in width?": "Combine",
    "By how much is the {a} bigger in diameter than the {b}?": "Combine",
    "How many times wider is the {a} than the {b}?": "Combine",
    "Is the {a} twice as wide as the {b}?": "Check",
    "Is the {a} half as wide as the {b}?": "Check",
    "Is the width of the {a} three times that of the {b}?": "Check",
    "Are the {a} and the {b} on the same side?": "Facing",
    "Does the {a} stand on the same side as the {b}?": "Facing",
    "Do the {a} and the {b} point to opposite sides?": "Facing",
    "Are the {a} and the {b} coaxial?": "Parallel",
    "Does the {a} line up with the {b}?": "Parallel",
    "Is the {a} parallel to the {b}?": "Parallel",
    "What is the angle between the {a} and the {b}?": "Angle",
}
OF_SEVERAL = {
    "What is the difference in depth of the two {aa}?": "Combine",
    "By how much do the two {aa} differ in height?": "Combine",
    "The four {aa} form a square. What is its side?": "Distance",
    "What are the sides of the rectangle on which the {aa} lie?": "Distance",
    "Are the two {aa} diametrically opposite each other?": "Facing",
    "Are all {aa} on the same side?": "Facing",
    "Do the two {aa} meet?": "Check",
    "Is the {a} hollow?": "Every",
    "Which axis does the {a} run along?": "Get",
    "Coordinates of the centre of the {a}, in model coordinates?": "Get",
    "How far in from the left edge is the {a}?": "Distance",
    "On what circle do the {aa} lie?": "Get",
}
WEBS = ("What web is left between the {a} and the {b}?", "What wall remains between the {a} and the {b}?")
RELATIONS = (
    *("carries", "contains", "touches", "adjoins", "crosses", "pierces", "surrounds", "encloses"),
    *("faces", "stands on", "rises from", "ends at", "runs into", "borders", "flanks", "lies on", "is next to"),
    *("is carried by", "is surrounded by", "is crossed by", "is cut into", "belongs to", "is part of"),
)
NAMED = {
    "left {a}": "ends",
    "{a} on the left side": "sides",
    "top left {a}": "ends",
    "{a} in the top left corner": "ends",
    "+X {a}": "ends",
    "{a} facing right": "sides",
    "{a} visible from above": "sides",
    "{a} with the highest z": "ranks",
    "{a} at smaller x": "ranks",
    "{a} nearest the top": "ranks",
    "second {a} from the left": "ranks",
    "first {a} from the bottom": "ranks",
    "deepest {a}": "ranks",
    "{a} with the greater depth": "ranks",
    "{a} closest to the centre": "adjectives",
    "innermost {a}": "adjectives",
    "chamfered {a}": "adjectives",
    "{a} that is not chamfered": "lacking",
    "unchamfered {a}": "lacking",
    "non-chamfered {a}": "lacking",
    "5 mm {a}": "sizes",
    "{a}, 5 mm wide,": "sizes",
    "{a} with a width of 5 mm": "sizes",
    "{a} that is 5 mm wide": "sizes",
    "six-sided {a}": "adjectives",
    "{a} coloured red": "colors",
}
LEADS = (
    "{Q}",
    "The {a}: {q}",
    "Look at the {a}. {Q}",
    "There is a {a} here. {Q}",
    "Regarding the {a}, {q}",
    "{a} - {q}",
    "This part has a {a}. {Q}",
)


EIGHT = (
    *("8 mm", "8mm", "8-mm", "8,0 mm", "Ø8", "ø 8", "Ø8 mm", "Ø8H7", "dia. 8", "dia 8", "8 dia", "8 mm dia", "D8"),
    *("d = 8 mm", "diameter 8", "0.8 cm", "eight mm", "8 x 20 mm", "8x20 mm", "8 mm wide"),
)


@pytest.mark.parametrize("size", EIGHT)
@pytest.mark.parametrize("question", ["How many {} {}?", "How deep is the {} {}?"])
def test_a_size_is_one_however_it_is_written(question: str, size: str) -> None:
    for noun in ("slot", "bore", "pocket"):
        several = plural_of(noun) if "many" in question else noun
        found = targets(question.format(size, several), noun)
        assert any(one.sizes and one.sizes[0].low == pytest.approx(8e-3) for one in found), (question, size, noun)


@pytest.mark.parametrize("template", DISTANCES)
def test_how_far_apart_two_parts_are(template: str) -> None:
    for question, a, b in filled(template):
        said = [repr(reading.form) for reading in readings(question) if type(reading.form).__name__ == "Distance"]
        assert any(f"noun='{a}'" in form and f"noun='{b}'" in form for form in said), question


@pytest.mark.parametrize("template", LEAST)
def test_the_least_that_is_left_between_two_parts(template: str) -> None:
    for question, a, b in filled(template):
        said = [repr(reading.form) for reading in readings(question) if type(reading.form).__name__ == "Distance"]
        assert any(f"noun='{a}'" in one and f"noun='{b}'" in one and "SMALLEST" in one for one in said), question


@pytest.mark.parametrize(("template", "says"), TO_PLACES.items())
def test_how_far_a_part_is_from_a_place_of_the_model(template: str, says: str) -> None:
    for question, a, _ in filled(template):
        said = [repr(reading.form) for reading in readings(question) if type(reading.form).__name__ == "Distance"]
        assert any(f"noun='{a}'" in one and says in one for one in said), question


@pytest.mark.parametrize(("template", "says"), OF_THE_TWO.items())
def test_two_of_a_kind_are_told_apart_by_what_stands_before_the_noun(template: str, says: str) -> None:
    for question, a, _ in filled(template):
        said = [repr(reading.form) for reading in readings(question)]
        assert any(form.startswith(f"Distance(first=PartQuery(noun='{a}'") and says in form for form in said), question


def test_a_part_lies_so_far_from_the_end_of_what_it_is_in() -> None:
    for question, _, b in filled("How far is the {a} in the {b} from its end?"):
        said = [reading.form for reading in readings(question) if isinstance(reading.form, Distance)]
        ends = [end for form in said for end in (form.first, form.second) if isinstance(end, Plane)]
        assert b in [end.of.noun for end in ends], question


@pytest.mark.parametrize("sides", ["left and right", "front and back", "top and bottom"])
def test_two_opposite_sides_are_as_far_apart_as_the_model_reaches(sides: str) -> None:
    (form, *_) = [reading.form for reading in readings(f"What is the distance between the {sides} sides?")]
    first, _, second = sides.partition(" and ")
    assert form == Distance(Plane(Side(first), WHOLE), Boundary(Side(second)))


@pytest.mark.parametrize("said", ["angle", "included angle"])
def test_an_angle_between_two_is_no_measure_of_each(said: str) -> None:
    for question, a, _ in filled(f"What is the {said} between the two {{aa}}?"):
        (form, *_) = [reading.form for reading in readings(question)]
        assert isinstance(form, Angle), question
        assert form.first.noun == a


@pytest.mark.parametrize(("template", "form"), COMPARISONS.items())
def test_what_two_parts_have_together_or_apart(template: str, form: str) -> None:
    for question, a, b in filled(template):
        said = [repr(reading.form) for reading in readings(question) if type(reading.form).__name__ == form]
        assert any(f"noun='{a}'" in one and f"noun='{b}'" in one for one in said), question


@pytest.mark.parametrize(("template", "form"), OF_SEVERAL.items())
def test_what_one_of_several_has_more(template: str, form: str) -> None:
    for question, a, _ in filled(template):
        first = [repr(one.form) for one in readings(question)[:3] if type(one.form).__name__ == form]
        assert any(f"noun='{a}'" in said for said in first), question


@pytest.mark.parametrize("template", WEBS)
def test_what_is_left_between_two_parts_is_none_of_them(template: str) -> None:
    for question, a, b in filled(template):
        found = [one for one in readings(question) if type(one.form).__name__ == "Distance" and not one.skipped]
        assert any(f"noun='{a}'" in repr(one.form) and f"noun='{b}'" in repr(one.form) for one in found), question


@pytest.mark.parametrize("relation", RELATIONS)
def test_a_relative_clause_places_the_part(relation: str) -> None:
    for question, a, b in filled(f"How wide is the {{a}} that {relation} the {{b}}?"):
        placed = [place.what for query in targets(question, a) for place in query.places]
        assert any(what is not None and what.noun == b for what in placed), question


@pytest.mark.parametrize(("phrase", "field"), NAMED.items())
@pytest.mark.parametrize("question", ["How wide is the {}?", "Where is the {}?", "I need the depth of the {}."])
def test_each_way_to_tell_parts_apart_restricts(phrase: str, field: str, question: str) -> None:
    for said, a, _ in filled(question.format(phrase)):
        assert any(getattr(query, field) for query in targets(said, a)), said


@pytest.mark.parametrize("lead", LEADS[1:])
@pytest.mark.parametrize("asked", ["how broad is it?", "its width?", "what is its width?", "please give me the width."])
def test_what_was_said_before_owns_the_measure(lead: str, asked: str) -> None:
    for question, a, _ in filled(lead.replace("{q}", asked).replace("{Q}", asked.capitalize())):
        assert any(isinstance(one.form, Get) and one.form.measures[0] == "width" for one in readings(question))
        assert targets(question, a), question


@pytest.mark.parametrize(
    "frame", ["How long is the {}?", "How deep is the large {}?", "What is the diameter of the {}?"]
)
def test_every_noun_of_the_lexicon_is_read(frame: str) -> None:
    nouns = lexicon().nouns
    whole = {*lexicon().words("whole"), *lexicon().words("aside"), "drill", "wrench", "spanner", "blank", "single part"}
    lost = []
    for name, noun in nouns.items():
        mentioned = {getattr(getattr(one.form, "target", None), "noun", None) for one in read(frame.format(name), ())}
        if name not in whole and not {name, noun.name} & mentioned:
            lost.append(name)
    assert len(lost) <= 0.01 * len(nouns), lost
