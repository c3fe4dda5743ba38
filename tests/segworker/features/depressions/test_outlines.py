"""What outlines are called, what is inside of them, and what only stands in them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
from OCP.BRepOffsetAPI import BRepOffsetAPI_MakePipe
from OCP.collections import Array1_gp_Pnt
from OCP.Geom import Geom_BezierCurve
from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pnt
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import Vec, box, cut, cylinder, filleted, find, fuse, plate, prism, shifted, upright

from querycad_contracts import Part

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-7)


def only(found: list[Part]) -> Part:
    (part,) = found
    return part


def arch(width: float, height: float, thickness: float) -> TopoDS_Shape:
    """A rectangle with a half circle on top."""
    return fuse(box((width, height, thickness), (-width / 2, -height, 0)), cylinder(width / 2, thickness))


@pytest.mark.parametrize("floor", [0, 3])
def test_a_window_with_a_round_top_is_arched_and_no_triangle(floor: float) -> None:
    found = find(cut(plate(100, 60, 8), shifted(arch(20, 20, 8), (0, 0, floor - 8))))
    window = only([*found.of("cutout"), *found.of("pocket")])
    assert "arched" in window.tags
    assert [window.length, window.width] == near(30, 20)


def test_a_triangle_with_rounded_corners_stays_one() -> None:
    tool = prism([(-20, -15, -8), (20, -15, -8), (0, 20, -8)], (0, 0, 8))
    window = only(find(cut(plate(100, 60, 8), filleted(tool, 3, *upright(tool)))).of("cutout"))
    assert {"triangular", "rounded_corners"} <= set(window.tags)


def test_rounded_corners_make_no_round_end_of_a_slot() -> None:
    tool = box((20, 40, 10), (-10, 0, -10))
    corners = [edge for edge in upright(tool) if math.isclose(BRepAdaptor_Curve(edge).Value(0.0).Y(), 0, abs_tol=1e-9)]
    slot = only(find(cut(plate(100, 60, 20), filleted(tool, 4, *corners))).of("slot"))
    assert {"rectangular", "rounded_corners"} <= set(slot.tags)
    assert slot.radius == pytest.approx(4 * MM)


def test_the_round_end_of_an_end_mill_does() -> None:
    slot = only(
        find(cut(plate(100, 60, 20), box((20, 40, 10), (-10, 0, -10)), cylinder(10, 10, (0, 0, -10)))).of("slot")
    )
    assert "obround" in slot.tags


def cover(tab: TopoDS_Shape) -> TopoDS_Shape:
    """Open below, its walls 2 mm thick, with a tab."""
    return fuse(cut(box((100, 60, 15), (-50, -30, 0)), box((96, 56, 13), (-48, -28, 0))), tab)


def test_a_tab_that_hangs_out_of_a_cover_is_none_of_its_inside() -> None:
    found = find(cover(box((1.5, 10, 8), (-48, -5, -6))))
    inside = only(found.of("pocket"))
    assert [inside.length, inside.width, inside.depth] == near(96, 56, 13)
    assert [floor.thickness for floor in found.of("floor")] == near(2)


def test_a_block_inside_a_cover_leaves_its_measures() -> None:
    inside = only(find(cover(box((10, 10, 6), (-48, -5, 4)))).of("pocket"))
    assert [inside.length, inside.width, inside.depth] == near(96, 56, 13)


def swept(path: Sequence[Vec], radius: float) -> TopoDS_Shape:
    """A bar along a Bezier curve that begins along z; millimetres."""
    poles = Array1_gp_Pnt(1, len(path))
    for i, point in enumerate(path, start=1):
        poles.SetValue(i, gp_Pnt(*point))
    spine = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(Geom_BezierCurve(poles)).Edge()).Wire()
    ring = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(*path[0]), gp_Dir(0, 0, 1), gp_Dir(0, 1, 0)), radius)).Edge()
    return BRepOffsetAPI_MakePipe(spine, BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(ring).Wire()).Face()).Shape()


def test_the_inside_of_a_tube_bent_along_a_curve_is_no_cutout_and_a_bent_window_in_a_plate_is_one() -> None:
    path = [(0.0, 0.0, 0.0), (0.0, 0.0, 80.0), (200.0, 0.0, 180.0)]
    tube = find(cut(swept(path, 20), swept(path, 18)))
    assert not tube.of("cutout")
    assert any("ends aside" in one.reason for one in tube.refused)
    leaning = swept([(0.0, 0.0, -30.0), (0.0, 0.0, -10.0), (8.0, 0.0, 10.0)], 10)
    assert len(find(cut(plate(), leaning)).of("cutout")) == 1
