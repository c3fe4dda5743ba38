"""Values against each other: which candidate tells of a value that several give."""

from __future__ import annotations

from dataclasses import replace

from tests.made import hole, part, view

from querycad_answering.affinity import Affinity
from querycad_answering.candidates import Candidate, candidates
from querycad_answering.ranking import ranked
from querycad_language.readings import read

MODEL = view(hole(1, faces=(1,)), part("slot-1", (0.03, 0.0, 0.0), width=0.005, depth=0.01, faces=(2,)))


def candidate(features: dict[str, float], *skipped: tuple[str, str]) -> Candidate:
    """One that gives 5 mm, and passes over these words."""
    one = candidates(read("How wide is the slot?"), MODEL.ground, MODEL.whole, Affinity((), MODEL.whole))[0]
    return replace(one, features=features, reading=replace(one.reading, skipped=skipped), value=0.005)


def test_a_value_is_told_by_the_reading_that_passes_over_least() -> None:
    likeliest = candidate({"link_of": 1.0}, ("noun", "hole"))
    whole, far = candidate({"link_of": 0.9}, ("chatter", "please")), candidate({"link_of": -9.0})
    (value,) = ranked([likeliest, whole, far]).values
    assert value.candidate is whole
    alone = ranked([likeliest, far]).values[0]
    assert alone.candidate is likeliest  # the other one is far less likely
