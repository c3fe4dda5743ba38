"""Pairs of words and traits of programs: the same place for the same pair, and one weight for each."""

from __future__ import annotations

import pytest

from querycad_answering import affinity
from querycad_answering.affinity import SLOTS, Affinity, code, grams, packed, slot, traits, unpacked


def test_numbers_are_one_word_and_articles_none() -> None:
    assert grams(["the", "5", "hole"]) == ["0", "hole", "0 hole", "the 0"]
    assert grams([]) == []


def test_traits_are_what_a_program_is_and_not_what_it_gave() -> None:
    features = {"form_get": 1.0, "depth as {0}.depth": 1.0, "depth of hole": 0.5, "value_digits": 2.0, "words": 1.0}
    assert traits(features) == [
        "form_get", "depth as {0}.depth", "depth of hole", "kind hole", "measure depth",
    ]  # fmt: skip
    assert traits({"form_get": 0.0}) == []


def test_a_packed_table_says_what_was_fitted(monkeypatch: pytest.MonkeyPatch) -> None:
    weights = [0.0] * SLOTS
    at = slot(code("hole"), code("form_count"))
    weights[at], weights[(at + 1) % SLOTS] = 0.5, -1.0
    table = unpacked(packed(weights))
    monkeypatch.setattr(affinity, "_table", lambda: table)
    assert Affinity(["hole"]).of({"form_count": 1.0}) == pytest.approx(0.5, abs=0.01)
    assert Affinity(["hole", "slot"]).of({"form_count": 1.0}) == pytest.approx(0.5 / 3**0.5, abs=0.01)
    assert Affinity(["slot"]).of({"form_count": 1.0}) == 0.0
    assert Affinity([]).of({"form_count": 1.0}) == 0.0


def test_the_shipped_table_has_a_place_for_every_pair() -> None:
    _, steps = affinity._table()
    assert len(steps) == SLOTS
