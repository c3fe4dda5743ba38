"""What plain parts are made of: legs of bent sheet, gaps of rings, grooves in bores, balls on studs, filled holes."""

from __future__ import annotations

import math

import pytest
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.BRepPrimAPI import BRepPrimAPI_MakeSphere, BRepPrimAPI_MakeTorus
from OCP.gp import gp_Pnt, gp_Trsf, gp_Vec
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, compound, cut, cylinder, find, fuse, turned

MM = 1e-3


def tube(outer: float, inner: float, height: float, z: float = 0.0) -> TopoDS_Shape:
    return cut(cylinder(outer, height, (0, 0, z)), cylinder(inner, height, (0, 0, z)))


def ball(radius: float, z: float) -> TopoDS_Shape:
    return BRepPrimAPI_MakeSphere(gp_Pnt(0, 0, z), radius).Shape()


def bent_channel(inner: float = 2.0, sheet: float = 2.0) -> TopoDS_Shape:
    """60 wide, 25 high and 100 long, of 2 mm sheet with bends."""
    outer = inner + sheet
    side = box((sheet, 100, 25 - outer), (-30, 0, outer))
    corner = cut(
        turned(cylinder(outer, 100), (1, 0, 0), -90),
        turned(cylinder(inner, 100), (1, 0, 0), -90),
        box((2 * outer, 100, outer), (-outer, 0, 0)),
        box((outer, 100, 2 * outer), (0, 0, -outer)),
    )
    half = fuse(side, moved(corner, (-30 + outer, 0, outer)), box((30 - outer, 100, sheet), (-30 + outer, 0, 0)))
    return fuse(half, turned(moved(half, (0, -100, 0)), (0, 0, 1), 180))


def moved(shape: TopoDS_Shape, by: tuple[float, float, float]) -> TopoDS_Shape:
    move = gp_Trsf()
    move.SetTranslation(gp_Vec(*by))
    return BRepBuilderAPI_Transform(shape, move).Shape()


def hexagon(height: float, across: float = 22.0) -> TopoDS_Shape:
    slab = box((across, 3 * across, height), (-across / 2, -1.5 * across, 0))
    both = BRepAlgoAPI_Common(slab, turned(slab, (0, 0, 1), 60)).Shape()
    return BRepAlgoAPI_Common(both, turned(slab, (0, 0, 1), 120)).Shape()


def test_the_legs_of_a_bent_channel_reach_to_the_outside_of_the_bend() -> None:
    legs = [part for part in find(bent_channel()).of("wall") if "leg" in part.tags]
    assert [leg.height for leg in legs] == pytest.approx([25 * MM, 25 * MM])


def test_a_box_has_walls_and_no_legs() -> None:
    tray = cut(box((80, 60, 30)), box((76, 56, 28), (2, 2, 2)))
    assert not [part for part in find(tray).parts if "leg" in part.tags]


def test_the_gap_of_a_retaining_ring_is_wider_than_long() -> None:
    clip = cut(tube(15, 12, 1.5), box((6, 10, 1.5), (-3, -18, 0)))
    (gap,) = find(clip).of("slot")
    assert "gap" in gap.tags
    assert gap.width == pytest.approx(6 * MM)


def test_a_slit_of_a_collar_is_no_gap() -> None:
    (slit,) = find(cut(tube(20, 8, 12), box((2, 14, 12), (-1, -21, 0)))).of("slot")
    assert "slit" in slit.tags


def test_what_a_ring_groove_leaves_level_is_no_boss() -> None:
    cover = cut(cylinder(40, 8), tube(29, 26, 2, 6), cylinder(6, 8))
    assert sorted(boss.diameter or 0.0 for boss in find(cover).of("boss")) == pytest.approx([80 * MM])


def test_what_stands_above_the_groove_around_it_is_one() -> None:
    cover = fuse(cut(cylinder(40, 8), tube(29, 26, 2, 6)), cylinder(26, 5, (0, 0, 8)))
    assert any(boss.diameter == pytest.approx(52 * MM) for boss in find(cover).of("boss"))


def test_a_counterbore_goes_on_behind_the_groove_of_a_ring() -> None:
    sleeve = cut(cylinder(20, 40), cylinder(10, 40), cylinder(14, 20, (0, 0, 20)), tube(15.5, 14, 2, 30))
    found = find(sleeve)
    (hole,) = found.of("hole")
    (counterbore,) = found.of("counterbore")
    assert sorted(hole.radii) == pytest.approx([10 * MM, 14 * MM])
    assert counterbore.depth == pytest.approx(20 * MM)


def test_a_chamber_in_a_bore_is_a_step_of_it() -> None:
    (hole,) = find(cut(cylinder(30, 60), cylinder(10, 60), cylinder(20, 30, (0, 0, 15)))).of("hole")
    assert max(hole.radii) == pytest.approx(20 * MM)


def test_a_ball_ends_the_neck_of_its_stud() -> None:
    stud = fuse(cylinder(5, 20), cylinder(9, 5, (0, 0, 20)), cylinder(4, 8, (0, 0, 25)), ball(8, 38))
    (neck,) = [part for part in find(stud).of("boss") if "neck" in part.tags]
    assert neck.diameter == pytest.approx(8 * MM)
    assert neck.height == pytest.approx(38 * MM - math.sqrt(8**2 - 4**2) * MM - 25 * MM)


def test_a_round_tip_belongs_to_its_pin() -> None:
    (pin,) = find(fuse(cylinder(5, 30), ball(5, 30))).of("boss")
    assert pin.height == pytest.approx(35 * MM)


def test_a_hole_with_a_pin_in_it_is_filled() -> None:
    block = cut(box((60, 40, 20)), cylinder(4, 20, (15, 20, 0)), cylinder(4, 20, (45, 20, 0)))
    holes = find(compound(block, cylinder(4, 30, (15, 20, -5)))).of("hole")
    assert [("filled" in hole.tags, round(hole.center[0] / MM)) for hole in holes] == [(True, 15), (False, 45)]


def test_a_hexagon_is_as_thick_as_it_is_along_its_axis() -> None:
    thick, bar = (find(hexagon(height)).of("prism")[0] for height in (10.0, 80.0))
    assert thick.thickness == pytest.approx(10 * MM)
    assert bar.thickness is None or bar.thickness < 25 * MM


def test_the_balls_of_a_bearing_lie_on_a_circle() -> None:
    race = BRepPrimAPI_MakeTorus(15, 3.2).Shape()
    outer, inner = (cut(moved(ring, (0, 0, -4.5)), race) for ring in (tube(21, 16, 9), tube(13.5, 10, 9)))
    balls = [turned(moved(ball(3, 0), (15, 0, 0)), (0, 0, 1), i * 40.0) for i in range(9)]
    (circle,) = find(compound(outer, inner, *balls)).of("pattern")
    assert circle.count == 9
    assert circle.diameter == pytest.approx(30 * MM)


def test_balls_without_rings_are_no_bearing() -> None:
    assert not find(compound(*(moved(ball(3, 0), (10.0 * i, 0, 0)) for i in range(4)))).of("pattern")
