"""How far edges reach along a direction, exactly for lines and arcs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from querycad_contracts import Vector
from querycad_segworker.topology import Brep, EdgeKind, EdgeRecord
from querycad_segworker.vectors import add, dot, norm, scale, sub, unit


def reach_along(brep: Brep, edges: Iterable[int], way: Vector) -> tuple[float, float] | None:
    """From where to where do edges reach along a unit vector, metres? None where a curve is no line and no arc."""
    reach: list[float] = []
    for edge in (brep.edges[e] for e in edges):
        if edge.kind is EdgeKind.OTHER:
            return None
        reach += [dot(point, way) for point in (edge.start, edge.mid, edge.end, *_arc_extremes(edge, way))]
    return (min(reach), max(reach)) if reach else None


def _arc_extremes(edge: EdgeRecord, way: Vector) -> Sequence[Vector]:
    """The points of an arc that lie farthest along a unit vector and against it, where the arc passes them."""
    if edge.center is None or edge.axis is None or not edge.radius:
        return ()
    flat = sub(way, scale(edge.axis, dot(way, edge.axis)))
    if norm(flat) < 1e-9:
        return ()
    found = []
    for sign in (1.0, -1.0):
        ray = scale(unit(flat), sign)
        cosine = dot(ray, unit(sub(edge.mid, edge.center)))
        if math.acos(max(-1.0, min(1.0, cosine))) <= edge.length / edge.radius / 2 + 1e-9:
            found.append(add(edge.center, scale(ray, edge.radius)))
    return found
