"""Pairs of words and traits of programs: the same place for the same pair, and one weight for each."""

from __future__ import annotations

import pytest
from tests.made import hole, whole

from querycad_answering import affinity
from querycad_answering.affinity import PART_SHARE, SLOTS, Affinity, code, grams, packed, placed, slot, traits, unpacked
from querycad_contracts import Grounded

WHOLE = whole()


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
    assert Affinity(["hole"], WHOLE).of({"form_count": 1.0}) == pytest.approx(0.5, abs=0.01)
    assert Affinity(["hole", "slot"], WHOLE).of({"form_count": 1.0}) == pytest.approx(0.5 / 3**0.5, abs=0.01)
    assert Affinity(["slot"], WHOLE).of({"form_count": 1.0}) == 0.0
    assert Affinity([], WHOLE).of({"form_count": 1.0}) == 0.0


def test_single_words_are_paired_with_what_the_parts_of_each_query_are(monkeypatch: pytest.MonkeyPatch) -> None:
    weights = [0.0] * SLOTS
    for words, place, weight in (("hole", 0, 1.0), ("hole", 1, -1.0), ("the hole", 0, 4.0)):
        weights[slot(code(words), code(placed(place, "is hole")))] = weight
    monkeypatch.setattr(affinity, "_table", lambda: unpacked(packed(weights)))
    way, other = (Grounded(parts=parts, features={}) for parts in ((hole(1),), ()))
    asked = Affinity(["the", "hole"], WHOLE)  # two grams: "hole" and "the hole"
    assert asked.of({}, [way]) == pytest.approx(PART_SHARE / 2**0.5, rel=0.02)
    assert asked.of({}, [other, way]) == pytest.approx(-PART_SHARE / 2**0.5, rel=0.02)
    assert asked.of({}, [other, other, way]) == 0.0


def test_the_shipped_table_has_a_place_for_every_pair() -> None:
    _, steps = affinity._table()
    assert len(steps) == SLOTS
