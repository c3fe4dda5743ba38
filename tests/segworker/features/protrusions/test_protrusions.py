"""Protrusions that other things stand on."""

from __future__ import annotations

from itertools import pairwise
from math import dist

import pytest
from tests.segworker.shapes import box, cut, cylinder, find, fuse, plate, prism, turned


MM = 1e-3


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


def test_each_of_several_ribs_level_with_the_rim_is_one_and_a_lone_divider_too() -> None:
    for ends in ((-25, -21, -2, 2, 21, 25), (-25, -21)):
        starts = (-46, *ends[1::2])
        rooms = [box((x1 - x0, 52, 17), (x0, -26, -17)) for x0, x1 in zip(starts, (*ends[::2], 46), strict=True)]
        tray = find(cut(plate(100, 60, 20), *rooms))
        ribs = tray.of("rib")
        assert len([wall for wall in tray.of("wall") if "between" in wall.tags]) == len(ribs)
        assert not [rib for rib in ribs if "fin" in rib.tags]  # those stand free
        middles = [(a + b) / 2000 for a, b in zip(ends[::2], ends[1::2], strict=True)]
        assert sorted(rib.center[0] for rib in ribs) == pytest.approx(middles)
        assert [(rib.thickness, rib.height) for rib in ribs] == [pytest.approx((0.004, 0.017))] * len(middles)


def test_ribs_between_hub_and_rim_in_a_pocket_are_no_spokes_and_webs_over_openings_are_no_ribs() -> None:
    ribs = [turned(box((60, 4, 8), (0, -2, 0)), (0, 0, 1), way) for way in (0, 60, 120, 180, 240, 300)]
    wheel = fuse(cut(cylinder(70, 18), cylinder(60, 8)), cylinder(15, 8), *ribs)
    found = find(wheel)
    assert [(rib.thickness, rib.height) for rib in found.of("rib")] == [pytest.approx((0.004, 0.008))] * 6
    assert not [part for part in found.parts if "spoke" in part.tags]
    open_ = find(cut(wheel, cut(cylinder(60, 18, (0, 0, 8)), cylinder(15, 18, (0, 0, 8)))))
    assert len([part for part in open_.parts if "spoke" in part.tags]) == 6
    assert not open_.of("rib")


@pytest.mark.parametrize("lean", [0.0, 0.6])
def test_a_rib_is_in_the_middle_of_its_flanks_whether_they_have_draft_or_not(lean: float) -> None:
    """Nine of 30 mm, 2 mm thick at mid height, 8 mm apart; `lean`: of each flank from there to its foot, mm."""
    outline = [(-1 - lean, 0), (1 + lean, 0), (1 - lean, 30), (-1 + lean, 30)]
    row = [prism([(x + at, 0, z) for x, z in outline], (0, 60, 0)) for at in range(4, 72, 8)]
    shape = fuse(box((76, 60, 6), (-2, 0, -6)), *row)
    ribs = find(shape).of("rib")
    assert sorted(rib.center[0] for rib in ribs) == pytest.approx([at * MM for at in range(4, 72, 8)])
    for rib in ribs:
        assert (*rib.center[1:], rib.extents[2]) == pytest.approx((30 * MM, 15 * MM, 30 * MM))
    placed = sorted(rib.center for rib in find(turned(shape, (1, 2, 3), 35)).of("rib"))
    assert [dist(a, b) for a, b in pairwise(placed)] == pytest.approx(8 * [8 * MM])
