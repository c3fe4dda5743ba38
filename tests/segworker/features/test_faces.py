"""Faces as programs see them: outlines, own sizes, axes and neighbours; and the side that a model stands on."""

from __future__ import annotations

import pytest
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.GC import GC_MakeArcOfCircle
from OCP.gp import gp_Pnt, gp_Vec
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import ball, box, cut, cylinder, extruded, find, fuse, plate, turned

from querycad_contracts import Convexity, Face, FaceQuery, Line, Outline, Part, Side, SurfaceKind
from querycad_segworker.face_table import chosen, owned
from querycad_segworker.features.faces import faces_of, likely_up

TILTED = ((1.0, 1.0, 0.0), 33.0)


def faces(shape: TopoDS_Shape) -> list[Face]:
    return faces_of(find(shape).brep)


def of(found: list[Face], kind: SurfaceKind) -> list[Face]:
    return [face for face in found if face.kind is kind]


@pytest.mark.parametrize("tilt", [None, TILTED])
def test_a_rod_has_round_ends_and_a_wall_of_its_length(tilt: tuple[tuple[float, float, float], float] | None) -> None:
    rod = cylinder(3, 20, (5, 6, 7))
    found = faces(rod if tilt is None else turned(rod, *tilt))
    assert [face.outline for face in of(found, SurfaceKind.PLANE)] == [Outline.CIRCLE] * 2
    for end in of(found, SurfaceKind.PLANE):
        assert end.local_size == pytest.approx((0.006, 0.006, 0.0))
    (wall,) = of(found, SurfaceKind.CYLINDER)
    assert wall.length == pytest.approx(0.02)
    assert wall.axis_point == pytest.approx(wall.center)
    assert (wall.outline, wall.local_size, wall.convexity) == (None, None, Convexity.CONVEX)


@pytest.mark.parametrize("tilt", [None, TILTED])
def test_a_plates_sides_are_rectangles_in_their_own_frame(
    tilt: tuple[tuple[float, float, float], float] | None,
) -> None:
    shape = box((60, 40, 20))
    found = faces(shape if tilt is None else turned(shape, *tilt))
    sizes = sorted(tuple(round(size, 9) for size in face.local_size or ()) for face in found)
    assert sizes == sorted([(0.06, 0.04, 0.0), (0.06, 0.02, 0.0), (0.04, 0.02, 0.0)] * 2)
    assert {face.outline for face in found} == {Outline.RECTANGLE}
    assert all(len(face.neighbours) == 4 and face.length == (face.local_size or (0,))[0] for face in found)


def link() -> TopoDS_Shape:
    """20 mm between the centres of round ends of 4 mm radius, 5 mm thick."""
    left, right = (gp_Pnt(-4, 4, 0), gp_Pnt(0, 0, 0), gp_Pnt(0, 8, 0)), (gp_Pnt(24, 4, 0), gp_Pnt(20, 0, 0))
    wire = BRepBuilderAPI_MakeWire()
    for arc in ((left[1], left[0], left[2]), (right[1], right[0], gp_Pnt(20, 8, 0))):
        wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(*arc).Value()).Edge())
        if arc[0] is left[1]:
            wire.Add(BRepBuilderAPI_MakeEdge(left[1], right[1]).Edge())
    wire.Add(BRepBuilderAPI_MakeEdge(left[2], gp_Pnt(20, 8, 0)).Edge())
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 0, 5)).Shape()


@pytest.mark.parametrize("tilt", [None, TILTED])
def test_an_end_between_half_circles_is_a_slot_by_outline_and_as_long_as_it_reaches(
    tilt: tuple[tuple[float, float, float], float] | None,
) -> None:
    found = faces(link() if tilt is None else turned(link(), *tilt))
    top = next(face for face in of(found, SurfaceKind.PLANE) if face.outline is not Outline.RECTANGLE)
    assert top.outline is Outline.SLOT
    assert top.local_size == pytest.approx((0.028, 0.008, 0.0))


def test_an_outline_that_is_none_of_these_is_free() -> None:
    corner = extruded([(0, 0), (30, 0), (30, 10), (10, 10), (10, 30), (0, 30)], 0, 5)
    top = max(faces(corner), key=lambda face: face.center[2])
    assert top.outline is Outline.FREE


def test_a_length_that_is_not_known_exactly_is_not_told() -> None:
    """A cylinder that is cut by another one ends in curves that are neither lines nor circles."""
    pipe = turned(fuse(cylinder(6, 40, (0, 0, -20)), cylinder(4, 30, (0, 0, 0), (1, 0, 0))), (1, 1, 1), 25)
    thin = next(face for face in of(faces(pipe), SurfaceKind.CYLINDER) if face.radius == pytest.approx(0.004))
    assert thin.length is None


def drilled() -> tuple[tuple[Face, ...], tuple[Part, ...]]:
    found = find(cut(box((60, 40, 20)), cylinder(3, 30, (15, 20, -5)), cylinder(5, 8, (15, 20, 15))))
    return owned(faces_of(found.brep), found.parts), found.parts


def test_a_face_belongs_to_the_smallest_feature_that_it_is_of_else_to_its_body() -> None:
    found, parts = drilled()
    owners = {face.id: face.part for face in found}
    bore = next(face for face in found if face.radius == pytest.approx(0.003))
    assert owners[bore.id].startswith("hole-")
    assert {owners[face.id] for face in found if Side.LEFT.outward == face.normal} == {"body-1"}
    assert set(owners.values()) <= {part.id for part in parts}


@pytest.mark.parametrize(
    ("query", "count"),
    [
        (FaceQuery(), 9),
        (FaceQuery(kind=SurfaceKind.CYLINDER), 2),
        (FaceQuery(kind=SurfaceKind.CYLINDER, radius=0.00502), 1),
        (FaceQuery(radius=0.0052), 0),
        (FaceQuery(facing=Side.TOP), 2),
        (FaceQuery(facing=Side.LEFT, kind=SurfaceKind.CYLINDER), 0),
        (FaceQuery(convexity=Convexity.CONCAVE), 2),
        (FaceQuery(body=1), 0),
        (FaceQuery(coaxial_with=Line(point=(0.015, 0.02, 9.0), direction=(0, 0, -1))), 2),
        (FaceQuery(coaxial_with=Line(point=(0.0151, 0.02, 0.0), direction=(0, 0, 1))), 0),
    ],
)
def test_faces_are_chosen_by_what_is_said_and_nothing_else(query: FaceQuery, count: int) -> None:
    found, _ = drilled()
    assert len(chosen(found, query, 0.075)) == count


@pytest.mark.parametrize(
    ("shape", "up"),
    [
        (plate(), Side.TOP),
        (turned(cylinder(5, 40), (0, 1, 0), 90), Side.RIGHT),
        (cut(box((60, 60, 30)), box((54, 54, 30), (3, 3, -3))), Side.BOTTOM),
        (ball(10), None),
    ],
    ids=["plate", "lying shaft", "box turned over", "ball"],
)
def test_a_model_stands_on_its_bottom_unless_it_hardly_would(shape: TopoDS_Shape, up: Side | None) -> None:
    assert likely_up(find(shape).brep) is up
    assert find(shape).shape.up is up
