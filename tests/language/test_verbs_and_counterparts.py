"""Verbs that are no parts, leaning, axes that parts turn about, what is left out, and what goes into a cut."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure
from querycad_language.forms import Count, Form, Get, Towards
from querycad_language.readings import Reading
from querycad_language.readings.reader import read
from querycad_language.tokens import tokenize


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


def asked(question: str, measure: Measure) -> list[Reading]:
    """The readings that ask for this measure of a part."""
    found = [one for one in read(question) if isinstance(one.form, Get) and one.form.measures == (measure,)]
    return [one for one in found if isinstance(one.form, Get) and one.form.target is not None]


@pytest.mark.parametrize(
    ("question", "noun"),
    [
        ("How deep is the recess that I deburr?", "deburr"),
        ("On which face must I grind the collar?", "grind"),
        ("How long is the bar that it is riveted to?", "riveted"),
        ("How high is the lug that is glued on?", "glued"),
        ("How wide is the slot where it leaves the rim?", "leaf"),
    ],
)
def test_a_verb_behind_a_pronoun_or_a_participle_names_no_part(question: str, noun: str) -> None:
    targets = [form.target for form in forms(question) if isinstance(form, Get | Count | Towards)]
    assert targets
    assert all(target is None or target.noun != noun for target in targets)


def test_plural_nouns_behind_has_it_are_parts() -> None:
    assert any(isinstance(form, Count) and form.target.noun == "rib" for form in forms("How many has it ribs?"))


@pytest.mark.parametrize("word", ["webbed", "covering", "cartridge"])
def test_an_english_word_is_not_taken_apart(word: str) -> None:
    assert [token.word for token in tokenize(word)] == [word]


@pytest.mark.parametrize(
    ("question", "measure"),
    [
        ("By how much is the wall tilted against the horizontal?", Measure.INCLINATION),
        ("The lip is slanted, by how much against the level?", Measure.INCLINATION),
        ("How many degrees does the flap lean away from upright?", Measure.DRAFT),
        ("By how many degrees is the arm tipped from the vertical?", Measure.DRAFT),
    ],
)
def test_how_far_something_leans_is_an_angle(question: str, measure: Measure) -> None:
    assert asked(question, measure)


def test_a_tilted_part_may_be_asked_for_its_mass() -> None:
    reading = asked("How much does the tilted wall weigh?", Measure.MASS)[0]
    assert isinstance(reading.form, Get)
    assert reading.form.target is not None
    assert "tilted" in reading.form.target.adjectives


@pytest.mark.parametrize(
    "question",
    [
        "About which axis does the drum turn?",
        "The knob spins around which axis, x or y?",
        "Along which of the coordinate axes does the rod lie?",
    ],
)
def test_the_axis_that_a_part_turns_about_is_one_of_the_frame(question: str) -> None:
    assert asked(question, Measure.LONG_AXIS)


@pytest.mark.parametrize(
    ("question", "axes"),
    [
        ("Which side of the file's axes does the lip face?", False),
        ("On what side, in the model's axes, is the lug?", False),
        ("Which way does the lip point, along which axis, + or -?", True),
    ],
)
def test_who_asks_for_a_side_is_told_a_side(question: str, axes: bool) -> None:
    assert {form.axes for form in forms(question) if isinstance(form, Towards)} == {axes}


@pytest.mark.parametrize(
    "question",
    [
        "How many ribs, the gusset does not count?",
        "How many ribs, gusset ignored?",
    ],
)
def test_what_does_not_count_is_left_out(question: str) -> None:
    counted = [form for form in forms(question) if isinstance(form, Count) and form.target.noun == "rib"]
    assert any([one.noun for one in form.target.excluded] == ["gusset"] for form in counted)


@pytest.mark.parametrize(
    ("question", "noun"),
    [
        ("How thick a cable goes through the grommet?", "grommet"),
        ("Largest bolt that fits the eye?", "eye"),
        ("The long slots: what screw will pass?", "slot"),
    ],
)
def test_what_goes_in_is_as_wide_as_what_it_goes_into(question: str, noun: str) -> None:
    targets = [reading.form.target for reading in asked(question, Measure.DIAMETER) if isinstance(reading.form, Get)]
    assert any(target is not None and target.noun == noun for target in targets)


@pytest.mark.parametrize("question", ["the lip is how many mm", "measure the rim along the axle, how many mm"])
def test_a_unit_may_be_the_last_word(question: str) -> None:
    assert any(isinstance(form, Get) for form in forms(question))
