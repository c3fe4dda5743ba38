"""Which faces are one wall? Cylinders and cones that a CAD system split into halves or strips are united again."""

from __future__ import annotations

import math
from collections.abc import Sequence

from querycad_contracts import SurfaceKind
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import REVOLVED, Brep, EdgeConvexity, EdgeRecord, FaceRecord, linked
from querycad_segworker.vectors import angle_covered, cross, dot, foot, norm, sub

from .axes import Axis, Wall
from .interrupted_walls import with_interrupted
from .modelled_threads import with_threads

__all__ = ["REVOLVED", "Axis", "Wall", "is_waist", "same_surface", "walls"]

ALIGNED = 1 - 1e-12
"""Cosine: along an axis of the file, where a face's box tells how far its rims reach, saddles too, to 1e-6 of it."""

AT_WIDE_END = 1e-3
"""Share of the distance from a cone's apex to its wide end, within which edges are those of the wide end."""


def walls(brep: Brep, tolerances: Tolerances) -> list[Wall]:
    """Which cylindrical, conical and toroidal walls does the model have? Neighbours on one surface are united.

    The faces of a modelled thread are one wall.
    """
    faces = [face.id for face in brep.faces if face.kind in REVOLVED]
    pairs = []
    for edge in brep.edges:
        if edge.convexity is EdgeConvexity.SMOOTH and len(edge.faces) == 2:
            a, b = (brep.faces[i] for i in edge.faces)
            if a.kind in REVOLVED and same_surface(a, b, tolerances):
                pairs.append((a.id, b.id))
    found = [_wall([brep.faces[i] for i in ids], brep) for ids in linked(faces, pairs)]
    return with_interrupted(brep, with_threads(brep, found, tolerances), tolerances)


def same_surface(a: FaceRecord, b: FaceRecord, tolerances: Tolerances) -> bool:
    """Do two faces of revolution lie on one surface, on the same side of the material?"""
    if a.kind is not b.kind or a.outward != b.outward or a.body != b.body:
        return False
    if not Axis.of(a).same_line(Axis.of(b), tolerances):
        return False
    near = 3 * tolerances.length
    if a.kind is SurfaceKind.CYLINDER:
        return abs(a.radius - b.radius) <= near
    along = abs(dot(sub(b.origin, a.origin), a.axis)) <= near
    if a.kind is SurfaceKind.CONE:
        return along and abs(a.half_angle - b.half_angle) <= 10 * tolerances.angle
    return along and abs(a.radius - b.radius) <= near and abs(a.minor_radius - b.minor_radius) <= near


def is_waist(torus: FaceRecord) -> bool:
    """Does a hollow torus narrow what it goes around, rather than widen a bore?"""
    return Axis.of(torus).radius_of(torus.point) < torus.radius


def _wall(faces: Sequence[FaceRecord], brep: Brep) -> Wall:
    first = faces[0]
    axis = Axis.of(first)
    points = [p for face in faces for e in brep.face_edges[face.id] for p in brep.edges[e].points]
    positions = [axis.position(p) for p in points] or [axis.position(first.point)]
    if first.kind is SurfaceKind.CYLINDER and max(map(abs, axis.direction)) > ALIGNED:
        positions = [axis.position(corner) for face in faces for corner in face.box]
    if first.kind is SurfaceKind.TORUS:
        positions.extend(axis.position(f.point) for f in faces)
        if not any(_goes_around(brep.edges[e], axis) for f in faces for e in brep.face_edges[f.id]):
            middle = axis.position(first.origin)  # no rim: all of the cross-section is there
            positions += [middle - first.minor_radius, middle + first.minor_radius]
    low, high = min(positions), max(positions)
    if first.kind is SurfaceKind.CONE:
        slope = math.tan(first.half_angle)
        if not any(_rings(brep.edges[e], axis, near=low) for f in faces for e in brep.face_edges[f.id]):
            low = _narrow_end(brep, faces, axis, high)
        radius_low, radius_high = max(low, 0.0) * slope, high * slope
    elif first.kind is SurfaceKind.TORUS:
        radii = [axis.radius_of(p) for p in points] or [first.radius]
        at_low = [axis.radius_of(p) for p in points if axis.position(p) - low <= 0.1 * (high - low)]
        at_high = [axis.radius_of(p) for p in points if high - axis.position(p) <= 0.1 * (high - low)]
        radius_low, radius_high = max(at_low or radii), max(at_high or radii)
    else:
        radius_low = radius_high = first.radius
    return Wall(
        kind=first.kind,
        axis=axis,
        radius_low=radius_low,
        radius_high=radius_high,
        low=low,
        high=high,
        sweep=_sweep(faces, axis),
        outward=first.outward,
        faces=tuple(face.id for face in faces),
        body=first.body,
    )


def _narrow_end(brep: Brep, faces: Sequence[FaceRecord], axis: Axis, high: float) -> float:
    """Where does a cone end that no circle bounds towards its apex: where plane sides cut it off, or at its apex?

    A position along the axis, 0 at the apex. A cone that reaches its apex has a seam or straight edges up to there, or
    no edge but those of its wide end.
    """
    reach = min(
        (axis.position(p) for f in faces for e in brep.face_edges[f.id] for p in brep.edge_points[e]), default=0.0
    )
    return reach if reach < (1 - AT_WIDE_END) * high else 0.0


def _rings(edge: EdgeRecord, axis: Axis, near: float) -> bool:
    """Is the edge a circle around the axis, of some radius, at the position `near`?"""
    if not _goes_around(edge, axis) or edge.center is None or edge.radius is None:
        return False
    return abs(axis.position(edge.center) - near) < 0.05 * edge.radius


def _goes_around(edge: EdgeRecord, axis: Axis) -> bool:
    """Is the edge part of a circle around the axis, and no seam?"""
    if edge.center is None or edge.axis is None or edge.radius is None or edge.convexity is EdgeConvexity.SEAM:
        return False
    return (
        norm(cross(edge.axis, axis.direction)) < 1e-2
        and norm(sub(edge.center, foot(edge.center, axis.origin, axis.direction))) < 1e-2 * edge.radius
    )


def _sweep(faces: Sequence[FaceRecord], axis: Axis) -> float:
    """The angle covered by all faces together: the union of their ranges, each centred on the face's middle point."""
    ranges = []
    for face in faces:
        if face.sweep >= 2 * math.pi - 1e-6:
            return 2 * math.pi
        middle = axis.angle_of(face.point)
        ranges.append((middle - face.sweep / 2, middle + face.sweep / 2))
    return angle_covered(ranges)
