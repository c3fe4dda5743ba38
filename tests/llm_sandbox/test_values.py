"""Results as plain data: what has a plain form, and what is refused with which words."""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.llm_sandbox.conftest import make_body, make_face, make_part, make_shape

from querycad_sandbox.values import MAX_DEPTH, MAX_ITEMS, MAX_TEXT_CHARS, UnfitError, plain


def nested(depth: int) -> list[Any]:
    value: list[Any] = []
    for _ in range(depth):
        value = [value]
    return value


def shared(levels: int) -> list[Any]:
    """A list of 10^levels values in memory of 10 x levels."""
    value: list[Any] = [0.0] * 10
    for _ in range(levels - 1):
        value = [value] * 10
    return value


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (None, None),
        (True, True),
        (3, 3),
        (2**63 - 1, 2**63 - 1),
        (0.5, 0.5),
        ("5 mm", "5 mm"),
        ("", ""),
        ((1.0, 2.0, 3.0), [1.0, 2.0, 3.0]),
        ([(0.0, 1.0), [2, "a"]], [[0.0, 1.0], [2, "a"]]),
        ({3.0, 1.0, 2}, [1.0, 2, 3.0]),
        (frozenset({"b", "a"}), ["a", "b"]),
        ({(2, 1), (1, 2)}, [[1, 2], [2, 1]]),
        (make_part("hole-3"), {"part": "hole-3"}),
        ([make_face(4), make_part("hole-3")], [{"face": 4}, {"part": "hole-3"}]),
        ("<b>bold</b>", "<b>bold</b>"),
        ("a range(1, 2) in a text", "a range(1, 2) in a text"),
    ],
)
def test_a_value_has_one_plain_form(value: object, expected: object) -> None:
    found = plain(value)
    assert found == expected
    assert type(found) is type(expected)


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (math.nan, "is not a finite number"),
        ([1.0, -math.inf], "is not a finite number"),
        (2**63, "an integer of more than 64 bit"),
        (-(10**400), "an integer of more than 64 bit"),
        ({"a": 1}, "is a dict"),
        (Counter("aab"), "is a dict"),
        ([{}], "is a dict"),
        (b"bytes", "holds 'bytes'"),
        (1j, "holds 'complex'"),
        (object(), "holds 'object'"),
        (int, "holds 'int'"),
        (ValueError("x"), "holds 'ValueError'"),
        (make_shape(), "holds 'Shape'"),
        ([make_body()], "holds 'Body'"),
        ({1, "a"}, "have no order"),
        ([0] * MAX_ITEMS, f"more than {MAX_ITEMS:,} values"),
        (shared(7), f"more than {MAX_ITEMS:,} values"),
        (nested(MAX_DEPTH), f"deeper than {MAX_DEPTH} lists"),
        (nested(900), f"deeper than {MAX_DEPTH} lists"),
        ("a" * (MAX_TEXT_CHARS + 1), f"more than {MAX_TEXT_CHARS:,} characters"),
        (["a" * 1000] * 1100, f"more than {MAX_TEXT_CHARS:,} characters"),
        ("<function '<lambda>' at 0xc>", "which is no value"),
        ("<class 'Part'>", "which is no value"),
        ("<module 'math'>", "which is no value"),
        ("<list_iterator object>", "which is no value"),
        ("<re.Match object; span=(0, 1), match='a'>", "which is no value"),
        ("<deeply nested>", "which is no value"),
        ("range(0, 5)", "which is no value"),
        ("dict_values([2])", "which is no value"),
        ([1, "[...]"], "which is no value"),
    ],
)
def test_anything_else_is_refused(value: object, words: str) -> None:
    with pytest.raises(UnfitError, match=r"^(is|has|holds) ") as refusal:
        plain(value)
    assert words in str(refusal.value)
    assert len(str(refusal.value)) < 250


def test_the_largest_results_still_leave() -> None:
    assert len(plain([0.0] * (MAX_ITEMS - 1))) == MAX_ITEMS - 1
    assert plain(nested(MAX_DEPTH - 1)) == nested(MAX_DEPTH - 1)
    assert len(plain("a" * MAX_TEXT_CHARS)) == MAX_TEXT_CHARS


NUMBERS = (
    st.none() | st.booleans() | st.integers(-(2**63) + 1, 2**63 - 1) | st.floats(allow_nan=False, allow_infinity=False)
)


@given(st.lists(st.lists(NUMBERS | st.text("abc"), max_size=5) | NUMBERS, max_size=5))
def test_plain_data_stays_what_it_is(value: list[Any]) -> None:
    assert plain(value) == value
