"""Bores that cross inside are one passage, and open at each of their ends."""

from typing import Any

import pytest
from tests.made import hole, whole

from querycad_answering.programs import write
from querycad_contracts import Part, PartQuery
from querycad_language.forms import Count

OPENINGS = PartQuery(noun="opening", plural=True)
ACROSS: dict[str, Any] = {"axis": (1.0, 0.0, 0.0), "normal": (1.0, 0.0, 0.0)}
BORE = hole(1, depth=0.05, diameter=0.012)


@pytest.mark.parametrize(
    ("other", "all_ends"),
    [
        (hole(2, depth=0.05, diameter=0.012, **ACROSS), True),  # a cross of pipe
        (hole(2, 15, depth=0.02, diameter=0.012, bottom="bore", tags=("cross",), **ACROSS), True),  # a tee
        (hole(2, 16, depth=0.019, diameter=0.004, **ACROSS), False),  # through the wall of a tube
        (hole(2, 40, depth=0.05, diameter=0.012), False),  # beside it
    ],
)
def test_openings_of_a_passage_are_the_ends_of_its_bores(other: Part, all_ends: bool) -> None:
    code = write(Count(OPENINGS), {OPENINGS: ((BORE, other), 0)}, whole()).code
    assert ("openings" in code) == all_ends


def test_holes_that_cross_are_counted_as_holes() -> None:
    query = PartQuery(noun="hole", plural=True)
    both = (BORE, hole(2, depth=0.05, diameter=0.012, **ACROSS))
    assert "openings" not in write(Count(query), {query: (both, 0)}, whole()).code
