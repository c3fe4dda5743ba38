"""From shape to B-rep: exact boxes, convexity of edges, canonical surfaces, loose and broken faces."""

from __future__ import annotations

import math
from collections import Counter

import pytest
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy, BRepBuilderAPI_MakeFace
from OCP.BRepPrimAPI import BRepPrimAPI_MakeTorus
from OCP.Geom import Geom_RectangularTrimmedSurface
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
from OCP.TopoDS import TopoDS, TopoDS_Face, TopoDS_Shape
from tests.segworker.shapes import (
    UP,
    Found,
    Vec,
    ball,
    box,
    chamfered,
    compound,
    cone,
    cut,
    cylinder,
    faces,
    filleted,
    find,
    fuse,
    nurbs,
    plate,
    rims,
    shuffled,
    turned,
    upright,
)

from querycad_contracts import SurfaceKind
from querycad_segworker.errors import IncompleteFile
from querycad_segworker.topology import EdgeConvexity, EdgeKind
from querycad_segworker.vectors import unit

OBLIQUE = unit((1.0, 2.0, 3.0))


def extents_mm(found: Found) -> list[float]:
    low, high = found.brep.box
    return [(b - a) * 1e3 for a, b in zip(low, high, strict=True)]


def torus(major: float, minor: float, along: Vec = UP) -> TopoDS_Shape:
    return BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(*along)), major, minor).Shape()


def test_the_box_of_a_block_has_no_gap() -> None:
    assert extents_mm(find(box((10, 20, 30)))) == pytest.approx([10, 20, 30], abs=1e-12)


@pytest.mark.parametrize("form", [lambda s: s, nurbs], ids=["native", "B-splines"])
@pytest.mark.parametrize("along", [UP, OBLIQUE, (1.0, 0.0, 1.0)])
def test_boxes_of_round_bodies_are_exact_however_they_lie(along: Vec, form: object) -> None:
    a = unit(along)
    across = [math.sqrt(max(0.0, 1 - c * c)) for c in a]
    expected = {
        "cylinder": [30 * abs(c) + 2 * 7 * s for c, s in zip(a, across, strict=True)],
        "ball": [18.0] * 3,
        "torus": [2 * (20 * s + 4) for s in across],
    }
    built = {"cylinder": cylinder(7, 30, along=along), "ball": ball(9, (5, 6, 7)), "torus": torus(20, 4, along)}
    for name, shape in built.items():
        assert extents_mm(find(form(shape))) == pytest.approx(expected[name], abs=2e-4), name  # type: ignore[operator]


def test_the_box_of_a_slice_of_a_ball_stops_where_the_ball_is_cut() -> None:
    sliced = cut(ball(10), box((40, 40, 40), (-20, -20, 6)))
    low, high = find(sliced).brep.box
    assert low == pytest.approx((-0.010, -0.010, -0.010))
    assert high == pytest.approx((0.010, 0.010, 0.006))


def test_the_box_of_a_quarter_of_a_ring_stops_at_its_ends() -> None:
    quarter = cut(torus(20, 4), box((60, 30, 20), (-30, -30, -10)), box((30, 60, 20), (-30, -30, -10)))
    low, high = find(quarter).brep.box
    assert low == pytest.approx((0.0, 0.0, -0.004), abs=1e-9)
    assert high == pytest.approx((0.024, 0.024, 0.004), abs=1e-9)


def test_each_face_has_the_box_that_its_triangles_fill() -> None:
    found = find(nurbs(turned(fuse(torus(20, 4), ball(9), cone(6, 2, 30)), OBLIQUE, 40)))
    for face in found.brep.faces:
        corners = found.mesh.vertices_m[found.mesh.triangles[found.mesh.triangle_face == face.id].ravel()]
        size = max(b - a for a, b in zip(*found.brep.box, strict=True))
        assert corners.min(axis=0) == pytest.approx(face.box[0], abs=6e-3 * size)
        assert corners.max(axis=0) == pytest.approx(face.box[1], abs=6e-3 * size)


def test_every_edge_of_a_block_is_convex_with_a_right_angle() -> None:
    edges = find(box((10, 20, 30))).brep.edges
    assert len(edges) == 12
    for edge in edges:
        assert edge.kind is EdgeKind.LINE
        assert edge.convexity is EdgeConvexity.CONVEX
        assert edge.angle == pytest.approx(math.pi / 2)
        assert len(edge.faces) == 2


@pytest.mark.parametrize("store", [lambda s: s, nurbs, shuffled], ids=["native", "B-splines", "reordered"])
def test_edges_are_convex_concave_or_smooth_as_the_material_lies(store: object) -> None:
    block = fuse(cut(plate(), cylinder(4, 30, (-15, 0, -25))), cylinder(5, 8, (15, 0, 0)))
    brep = find(store(block)).brep  # type: ignore[operator]
    circles = {
        (round((e.radius or 0) * 1e3), round((e.center or (0, 0, 0))[2] * 1e3)): e.convexity
        for e in brep.edges
        if e.kind is EdgeKind.CIRCLE
    }
    assert circles == {
        (4, 0): EdgeConvexity.CONVEX,
        (4, -20): EdgeConvexity.CONVEX,
        (5, 0): EdgeConvexity.CONCAVE,
        (5, 8): EdgeConvexity.CONVEX,
    }
    assert Counter(e.convexity for e in brep.edges)[EdgeConvexity.SEAM] == 2


def test_a_fillet_meets_its_neighbours_smoothly() -> None:
    block = plate()
    brep = find(filleted(block, 3.0, upright(block)[0])).brep
    (blend,) = [face for face in brep.faces if face.kind is SurfaceKind.CYLINDER]
    assert blend.outward == 1
    assert blend.sweep == pytest.approx(math.pi / 2)
    along = [edge.convexity for edge, _ in brep.neighbours(blend.id) if edge.kind is EdgeKind.LINE]
    assert along == [EdgeConvexity.SMOOTH, EdgeConvexity.SMOOTH]


def test_a_fillet_in_a_corner_is_concave() -> None:
    block = fuse(plate(), cylinder(5, 8))
    brep = find(filleted(block, 1.0, *rims(block, 5, 0))).brep
    (blend,) = [face for face in brep.faces if face.kind is SurfaceKind.TORUS]
    assert blend.outward == -1
    assert blend.minor_radius == pytest.approx(0.001)
    assert blend.radius == pytest.approx(0.006)


def test_a_chamfer_meets_its_neighbours_at_half_a_right_angle() -> None:
    block = plate()
    brep = find(chamfered(block, 3.0, upright(block)[0])).brep
    slanted = [f for f in brep.faces if all(abs(c) < 0.9 for c in f.axis)]
    assert len(slanted) == 1
    angles = [edge.angle for edge, _ in brep.neighbours(slanted[0].id) if edge.angle < 1.0]
    assert angles == pytest.approx([math.pi / 4, math.pi / 4])


def parade() -> TopoDS_Shape:
    """One body with each canonical surface, inner and outer."""
    block = fuse(plate(100, 40, 20), cylinder(6, 10, (-40, 0, 0)), cone(8, 4, 10, (-15, 0, 0)))
    block = cut(block, cylinder(5, 30, (8, 0, -25)), ball(6, (25, 0, 0)), cone(6, 2, 8, (40, 0, 0), (0, 0, -1)))
    return filleted(block, 1.5, *rims(block, 6, 10))


def test_b_splines_that_are_plain_surfaces_are_recognised_as_those() -> None:
    native, converted = find(parade()).brep, find(nurbs(parade())).brep
    assert {f.kind for f in native.faces} == set(SurfaceKind) - {SurfaceKind.FREEFORM}
    for before, after in zip(native.faces, converted.faces, strict=True):
        assert after.kind is before.kind
        assert after.outward == before.outward
        assert after.radius == pytest.approx(before.radius, abs=1e-7)
        assert after.minor_radius == pytest.approx(before.minor_radius, abs=1e-7)
        assert after.half_angle == pytest.approx(before.half_angle, abs=1e-6)
        assert after.sweep == pytest.approx(before.sweep, abs=1e-4)
        assert after.area == pytest.approx(before.area, rel=1e-4)
        if before.kind is not SurfaceKind.SPHERE:
            assert abs(sum(a * b for a, b in zip(after.axis, before.axis, strict=True))) == pytest.approx(1.0)


def test_a_b_spline_that_is_trimmed_once_more_is_recognised_too() -> None:
    """Some systems write a rectangular trimmed surface around the B-spline."""
    face = next(f for f in faces(nurbs(cone(8, 4, 10))) if find(f).brep.faces[0].kind is SurfaceKind.CONE)
    spline = BRep_Tool.Surface_s(TopoDS.Face(face))
    low_u, high_u, low_v, high_v = spline.Bounds()
    trimmed = Geom_RectangularTrimmedSurface(
        spline, low_u, low_u + 0.9 * (high_u - low_u), low_v, low_v + 0.9 * (high_v - low_v)
    )
    (record,) = find(BRepBuilderAPI_MakeFace(trimmed, 1e-7).Face()).brep.faces
    assert record.kind is SurfaceKind.CONE
    assert record.half_angle == pytest.approx(math.atan(0.4))


@pytest.mark.parametrize(("shape", "volume"), [(cylinder(10, 20), 2000 * math.pi), (ball(10), 4000 * math.pi / 3)])
def test_volumes_of_b_splines_are_as_exact_as_those_of_plain_surfaces(shape: TopoDS_Shape, volume: float) -> None:
    assert find(shape).shape.volume == pytest.approx(volume * 1e-9, rel=1e-9)
    assert find(nurbs(shape)).shape.volume == pytest.approx(volume * 1e-9, rel=1e-4)


def test_a_really_free_surface_stays_free() -> None:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeWire
    from OCP.BRepOffsetAPI import BRepOffsetAPI_ThruSections
    from OCP.gp import gp_Elips

    loft = BRepOffsetAPI_ThruSections(True)
    for z, major, minor in ((0, 20, 8), (15, 12, 10), (30, 22, 6)):
        ellipse = gp_Elips(gp_Ax2(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1)), major, minor)
        loft.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ellipse).Edge()).Wire())
    kinds = Counter(face.kind for face in find(loft.Shape()).brep.faces)
    assert kinds[SurfaceKind.FREEFORM] >= 1
    assert kinds[SurfaceKind.PLANE] == 2


def loose(shape: TopoDS_Shape, count: int | None = None) -> TopoDS_Shape:
    """The faces of a shape, each with edges of its own."""
    return compound(*(BRepBuilderAPI_Copy(face).Shape() for face in faces(shape)[:count]))


def test_loose_surfaces_that_close_are_sewn_to_a_body_with_a_volume() -> None:
    found = find(loose(cut(plate(), cylinder(5, 30, (0, 0, -25)))))
    (body,) = found.brep.bodies
    assert body.volume == pytest.approx((60 * 40 * 20 - math.pi * 25 * 20) * 1e-9)
    assert all(len(edge.faces) == 2 or edge.convexity is EdgeConvexity.SEAM for edge in found.brep.edges)
    assert any("belong to no solid" in warning for warning in found.brep.warnings)
    assert found.hole.radius == pytest.approx(0.005)


def test_an_open_shell_has_no_volume_and_says_so() -> None:
    found = find(loose(box((10, 10, 10)), 5))
    (body,) = found.brep.bodies
    assert not body.is_solid
    assert body.volume == 0.0
    assert body.area == pytest.approx(5e-4)
    assert any("not closed" in warning for warning in found.brep.warnings)


def test_surfaces_apart_are_bodies_apart() -> None:
    found = find(compound(loose(box((10, 10, 10))), loose(box((10, 10, 10), (50, 0, 0)), 3)))
    assert [(len(body.faces), body.is_solid) for body in found.brep.bodies] == [(6, True), (3, False)]


def test_a_body_that_is_stored_inside_out_is_turned() -> None:
    found = find(cut(plate(), cylinder(5, 30, (0, 0, -25))).Reversed())
    assert found.brep.bodies[0].volume > 0
    assert found.hole.radius == pytest.approx(0.005)
    assert found.of("boss") == []


def test_a_face_without_a_surface_is_left_out_with_a_warning() -> None:
    empty = TopoDS_Face()
    BRep_Builder().MakeFace(empty)
    found = find(compound(box((10, 10, 10)), empty))
    assert len(found.brep.faces) == 6
    assert "1 face(s) without a surface were left out" in found.brep.warnings


def test_a_file_without_faces_is_refused() -> None:
    with pytest.raises(IncompleteFile, match="no face"):
        _ = find(compound()).brep


def test_touching_bodies_stay_two() -> None:
    found = find(compound(box((10, 10, 10)), box((10, 10, 10), (10, 0, 0))))
    assert [body.volume for body in found.brep.bodies] == [pytest.approx(1e-6)] * 2
    assert {face.body for face in found.brep.faces} == {0, 1}


def test_the_volume_of_a_bolt_is_exact_to_a_millionth() -> None:
    """Many small faces with arcs: where integration with a loose tolerance goes wrong first."""
    bolt = fuse(cylinder(5, 30), cylinder(9, 6, (0, 0, 30)))
    bolt = cut(bolt, box((4, 40, 3), (-2, -20, 33)), cylinder(1, 40, (0, -20, 5), (0, 1, 0)))
    exact = find(bolt).shape.volume
    assert find(shuffled(turned(bolt, OBLIQUE, 40))).shape.volume == pytest.approx(exact, rel=1e-6)
    slot = 3 * (4 * math.sqrt(81 - 4) + 2 * 81 * math.asin(2 / 9))
    whole = math.pi * (25 * 30 + 81 * 6) - slot
    bore = find(cut(cylinder(5, 30), cylinder(1, 40, (0, -20, 5), (0, 1, 0)))).shape.volume
    assert exact * 1e9 == pytest.approx(whole - (math.pi * 25 * 30 - bore * 1e9), rel=1e-5)


@pytest.mark.parametrize("at", [(0.0, 0.0, 0.0), (700.0, -300.0, 50.0)], ids=["at the origin", "far from it"])
def test_where_the_weight_of_a_turned_block_lies_and_how_it_spreads(at: Vec) -> None:
    """Plane faces are not integrated: cones between them and a point add up to what the formulas of a block say."""
    moments = find(box((60, 40, 20), at)).brep.bodies[0].moments
    assert moments is not None
    assert [c * 1e3 for c in moments.center] == pytest.approx([a + b for a, b in zip(at, (30, 20, 10), strict=True)])
    mass = 60 * 40 * 20 * 1e-15  # mm5 in m5
    about = [mass * (b * b + c * c) / 12 for b, c in ((40, 20), (60, 20), (60, 40))]
    assert [moments.inertia[i][i] for i in range(3)] == pytest.approx(about, rel=1e-9)
    oblique = find(turned(box((60, 40, 20), at), OBLIQUE, 40)).brep.bodies[0].moments
    assert oblique is not None
    assert sum(oblique.inertia[i][i] for i in range(3)) == pytest.approx(sum(about), rel=1e-8)


@pytest.mark.parametrize("hollow", [False, True])
def test_round_and_plane_faces_give_one_volume_together(hollow: bool) -> None:
    tube = cut(cylinder(10, 30, (200, 0, 0)), cylinder(6, 30, (200, 0, 0))) if hollow else cylinder(10, 30, (200, 0, 0))
    body = find(tube).brep.bodies[0]
    area = math.pi * (100 - 36 * hollow)
    assert body.volume * 1e9 == pytest.approx(area * 30, rel=1e-9)
    assert body.moments is not None
    about = area * 30 * (100 + 36 * hollow) / 2 * 1e-15
    assert body.moments.inertia[2][2] == pytest.approx(about, rel=1e-8)
