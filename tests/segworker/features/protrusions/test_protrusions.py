"""Protrusions that other things stand on."""

from __future__ import annotations

import math
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


def test_the_side_of_a_block_is_no_rib_where_a_lug_touches_it_and_one_on_a_longer_foot_is() -> None:
    walled = fuse(box((60, 30, 4)), box((60, 1.2, 16)))
    for lug, ribs in ((14, 0), (30, 1)):
        assert len(find(fuse(walled, box((lug, 5, 6), (20, -5, 0)))).of("rib")) == ribs
    crossed = fuse(plate(), box((50, 2, 10), (-25, -1, 0)), box((2, 30, 10), (-1, -15, 0)))
    assert len(find(crossed).of("rib")) == 4


@pytest.mark.parametrize("degrees", [0.0, 37.0, 90.0, 180.0])
def test_a_pad_on_a_tube_is_as_high_as_it_stands_off_it_and_looks_away_from_the_axis(degrees: float) -> None:
    sides = [box((40, 40, 60), (-20, y, -10)) for y in (-45.4, 5.4)]
    shell = cut(cylinder(10.8, 14, (0, 0, 12)), *sides, box((20, 40, 60), (0, -20, -10)))
    for pad, height in ((shell, 0.0008), (box((11, 10, 14), (-11, -5, 12)), 0.001)):
        (found,) = find(turned(fuse(cylinder(10, 40), pad), (0, 0, 1), degrees)).of("protrusion")
        assert (found.height, found.length) == pytest.approx((height, 0.014))
        turn = math.radians(degrees)
        assert found.normal == pytest.approx((-math.cos(turn), -math.sin(turn), 0), abs=1e-9)


def test_a_key_in_a_bore_is_as_high_as_it_stands_out_of_the_wall_and_looks_to_the_axis() -> None:
    tube = cut(cylinder(20, 40), cylinder(15, 40))
    (key,) = find(fuse(tube, box((5, 6, 20), (-17, -3, 10)))).of("protrusion")
    assert (key.height, key.length, key.width) == pytest.approx((0.003, 0.02, 0.006))
    assert key.normal == pytest.approx((1, 0, 0))


def test_the_leaf_of_a_hinge_is_a_plate_and_no_rib_of_its_barrels() -> None:
    """A fin on a tube and the web of a T section are ribs."""
    leaf = cut(box((30, 60, 3)), *(box((4.5, 12, 3), (0, y, 0)) for y in (12, 36)))
    barrels = [cylinder(4, 12, (0, y, 3), (0, 1, 0)) for y in (0, 24, 48)]
    found = find(cut(fuse(leaf, *barrels), cylinder(2, 60, (0, 0, 3), (0, 1, 0))))
    assert not found.of("rib")
    assert [part.thickness for part in found.of("prism") if "plate" in part.tags] == pytest.approx([0.003])
    tee = fuse(box((60, 40, 5)), box((60, 5, 55), (0, 17.5, 5)))
    fin = fuse(cylinder(5, 60), box((10, 3, 60), (4, -1.5, 0)))
    assert [len(find(shape).of("rib")) for shape in (tee, fin)] == [1, 1]
