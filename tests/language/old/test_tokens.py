"""Numbers, units and words as they are written in questions."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from querycad_language.old.tokens import Kind, edit_distance, tokenize


def quantities(text: str) -> list[tuple[float, int | None]]:
    return [(token.value, token.power) for token in tokenize(text) if token.kind is Kind.NUMBER]


@pytest.mark.parametrize(
    ("text", "value", "power"),
    [
        ("5.5 mm", 0.0055, 1),
        ("5.5mm", 0.0055, 1),
        ("5,5 mm", 0.0055, 1),
        (".5 mm", 0.0005, 1),
        ("1,000 mm", 1.0, 1),
        ("0,125 mm", 0.000125, 1),
        ("3 cm", 0.03, 1),
        ("2 m", 2.0, 1),
        ("100 µm", 0.0001, 1),
        ("1/4 inch", 0.00635, 1),
        ('1/4"', 0.00635, 1),
        ("1 1/2 in", 0.0381, 1),
        ("0.2 inches", 0.00508, 1),
        ("5 thou", 0.000127, 1),
        ("2 ft", 0.6096, 1),
        ("20 mm²", 2e-5, 2),
        ("20 mm2", 2e-5, 2),
        ("20 square millimetres", 2e-5, 2),
        ("3 cubic centimeters", 3e-6, 3),
        ("45°", math.pi / 4, 0),
        ("90 degrees", math.pi / 2, 0),
        ("12", 12.0, None),
        ("twelve", 12.0, None),
    ],
)
def test_a_quantity_is_read_in_si(text: str, value: float, power: int | None) -> None:
    [(found, found_power)] = quantities(text)
    assert math.isclose(found, value, rel_tol=1e-9)
    assert found_power == power


@pytest.mark.parametrize("text", ["4 to 6 mm", "4-6 mm", "4 – 6 mm", "between 4 and 6 mm"])
def test_a_range_shares_its_unit(text: str) -> None:
    assert quantities(text) == [(0.004, 1), (0.006, 1)]


def test_in_is_a_unit_only_where_no_phrase_begins() -> None:
    assert quantities("5.5 in diameter")[0][1] is None
    assert quantities("5 in the plate")[0][1] is None
    assert quantities("5 in deep")[0] == (0.127, 1)


@pytest.mark.parametrize(("text", "words"), [("2 M3 screws", ["2", "m3", "screws"]), ("M5 hole", ["m5", "hole"])])
def test_a_thread_is_no_volume(text: str, words: list[str]) -> None:
    assert [token.word for token in tokenize(text)] == words


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("left-hand side", ["left", "hand", "side"]),
        ("x-direction", ["x", "direction"]),
        ("u-shaped slot", ["u-shaped", "slot"]),
        ("the shaft's tip", ["the", "shaft", "'s", "tip"]),
        ("what's it", ["what", "is", "it"]),
        ("isn't", ["is", "not"]),
        ("Ø5.5", ["diameter", "5.5"]),
        ("R2", ["radius", "2"]),
        ("2nd", ["2nd"]),
        ("3D model", ["3d", "model"]),
    ],
)
def test_words_are_folded(text: str, words: list[str]) -> None:
    assert [token.word for token in tokenize(text)] == words


@given(st.text(max_size=300))
def test_any_text_has_tokens_or_none(text: str) -> None:
    for token in tokenize(text):
        assert token.word
        assert math.isfinite(token.value)


@given(st.text("abc", max_size=6), st.text("abc", max_size=6))
def test_edit_distance_is_a_symmetric_distance(a: str, b: str) -> None:
    assert edit_distance(a, b) == edit_distance(b, a)
    assert (edit_distance(a, b) == 0) == (a == b)
    assert edit_distance(a, b) <= max(len(a), len(b))


def test_swapped_neighbours_are_one_edit() -> None:
    assert edit_distance("daimeter", "diameter") == 1
    assert edit_distance("visable", "visible") == 1
