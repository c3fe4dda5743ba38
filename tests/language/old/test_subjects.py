"""What 'it' and 'they' stand for: the parts that a statement before the question is about."""

from __future__ import annotations

import pytest

from querycad_language.old import parse


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("A rectangular key on the top locates the finger in the jaw. How long is it?",
         "How long is the rectangular key on the top?"),
        ("Four screws hold the heat sink. How long are they?", "How long are the screws?"),
        ("I cut a long window with round ends through the beam. How wide is it?",
         "How wide is the long window with round ends through the beam?"),
        ("The spindle ends in a cone. What is the angle of it?", "What is the angle of the cone?"),
        ("The lever carries a pin. How thick is it?", "How thick is the pin?"),
    ],
)  # fmt: skip
def test_a_statement_is_about_what_its_verb_says_something_of(said: str, plain: str) -> None:
    assert parse(said).code == parse(plain).code


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("Our foil is glued into the rectangular recess on the front. How deep is it?",
         "How deep is the rectangular recess on the front?"),
        ("A rubber strip gets glued into the pocket. How long may it be at most?", "How long is the pocket?"),
        ("My rods sit in the groove. Which rod diameter fits in there exactly?", "What is the diameter of the groove?"),
    ],
)  # fmt: skip
def test_what_is_no_part_of_the_model_is_as_large_as_the_place_for_it(said: str, plain: str) -> None:
    assert parse(said).code == parse(plain).code


def test_what_is_there_already_is_no_other_part_for_being_in_a_hole() -> None:
    assert 'find_parts("the pin")' in parse("The pin sits in the hole. How long is it?").code
    assert 'find_parts("the pin")' in parse("A pin sits in the hole. How long is it?").code


def test_a_clause_without_pronoun_has_its_verb_at_the_end() -> None:
    assert 'find_parts("hole' in parse("Look at the holes the screws go in. How deep are they?").code


def test_holes_for_what_was_named_before_are_the_holes() -> None:
    code = parse("Four screws hold the heat sink to the wall. What diameters do the holes for them have?").code
    assert 'find_parts("hole for four screw")' in code
