"""How near is a hole to the outer edge of the face it lies in?"""

from __future__ import annotations

import math
from collections.abc import Sequence

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import breaks_edge
from querycad_segworker.topology import Brep, EdgeKind, EdgeRecord, FaceRecord
from querycad_segworker.vectors import add, cross, dist, dot, norm, parallel, scale, sub, unit


def edge_distance(brep: Brep, faces: Sequence[int], center: Vector, axis: Vector, radius: float) -> float | None:
    """The smallest distance from a circle to the outer boundary of its plane face, in metres.

    Chamfers and rounds that break the boundary belong to the face: the distance is up to where they end.
    `center`, `axis` and `radius` describe the circle; its face is the largest plane one at right angles to the axis
    that shares an edge with `faces`. None without such a face, or when its boundary has other curves than lines and
    arcs: then the kernel must measure.
    """
    own = set(faces)
    hosts = {
        other
        for face in faces
        for _, other in brep.neighbours(face)
        if other not in own and _is_host(brep.faces[other], center, axis, radius)
    }
    if not hosts:
        return None
    host = max((brep.faces[i] for i in hosts), key=lambda face: face.area)
    outer = next((loop for loop in host.loops if loop.outer), None)
    if outer is None:
        return None
    gaps = [_to_edge(center, axis, _beyond_broken(brep, host, brep.edges[e])) for e in outer.edges]
    if not gaps or any(gap is None for gap in gaps):
        return None
    return max(0.0, min(gap for gap in gaps if gap is not None) - radius)


def _is_host(face: FaceRecord, center: Vector, axis: Vector, radius: float) -> bool:
    in_plane = abs(dot(sub(face.point, center), face.axis)) <= 0.1 * radius
    return face.kind is SurfaceKind.PLANE and parallel(face.axis, axis, 1e-3) and in_plane


def _beyond_broken(brep: Brep, host: FaceRecord, edge: EdgeRecord) -> EdgeRecord:
    """The edge itself, or where the chamfer or round ends that breaks it: the one alike, on its far side."""
    for other in edge.faces:
        if other != host.id and breaks_edge(brep, host, edge, brep.faces[other]):
            ends = [far for far, face in brep.neighbours(other) if face != host.id and _is_alike(edge, far)]
            return max(ends, key=lambda far: dist(far.mid, edge.mid), default=edge)
    return edge


def _is_alike(one: EdgeRecord, other: EdgeRecord) -> bool:
    """Are these parallel lines, or arcs about one axis?"""
    if one.kind is EdgeKind.LINE:
        return other.kind is EdgeKind.LINE and parallel(
            unit(sub(one.end, one.start)), unit(sub(other.end, other.start)), 1e-3
        )
    if not (one.kind is other.kind is EdgeKind.CIRCLE):
        return False
    return one.axis is not None and other.axis is not None and parallel(one.axis, other.axis, 1e-3)


def _to_edge(center: Vector, axis: Vector, edge: EdgeRecord) -> float | None:
    """The distance across an axis from a point to a line segment or an arc, both exact."""
    point = add(center, scale(axis, dot(sub(edge.start, center), axis)))
    if edge.kind is EdgeKind.LINE:
        along = sub(edge.end, edge.start)
        share = dot(sub(point, edge.start), along) / max(dot(along, along), 1e-30)
        return dist(point, add(edge.start, scale(along, min(1.0, max(0.0, share)))))
    if edge.kind is not EdgeKind.CIRCLE or edge.center is None or edge.axis is None or edge.radius is None:
        return None
    offset = sub(point, edge.center)
    height = dot(offset, edge.axis)
    in_plane = sub(offset, scale(edge.axis, height))
    if _on_arc(unit(in_plane), edge):
        return math.hypot(norm(in_plane) - edge.radius, height)
    return min(dist(point, edge.start), dist(point, edge.end))


def _on_arc(direction: Vector, edge: EdgeRecord) -> bool:
    """Does the ray from the arc's centre in this direction meet the arc? Its middle is `edge.mid`."""
    assert edge.center is not None
    assert edge.radius is not None
    to_middle = unit(sub(edge.mid, edge.center))
    angle = math.atan2(norm(cross(to_middle, direction)), dot(to_middle, direction))
    return angle <= edge.length / edge.radius / 2 + 1e-9
