"""How much material is left behind a bottom and beside a hole."""

from __future__ import annotations

import math

import pytest
from tests.segworker.shapes import (
    DOWN,
    box,
    cone,
    cut,
    cylinder,
    filleted,
    find,
    fuse,
    plate,
    prism,
    rims,
    scaled,
    turned,
)

MM = 1e-3


@pytest.mark.parametrize("factor", [1.0, 100.0])
def test_below_a_blind_hole_is_what_is_left_down_to_the_other_side(factor: float) -> None:
    shape = cut(plate(60, 40, 20), cylinder(4, 12, along=DOWN))
    for placed in (shape, turned(shape, (0.3, 0.5, 0.8), 40)):
        assert find(scaled(placed, factor)).hole.bottom_thickness == pytest.approx(8 * factor * MM, rel=1e-4)


def test_below_a_drill_point_it_counts_from_the_tip_and_a_through_hole_has_none() -> None:
    drilled = cut(plate(60, 40, 20), fuse(cylinder(4, 12, along=DOWN), cone(4, 0, 3, (0, 0, -12), DOWN)))
    assert find(drilled).hole.bottom_thickness == pytest.approx(5 * MM, rel=1e-4)
    assert find(cut(plate(), cylinder(4, 20, along=DOWN))).hole.bottom_thickness is None


def test_below_a_pocket_the_thinnest_place_counts() -> None:
    shape = cut(plate(60, 40, 20), box((30, 20, 12), (-15, -10, -12)))
    (pocket,) = find(shape).of("pocket")
    assert pocket.bottom_thickness == pytest.approx(8 * MM)
    (hollow,) = find(cut(shape, box((60, 8, 3), (-30, -4, -20)))).of("pocket")
    assert hollow.bottom_thickness == pytest.approx(5 * MM)


@pytest.mark.parametrize(("side", "left"), [(0.0, 4.0), (40.0, 12.0)])
def test_behind_a_wide_bottom_a_small_tip_counts(side: float, left: float) -> None:
    """A round recess of 60 mm below, and above its middle, or beside it, a drilled hole."""
    drilled = fuse(cylinder(2, 6, (side, 0, 0), DOWN), cone(2, 0, 2, (side, 0, -6), DOWN))
    shape = cut(plate(120, 80, 20), drilled, cylinder(30, 8, (0, 0, -20)))
    (recess,) = [part for part in find(shape).parts if part.kind in ("pocket", "hole") and (part.radius or 0) > 0.02]
    assert recess.bottom_thickness == pytest.approx(left * MM)


@pytest.mark.parametrize(("aside", "left"), [(7.0, 4.0), (33.0, 12.0)])
def test_above_a_cross_bore_the_thinnest_place_counts(aside: float, left: float) -> None:
    """A bore of 8 mm that runs 8 mm below the floor of a pocket, or beside it."""
    shape = cut(plate(60, 80, 20), box((30, 40, 8), (-15, -20, -8)), cylinder(4, 60, (-30, aside, -16), (1, 0, 0)))
    (pocket,) = find(shape).of("pocket")
    assert pocket.bottom_thickness == pytest.approx(left * MM)


def test_below_a_head_and_below_a_slot_is_what_is_left_too() -> None:
    stepped = cut(plate(60, 40, 20), cylinder(4, 20, along=DOWN), cylinder(8, 6, along=DOWN))
    (seat,) = find(stepped).of("counterbore")
    assert seat.bottom_thickness == pytest.approx(14 * MM)
    (slot,) = find(cut(plate(60, 40, 20), box((8, 40, 5), (-4, -20, -5)))).of("slot")
    assert slot.bottom_thickness == pytest.approx(15 * MM)
    (gap,) = find(cut(plate(60, 40, 20), box((8, 30, 20), (-4, -10, -20)))).of("slot")
    assert gap.bottom_thickness is None


@pytest.mark.parametrize(("size", "left"), [(24, 8), (60, 11)])
def test_below_a_slot_the_material_beside_a_pad_counts_but_where_the_pad_is_under_all_of_it(
    size: float, left: float
) -> None:
    padded = fuse(plate(60, 80, 20), box((size, size, 3), (-size / 2, -size / 2, -23)))
    (slot,) = find(cut(padded, box((60, 8, 12), (-30, -4, -12)))).of("slot")
    assert slot.bottom_thickness == pytest.approx(left * MM)


@pytest.mark.parametrize("width", [10.0, 18.0])
def test_between_slots_that_cross_the_web_counts(width: float) -> None:
    across = box((width, 90, 6), (-width / 2, -45, -20))
    slots = find(cut(plate(220, 90, 20), box((220, 24, 8), (-110, -12, -8)), across)).of("slot")
    assert [slot.bottom_thickness for slot in slots] == pytest.approx([6 * MM, 6 * MM])


def test_below_a_keyway_in_a_hub_the_way_out_through_its_round_wall_is_that_of_its_middle() -> None:
    (keyway,) = find(cut(cylinder(26, 40), cylinder(12, 40), box((16, 8, 40), (0, -4, 0)))).of("slot")
    assert keyway.bottom_thickness == pytest.approx(10 * MM, rel=5e-3)


def test_below_a_round_trough_is_what_is_left_at_its_lowest_line() -> None:
    trough = cut(plate(60, 40, 20), cylinder(6, 40, (0, -20, 0), (0, 1, 0)))
    (found,) = [part for part in find(trough).parts if part.kind in ("slot", "channel", "notch")]
    assert found.bottom_thickness == pytest.approx(14 * MM)


def test_beside_a_hole_is_the_nearest_outer_face_and_no_other_hole() -> None:
    near, far = cylinder(3, 20, (-20, 5, -20)), cylinder(3, 20, (-12, 5, -20))
    found = find(cut(plate(60, 40, 20), near, far))
    assert sorted(hole.wall_distance or 0.0 for hole in found.of("hole")) == pytest.approx([7 * MM, 12 * MM])
    (in_disc,) = find(cut(cylinder(30, 10), cylinder(4, 10, (15, 0, 0)))).of("hole")
    assert in_disc.wall_distance == pytest.approx(11 * MM)
    (coaxial,) = find(cut(cylinder(30, 10), cylinder(4, 10))).of("hole")
    assert coaxial.wall_distance == pytest.approx(26 * MM)


def test_beside_a_counterbore_is_the_outer_wall_and_not_the_broken_edge_at_its_mouth() -> None:
    hub = fuse(cylinder(33, 18), cone(33, 32, 1, (0, 0, 18)))
    (step,) = find(cut(hub, cylinder(8, 19), cylinder(14, 10, (0, 0, 9)))).of("counterbore")
    assert step.wall_distance == pytest.approx(19 * MM)
    (blind,) = find(cut(plate(60, 40, 20), cylinder(4, 12, along=DOWN))).of("hole")
    assert blind.wall_distance == pytest.approx(16 * MM)


@pytest.mark.parametrize("leans", [True, False])
def test_below_the_slot_of_a_screw_is_what_is_left_down_to_its_tip(leans: bool) -> None:
    head = cone(5, 10, 5, (0, 0, -5)) if leans else cylinder(10, 5, (0, 0, -5))
    screw = cut(fuse(head, cylinder(5, 30, along=DOWN)), box((40, 2.5, 3), (-20, -1.25, -3)))
    (slot,) = find(screw).of("slot")
    assert slot.bottom_thickness == pytest.approx((27 if leans else 2) * MM)


def test_below_a_pocket_over_a_sloping_underside_the_thinnest_place_counts() -> None:
    block = cut(plate(60, 40, 20), prism([(-30, -20, -20), (30, -20, -20), (30, -20, -14)], (0, 40, 0)))
    (pocket,) = find(cut(block, box((20, 20, 5), (-10, -10, -5)))).of("pocket")
    assert 11 * MM < (pocket.bottom_thickness or 0.0) < 12 * MM


def test_beside_a_hole_the_wall_counts_and_not_the_rounds_of_its_edges() -> None:
    """A flange of 60 mm, its edges rounded over a third of its height each, and holes 4 mm from its wall."""
    disc = cylinder(30, 12)
    rounded = filleted(disc, 4, *rims(disc, 30, 0), *rims(disc, 30, 12))
    holes = [cylinder(4, 12, (22 * math.cos(a), 22 * math.sin(a), 0)) for a in (0.0, 0.4, 1.7)]
    distances = [hole.wall_distance for hole in find(cut(rounded, *holes)).of("hole")]
    assert distances == pytest.approx([4 * MM] * 3)


def test_beside_a_hole_the_sloping_face_that_it_opens_in_does_not_count() -> None:
    block = prism([(-20, -15, 0), (20, -15, 0), (20, -15, 10), (-20, -15, 30)], (0, 30, 0))
    (hole,) = find(cut(block, cylinder(3, 40, (12, 0, -1)))).of("hole")
    assert hole.wall_distance == pytest.approx(5 * MM)


def test_beside_a_hole_a_round_edge_of_the_whole_height_and_a_cone_count() -> None:
    bar = fuse(box((60, 30, 10)), cylinder(5, 60, (0, 0, 5), (1, 0, 0)), cylinder(5, 60, (0, 30, 5), (1, 0, 0)))
    (hole,) = find(cut(bar, cylinder(4, 10, (30, 5, 0)))).of("hole")
    assert hole.wall_distance == pytest.approx(4 * MM, rel=1e-3)
    (beside,) = find(cut(cone(30, 20, 20), cylinder(4, 20, (12, 0, 0)))).of("hole")
    assert beside.wall_distance == pytest.approx(5 * MM, rel=1e-3)
