"""Plain parts whose edges are broken and whose corners are rounded, as real ones: nothing changes its size by that."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from OCP.BRep import BRep_Tool
from OCP.gp import gp_Pnt
from OCP.TopExp import TopExp
from OCP.TopoDS import TopoDS_Edge, TopoDS_Shape
from tests.segworker.shapes import (
    bend,
    box,
    chamfered,
    cone,
    cut,
    cylinder,
    edges,
    extruded,
    filleted,
    find,
    fuse,
    rims,
    turned,
    upright,
)

MM = 1e-3


def along_y(shape: TopoDS_Shape, belongs: Callable[[float, float], bool]) -> list[TopoDS_Edge]:
    """The straight edges along y at an x and z that belong."""
    found = []
    for edge in edges(shape):
        a, b = _ends(edge)
        if abs(a.X() - b.X()) < 1e-6 and abs(a.Z() - b.Z()) < 1e-6 and belongs(a.X(), a.Z()):
            found.append(edge)
    return found


def staircase() -> TopoDS_Shape:
    """Four levels, 21 by 12 each and 48 wide, filleted inside and chamfered outside."""
    corners = [(0.0, 0.0), (84.0, 0.0)]
    for i in range(4):
        x = (4 - i) * 21.0
        corners += [(x, 12.0 * (i + 1)), (x - 21.0, 12.0 * (i + 1))]
    solid = turned(extruded(corners, 0, 48), (1, 0, 0), 90)
    inner = {((4 - i) * 21, i * 12) for i in (1, 2, 3)}
    solid = filleted(solid, 3, *along_y(solid, lambda x, z: (round(x), round(z)) in inner))
    outer = {((4 - i) * 21, (i + 1) * 12) for i in range(4)}
    return chamfered(solid, 1, *along_y(solid, lambda x, z: (round(x), round(z)) in outer))


def test_steps_with_chamfered_edges_are_steps_as_high_as_without() -> None:
    steps = find(staircase()).of("step")
    assert [step.depth for step in steps] == pytest.approx([12 * MM] * 3)


def test_a_v_groove_beside_chamfered_edges_is_no_step() -> None:
    block = box((70, 40, 50), (-35, -40, 0))
    block = chamfered(block, 2, *along_y(block, lambda x, z: abs(x) > 34 and z > 49))
    groove = turned(extruded([(-20, 50), (0, 30), (20, 50)], 0, 40), (1, 0, 0), 90)
    (slot,) = find(cut(block, groove)).of("slot")
    assert "v_shaped" in slot.tags


def test_a_t_slot_is_as_deep_as_its_unbroken_edge() -> None:
    block = cut(box((110, 72, 46), (0, -36, 0)), box((110, 14, 13), (0, -7, 33)), box((110, 26, 11), (0, -13, 22)))
    mouth = [edge for edge in edges(block) if _runs_at(edge, 46, 7)]
    (slot,) = find(chamfered(block, 1, *mouth)).of("slot")
    assert slot.depth == pytest.approx(24 * MM)
    assert "t_slot" in slot.tags


def _runs_at(edge: TopoDS_Edge, z: float, off: float) -> bool:
    """At this height, and this far off the x axis."""
    return all(abs(p.Z() - z) < 1e-6 and abs(abs(p.Y()) - off) < 1e-6 for p in _ends(edge))


def _ends(edge: TopoDS_Edge) -> list[gp_Pnt]:
    return [BRep_Tool.Pnt_s(vertex) for vertex in (TopExp.FirstVertex_s(edge), TopExp.LastVertex_s(edge))]


def test_a_ring_groove_with_fillets_on_its_floor_is_a_groove() -> None:
    ring = cut(cylinder(35, 6, (0, 0, 14)), cylinder(27, 6, (0, 0, 14)))
    ring = filleted(ring, 2, *rims(ring, 35, 14), *rims(ring, 27, 14))
    found = find(cut(box((110, 110, 20), (-55, -55, 0)), ring))
    (groove,) = found.of("groove")
    assert (groove.width, groove.depth) == pytest.approx((8 * MM, 6 * MM))
    assert groove.inner_diameter == pytest.approx(54 * MM)
    assert not found.of("boss")


@pytest.mark.parametrize("radius", [0.0, 0.5])
def test_a_turned_groove_is_as_deep_with_rounded_corners(radius: float) -> None:
    ring = cut(cylinder(15, 4, (0, 0, 22)), cylinder(9.5, 4, (0, 0, 22)))
    if radius:
        ring = filleted(ring, radius, *rims(ring, 9.5, 22), *rims(ring, 9.5, 26))
    (groove,) = find(cut(cylinder(12.5, 72), ring)).of("groove")
    assert groove.depth == pytest.approx(3 * MM)
    assert groove.width == pytest.approx(4 * MM)


def test_a_boss_with_draft_is_cylindrical_and_a_cone_is_not() -> None:
    post, spike = cone(17, 15.3, 50, (0, 0, 10)), cone(17, 5, 50, (0, 0, 10))
    plate = box((100, 60, 10), (-50, -30, 0))
    (boss,) = find(fuse(plate, post)).of("boss")
    assert {"cylindrical", "conical"} <= set(boss.tags)
    (boss,) = find(fuse(plate, spike)).of("boss")
    assert "cylindrical" not in boss.tags


def test_the_fillet_inside_a_bowl_and_the_rounding_outside_are_parts() -> None:
    outside = cone(60, 70, 50)
    inside = cone(56, 66, 46, (0, 0, 4))
    found = find(
        cut(
            filleted(outside, 20, *rims(outside, 60, 0)),
            filleted(inside, 15, *rims(inside, 56, 4)),
        )
    )
    assert [fillet.radius for fillet in found.of("fillet")] == pytest.approx([15 * MM])
    assert [rounding.radius for rounding in found.of("round")] == pytest.approx([20 * MM])


def test_a_bar_bends_inside_and_outside_of_its_middle_line() -> None:
    hook = fuse(
        cylinder(7, 60, (29, 0, 0)),
        bend(29, 7, 180, (0, 0, 0), (0, 1, 0), (1, 0, 0)),
    )
    (part,) = find(hook).of("bend")
    assert (part.inner_diameter, part.outer_diameter) == pytest.approx((44 * MM, 72 * MM))


def test_a_flat_on_a_shaft_has_the_depth_that_it_is_milled_to() -> None:
    shaft = cut(cylinder(10, 84), box((20, 40, 30), (7, -20, 58)))
    (flat,) = [face for face in find(shaft).of("face") if "milled" in face.tags]
    assert (flat.depth, flat.width) == pytest.approx((3 * MM, 2 * math.sqrt(51) * MM))


def test_the_flat_of_a_d_shaped_bore_is_one() -> None:
    bore = cut(cylinder(4, 20), box((8, 8, 20), (3, -4, 0)))
    flats = [face for face in find(cut(cylinder(15, 20), bore)).of("face") if "milled" in face.tags]
    assert [flat.depth for flat in flats] == pytest.approx([1 * MM])


def test_the_sides_of_a_hexagon_are_flats_and_those_of_a_keyway_are_not() -> None:
    hexagon = [(12 * math.cos(i * math.pi / 3), 12 * math.sin(i * math.pi / 3)) for i in range(6)]
    plug = fuse(cylinder(10, 20), extruded(hexagon, 20, 10))
    assert sum("milled" in face.tags for face in find(plug).of("face")) == 6
    shaft = cut(cylinder(18, 95), box((10, 20, 42), (-5, 13, 20)))
    assert not [face for face in find(shaft).of("face") if "milled" in face.tags]


def test_a_long_taper_in_a_bore_is_no_countersink() -> None:
    nozzle = cut(cylinder(16, 64), cone(10, 3, 48), cylinder(3, 64))
    (hole,) = find(nozzle).of("hole")
    assert "tapered" in hole.tags
    assert "countersunk" not in hole.tags
    assert hole.angle == pytest.approx(2 * math.atan2(7, 48))
    (hole,) = find(cut(cylinder(16, 64), cone(6, 3, 3), cylinder(3, 64))).of("hole")
    assert "countersunk" in hole.tags


def test_two_faces_and_the_chamfers_between_them_are_no_prism() -> None:
    block = box((95, 60, 35))
    block = chamfered(block, 3, *upright(block))
    found = find(cut(block, box((50, 18, 35), (50, 21, 0)))).of("prism")
    assert not [prism for prism in found if (prism.width or 0) > 96 * MM]


def test_ribs_between_a_post_and_its_plate_are_gussets() -> None:
    profile = [(5.0, 9.0), (42.0, 9.0), (42.0, 16.0), (24.0, 54.0), (5.0, 54.0)]
    rib = turned(extruded(profile, -4, 8), (1, 0, 0), 90)
    plate = box((100, 100, 10), (-50, -50, 0))
    post = fuse(plate, cylinder(18, 60, (0, 0, 10)), *(turned(rib, (0, 0, 1), 90 * i) for i in range(4)))
    gussets = [part for part in find(post).of("rib") if "gusset" in part.tags]
    assert len(gussets) == 4
    for gusset in gussets:
        assert gusset.thickness == pytest.approx(8 * MM)
        assert (gusset.length, gusset.height) == pytest.approx((24 * MM, 44 * MM), rel=0.01)


def test_the_tines_of_a_yoke_are_walls_whatever_rounds_their_gap() -> None:
    yoke = cut(box((30, 48, 64), (-15, -24, 0)), box((30, 26, 48), (-15, -13, 16)))
    inner = [edge for edge in edges(yoke) if _runs_at(edge, 16, 13) and _ends(edge)[0].X() < _ends(edge)[1].X()]
    tines = [wall for wall in find(filleted(yoke, 8, *inner)).of("wall") if "tine" in wall.tags]
    assert [tine.thickness for tine in tines] == pytest.approx([11 * MM] * 2)


def test_a_t_profile_is_as_wide_as_its_rounded_edges() -> None:
    profile = fuse(box((80, 60, 10)), box((10, 60, 40), (35, 0, 10)))
    outer = [edge for edge in edges(profile) if _lies_along_y(edge) and not _is_in_the_corner(edge)]
    walls = find(filleted(profile, 1, *outer)).of("wall")
    assert sorted(wall.length or 0 for wall in walls) == pytest.approx([60 * MM, 80 * MM])
    plates = find(filleted(profile, 1, *outer)).of("prism")
    assert max(plate.length or 0 for plate in plates) == pytest.approx(80 * MM)


def _lies_along_y(edge: TopoDS_Edge) -> bool:
    a, b = _ends(edge)
    return bool(abs(a.X() - b.X()) < 1e-6 and abs(a.Z() - b.Z()) < 1e-6)


def _is_in_the_corner(edge: TopoDS_Edge) -> bool:
    point = _ends(edge)[0]
    return bool(abs(point.Z() - 10) < 1e-6 and 30 < point.X() < 50)


def test_opposed_flats_tell_how_far_it_is_across_them() -> None:
    tail = cut(cylinder(20, 34), box((40, 10, 15), (-20, 17, 19)), box((40, 10, 15), (-20, -27, 19)))
    flats = [face for face in find(tail).of("face") if "milled" in face.tags]
    assert [flat.across_flats for flat in flats] == pytest.approx([34 * MM] * 2)


def test_a_window_in_the_wall_of_a_pocket_leaves_it_a_pocket() -> None:
    shroud = cut(box((30, 13, 16)), box((27, 10, 13), (1.5, 1.5, 3)), box((4.5, 3, 8), (12.75, -1, 8)))
    windows = (box((4, 4, 3), (-1, 4.5, 9)), box((4, 4, 3), (27, 4.5, 9)))
    (pocket,) = find(cut(shroud, *windows)).of("pocket")
    assert pocket.depth == pytest.approx(13 * MM)
    assert pocket.length == pytest.approx(27 * MM)
