"""The ways of a family ask the same, and have the same answer."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from benchmark.paraphrases.__main__ import ways

from querycad.runtime import EmbeddedRuntime

FLANGE = Path(__file__).parents[2] / "examples" / "flange.step"
MOST = 0.85
"""The share of ways that have to agree with most of their family."""


@pytest.fixture(scope="module")
def runtime() -> Iterator[EmbeddedRuntime]:
    with EmbeddedRuntime() as runtime:
        yield runtime


@pytest.mark.parametrize("family", ["how many", "through holes", "blind holes", "there is", "yes or no, true", "depth"])
def test_the_ways_to_ask_agree(runtime: EmbeddedRuntime, family: str) -> None:
    asked = list(ways(runtime, FLANGE, frozenset((family,))))
    odd = [(way.question, way.answer, way.most) for way in asked if way.answer != way.most]
    assert len(asked) >= 8
    assert len(odd) <= (1 - MOST) * len(asked), odd
