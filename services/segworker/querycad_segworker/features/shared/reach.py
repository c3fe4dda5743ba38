"""How far edges and faces reach along a direction, exactly for lines and arcs."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator

from querycad_contracts import Vector
from querycad_segworker.topology import Brep, EdgeKind, EdgeRecord
from querycad_segworker.vectors import AXES, Box, dot, span, sub


def edges_span(brep: Brep, edges: Iterable[int], way: Vector) -> tuple[float, float]:
    """From where to where do edges reach along a unit vector, metres? (0, 0) without edges.

    Exact for lines and arcs; of other curves between `Brep.edge_points`.
    """
    own = list(edges)
    low, high = span((point for e in own for point in brep.edge_points[e]), way)
    for e in own:
        for level in _arc_extremes(brep.edges[e], way, low, high):
            low, high = min(low, level), max(high, level)
    return low, high


def faces_span(brep: Brep, faces: Iterable[int], way: Vector) -> tuple[float, float]:
    """From where to where do the edges of faces reach along a unit vector, as for `edges_span`?"""
    return edges_span(brep, (e for face in faces for e in brep.face_edges[face]), way)


def edges_box(brep: Brep, edges: Collection[int]) -> Box:
    """Which box holds edges, as for `edges_span`? Axes of the file."""
    (x, x_high), (y, y_high), (z, z_high) = (edges_span(brep, edges, axis) for axis in AXES)
    return (x, y, z), (x_high, y_high, z_high)


def reach_along(brep: Brep, edges: Collection[int], way: Vector) -> tuple[float, float] | None:
    """From where to where do edges reach along a unit vector, metres? None where a curve is no line and no arc."""
    if not edges or any(brep.edges[e].kind is EdgeKind.OTHER for e in edges):
        return None
    return edges_span(brep, edges, way)


def _arc_extremes(edge: EdgeRecord, way: Vector, low: float, high: float) -> Iterator[float]:
    """How far along a unit vector does an arc reach between its ends, where that is beyond a range? Metres."""
    if edge.center is None or edge.axis is None or not edge.radius:
        return
    middle = dot(edge.center, way)
    if low <= middle - edge.radius and middle + edge.radius <= high:
        return
    sine = math.sqrt(max(0.0, 1.0 - dot(edge.axis, way) ** 2))
    if sine < 1e-6:
        return
    # The farthest point lies along `way` as projected to the arc's plane, whose length is `sine`.
    cosine = dot(sub(edge.mid, edge.center), way) / (edge.radius * sine)
    half = edge.length / edge.radius / 2 + 1e-9
    for sign in (1.0, -1.0):
        if math.acos(max(-1.0, min(1.0, sign * cosine))) <= half:
            yield middle + sign * edge.radius * sine
