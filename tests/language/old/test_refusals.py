"""What is not understood is declined: it is never read as something else."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from querycad_language.old import EmptyQuestion, NotUnderstood, ParseError, parse
from querycad_language.old.lexicon import LEXICON
from querycad_language.old.questions import question
from querycad_language.old.text import Text
from querycad_language.old.tokens import tokenize


@pytest.mark.parametrize("text", ["", "   ", "\n\t"])
def test_an_empty_question_has_an_error_of_its_own(text: str) -> None:
    with pytest.raises(EmptyQuestion):
        parse(text)


@pytest.mark.parametrize(
    ("text", "language"),
    [
        ("Wie viele Löcher hat das Bauteil?", "German"),
        ("Welchen Durchmesser haben die Bohrungen?", "German"),
        ("Combien de trous y a-t-il dans la pièce ?", "French"),
        ("¿Cuántos agujeros tiene la pieza?", "Spanish"),
        ("Quanti fori ci sono?", "Italian"),
    ],
)
def test_another_language_is_named(text: str, language: str) -> None:
    with pytest.raises(NotUnderstood, match=language):
        parse(text)


@pytest.mark.parametrize("text", ["有多少个孔？", "Сколько отверстий?", "穴はいくつありますか"])
def test_other_scripts_are_declined_as_not_english(text: str) -> None:
    with pytest.raises(NotUnderstood, match="English"):
        parse(text)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("What is the weight of the object?", "density"),
        ("What material is the part made of?", "material"),
        ("How much does the part cost?", "Prices"),
        ("What is the surface finish of the shaft?", "Tolerances"),
        ("How many holes are there? And how deep are they?", "one question at a time"),
        ("What is the axis of the object?", "whole model has no axis"),
    ],
)
def test_what_a_model_does_not_tell_is_said(text: str, reason: str) -> None:
    with pytest.raises(NotUnderstood, match=reason):
        parse(text)


@pytest.mark.parametrize(
    "text",
    [
        "How many holes with the same diameter are on the top?",
        "What percentage of the holes are blind?",
        "Is the base plate round or rectangular?",
        "Are the holes on the top through or blind?",
        "Which side has the most holes?",
        "What size of screw fits in the holes?",
        "What is the minimum thickness between two holes?",
        "How many countersunk holes are on the top, and how many on the bottom?",
        "Is the hole on the left coaxial with the hole on the right?",
        "Is the part twice as wide as it is deep?",
        "Does the object fit in a box of 100 x 60 x 50 mm?",
        "Where on the x axis is the shaft?",
        "What is the meaning of the holes?",
        "How many?",
        "the holes on the top",
        "Hello!",
        "asdf qwer zxcv",
    ],
)
def test_a_word_that_changes_the_meaning_is_not_passed_over(text: str) -> None:
    with pytest.raises(NotUnderstood):
        parse(text)


def test_a_refusal_names_the_words_and_near_terms() -> None:
    with pytest.raises(NotUnderstood) as refusal:
        parse("What is the widness of the shaft?")
    assert refusal.value.unused_words == ("widness", "shaft") or "widness" in refusal.value.unused_words
    assert "width" in refusal.value.nearest or "thickness" in refusal.value.nearest


def test_words_that_say_nothing_are_listed_as_unused() -> None:
    program = parse("How deep are the blind holes on the top maybe?")
    assert program.unused_words
    assert program.confidence < 1


@settings(max_examples=300)
@given(st.text(max_size=200))
def test_any_text_is_parsed_or_declined(text: str) -> None:
    try:
        program = parse(text)
    except ParseError:
        return
    assert "solution = " in program.code


WORDS = [*sorted(LEXICON.words), "gizmo", "5.5", "mm", "M5", "'s", ",", "?", "(", "12", '"', "plate", "screws"]


@settings(max_examples=500, deadline=None)
@given(st.lists(st.sampled_from(WORDS), max_size=30))
def test_any_mix_of_the_grammars_words_is_parsed_or_declined(words: list[str]) -> None:
    try:
        program = parse(" ".join(words))
    except ParseError:
        return
    compile(program.code, "<program>", "exec")


@pytest.mark.parametrize(
    "repeated",
    [
        "the radius of the hole and",
        "the distance between the hole in the flange of the plate and",
        "is the",
        "holes and",
        "the hole closest to the hole deeper than",
        "with a diameter of 5 mm or",
    ],
)
def test_the_work_grows_with_the_cube_of_the_length_at_most(repeated: str) -> None:
    def work(times: int) -> int:
        text = Text(tokenize("What is " + f"{repeated} " * times + "the slot?"))
        question(text)
        return len(text.book.known)

    assert work(8) <= 8 * work(4) + 100


def test_a_text_longer_than_any_question_is_declined() -> None:
    with pytest.raises(NotUnderstood, match="too long"):
        parse("How many holes " + "and holes " * 50)
