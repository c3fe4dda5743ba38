"""Fillets and rounds: along straight and round edges, between curved faces, in corners, and of changing radius."""

from __future__ import annotations

import math

import pytest
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet
from OCP.TopoDS import TopoDS_Edge, TopoDS_Shape
from tests.segworker.shapes import (
    box,
    cone,
    cut,
    cylinder,
    edges,
    extruded,
    filleted,
    find,
    fuse,
    nurbs,
    plate,
    prism,
    rims,
    turned,
    upright,
)

MM = 1e-3
MOVES = {"as built": lambda shape: shape, "oblique": lambda shape: turned(shape, (1, 2, 3), 37), "B-splines": nurbs}


def changing(shape: TopoDS_Shape, first: float, last: float, *chosen: TopoDS_Edge) -> TopoDS_Shape:
    """Rounds whose radius grows along the edge."""
    maker = BRepFilletAPI_MakeFillet(shape)
    for edge in chosen:
        maker.Add(first, last, edge)
    return maker.Shape()


@pytest.mark.parametrize("move", MOVES)
def test_three_rounds_and_the_ball_in_their_corner_are_one_round(move: str) -> None:
    block = box((30, 20, 10))
    corner = [e for e in edges(block) if _touches(e, (0, 0, 0))]
    found = find(MOVES[move](filleted(block, 2.0, *corner)))
    (made,) = found.of("round")
    assert made.radius == pytest.approx(2 * MM, rel=1e-3)
    assert len(made.faces) == 4
    assert found.of("fillet") == []


@pytest.mark.parametrize("move", MOVES)
def test_all_edges_of_a_block_rounded_are_one_round(move: str) -> None:
    block = box((30, 20, 10))
    (made,) = find(MOVES[move](filleted(block, 2.0, *edges(block)))).of("round")
    assert len(made.faces) == 12 + 8


@pytest.mark.parametrize("move", MOVES)
def test_the_foot_of_a_boss_on_a_shaft_is_a_fillet_between_curved_faces(move: str) -> None:
    """Two cylinders meet: the fillet between them is freeform."""
    cross = fuse(cylinder(10, 60), cylinder(5, 25, (0, 0, 30), (1, 0, 0)))
    meeting = [e for e in edges(cross) if _is_space_curve(e)]
    found = find(MOVES[move](filleted(cross, 1.5, *meeting)))
    (made,) = found.of("fillet")
    assert made.radius == pytest.approx(1.5 * MM, rel=0.02)


@pytest.mark.parametrize("move", MOVES)
def test_the_foot_of_a_boss_on_a_plate_is_a_fillet(move: str) -> None:
    body = fuse(plate(), cylinder(8, 12))
    (made,) = find(MOVES[move](filleted(body, 2.0, *rims(body, 8, 0)))).of("fillet")
    assert made.radius == pytest.approx(2 * MM, rel=1e-3)


@pytest.mark.parametrize("move", MOVES)
def test_a_round_of_changing_radius_is_a_round_between_its_radii(move: str) -> None:
    block = plate()
    found = find(MOVES[move](changing(block, 2.0, 5.0, upright(block)[0])))
    (made,) = found.of("round")
    assert 2 * MM <= (made.radius or 0) <= 5 * MM
    assert "variable" in made.tags
    assert list(made.radii) == pytest.approx([2 * MM, 5 * MM], rel=0.02)


@pytest.mark.parametrize("move", MOVES)
def test_an_inner_corner_of_changing_radius_is_a_fillet(move: str) -> None:
    angle = cut(box((40, 30, 30)), box((40, 30, 30), (0, 10, 10)))
    inner = [e for e in edges(angle) if _touches(e, (0, 10, 10)) and _touches(e, (40, 10, 10))]
    (made,) = find(MOVES[move](changing(angle, 3.0, 6.0, inner[0]))).of("fillet")
    assert "variable" in made.tags
    assert list(made.radii) == pytest.approx([3 * MM, 6 * MM], rel=0.02)


@pytest.mark.parametrize("move", MOVES)
def test_a_freeform_face_that_is_tangent_on_one_side_only_is_no_fillet(move: str) -> None:
    dented = cut(plate(), turned(cylinder(60, 100, (0, 55, -50)), (1, 0, 0), 8))
    assert find(MOVES[move](dented)).of("fillet") == []


def _touches(edge: TopoDS_Edge, point: tuple[float, float, float]) -> bool:
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    curve = BRepAdaptor_Curve(edge)
    ends = (curve.Value(curve.FirstParameter()), curve.Value(curve.LastParameter()))
    return any(max(abs(a - b) for a, b in zip((p.X(), p.Y(), p.Z()), point, strict=True)) < 1e-6 for p in ends)


def _is_space_curve(edge: TopoDS_Edge) -> bool:
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GeomAbs import GeomAbs_CurveType

    plain = (GeomAbs_CurveType.GeomAbs_Line, GeomAbs_CurveType.GeomAbs_Circle)
    return BRepAdaptor_Curve(edge).GetType() not in plain


def test_corners_cut_off_a_block_are_chamfers_and_the_end_between_them_is_none() -> None:
    block = extruded([(15, 0), (80, 0), (80, 40), (15, 40), (0, 25), (0, 15)], 0, 20)
    for shape in (block, turned(block, (1, 2, 3), 40)):
        found = find(shape).of("chamfer")
        assert [one.width for one in found] == pytest.approx([15e-3 * math.sqrt(2)] * 2)
    octagon = [(math.cos(math.radians(45 * i)), math.sin(math.radians(45 * i))) for i in range(8)]
    assert not find(extruded([(20 * x, 20 * y) for x, y in octagon], 0, 20)).of("chamfer")


def test_a_slope_that_carries_a_boss_shapes_the_body() -> None:
    wedge = prism([(0, 0, 0), (60, 0, 0), (60, 0, 20), (25, 0, 55), (0, 0, 55)], (0, 45, 0))
    assert len(find(wedge).of("chamfer")) == 1
    assert not find(fuse(wedge, cylinder(8, 20, (42.5, 22.5, 37.5), (1, 0, 1)))).of("chamfer")


def test_a_hole_through_a_chamfer_leaves_its_width() -> None:
    wedge = prism([(0, 0, 0), (40, 0, 0), (40, 0, 15), (35, 0, 20), (0, 0, 20)], (0, 60, 0))
    (chamfer,) = find(cut(wedge, cylinder(2, 20, (30, 30, 10), (1, 0, 1)))).of("chamfer")
    assert chamfer.width == pytest.approx(5 * math.sqrt(2) * MM)


def test_a_notch_in_a_cut_corner_leaves_its_width() -> None:
    sheet = extruded([(0, 0), (80, 0), (80, 47), (72, 55), (0, 55)], 0, 4)
    notched = cut(sheet, turned(box((40, 5, 2), (70, -2.5, 0)), (0, 0, 1), math.degrees(math.atan2(51, 76))))
    (chamfer,) = find(notched).of("chamfer")
    assert chamfer.width == pytest.approx(8 * math.sqrt(2) * MM)


def test_a_face_beside_an_end_of_two_slopes_is_no_chamfer() -> None:
    lower, upper = (prism([(0, 0, z), (40, 0, z), (40, 0, z + 3), (0, 0, z + 3)], (6 + z, 12, 0)) for z in (0, 3))
    assert not find(fuse(lower, upper)).of("chamfer")


def test_a_v_groove_makes_no_chamfer_of_the_face_that_it_is_cut_into() -> None:
    groove = prism([(-5, 0, 0), (5, 0, 0), (0, 0, -5)], (0, 30, 0))
    assert not find(cut(box((80, 60, 20), (-40, 0, -20)), groove)).of("chamfer")


def hexagon_nut(corners: float) -> TopoDS_Shape:
    """30 across flats, 18 high, turned down to a radius of `corners`; cones from a radius of 15 break both ends."""
    outline = [(math.cos(i * math.pi / 3) * 17.3205, math.sin(i * math.pi / 3) * 17.3205) for i in range(6)]
    rings = [cut(cylinder(25, 3, (0, 0, -1)), cone(13.268, 18.464, 3, (0, 0, -1)))]
    rings += [cut(cylinder(25, 3, (0, 0, 16)), cone(18.464, 13.268, 3, (0, 0, 16)))]
    around = cut(cylinder(25, 18), cylinder(corners, 18))
    return cut(extruded(outline, 0, 18), *rings, around, cylinder(10, 18))


@pytest.mark.parametrize("corners", [20.0, 17.2])
@pytest.mark.parametrize("degrees", [0, 35])
def test_the_corners_of_a_nut_are_chamfered_at_both_ends_and_no_bosses(corners: float, degrees: float) -> None:
    found = find(turned(hexagon_nut(corners), (1, 2, 3), degrees))
    assert len(found.of("chamfer")) == 2
    assert [part.angle for part in found.of("chamfer")] == pytest.approx([math.radians(30)] * 2, rel=1e-4)
    assert not found.of("boss")


def test_a_cone_on_the_end_of_a_hexagon_is_a_boss_and_no_chamfer() -> None:
    outline = [(math.cos(i * math.pi / 3) * 17.3205, math.sin(i * math.pi / 3) * 17.3205) for i in range(6)]
    found = find(fuse(extruded(outline, 0, 18), cone(15, 12, 6, (0, 0, 18))))
    assert not found.of("chamfer")
    assert ["conical" in boss.tags for boss in found.of("boss")] == [True]
