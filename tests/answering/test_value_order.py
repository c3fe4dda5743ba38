"""Several values come in the order that the question asks for."""

from __future__ import annotations

import pytest

from querycad_answering.value_order import in_order, order_of
from querycad_contracts import AnswerType
from querycad_language.text import Text


@pytest.mark.parametrize(
    ("question", "order"),
    [
        ("Diameters of the pins, larger one first?", "descending"),
        ("Both lug widths please, smallest value first.", "ascending"),
        ("What are the rib heights, from the highest to the lowest?", "descending"),
        ("Which diameters do the bores have, small then large?", "ascending"),
        ("List the slot depths in ascending order.", "ascending"),
        ("How deep is the larger bore, and how far is it from the smaller one?", None),
        ("How wide is the first slot?", None),
    ],
)
def test_the_words_say_which_order(question: str, order: str | None) -> None:
    assert order_of(Text(question)) == order


def test_the_program_gives_lists_in_it_and_leaves_what_is_no_list() -> None:
    code = in_order("holes = parts()\nsolution = [h.depth for h in holes]", AnswerType.LENGTHS, "descending")
    assert code.splitlines()[1:] == [
        "found = [h.depth for h in holes]",
        "solution = sorted(found, reverse=True) if isinstance(found, list | tuple) else found",
    ]
    assert in_order("solution = shape.center", AnswerType.POINT, "ascending") == "solution = shape.center"
