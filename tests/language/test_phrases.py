"""Noun phrases become typed queries: all that restricts is in a field of its own."""

from __future__ import annotations

from typing import Any

import pytest

from querycad_contracts import Measure, PartQuery, Relation, Side
from querycad_language.phrases import noun_phrase

NONE: frozenset[str] = frozenset()


def said(phrase: str, **fields: Any) -> None:
    query = noun_phrase(phrase, NONE)
    assert {name: getattr(query, name) for name in fields} == fields


def test_a_plain_noun_is_its_entry_of_the_lexicon() -> None:
    said("bores", noun=noun_phrase("bore", NONE).noun, plural=True, definite=False, known=True)
    said("the slot", noun="slot", plural=False, definite=True)


@pytest.mark.parametrize(
    ("phrase", "fields"),
    [
        ("three slots", {"count": 3}),
        ("4x slots", {"count": 4}),
        ("slot 4", {"ids": ("slot-4",)}),
        ("M6 screws", {"threads": ("m6",)}),
        ("red body", {"colors": ("red",)}),
        ("the left leg", {"ends": (Side.LEFT,)}),
        ("gronk slot", {"unknown": ("gronk",), "noun": "slot"}),
        ("the plumber recess", {"unknown": ("plumber",), "noun": "recess"}),
        ("the angled recess", {"adjectives": ("angled",), "noun": "recess"}),
        ("one humming lug", {"unknown": ("humming",), "noun": "lug"}),
        ("one of the slots", {"sample": True}),
        ("slots on the left side", {"sides": (Side.LEFT,)}),
        ("the slots underneath", {"sides": (Side.BOTTOM,)}),
        ("this lever", {"deictic": True, "definite": True}),
        ("my lever", {"deictic": True}),
        ("the lever", {"deictic": False}),
    ],
)
def test_each_restriction_has_its_field(phrase: str, fields: dict[str, Any]) -> None:
    said(phrase, **fields)


def test_sizes_keep_measure_and_relation() -> None:
    (deep,) = noun_phrase("slots deeper than 11 mm", NONE).sizes
    assert [deep.measure, deep.relation, deep.low] == [Measure.DEPTH, Relation.MORE, pytest.approx(0.011)]
    (plain,) = noun_phrase("5 mm slots", NONE).sizes
    assert [plain.measure, plain.relation, plain.low] == [None, Relation.EQUAL, pytest.approx(0.005)]


def test_ranks_are_by_measure_or_by_nearness() -> None:
    (largest,) = noun_phrase("the largest slot", NONE).ranks
    assert largest.most
    (second,) = noun_phrase("the second deepest slot", NONE).ranks
    assert (second.measure, second.nth) == (Measure.DEPTH, 2)
    assert not second.is_unordered
    (near,) = noun_phrase("the slot nearest to the boss", NONE).ranks
    assert near.near is not None
    assert near.near.noun == "boss"


def test_an_ordinal_alone_says_that_there_are_so_many() -> None:
    (third,) = noun_phrase("the third slot", NONE).ranks
    assert (third.nth, third.is_unordered) == (3, True)
    for phrase in ("the first slot", "the next slot"):
        assert not noun_phrase(phrase, NONE).ranks


def test_places_are_queries_themselves() -> None:
    (place,) = noun_phrase("the slots in the flange", NONE).places
    assert isinstance(place.what, PartQuery)
    assert (place.relation, place.what.noun) == ("in", "flange")


def test_exceptions_and_further_kinds_are_queries_too() -> None:
    assert noun_phrase("slots except the blind ones", NONE).excluded
    assert [other.noun for other in noun_phrase("slots and pockets", NONE).also] == ["pocket"]


def test_underneath_something_is_no_side() -> None:
    query = noun_phrase("the slot underneath the boss", NONE)
    assert not query.sides
    assert [place.relation for place in query.places] == ["below"]
