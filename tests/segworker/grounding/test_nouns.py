"""Nouns that mean part of what is of one shape."""

from __future__ import annotations

import pytest
from tests.made import inventory, part
from tests.segworker.grounding.plate import SMALL, ids

from querycad_contracts import PartQuery
from querycad_segworker.grounding.ground import ground


@pytest.mark.parametrize(("noun", "meant"), [("ball", {1, 2}), ("sphere", {1, 2, 3})])
def test_balls_stand_out_and_spheres_may_be_hollow_too(noun: str, meant: set[int]) -> None:
    balls = [part(f"sphere-{n}", (0.02 * n, 0.0, 0.0), tags=("outer", "spherical"), diameter=0.03) for n in (1, 2)]
    hollow = part("sphere-3", (0.09, 0.0, 0.0), tags=("inner", "spherical"), diameter=0.025)
    ways = ground(inventory(SMALL, *balls, hollow), PartQuery(noun=noun, words=(noun,), plural=True))
    assert ids(ways[0]) == {f"sphere-{n}" for n in meant}
