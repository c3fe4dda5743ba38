"""'Not counting the bore': what a question excepts is taken out of the parts that it counts or lists."""

from __future__ import annotations

import pytest

from querycad_language.old.exceptions import exception
from querycad_language.old.parser import parse


@pytest.mark.parametrize(
    "question",
    [
        "How many holes are there, the bore not counted?",
        "How many holes are there, not counting the bore?",
        "How many holes are there except the bore?",
        "Except for the bore, how many holes are there?",
        "How many holes, leaving out the bore, are there?",
        "How many holes are there if you don't count the bore?",
        "How many holes are there, the bore excluded?",
    ],
)
def test_an_excepted_part_is_taken_out_of_those_counted(question: str) -> None:
    code = parse(question).code
    assert 'find_parts("hole")' in code
    assert 'find_parts("the bore")' in code
    assert "p.id not in ids" in code


@pytest.mark.parametrize(
    ("question", "excepted"),
    [
        ("What are the diameters of all holes, excluding the threaded ones?", 'find_parts("threaded hole")'),
        ("How many ribs does the cover have, without the short one?", 'find_parts("the short rib")'),
        ("How many holes besides the four mounting holes are there?", 'find_parts("4 mounting hole")'),
        ("Apart from the main bore, how many holes does the plate have?", 'find_parts("the main bore")'),
        ("Is there any hole besides the bore?", 'find_parts("the bore")'),
        ("What is the number of parts, screws not counted?", 'find_parts("screw")'),
    ],
)
def test_what_is_excepted_may_be_named_in_many_ways(question: str, excepted: str) -> None:
    code = parse(question).code
    assert excepted in code
    assert "p.id not in ids" in code


@pytest.mark.parametrize(
    ("question", "plain"),
    [
        ("How many blind holes are there, excluding those on the bottom?",
         "How many blind holes are there that are not on the bottom?"),
        ("How many holes are there except those larger than 10 mm?",
         "How many holes are there that are not larger than 10 mm?"),
    ],
)  # fmt: skip
def test_those_that_are_excepted_by_what_they_are_or_where_are_denied_that(question: str, plain: str) -> None:
    assert parse(question).code == parse(plain).code


@pytest.mark.parametrize(
    "question",
    [
        "How deep is the hole, not counting the drill tip?",
        "What is the length of the screw without the head?",
        "How long are the screws, without the head?",
        "How thick are the flanges, not counting the raised face?",
        "How many holes have no ring?",
        "How many holes without a ring are there?",
    ],
)
def test_a_shorter_measure_and_a_missing_trait_are_no_exception(question: str) -> None:
    assert "p.id not in ids" not in parse(question).code


def test_a_question_without_exception_has_none() -> None:
    assert exception("How many holes are there?") is None
