"""Holes: each is found once, with the measures that a drawing would give."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    Vec,
    ball,
    box,
    chamfered,
    cone,
    cut,
    cylinder,
    edges,
    filleted,
    find,
    fuse,
    plate,
    rims,
    upright,
)

from querycad_contracts import Part, Side

MM = 1e-3


def only_hole(shape: TopoDS_Shape) -> Part:
    return find(shape).hole


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-8)


def sink(top_radius: float, angle_deg: float = 90.0) -> TopoDS_Shape:
    """A countersink's cone, from its rim at z = 0 to its apex."""
    return cone(top_radius, 0.0, top_radius / math.tan(math.radians(angle_deg / 2)), along=DOWN)


def test_a_through_hole_has_the_depth_of_the_plate() -> None:
    hole = only_hole(cut(plate(), cylinder(5, 30, (3, 4, -25))))
    assert hole.bottom == "through"
    assert {"through", "circular"} <= set(hole.tags)
    assert [hole.radius, hole.diameter, hole.depth] == near(5, 10, 20)
    assert list(hole.opening or ()) == near(3, 4, 0)
    assert list(hole.center) == near(3, 4, -10)
    assert hole.normal == pytest.approx((0, 0, 1))
    assert len(hole.faces) == 1


def test_a_blind_hole_with_a_flat_bottom() -> None:
    hole = only_hole(cut(plate(), cylinder(5, 12, along=DOWN)))
    assert hole.bottom == "flat"
    assert "blind" in hole.tags
    assert "through" not in hole.tags
    assert [hole.radius, hole.depth] == near(5, 12)
    assert list(hole.center) == near(0, 0, -6)
    assert len(hole.faces) == 2


def test_the_depth_of_a_drilled_hole_ends_where_its_point_begins() -> None:
    point = 5 / math.tan(math.radians(59))
    hole = only_hole(cut(plate(), fuse(cylinder(5, 12, along=DOWN), cone(5, 0, point, (0, 0, -12), DOWN))))
    assert hole.bottom == "conical"
    assert [hole.radius, hole.depth] == near(5, 12)
    assert len(hole.faces) == 2


def test_a_ball_nosed_hole_has_a_spherical_bottom() -> None:
    hole = only_hole(cut(plate(), fuse(cylinder(5, 12, along=DOWN), ball(5, (0, 0, -12)))))
    assert hole.bottom == "spherical"
    assert hole.radius == pytest.approx(5 * MM)


def test_a_counterbored_hole_is_one_hole_with_two_radii() -> None:
    hole = only_hole(cut(plate(), cylinder(3, 30, (0, 0, -25)), cylinder(6, 7, along=DOWN)))
    assert {"counterbored", "stepped", "through"} <= set(hole.tags)
    assert list(hole.radii) == near(6, 3)
    assert [hole.radius, hole.depth, hole.width] == near(3, 20, 12)
    assert list(hole.opening or ()) == near(0, 0, 0)
    assert hole.normal == pytest.approx((0, 0, 1))


def test_a_counterbore_from_below_opens_downwards() -> None:
    hole = only_hole(cut(plate(), cylinder(3, 30, (0, 0, -25)), cylinder(6, 7, (0, 0, -20))))
    assert hole.normal == pytest.approx((0, 0, -1))
    assert list(hole.opening or ()) == near(0, 0, -20)
    assert list(hole.radii) == near(6, 3)


def test_a_countersunk_hole_keeps_the_radius_of_its_bore() -> None:
    hole = only_hole(cut(plate(), cylinder(3, 30, (0, 0, -25)), sink(6)))
    assert {"countersunk", "beveled", "through"} <= set(hole.tags)
    assert "chamfered" not in hole.tags
    assert [hole.radius, hole.width, hole.depth] == near(3, 12, 20)


def test_a_broken_edge_is_a_chamfer_not_a_countersink() -> None:
    hole = only_hole(cut(plate(), cylinder(3, 30, (0, 0, -25)), sink(3.5)))
    assert {"chamfered", "beveled"} <= set(hole.tags)
    assert "countersunk" not in hole.tags
    assert [hole.radius, hole.depth] == near(3, 20)


def test_a_rounded_mouth_belongs_to_the_hole() -> None:
    block = cut(plate(), cylinder(5, 30, (0, 0, -25)))
    hole = only_hole(filleted(block, 1.0, *rims(block, 5.0, 0.0)))
    assert "rounded" in hole.tags
    assert [hole.radius, hole.depth, hole.width] == near(5, 20, 12)
    assert len(hole.faces) == 2


def test_a_hole_of_three_steps_is_one_hole() -> None:
    hole = only_hole(
        cut(plate(), cylinder(3, 30, (0, 0, -25)), cylinder(5, 14, along=DOWN), cylinder(8, 6, along=DOWN))
    )
    assert list(hole.radii) == near(8, 5, 3)
    assert "stepped" in hole.tags
    assert hole.bottom == "through"


def test_a_blind_counterbored_hole_ends_in_its_bore() -> None:
    hole = only_hole(cut(plate(), cylinder(3, 15, along=DOWN), cylinder(6, 5, along=DOWN)))
    assert hole.bottom == "flat"
    assert [hole.radius, hole.depth] == near(3, 15)
    assert list(hole.radii) == near(6, 3)


def test_a_wall_in_two_halves_is_one_hole() -> None:
    whole = cylinder(5, 30, (0, 0, -25))
    half = cut(whole, box((20, 20, 40), (0, -10, -30)))
    other = cut(whole, box((20, 20, 40), (-20, -10, -30)))
    found = find(cut(cut(plate(), half), other))
    assert len(found.hole.faces) == 3  # the second half is split once more by the seam of the tool
    assert found.hole.radius == pytest.approx(5 * MM)


def test_crossing_holes_are_two_holes() -> None:
    holes = find(cut(plate(), cylinder(4, 30, (0, 0, -25)), cylinder(2, 60, (0, -30, -10), (0, 1, 0)))).of("hole")
    assert sorted(round(hole.diameter / MM, 6) for hole in holes if hole.diameter) == [4, 8]
    assert all("through" in hole.tags for hole in holes)
    assert sorted(round((hole.depth or 0) / MM, 6) for hole in holes) == [20, 40]


def test_an_oblique_hole_runs_along_its_own_axis() -> None:
    lean = math.radians(30)
    along = (math.sin(lean), 0.0, math.cos(lean))
    hole = only_hole(cut(plate(), cylinder(3, 80, (-40 * along[0], 0, -10 - 40 * along[2]), along)))
    assert hole.radius == pytest.approx(3 * MM)
    assert hole.axis is not None
    assert abs(sum(a * b for a, b in zip(hole.axis, along, strict=True))) == pytest.approx(1.0)
    assert hole.bottom == "through"
    # From where the axis pierces the upper face to where it pierces the lower one.
    assert hole.depth == pytest.approx(20 / math.cos(lean) * MM, rel=1e-6)
    assert "oblique" in hole.tags


def fork() -> TopoDS_Shape:
    """Two ears 10 mm apart on a base."""
    return fuse(box((30, 20, 5), (-15, -10, -5)), box((5, 20, 25), (-10, -10, 0)), box((5, 20, 25), (5, -10, 0)))


def test_a_bore_through_two_ears_is_one_hole() -> None:
    hole = only_hole(cut(fork(), cylinder(4, 60, (-30, 0, 15), (1, 0, 0))))
    assert len(hole.faces) == 2
    assert hole.bottom == "through"
    assert [hole.radius, hole.depth] == near(4, 20)
    assert list(hole.center) == near(0, 0, 15)


def test_bores_of_two_radii_in_two_ears_are_two_holes() -> None:
    shape = cut(fork(), cylinder(4, 30, (-30, 0, 15), (1, 0, 0)), cylinder(3, 30, (0, 0, 15), (1, 0, 0)))
    assert len(find(shape).of("hole")) == 2


def test_a_hinge_with_three_knuckles_has_one_hole() -> None:
    base = box((50, 20, 5), (-25, -10, -5))
    ears = [box((5, 20, 25), (x, -10, 0)) for x in (-20, -2.5, 15)]
    hole = only_hole(cut(fuse(base, *ears), cylinder(7, 80, (-40, 0, 12), (1, 0, 0))))
    assert len(hole.faces) == 3
    assert hole.depth == pytest.approx(40 * MM)


def test_blind_holes_from_both_sides_of_one_wall_are_two_holes() -> None:
    shape = cut(plate(), cylinder(5, 6, along=DOWN), cylinder(5, 6, (0, 0, -20)))
    holes = find(shape).of("hole")
    assert len(holes) == 2
    assert all(hole.bottom == "flat" for hole in holes)


def test_a_hole_in_a_boss_opens_at_the_tip_of_the_boss() -> None:
    hole = only_hole(cut(fuse(plate(), cylinder(8, 15)), cylinder(3, 25, (0, 0, 15), DOWN)))
    assert list(hole.opening or ()) == near(0, 0, 15)
    assert [hole.depth] == near(25)
    assert hole.bottom == "flat"


def test_a_ring_groove_is_a_groove_and_no_hole() -> None:
    ring = cut(cylinder(10, 5, along=DOWN), cylinder(7, 5, along=DOWN))
    found = find(cut(plate(), ring))
    assert found.of("hole") == []
    (groove,) = found.of("groove")
    assert groove.depth == pytest.approx(5 * MM)


def test_a_groove_inside_a_bore_is_part_of_one_hole() -> None:
    hole = only_hole(cut(plate(), cylinder(6, 30, (0, 0, -25)), cylinder(7, 2, (0, 0, -6))))
    assert hole.bottom == "through"
    assert hole.radius == pytest.approx(6 * MM)


@pytest.mark.parametrize("middle", [0.0, 1.0])
def test_a_notch_of_half_a_circle_or_less_is_no_hole(middle: float) -> None:
    shape = cut(plate(), cylinder(5, 30, (30 + middle, 0, -25)))
    assert find(shape).of("hole") == []


def test_a_bore_that_breaks_a_little_through_the_side_is_still_a_hole() -> None:
    assert only_hole(cut(plate(), cylinder(5, 30, (27, 0, -25)))).diameter == pytest.approx(10 * MM)


def test_a_rounded_pocket_is_no_hole() -> None:
    pocket = box((20, 20, 10), (-10, -10, -10))
    assert find(cut(plate(), filleted(pocket, 4.0, *upright(pocket)))).of("hole") == []


def test_a_shaft_is_no_hole() -> None:
    assert find(fuse(cylinder(10, 40), cylinder(6, 30, (0, 0, 40)))).of("hole") == []


def test_a_tube_has_one_hole_along_all_of_it() -> None:
    hole = only_hole(cut(cylinder(10, 50), cylinder(8, 50)))
    assert [hole.depth, hole.diameter] == near(50, 16)


def test_a_cone_as_deep_as_the_sheet_is_a_countersunk_hole_where_it_is_wide_enough() -> None:
    sheet = find(cut(plate(z=2.0), cone(5, 3, 2, along=DOWN)))
    assert "countersunk" in sheet.hole.tags
    assert [sheet.hole.diameter] == near(6)
    (sunk,) = [part for part in sheet.parts if part.kind == "countersink"]
    assert [sunk.diameter] == near(10)
    assert "countersunk" not in only_hole(cut(plate(z=10.0), cone(5, 3, 10, along=DOWN))).tags
    assert "countersunk" not in only_hole(cut(plate(), cone(8, 0, 8, along=DOWN))).tags  # a blind pit


def test_a_conical_hole_is_named_so() -> None:
    hole = only_hole(cut(plate(), cone(6, 4, 20, along=DOWN)))
    assert "conical" in hole.tags
    assert hole.bottom == "through"
    assert list(hole.opening or ()) == near(0, 0, 0)


@pytest.mark.parametrize(
    ("at", "along", "side"),
    [
        ((0, 0, 0), (0, 0, -1), Side.TOP),
        ((0, 0, -20), (0, 0, 1), Side.BOTTOM),
        ((-30, 0, -10), (1, 0, 0), Side.LEFT),
        ((30, 0, -10), (-1, 0, 0), Side.RIGHT),
        ((0, -20, -10), (0, 1, 0), Side.FRONT),
        ((0, 20, -10), (0, -1, 0), Side.BACK),
    ],
)
def test_a_blind_hole_is_visible_from_the_side_it_opens_to(at: Vec, along: Vec, side: Side) -> None:
    found = find(cut(plate(), cylinder(4, 8, at, along)))
    (hole,) = [part for part in found.seen_parts if part.kind == "hole"]
    assert hole.sides == (side,)
    assert list(hole.opening or ()) == near(*at)
    assert hole.normal == pytest.approx([-c for c in along])


def test_the_distance_to_the_edge_runs_from_the_rim_to_the_outer_edge() -> None:
    hole = only_hole(cut(plate(), cylinder(5, 30, (20, 3, -25))))
    assert hole.edge_distance == pytest.approx(5 * MM)


def test_a_chamfer_of_the_outer_edge_belongs_to_the_plate() -> None:
    block = plate()
    around = [edge for edge in edges(block) if edge not in upright(block)]
    drilled = cut(chamfered(block, 2.0, *around), cylinder(5, 30, (20, 3, -25)))
    assert only_hole(drilled).edge_distance == pytest.approx(5 * MM)


def test_a_chamfered_plate_has_no_holes() -> None:
    block = plate()
    assert find(chamfered(block, 2.0, *upright(block))).of("hole") == []


@pytest.mark.parametrize(("beside", "grazes"), [(30.0, True), (34.0, True), (27.0, False)])
def test_a_flange_hole_that_grazes_the_fillet_of_the_hub_is_as_deep_as_the_flange(beside: float, grazes: bool) -> None:
    """A hub of 20 mm with a fillet that ends at 28 mm; nearer than that most of a hole opens in the fillet."""
    hub = fuse(cylinder(50, 10), cylinder(20, 30, (0, 0, 10)))
    hole = only_hole(cut(filleted(hub, 8, *rims(hub, 20, 10)), cylinder(5, 40, (beside, 0, -5))))
    assert (hole.depth == pytest.approx(10 * MM)) is grazes
    assert (hole.center[2] == pytest.approx(5 * MM)) is grazes
    assert hole.bottom == "through"
