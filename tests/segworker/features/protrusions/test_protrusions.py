"""Protrusions that other things stand on."""

from __future__ import annotations

import pytest
from tests.segworker.shapes import box, cut, cylinder, find, fuse, plate, prism


def test_a_block_is_as_high_as_its_own_top_and_a_block_with_a_step_as_its_highest() -> None:
    base = fuse(plate(80, 60, 5), box((60, 40, 10), (-30, -20, 0)))
    (block,) = find(fuse(base, cylinder(12, 15, (0, 0, 10)))).of("protrusion")
    assert block.height == pytest.approx(0.010)
    (stepped,) = find(fuse(base, box((30, 40, 15), (-30, -20, 10)))).of("protrusion")
    assert stepped.height == pytest.approx(0.025)


def test_a_pad_with_holes_deeper_than_it_is_high_is_as_high_as_one_without() -> None:
    plain = fuse(box((120, 80, 25)), box((90, 50, 6), (15, 15, 25)))
    bored = cut(plain, *(cylinder(5, 28, (x, 40, 3)) for x in (40, 80)))
    for shape in (plain, bored):
        (pad,) = find(shape).of("protrusion")
        assert (pad.height, pad.extents[2]) == pytest.approx((0.006, 0.006))
        assert pad.center[2] == pytest.approx(0.028)


@pytest.mark.parametrize("ramp", [0.0, 20.0])
def test_a_long_low_ridge_is_a_rib_also_between_ramps_and_a_strip_and_a_short_pad_are_none(ramp: float) -> None:
    side = [(30, 30, 20), (270, 30, 20), (270 - ramp, 30, 26), (30 + ramp, 30, 26)]
    (ridge,) = find(fuse(box((300, 80, 20)), prism(side, (0, 7, 0)))).of("rib")
    assert (ridge.thickness, ridge.height) == pytest.approx((0.007, 0.006))
    for size in ((150, 20, 3), (40, 10, 5)):
        assert not find(fuse(box((300, 80, 20)), box(size, (30, 30, 20)))).of("rib")


def test_the_edge_of_a_plate_that_stands_out_a_little_is_no_low_rib() -> None:
    upright = box((19, 64, 152), (0, -32, -152))
    assert not find(fuse(upright, box((120, 40, 19), (0, -20, -152)), box((30, 40, 19), (-30, -20, -80)))).of("rib")
