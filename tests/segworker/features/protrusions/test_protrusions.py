"""Protrusions that other things stand on."""

from __future__ import annotations

import pytest
from tests.segworker.shapes import box, cylinder, find, fuse, plate


def test_a_block_is_as_high_as_its_own_top_and_a_block_with_a_step_as_its_highest() -> None:
    base = fuse(plate(80, 60, 5), box((60, 40, 10), (-30, -20, 0)))
    (block,) = find(fuse(base, cylinder(12, 15, (0, 0, 10)))).of("protrusion")
    assert block.height == pytest.approx(0.010)
    (stepped,) = find(fuse(base, box((30, 40, 15), (-30, -20, 10)))).of("protrusion")
    assert stepped.height == pytest.approx(0.025)
