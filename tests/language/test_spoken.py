"""What is said aloud, and what a clause has elsewhere."""

from __future__ import annotations

import pytest

from querycad_language.spoken import written
from querycad_language.text import Text


@pytest.mark.parametrize(
    ("said", "text"),
    [
        ("wider than um five millimetres", "wider than 5 millimetres"),
        ("longer than a hundred mm", "longer than 100 mm"),
        ("two hundred by a hundred by fifty millimetres", "200 by 100 by 50 millimetres"),
        ("a twelve point five mm bore", "a 12.5 mm bore"),
        ("half an inch", "0.5 inch"),
        ("two and a half millimetres", "2.5 millimetres"),
        ("the second one of two", "the second one of two"),
        ("5 um thick", "5 um thick"),
    ],
)
def test_numbers_in_words_before_a_unit_are_digits(said: str, text: str) -> None:
    assert written(said) == text


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("Of the slots, how many are open?", "how many of the slot are open ?"),
        ("The largest boss, has it more than 10 mm?", "has the largest boss more than 10 mm ?"),
        ("For the slot, how deep is it?", "how deep is the slot ?"),
        ("Ribs: how many does the part have?", "how many rib does the part have ?"),
        ("What slots do we have that are open?", "what slot that are open ?"),
        ("The pins, which are M5, how long are they?", "the pin , which are m5 , how long are they ?"),
    ],
)
def test_what_stands_before_its_clause_is_put_into_it(said: str, meant: str) -> None:
    assert " ".join(Text(said).words) == meant
