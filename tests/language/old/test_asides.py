"""What is said beside a question neither becomes a part of it nor goes unmentioned."""

from __future__ import annotations

import pytest

from querycad_language.old import parse


@pytest.mark.parametrize(
    ("plain", "longer"),
    [
        ("How deep are the blind holes?", "How deep are the blind holes? They were drilled first."),
        ("How many bosses are there?", "How many bosses (raised pads) are there?"),
        ("How long is the tube?", "How long is the tube from the inlet to the outlet?"),
        ("What is the depth of the blind hole?", "What is the depth of the blind hole, not counting the drill cone?"),
        ("How wide is the lid?", "How wide is the lid, hinges included?"),
        ("What is the size of the lid?", "What is the size of the lid (width, depth and height)?"),
        ("How many holes are in the lid?", "How many holes are in the rim of the lid?"),
    ],
)
def test_an_aside_leaves_the_program_and_is_noted(plain: str, longer: str) -> None:
    program = parse(longer)
    assert program.code == parse(plain).code
    assert program.confidence < parse(plain).confidence
    assert any(note.startswith("Left out: ") for note in program.notes)


@pytest.mark.parametrize(
    "asked",
    [
        "How many holes (5 mm) are there?",
        "How many holes (visible from the top) are there?",
        "What is the distance from the shaft to the flange?",
        "What is the distance between the shaft and the flange?",
        "How many holes are there with a depth from 5 to 10 mm?",
        "How many holes with a chamfer are on the top?",
    ],
)
def test_what_selects_or_measures_is_no_aside(asked: str) -> None:
    assert not any(note.startswith("Left out: ") for note in parse(asked).notes)


def test_a_pronoun_stands_for_what_the_sentence_before_speaks_of() -> None:
    stated = parse("The part has a tapped hole. How deep is it?")
    assert 'find_parts("the tapped hole")' in stated.code
    assert "'it' is read as 'a tapped hole'." in stated.notes
