"""What belongs to a hole beside its bore, where it ends, and how it stands on its face."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    Found,
    ball,
    box,
    chamfered,
    cone,
    cut,
    cylinder,
    extruded,
    filleted,
    find,
    fuse,
    nurbs,
    plate,
    rims,
    turned,
)

from querycad_contracts import Part

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-8)


def child(found: Found, hole: Part, kind: str) -> Part:
    (part,) = [part for part in found.parts if part.kind == kind and part.id in hole.children]
    return part


def test_a_counterbore_is_a_part_that_its_hole_carries() -> None:
    found = find(cut(plate(), cylinder(3, 30, (0, 0, -25)), cylinder(5.5, 6, along=DOWN)))
    step = child(found, found.hole, "counterbore")
    assert [step.diameter, step.depth] == near(11, 6)
    assert list(step.opening or ()) == near(0, 0, 0)
    assert found.hole.diameter == pytest.approx(6 * MM)


@pytest.mark.parametrize(("depth", "kind"), [(0.5, "spotface"), (1.0, "spotface"), (4.0, "counterbore")])
def test_a_spot_face_is_told_from_a_counterbore_by_its_depth(depth: float, kind: str) -> None:
    found = find(cut(plate(), cylinder(3, 30, (0, 0, -25)), cylinder(6, depth, along=DOWN)))
    assert ("spotfaced" in found.hole.tags) == (kind == "spotface")
    assert ("counterbored" in found.hole.tags) == (kind == "counterbore")
    step = child(found, found.hole, kind)
    assert [step.diameter, step.depth] == near(12, depth)


def test_a_countersink_has_the_diameter_of_the_screw_head() -> None:
    found = find(cut(plate(), cylinder(3, 30, (0, 0, -25)), cone(6, 3, 3, along=DOWN)))
    sink = child(found, found.hole, "countersink")
    assert "countersunk" in found.hole.tags
    assert [sink.diameter, sink.depth] == near(12, 3)


def test_chamfers_at_both_mouths_are_two_parts_with_their_depth_along_the_axis() -> None:
    block = cut(plate(), cylinder(5, 30, (0, 0, -25)))
    block = chamfered(block, 1.0, *rims(block, 5, 0), *rims(block, 5, -20))
    found = find(block)
    chamfers = [part for part in found.of("chamfer") if part.id in found.hole.children]
    assert "chamfered" in found.hole.tags
    assert [part.depth for part in chamfers] == near(1, 1)
    assert [part.width for part in chamfers] == near(math.sqrt(2), math.sqrt(2))
    assert sorted(part.center[2] for part in chamfers) == near(-19.5, -0.5)


def test_a_stepped_hole_with_steps_on_both_sides_has_a_counterbore_on_each() -> None:
    found = find(cut(plate(), cylinder(2, 30, (0, 0, -25)), cylinder(5, 6, along=DOWN), cylinder(4, 6, (0, 0, -20))))
    steps = [part for part in found.of("counterbore") if part.id in found.hole.children]
    assert sorted((round((p.diameter or 0) / MM, 6), round(p.normal[2])) for p in steps if p.normal) == [
        (8, -1),
        (10, 1),
    ]
    assert "stepped" in found.hole.tags


def manifold() -> TopoDS_Shape:
    """A block with a blind gallery along x and a port from the top that ends in it."""
    return cut(plate(60, 40, 40), cylinder(5, 50, (-30, 0, -20), (1, 0, 0)), cylinder(3, 20, (0, 0, 0), DOWN))


@pytest.mark.parametrize("move", [lambda s: s, lambda s: turned(s, (1, 2, 3), 40), nurbs])
def test_a_port_that_ends_in_a_gallery_is_a_cross_hole_and_does_not_go_through(move: object) -> None:
    assert callable(move)
    port, gallery = sorted(find(move(manifold())).of("hole"), key=lambda part: part.radius or 0)
    assert port.bottom == "bore"
    assert "cross" in port.tags
    assert not {"through", "blind"} & set(port.tags)
    assert gallery.bottom == "flat"
    assert "blind" in gallery.tags


def test_a_hole_through_the_wall_of_a_tube_goes_through() -> None:
    tube = cut(cylinder(20, 60), cylinder(17, 60), cylinder(3, 30, (0, 0, 30), (1, 0, 0)))
    radial = min(find(tube).of("hole"), key=lambda part: part.radius or 0)
    assert "through" in radial.tags


def test_a_hole_across_a_shaft_and_its_bore_is_one_through_hole() -> None:
    shaft = cut(cylinder(20, 60), cylinder(7, 60), cylinder(2, 60, (-30, 0, 30), (1, 0, 0)))
    holes = find(shaft).of("hole")
    assert sorted(round((hole.radius or 0) / MM, 6) for hole in holes) == [2, 7]
    assert all("through" in hole.tags and "cross" not in hole.tags for hole in holes)


def test_a_hole_in_a_turned_plate_is_not_oblique_but_one_that_leans_on_its_face_is() -> None:
    lean = math.radians(20)
    straight = turned(cut(plate(), cylinder(3, 30, (0, 0, -25))), (1, 1, 0), 30)
    leaning = cut(plate(), cylinder(3, 60, (-30 * math.sin(lean), 0, -10 - 30 * math.cos(lean)),
                                    (math.sin(lean), 0, math.cos(lean))))  # fmt: skip
    assert "oblique" not in find(straight).hole.tags
    hole = find(leaning).hole
    assert "oblique" in hole.tags
    assert hole.label.startswith("oblique through hole")
    assert list(hole.center) == near(0, 0, -10)


def test_a_ball_leaves_a_dimple_and_no_hole() -> None:
    found = find(cut(plate(), ball(5, (3, 4, 3))))
    (dimple,) = found.of("dimple")
    assert found.of("hole") == []
    assert [dimple.radius, dimple.diameter, dimple.depth] == near(5, 8, 2)
    assert list(dimple.opening or ()) == near(3, 4, 0)
    assert dimple.normal == pytest.approx((0, 0, 1))


def test_the_round_bottom_of_a_hole_is_no_dimple() -> None:
    found = find(cut(plate(), cylinder(4, 8, along=DOWN), ball(4, (0, 0, -8))))
    assert found.of("dimple") == []
    assert found.hole.bottom == "spherical"


def test_a_hole_in_a_low_ring_is_ringed_and_its_neighbour_is_not() -> None:
    block = fuse(plate(), cylinder(7, 2, (15, 0, 0)))
    found = find(cut(block, cylinder(4, 40, (15, 0, -30)), cylinder(4, 40, (-15, 0, -30))))
    tagged = {round(hole.center[0] / MM): "ringed" in hole.tags for hole in found.of("hole")}
    assert tagged == {15: True, -15: False}
    (ring,) = found.of("boss")
    assert ring.label.startswith("ring")
    assert [ring.height, *ring.radii] == near(2, 7, 4)


def test_a_hexagonal_hole_is_a_hexagonal_cutout_with_its_width_across_flats() -> None:
    corner = 5 / math.cos(math.pi / 6)
    hexagon = [(corner * math.cos(i * math.pi / 3), corner * math.sin(i * math.pi / 3)) for i in range(6)]
    (cutout,) = find(cut(plate(), extruded(hexagon, -30, 60))).of("cutout")
    assert "hexagonal" in cutout.tags
    assert cutout.width == pytest.approx(10 * MM)


def test_a_bore_of_half_a_block_is_no_gallery() -> None:
    """A cross hole into the wide inside of a housing goes through its wall."""
    block = cut(box((30, 30, 60), (-15, -15, 0)), cylinder(12, 60), cylinder(2, 20, (0, 0, 30), (1, 0, 0)))
    wall_hole = min(find(block).of("hole"), key=lambda part: part.radius or 0)
    assert "through" in wall_hole.tags


def test_grooves_that_are_far_apart_in_a_bore_are_no_thread() -> None:
    rings = [cylinder(13, 3, (0, 0, z)) for z in (14, 26, 38)]
    found = find(cut(cylinder(16, 56), cylinder(12, 56), *rings))
    (bore,) = found.of("hole")
    assert "threaded" not in bore.tags
    assert bore.diameter == pytest.approx(24 * MM)
    assert [groove.diameter for groove in found.of("groove")] == pytest.approx([26 * MM] * 3)


def test_a_clamping_collar_with_two_slits_keeps_its_bore() -> None:
    ring = cut(cylinder(27, 16), cylinder(12, 16))
    collar = cut(ring, box((30, 3, 16), (0, -1.5, 0)), box((20, 1.5, 16), (-20, -0.75, 0)))
    (bore,) = find(collar).of("hole")
    assert bore.diameter == pytest.approx(24 * MM)
    assert "through" in bore.tags


def test_the_roof_and_the_bottom_of_a_chamber_are_no_countersinks() -> None:
    inside = [cone(9, 28, 20, (0, 0, 2)), cylinder(28, 80, (0, 0, 22)), cone(28, 10, 20, (0, 0, 102))]
    bottle = cut(cylinder(30, 140), *inside, cylinder(10, 20, (0, 0, 121)))
    found = find(bottle)
    assert not found.of("countersink")
    assert [found.hole.diameter, found.hole.depth] == near(20, 138)


def test_a_cone_from_either_face_down_to_the_bore_is_a_countersink() -> None:
    block = cut(box((60, 60, 20), (-30, -30, 0)), cylinder(5, 20), cone(10, 5, 5), cone(5, 10, 5, (0, 0, 15)))
    assert [sink.diameter for sink in find(block).of("countersink")] == near(20, 20)


@pytest.mark.parametrize("band", [0.0, 8.0])
def test_the_bowl_of_a_funnel_is_no_countersink_and_the_band_at_its_rim_no_counterbore(band: float) -> None:
    inside = [cylinder(5, 40), cone(5, 40, 35, (0, 0, 40)), *([cylinder(40, band, (0, 0, 75))] if band else [])]
    outside = [
        cylinder(6.5, 40),
        cone(6.5, 41.5, 35, (0, 0, 40)),
        *([cylinder(41.5, band, (0, 0, 75))] if band else []),
    ]
    found = find(cut(fuse(*outside), *inside))
    assert not {"countersink", "counterbore", "spotface"} & {part.kind for part in found.parts}
    assert {"through", "tapered"} <= set(found.hole.tags)
    assert found.hole.diameter == pytest.approx(10 * MM)


def test_a_sunk_countersink_and_a_step_that_a_drill_left_are_no_bowl() -> None:
    sunk = find(
        cut(plate(), cylinder(4.5, 30, (0, 0, -25)), cone(9, 4.5, 4.5, (0, 0, -3), DOWN), cylinder(9, 3, along=DOWN))
    )
    assert child(sunk, sunk.hole, "countersink").diameter == pytest.approx(18 * MM)
    assert child(sunk, sunk.hole, "spotface").diameter == pytest.approx(18 * MM)
    drilled = find(
        cut(plate(), cylinder(3, 30, (0, 0, -25)), cone(10, 3, 4, (0, 0, -12), DOWN), cylinder(10, 12, along=DOWN))
    )
    assert child(drilled, drilled.hole, "counterbore").diameter == pytest.approx(20 * MM)


def test_a_fillet_at_its_floor_makes_a_bore_no_tapered_one_and_a_shallow_one_a_pocket() -> None:
    """A taper is that of the wall: a drafted bore stays one, and what is deeper than a quarter of its width a hole."""
    shallow, deep = (cut(plate(), cylinder(radius, 9, (0, 0, -9))) for radius in (19, 10))
    found = find(filleted(shallow, 3, *rims(shallow, 19, -9)))
    (pocket,) = found.of("pocket")
    assert (pocket.width, pocket.depth) == near(38, 9)
    assert not found.of("hole")
    bore = find(filleted(deep, 2, *rims(deep, 10, -9))).hole
    assert "tapered" not in bore.tags
    assert bore.depth == pytest.approx(9 * MM)
    drafted = find(cut(plate(), cylinder(6, 5, along=DOWN), cone(6, 4, 10, (0, 0, -5), DOWN))).hole
    assert "tapered" in drafted.tags
