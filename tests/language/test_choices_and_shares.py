"""One of two words, numbers on each side and of each part, kinds that are counted, what a yes or no is about."""

from __future__ import annotations

import pytest

from querycad_answering.drawing.meaning import describe
from querycad_contracts import Relation, Side
from querycad_language.forms import (
    Check,
    Combine,
    Count,
    Distance,
    Either,
    Every,
    Exists,
    Form,
    Get,
    Towards,
    Which,
)  # fmt: skip
from querycad_language.readings.question import Question
from querycad_language.readings.reader import read
from querycad_language.readings.skipped_words import CLOSED


def forms(question: str) -> list[Form]:
    return [reading.form for reading in read(question)]


@pytest.mark.parametrize(
    ("question", "words"),
    [
        ("Are the bores blind or through?", ("blind", "through")),
        ("Is the bore a blind or a through bore?", ("blind", "through")),
        ("Is the lug round or square?", ("round", "square")),
        ("Is it solid or hollow?", ("solid", "hollow")),
    ],
)
def test_one_of_two_words_is_asked_for(question: str, words: tuple[str, str]) -> None:
    form = next(form for form in forms(question) if isinstance(form, Either))
    assert form.words == words
    assert not set(form.target.adjectives) & {name for option in form.options for name in option.adjectives}


@pytest.mark.parametrize(
    ("question", "words"),
    [
        ("Which is longer, the spindle or the lever?", ("spindle", "lever")),
        ("Which lug is wider, the upper one or the lower one?", ("upper lug", "lower lug")),
        ("Which of the two lugs is wider, the upper one or the lower one?", ("upper lug", "lower lug")),
        ("Which of the two ribs is thicker, the left or the right one?", ("left rib", "right rib")),
    ],
)
def test_the_one_of_two_parts_is_called_as_the_question_does(question: str, words: tuple[str, str]) -> None:
    assert [form.words for form in forms(question) if isinstance(form, Which)] == [words]


def test_a_size_does_not_answer_which_of_two() -> None:
    sizes = [reading for reading in read("Which is wider, the lug or the rib?") if isinstance(reading.form, Get)]
    assert sizes
    assert all("value_for_yes_no" in reading.features for reading in sizes)


@pytest.mark.parametrize("question", ["How many lugs are on each side?", "How many lugs are there per side?"])
def test_numbers_on_each_side_are_counted_by_side(question: str) -> None:
    assert ("lug", "each") in [(form.target.noun, form.seen) for form in forms(question) if isinstance(form, Towards)]
    plain = [reading for reading in read(question) if isinstance(reading.form, Count)]
    assert all("skip_comparison" in reading.features for reading in plain)


def test_which_side_has_more_is_no_question_of_where_they_lie() -> None:
    asked = [form for form in forms("Are there more lugs on the left or on the right?") if isinstance(form, Towards)]
    assert [(form.seen, form.sides, form.target.sides) for form in asked] == [("most", (Side.LEFT, Side.RIGHT), ())]


@pytest.mark.parametrize("question", ["How many lugs does each lever have?", "How many lugs are there per lever?"])
def test_a_number_of_each_is_shared(question: str) -> None:
    shared = [form for form in forms(question) if isinstance(form, Combine) and form.operation == "per"]
    assert [(form.right.target.noun, form.right.target.plural) for form in shared[:1] if form.right.target] == [
        ("lever", True)
    ]


@pytest.mark.parametrize(
    "question", ["Do the lugs line up with the ribs?", "Are there as many lugs on the left as on the right?"]
)
def test_that_there_are_such_parts_answers_nothing_else(question: str) -> None:
    assert not any(isinstance(form, Exists) for form in forms(question))


@pytest.mark.parametrize(
    "question", ["Do the bores go right through the plate?", "Does the bore run all the way through the block?"]
)
def test_what_goes_through_is_through(question: str) -> None:
    form = forms(question)[0]
    assert isinstance(form, Every)
    assert form.among.adjectives == ("through",)


def test_where_parts_are_can_be_what_is_asked() -> None:
    asked = [form for form in forms("Do the cross holes run into the bore?") if isinstance(form, Every)]
    assert [(form.target.places, len(form.among.places)) for form in asked[:1]] == [((), 1)]


def test_whether_there_is_play_is_a_distance_and_no_part() -> None:
    found = forms("Is there any play between the spindle and the bush?")
    assert any(isinstance(form, Check) and isinstance(form.left, Distance) for form in found)
    assert not any(isinstance(form, Exists) for form in found)


def test_as_wide_as_is_as_much() -> None:
    form = next(form for form in forms("Is the lug as wide as the rib?") if isinstance(form, Check))
    assert form.relation is Relation.EQUAL
    assert "as much as the width of the rib" in describe(form)
    assert isinstance(form, CLOSED)


@pytest.mark.parametrize(
    "question",
    ["The cover has six slots. Is that correct?", "It has six slots. Is that number correct?"],
)
def test_a_number_that_is_told_is_compared_with_that_of_the_parts(question: str) -> None:
    check = next(form for form in forms(question) if isinstance(form, Check))
    assert isinstance(check.left, Count)
    assert (check.left.target.count, check.relation, check.low) == (None, Relation.EQUAL, 6.0)


def test_to_come_out_at_a_side_is_said_of_the_parts() -> None:
    asked = next(form for form in forms("Do the keyways on the left emerge at the top?") if isinstance(form, Every))
    assert (asked.target.sides, asked.among.sides) == ((Side.LEFT,), (Side.TOP,))


def test_a_word_before_a_noun_is_not_what_is_asked_of_it() -> None:
    asked = [form for form in forms("Are the lever slots through?") if isinstance(form, Every)]
    assert asked
    assert all(form.among.places == form.target.places for form in asked)


@pytest.mark.parametrize(
    ("question", "noun", "word"),
    [
        ("How wide is the narrower section of the keyway?", "keyway", "narrower"),
        ("How wide is the slender end of the cone?", "cone", "slender"),
    ],
)
def test_a_part_of_a_hole_or_a_cone_is_measured_on_it(question: str, noun: str, word: str) -> None:
    targets = [form.target for form in forms(question) if isinstance(form, Get) and form.target]
    assert any(target.noun == noun and word in target.adjectives and not target.places for target in targets)


@pytest.mark.parametrize(
    ("question", "closed"),
    [
        ("The slot goes right through?", True),
        ("Lugs are on the left side?", True),
        ("Lugs on the left side?", False),
        ("The slot that runs through the hub?", False),
        ("The lugs are how thick?", False),
        ("Lugs are left or right?", False),
        ("Slots all of the same width?", True),
        ("Distance of the lugs on the same flange?", False),
    ],
)
def test_what_is_said_with_a_question_mark_is_answered_by_yes_or_no(question: str, closed: bool) -> None:
    assert Question(question).closed is closed


@pytest.mark.parametrize(
    ("question", "sides"),
    [
        ("Up, down or left: which way does the keyway open?", (Side.TOP, Side.BOTTOM, Side.LEFT)),
        ("Is the lug on the top, the front or the back?", (Side.TOP, Side.FRONT, Side.BACK)),
        ("Seen from the front, is the lug the left one or the right one?", (Side.LEFT, Side.RIGHT)),
        ("The lug, seen from the front, is it on the left or on the right?", (Side.LEFT, Side.RIGHT)),
        ("Which is the lug: the left one, the right one or the back one?", (Side.LEFT, Side.RIGHT, Side.BACK)),
    ],
)
def test_the_sides_to_choose_from_are_those_that_are_offered(question: str, sides: tuple[Side, ...]) -> None:
    assert {form.sides for form in forms(question) if isinstance(form, Towards)} == {sides}


@pytest.mark.parametrize(
    ("question", "seen"),
    [
        ("Which sides do not have a groove?", "none"),
        ("To which side does the groove open, the one that does not end in a bore?", ""),
    ],
)
def test_only_sides_that_are_denied_are_those_without(question: str, seen: str) -> None:
    assert {form.seen or "" for form in forms(question) if isinstance(form, Towards)} == {seen}


@pytest.mark.parametrize(
    ("question", "exists"), [("Is there a rib?", True), ("What angle is there from one rib to the next?", False)]
)
def test_a_measure_that_is_there_is_no_yes_or_no(question: str, exists: bool) -> None:
    assert any(isinstance(form, Exists) for form in forms(question)) is exists
