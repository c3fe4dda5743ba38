"""Gussets: thin walls that fill the corner of two faces."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Sequence, Set
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.depressions.slot_sections import over_edge_break
from querycad_segworker.features.shared.adjacency import is_blend, same_cylinder
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.features.shared.frames import face_points
from querycad_segworker.features.shared.part_measures import UPRIGHT
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord
from querycad_segworker.vectors import add, cross, dist, dot, line_distance, norm, parallel, scale, sub, unit

SAME = 0.01
"""The rim of a gusset is as large as its edge and its thickness make it, but for this share."""
SQUARE = 0.02
"""Cosine of the angle between faces that are square to each other."""
SPREAD = math.sin(math.radians(18.0))
"""Sine of the angle that the two faces enclose at least."""
OPEN = 0.5
"""The corner of a gusset may be cut off, for a weld or a fillet between the two faces, over this share of its feet."""
CORNER = 0.75
"""The side of a gusset fills less than this share of the block over its two feet: a triangle half of it, a plate in the
corner of a box all."""


@dataclass(frozen=True, slots=True)
class Gusset:
    """Metres. `length` and `height`: of its feet, the more upright one is the height. `faces`: its two sides."""

    length: float
    height: float
    faces: tuple[int, ...]


def gusset_in(brep: Brep, sides: Sequence[int], center: Vector, thickness: float) -> Gusset | None:
    """The gusset that a wall is which fills the corner of two faces that meet; None where it fills none.

    `sides`: its faces. `center` and `thickness`: of the wall. Its height is that of the more upright foot, or of
    the shorter one. A side that is level with that of one of the faces has no foot there: then the gusset has the other
    side, and what is as wide as it is thick.
    """
    feet = {face: _feet(brep, brep.faces[face], set(sides) - {face}, thickness) for face in sides}
    standing = {face: found for face, found in feet.items() if len(found) == 2}
    if len(sides) != 2 or not standing or max(map(len, feet.values())) > 2:
        return None
    (a, a_length), (b, b_length) = next(iter(standing.values()))
    others = [i for found in feet.values() for i, _ in found]
    same = all(_is_one_surface(brep, a, i) or _is_one_surface(brep, b, i) for i in others)
    normals = _out_of(brep.faces[a], center), _out_of(brep.faces[b], center)
    if abs(dot(*normals)) < SQUARE:  # over fillets the feet go on to where both faces would meet
        points = face_points(brep, standing)
        planes = [(brep.faces[i], n) for i, n in zip((a, b), normals, strict=True)]
        reach = [max(_off(face, n, p) for p in points) for face, n in planes]
        corner = sub(points[0], add(*(scale(n, _off(face, n, points[0])) for face, n in planes)))
        for i, toe in enumerate(_toes(brep, standing, corner, normals)):
            up = [_off(*planes[1 - i], p) for p in points if _off(*planes[i], p) > (1 - SAME) * reach[i]]
            sharp = max(up) - min(up) < SAME * reach[1 - i]  # else it ends at a face of its own
            reach[i] = toe if sharp and reach[i] < toe < reach[i] + thickness else reach[i]
        near = (max(_off(*plane, p) / way for plane, way in zip(planes, reach, strict=True)) for p in points)
        if min(near) > OPEN:
            return None  # it leaves the corner open: an arm that is bent from one face to the other
        b_length, a_length = reach
    area = max(brep.faces[face].area for face in standing)
    spread = norm(cross(*normals))
    if not same or spread < SPREAD or area > CORNER * a_length * b_length * spread:
        return None
    upright = abs(normals[0][2]), abs(normals[1][2])  # a foot on an upright face runs upwards
    height, length = sorted((a_length, b_length))
    if abs(upright[0] - upright[1]) > UPRIGHT:
        height, length = (a_length, b_length) if upright[0] < upright[1] else (b_length, a_length)
    rims = {i for face in standing for e, i in brep.neighbours(face) if _is_rim(brep.faces[i], e, thickness)}
    faces = tuple(sides) if len(standing) == 2 else tuple(sorted({*standing, *rims}))
    return Gusset(length, height, faces)


def _toes(brep: Brep, sides: Collection[int], corner: Vector, ways: Sequence[Vector]) -> list[float]:
    """How far from its corner the slope of a gusset meets each foot, metres, which a fillet or chamfer may hide.

    `ways`: along the feet. Empty where it has no single slope.
    """
    beside = {i for side in sides for i in brep.beside(side, EdgeConvexity.CONVEX)}
    beside |= {face.id for side in sides for face in over_edge_break(brep, brep.faces[side])}
    planes = brep.of_kind(SurfaceKind.PLANE, sorted(beside))
    across = cross(*ways)
    slopes = [p for p in planes if abs(dot(p.axis, across)) < SQUARE < min(dot(p.axis, way) for way in ways)]
    if len(slopes) != 1:
        return []
    off = dot(sub(slopes[0].point, corner), slopes[0].axis)
    return [off / dot(slopes[0].axis, way) for way in ways]


def _out_of(foot: FaceRecord, at: Vector) -> Vector:
    """The direction out of the plane, or of the outer cylinder, that something stands on."""
    return foot.axis if foot.kind is SurfaceKind.PLANE else unit(sub(at, Axis.of(foot).foot(at)))


def _off(foot: FaceRecord, out: Vector, point: Vector) -> float:
    """How far is a point from what something stands on, along the direction out of it?"""
    radius = 0.0 if foot.kind is SurfaceKind.PLANE else foot.radius
    return dot(sub(point, foot.point if foot.kind is SurfaceKind.PLANE else foot.origin), out) - radius


def _is_rim(face: FaceRecord, edge: EdgeRecord, thickness: float) -> bool:
    """Does a face beyond a convex edge of a wall go as far as the wall is thick, and no further?"""
    return edge.convexity is EdgeConvexity.CONVEX and abs(face.area - edge.length * thickness) < SAME * face.area


def _feet(brep: Brep, side: FaceRecord, behind: Set[int], thickness: float) -> list[tuple[int, float]]:
    """The planes and outer cylinders that a side of a wall stands on, over fillets too, and for how long.

    Over the inside of a bend it stands on nothing: there it is the same sheet. `behind`, `thickness`: the wall's
    other side; of the wall, metres.
    """
    found: dict[int, float] = defaultdict(float)
    for edge, other in brep.neighbours(side.id):
        if edge.convexity is EdgeConvexity.CONCAVE and _bears(brep.faces[other], edge):
            found[other] += edge.length
        elif (
            edge.convexity is EdgeConvexity.SMOOTH
            and is_blend(brep, brep.faces[other])
            and not _is_bend(brep, brep.faces[other], behind, thickness)
        ):
            for face in set(brep.beside(other, EdgeConvexity.SMOOTH)) - {side.id}:
                if brep.faces[other].outward < 0 and _bears(brep.faces[face], edge):
                    found[face] += edge.length
    return sorted(found.items())


def _is_bend(brep: Brep, inner: FaceRecord, behind: Set[int], thickness: float) -> bool:
    """Does an outer cylinder about a fillet's axis, one thickness of the wall behind it, run on from the other side?"""
    near = SAME * thickness
    return inner.kind is SurfaceKind.CYLINDER and any(
        outer.kind is SurfaceKind.CYLINDER
        and outer.outward > 0
        and abs(outer.radius - inner.radius - thickness) < near
        and parallel(outer.axis, inner.axis, SQUARE)
        and line_distance(outer.origin, inner.origin, inner.axis) < near
        for side in behind
        for outer in (brep.faces[i] for i in brep.beside(side, EdgeConvexity.SMOOTH))
    )


def _bears(face: FaceRecord, edge: EdgeRecord) -> bool:
    """Is it a plane, or an outer cylinder along whose axis an edge runs?"""
    upright = face.kind is SurfaceKind.CYLINDER and edge.kind is EdgeKind.LINE and face.outward > 0
    return face.kind is SurfaceKind.PLANE or (upright and abs(dot(face.axis, edge.direction)) > 1 - UPRIGHT**2)


def _is_one_surface(brep: Brep, a: int, b: int) -> bool:
    first, second = brep.faces[a], brep.faces[b]
    if SurfaceKind.CYLINDER in (first.kind, second.kind):
        return a == b or same_cylinder(first, second)
    apart = abs(dot(sub(second.point, first.point), first.axis))
    return a == b or (
        dot(first.axis, second.axis) > 1 - UPRIGHT**2 and apart <= UPRIGHT * dist(first.point, second.point)
    )
