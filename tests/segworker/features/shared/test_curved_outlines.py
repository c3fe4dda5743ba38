"""How long and wide is what arcs of more than half a turn, ellipses and splines bound?"""

from __future__ import annotations

import math

import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.gp import gp_Ax2, gp_Dir, gp_Elips, gp_Pnt, gp_Vec
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, cylinder, find, plate, turned

from querycad_contracts import Part

Z = (0.0, 0.0, 1.0)


def only(shape: TopoDS_Shape, kind: str) -> Part:
    (part,) = (part for part in find(shape).parts if part.kind == kind)
    return part


def size_mm(part: Part) -> tuple[float, float]:
    assert part.length is not None
    assert part.width is not None
    return round(part.length * 1e3, 3), round(part.width * 1e3, 3)


def elliptic(length: float, width: float, depth: float) -> TopoDS_Shape:
    """An elliptic cylinder below z = 0."""
    ellipse = gp_Elips(gp_Ax2(gp_Pnt(0, 0, -depth), gp_Dir(0, 0, 1)), length / 2, width / 2)
    wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ellipse).Edge()).Wire()
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire).Face(), gp_Vec(0, 0, depth)).Shape()


@pytest.mark.parametrize("degrees", [0.0, 90.0])
def test_an_elliptic_pocket_is_as_wide_as_its_ellipse(degrees: float) -> None:
    shape = cut(plate(100, 100, 20), turned(elliptic(60, 24, 8), Z, degrees))
    assert size_mm(only(shape, "pocket")) == (60.0, 24.0)


def test_a_d_shaped_plate_is_as_wide_as_its_arc() -> None:
    """Its arc turns by 227 degrees: its ends and middle alone span 40 x 36.65 mm instead."""
    shape = cut(cylinder(20, 3), box((20, 60, 20), (8, -30, -5)))
    assert size_mm(only(shape, "prism")) == (40.0, 28.0)
    narrow = cut(cylinder(20, 3), box((60, 60, 20), (-8, -30, -5)))  # less than half a turn
    assert size_mm(only(narrow, "prism")) == (round(2 * math.sqrt(20**2 - 8**2), 3), 12.0)


def test_a_ring_with_a_slit_is_a_disc_and_no_plate() -> None:
    ring = cut(cylinder(20, 5), cylinder(8, 5))
    slit = cut(ring, box((30, 2, 5), (0, -1, 0)))
    assert [part.kind for part in find(slit).parts if part.kind in ("prism", "boss")] == ["boss"]
    half = cut(ring, box((60, 60, 5), (2, -30, 0)))  # little more than half of it
    assert "prism" in {part.kind for part in find(half).parts}
