"""What parts are called in the sentence that says how a question was understood."""

from __future__ import annotations

import pytest

from querycad_contracts import Measure, PartQuery, Rank
from querycad_language.describe import noun_phrase


@pytest.mark.parametrize(
    ("rank", "phrase"),
    [
        (Rank(measure=Measure.MAGNITUDE), "the largest rib"),
        (Rank(measure=Measure.HEIGHT, most=False), "the lowest rib"),
        (Rank(measure=Measure.WIDTH, nth=2), "the second widest rib"),
        (Rank(measure=Measure.VOLUME, most=False), "the smallest (by volume) rib"),
    ],
)
def test_a_rank_is_told_by_the_superlative_of_its_measure(rank: Rank, phrase: str) -> None:
    assert noun_phrase(PartQuery(noun="rib", ranks=(rank,), definite=True)) == phrase
