"""Which ways to ground the queries of a question are followed."""

from __future__ import annotations

import pytest
from tests.made import hole, part, view, whole

from querycad_answering.affinity import Affinity
from querycad_answering.candidates import GUESSED, GUESSES, Candidate, candidates
from querycad_language.readings.reader import Reader

SLOTS = [part(f"slot-{n}", (0.01 * n, 0.0, 0.0), width=0.003 + 0.001 * n, length=0.02, depth=0.004) for n in range(9)]
RIBS = [part(f"rib-{n}", (0.01 * n, 0.01, 0.0), thickness=0.002 * n, height=0.005 * n) for n in (1, 2)]
PARTS = (*SLOTS, *RIBS, hole(1, -20), hole(2, 0, diameter=0.012))


def found(question: str, limit: int = 60) -> list[Candidate]:
    reader = Reader(question)
    return candidates(reader.readings, view(*PARTS).ground, whole(), Affinity(reader.text.words, whole()), limit)


def test_what_a_noun_does_not_mean_is_guessed_behind_what_it_means() -> None:
    tried = found("How deep is the hole?")
    guesses = [one for one in tried if GUESSED in one.features]
    assert GUESSED not in tried[0].features
    assert guesses
    assert all(one.features["guessed_known"] for one in guesses)
    assert {one.kind for guess in guesses for way in guess.grounds.values() for one in way.parts} <= {"slot", "rib"}
    assert len({tuple(part.id for part in way.parts) for one in guesses for way in one.grounds.values()}) <= GUESSES


def test_of_a_noun_that_is_not_known_it_is_another_guess() -> None:
    guesses = [one for one in found("How thick is the vestibule?") if GUESSED in one.features]
    assert guesses
    assert not any("guessed_known" in one.features for one in guesses)


@pytest.mark.parametrize("question", ["How many holes are there?", "Is there a hole?", "Are all holes blind?"])
def test_what_is_counted_or_decided_is_not_guessed(question: str) -> None:
    assert not any(GUESSED in one.features for one in found(question))


def test_of_two_parts_one_is_guessed_at_most() -> None:
    tried = found("How far is the hole from the rib?", 400)
    counts = [sum(GUESSED in way.features for way in one.grounds.values()) for one in tried]
    assert set(counts) == {0, 1}
