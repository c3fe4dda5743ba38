"""What meets in concave edges and is no step: obtuse sides of a body, corners of walls; what looks alike is one."""

from __future__ import annotations

import math

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.GeomAbs import GeomAbs_CurveType
from OCP.TopoDS import TopoDS_Edge, TopoDS_Shape
from tests.segworker.shapes import (
    Vec,
    box,
    cut,
    cylinder,
    edges,
    extruded,
    filleted,
    find,
    fuse,
    plate,
    turned,
    upright,
)

from querycad_contracts import Part

MM = 1e-3


def leaning(degrees: float) -> list[str]:
    """What is cut into a block with a ledge whose wall leans back so far from upright."""
    back = 20 * math.tan(math.radians(degrees))
    outline = [(0, 0), (60, 0), (60, 10), (40, 10), (40 - back, 30), (0, 30)]
    return [part.kind for part in find(extruded(outline, 0, 40)).parts if part.kind.cuts_in]


@pytest.mark.parametrize("degrees", [30.0, 45.0])
def test_sides_of_a_body_at_an_obtuse_angle_are_no_step(degrees: float) -> None:
    assert not leaning(degrees)


@pytest.mark.parametrize("degrees", [0.0, 20.0])
def test_a_step_with_a_leaning_wall_is_one(degrees: float) -> None:
    assert leaning(degrees) == ["step"]


def angle(thick: float, inside: float = 0.0) -> list[Part]:
    """The steps and what is nameless of an angle with legs of 60 and 50, 40 long, with a fillet inside."""
    shape = extruded([(0, 0), (60, 0), (60, thick), (thick, thick), (thick, 50), (0, 50)], 0, 40)
    if inside:
        corner = box((inside, inside, 40), (thick, thick, 0))
        shape = fuse(shape, cut(corner, cylinder(inside, 40, (thick + inside, thick + inside, 0))))
    return [part for part in find(shape).parts if part.kind in ("step", "depression", "elevation")]


@pytest.mark.parametrize("inside", [0.0, 4.0], ids=["sharp", "filleted"])
def test_the_inside_of_an_angle_bracket_is_no_step(inside: float) -> None:
    assert not angle(8.0, inside)


def test_what_is_cut_out_of_a_thick_block_is_a_step() -> None:
    """Neither of its faces is level: the larger one is the floor."""
    assert [part.depth for part in angle(30.0) if part.kind == "step"] == [pytest.approx(20 * MM)]


@pytest.mark.parametrize("turn", [0.0, 90.0])
def test_a_rebate_in_the_edge_of_a_plate_is_a_step(turn: float) -> None:
    found = find(turned(cut(plate(80, 60, 10), box((100, 5, 5), (-50, 25, -5))), (1, 0, 0), turn))
    assert [step.depth for step in found.of("step")] == [pytest.approx(5 * MM)]


def cut_in_and_standing_out(*tools: TopoDS_Shape) -> list[str]:
    """What is cut into a shaft of 20 by 60 along z, and what of it has no name."""
    found = find(cut(cylinder(10, 60), *tools)).parts
    return [part.kind for part in found if part.kind.cuts_in or part.kind == "elevation"]


def test_the_flat_of_a_d_shaft_is_no_step_and_the_d_no_elevation() -> None:
    assert not cut_in_and_standing_out(box((20, 10, 25), (-10, 7, 35)))


@pytest.mark.parametrize(
    ("size", "at", "kind"),
    [((6, 10, 25), (-3, 7, 35), "slot"), ((10, 10, 70), (2, 2, -5), "step")],
    ids=["keyway", "corner along the shaft"],
)
def test_other_cuts_in_a_shaft_are_found(size: Vec, at: Vec, kind: str) -> None:
    assert kind in cut_in_and_standing_out(box(size, at))


def test_a_step_across_a_block_with_round_ends_is_one() -> None:
    block = fuse(box((60, 20, 30), (-30, -10, 0)), cylinder(10, 30, (-30, 0, 0)), cylinder(10, 30, (30, 0, 0)))
    (step,) = find(cut(block, box((30, 40, 10), (20, -20, 20)))).of("step")
    assert step.depth == pytest.approx(10 * MM)


def middle(edge: TopoDS_Edge) -> Vec:
    curve = BRepAdaptor_Curve(edge)
    at = curve.Value((curve.FirstParameter() + curve.LastParameter()) / 2)
    return at.X(), at.Y(), at.Z()


def lines(shape: TopoDS_Shape, level: float, within: float) -> list[TopoDS_Edge]:
    """The straight edges along x or y at a height, no farther than that from the middle."""
    found = []
    for edge in edges(shape):
        x, y, z = middle(edge)
        straight = BRepAdaptor_Curve(edge).GetType() == GeomAbs_CurveType.GeomAbs_Line
        if straight and abs(z - level) < 1e-6 and max(abs(x), abs(y)) < within:
            found.append(edge)
    return found


def test_the_plate_around_a_socket_at_its_border_is_no_step() -> None:
    """The socket lies on the plate over fillets, and has a plane end."""
    socket = fuse(plate(80, 60, 8), cylinder(15, 40, (0, -10, 8), (0, 1, 0)))
    assert not find(filleted(socket, 2, *lines(socket, 0, 20))).of("step")


@pytest.mark.parametrize("corner", [False, True], ids=["along an edge", "in a corner"])
def test_a_step_with_rounded_feet_is_one(corner: bool) -> None:
    block = cut(plate(), box((40 if corner else 70, 10, 5), (-5 if corner else -35, 12, -5)))
    (step,) = find(filleted(block, 2, *lines(block, -5, 19))).of("step")
    assert step.depth == pytest.approx(5 * MM)


def test_a_step_that_also_cuts_into_a_round_edge_is_one() -> None:
    rounded = fuse(plate(), cylinder(6, 40, (32, -20, -9), (0, 1, 0)))
    (step,) = find(cut(rounded, box((80, 15, 5), (-40, 10, -5)))).of("step")
    assert step.depth == pytest.approx(5 * MM)


def test_the_sides_of_a_bent_bar_are_no_cut() -> None:
    """They meet at 150 degrees, over a fillet."""
    outline = [(0, 0), (40, 0), (75, 20), (70, 29), (38, 10), (0, 10)]
    bar = extruded(outline, 0, 30)
    inside = [edge for edge in upright(bar) if math.dist(middle(edge), (38, 10, 15)) < 1e-6]
    assert not [part for part in find(filleted(bar, 8, *inside)).parts if part.kind.cuts_in]
