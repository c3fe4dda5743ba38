"""Breaking all edges of a part, or filleting all its corners, changes none of its nominal sizes."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import product

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS_Edge, TopoDS_Shape
from tests.segworker.shapes import box, chamfered, cut, cylinder, edges, extruded, filleted, find, fuse, plate, turned

from querycad_contracts import Part
from querycad_segworker.topology import EdgeConvexity

SIZE = 0.6
MM = 1e-3


def _middle(edge: TopoDS_Edge) -> tuple[float, float, float]:
    curve = BRepAdaptor_Curve(edge)
    point = curve.Value((curve.FirstParameter() + curve.LastParameter()) / 2)
    return round(point.X(), 3), round(point.Y(), 3), round(point.Z(), 3)


def _edges_of(shape: TopoDS_Shape, convexity: EdgeConvexity) -> list[TopoDS_Edge]:
    """The edges where the material turns this way, each once."""
    brep = find(shape).brep
    wanted = {tuple(round(c / MM, 3) for c in edge.mid) for edge in brep.edges if edge.convexity is convexity}
    return list({at: edge for edge in edges(shape) if (at := _middle(edge)) in wanted}.values())


def _as_it_is(shape: TopoDS_Shape) -> TopoDS_Shape:
    return shape


def _chamfered(shape: TopoDS_Shape) -> TopoDS_Shape:
    return chamfered(shape, SIZE, *_edges_of(shape, EdgeConvexity.CONVEX))


def _rounded(shape: TopoDS_Shape) -> TopoDS_Shape:
    return filleted(shape, SIZE, *_edges_of(shape, EdgeConvexity.CONVEX))


def _filleted(shape: TopoDS_Shape) -> TopoDS_Shape:
    return filleted(shape, SIZE, *_edges_of(shape, EdgeConvexity.CONCAVE))


def _profile(*corners: tuple[float, float]) -> TopoDS_Shape:
    """What a cutter with this section, y and z, takes out along x."""
    solid = extruded(corners, -60, 120)  # in x and y, along z
    return turned(turned(solid, (1, 0, 0), 90), (0, 0, 1), 90)


def counterbored() -> TopoDS_Shape:
    bores = [cylinder(4.5, 30, (x, 0, -25)) for x in (-20, 20)]
    return cut(plate(80, 50, 20), *bores, *(cylinder(8, 10, (x, 0, -6)) for x in (-20, 20)))


def t_slotted() -> TopoDS_Shape:
    return cut(plate(100, 70, 40), _profile((-7, -22), (7, -22), (7, 1), (-7, 1)), box((120, 24, 9), (-60, -12, -22)))


def dovetailed_with_relief() -> TopoDS_Shape:
    dovetail = _profile((-15, -10), (15, -10), (9.2265, 0), (-9.2265, 0))
    return cut(plate(80, 60, 30), dovetail, box((120, 6, 4), (-60, -3, -13)))


def stepped_slot() -> TopoDS_Shape:
    return cut(plate(90, 60, 30), box((120, 24, 10), (-60, -12, -8)), box((120, 8, 10), (-60, -4, -14)))


def v_grooved() -> TopoDS_Shape:
    return cut(plate(80, 60, 40), _profile((-20, 0), (0, -20), (20, 0), (20, 1), (-20, 1)))


def gusseted() -> TopoDS_Shape:
    angle = fuse(box((80, 50, 8), (0, -25, 0)), box((8, 50, 50), (0, -25, 0)))
    gusset = turned(extruded([(8, 8), (8, 38), (40, 8)], -3, 6), (1, 0, 0), 90)
    return fuse(angle, gusset)


def stepped_block() -> TopoDS_Shape:
    return cut(plate(80, 40, 30), box((60, 60, 20), (10, -30, -12)))


def flange() -> TopoDS_Shape:
    return cut(fuse(cylinder(40, 10), cylinder(20, 35)), cylinder(12, 60, (0, 0, -10)))


def _tagged(tag: str) -> Callable[[Part], bool]:
    return lambda part: tag in part.tags


EXAMPLES: dict[str, tuple[Callable[[], TopoDS_Shape], str, Callable[[Part], bool], dict[str, float]]] = {
    "counterbore": (counterbored, "counterbore", _tagged("inner"), {"depth": 6, "diameter": 16}),
    "T slot": (t_slotted, "slot", _tagged("t_slot"), {"depth": 22, "width": 14, "bottom_width": 24, "length": 100}),
    "dovetail": (dovetailed_with_relief, "slot", _tagged("dovetail"), {"depth": 10, "bottom_width": 30}),
    "stepped slot": (stepped_slot, "slot", lambda p: (p.width or 0) > 10 * MM, {"depth": 8, "width": 24, "length": 90}),
    "V groove": (v_grooved, "slot", _tagged("v_shaped"), {"width": 40, "length": 80}),
    "gusset": (gusseted, "rib", _tagged("gusset"), {"height": 30, "length": 32, "thickness": 6}),
    "step": (stepped_block, "step", _tagged("rectangular"), {"depth": 12, "width": 30, "length": 40}),
    "hub": (flange, "boss", lambda p: p.diameter == pytest.approx(40 * MM), {"height": 25}),
}


@cache
def _shape(name: str) -> TopoDS_Shape:
    return EXAMPLES[name][0]()


CHANGES = (_as_it_is, _chamfered, _rounded, _filleted)
TOES = {("gusset", _chamfered), ("gusset", _rounded)}
"""The kernel breaks no edge that ends in the sharp toe of a gusset."""


@pytest.mark.parametrize(("name", "change"), [one for one in product(EXAMPLES, CHANGES) if one not in TOES])
def test_broken_edges_change_no_size(name: str, change: Callable[[TopoDS_Shape], TopoDS_Shape]) -> None:
    _, kind, belongs, sizes = EXAMPLES[name]
    parts = [part for part in find(change(_shape(name))).parts if part.kind == kind and belongs(part)]
    assert parts
    for part in parts:
        found = {measure: getattr(part, measure) for measure in sizes}
        assert found == pytest.approx({measure: size * MM for measure, size in sizes.items()}, rel=2e-3)


def test_steps_on_both_sides_of_a_rail_are_no_slot() -> None:
    rail = cut(plate(90, 60, 30), box((120, 30, 10), (-60, 20, -8)), box((120, 30, 10), (-60, -50, -8)))
    found = find(cut(rail, box((120, 8, 10), (-60, -4, -6))))
    assert len(found.of("step")) == 2
    assert [slot.width for slot in found.of("slot")] == pytest.approx([8 * MM])
