"""Measurements between faces of a mesh, on its triangles: what `brep.measure` answers of exact surfaces. Metres."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.errors import UnreadableFile
from querycad_segworker.mesh import Mesh

from .triangles import Array, Ints, Triangles

BLOCK = 200_000
"""Pairs of triangles that are compared at a time: some hundred megabytes."""
MOST_PAIRS = 40_000_000
"""Beyond this, a minute: nobody makes parts whose triangles all lie about equally near to each other."""


def distance(mesh: Mesh, first: Sequence[int], second: Sequence[int]) -> float:
    """How far apart are two groups of faces? 0 where they touch. Facets lie within a shaft, and around a hole."""
    one, other = _corners(mesh, first), _corners(mesh, second)
    bound = float(np.linalg.norm(one.reshape(-1, 3)[:, None] - other.reshape(-1, 3)[None, :1], axis=2).min())
    low, high = one.min(axis=1), one.max(axis=1)
    low_other, high_other = other.min(axis=1), other.max(axis=1)
    rows = max(1, BLOCK // len(other))
    compared = 0
    for begin in range(0, len(one), rows):
        block = slice(begin, begin + rows)
        gap = np.maximum(low[block][:, None] - high_other[None], low_other[None] - high[block][:, None])
        near = np.linalg.norm(np.maximum(gap, 0.0), axis=2)
        i, j = np.nonzero(near <= bound)
        order = np.argsort(near[i, j], kind="stable")
        i, j, near = i[order], j[order], near[i, j][order]
        for start in range(0, len(i), BLOCK):
            if near[start] > bound:
                break
            part = slice(start, start + BLOCK)
            compared += len(i[part])
            if compared > MOST_PAIRS:
                raise UnreadableFile("these parts have too many triangles for their distance to be measured")
            bound = min(bound, float(_between(one[block][i[part]], other[j[part]]).min()))
            if bound <= 0.0:
                return 0.0
    return bound


def edge_distance(mesh: Mesh, part: Sequence[int]) -> float:
    """How far is a part from the outline of the plane face it lies in: the largest one that shares an edge with it?"""
    own = np.isin(mesh.triangle_face, part)
    triangles = Triangles(mesh.vertices_m, mesh.triangles.astype(np.int64))
    beside = triangles.beside[own]
    around = np.setdiff1d(mesh.triangle_face[beside[beside >= 0]], part)
    flat = {
        int(face): area for face in around if (area := _flat_area(triangles, mesh.triangle_face == face)) is not None
    }
    if not flat:
        raise UnreadableFile("the part lies in no plane face, so it has no distance to the edge of one")
    host = max(flat, key=lambda face: flat[face])
    outline = _outline(triangles, mesh.triangle_face, host)
    lines = triangles.vertices[outline]
    thin = np.concatenate([lines, lines[:, 1:]], axis=1)
    corners = np.concatenate([_corners(mesh, part), thin])
    faces = np.r_[np.zeros(len(corners) - len(thin)), np.ones(len(thin))].astype(np.int32)
    both = Mesh(corners.reshape(-1, 3), np.arange(3 * len(corners), dtype=np.int32).reshape(-1, 3), faces)
    return distance(both, (0,), (1,))


def extent(mesh: Mesh, part: Sequence[int], direction: Sequence[float]) -> float:
    """How far does a part extend along a unit vector?"""
    return float(np.ptp(_corners(mesh, part).reshape(-1, 3) @ np.asarray(direction, dtype=np.float64)))


def _corners(mesh: Mesh, faces: Sequence[int]) -> Array:
    chosen: Array = mesh.vertices_m[mesh.triangles[np.isin(mesh.triangle_face, faces)]]
    if not len(chosen):
        raise UnreadableFile("a part without triangles cannot be measured")
    return chosen


def _flat_area(mesh: Triangles, members: NDArray[np.bool_]) -> float | None:
    """The area of a plane face; None of any other."""
    normals, areas = mesh.normals[members], mesh.areas[members]
    total = areas @ normals
    return float(np.linalg.norm(total)) if np.linalg.norm(total) > 0.999999 * areas.sum() else None


def _outline(mesh: Triangles, owner: NDArray[np.int32], face: int) -> Ints:
    """(N, 2) vertices of the sides around a plane face: of its borders the one that encloses most."""
    members = np.flatnonzero(owner == face)
    beside = mesh.beside[members]
    rows, side = np.nonzero((beside < 0) | (owner[beside] != face))
    start, end = mesh.corners[members[rows], side], mesh.corners[members[rows], (side + 1) % 3]
    following = {int(a): k for k, a in enumerate(start)}
    left, rings = set(range(len(start))), []
    while left:
        ring = [left.pop()]
        while (after := following[int(end[ring[-1]])]) in left:
            left.remove(after)
            ring.append(after)
        rings.append(ring)
    places = mesh.vertices - mesh.vertices[start[0]]

    def enclosed(ring: list[int]) -> float:
        return float(np.linalg.norm(np.cross(places[start[ring]], places[end[ring]]).sum(axis=0)))

    outer = max(rings, key=enclosed)
    return np.stack([start[outer], end[outer]], axis=1)


def _between(one: Array, other: Array) -> Array:
    """(N,) the distance of each of N triangles to another: of corners to the triangle, of sides, 0 where one cuts."""
    best = np.full(len(one), np.inf)
    for k in range(3):
        best = np.minimum(best, _to_triangle(one[:, k], other))
        best = np.minimum(best, _to_triangle(other[:, k], one))
        for m in range(3):
            best = np.minimum(best, _of_segments(one[:, k], one[:, (k + 1) % 3], other[:, m], other[:, (m + 1) % 3]))

        best = np.where(
            _cuts(one[:, k], one[:, (k + 1) % 3], other) | _cuts(other[:, k], other[:, (k + 1) % 3], one), 0.0, best
        )
    return best


def _to_triangle(points: Array, triangles: Array) -> Array:
    """(N,) distance of a point to the plane of a triangle where its foot lies inside; infinite elsewhere."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normal = np.cross(b - a, c - a)
    square = (normal * normal).sum(axis=1)
    inside = square > 0
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(q - p, points - p) * normal).sum(axis=1) >= 0
    heights = np.abs(((points - a) * normal).sum(axis=1)) / np.sqrt(np.where(square > 0, square, 1.0))
    return np.where(inside, heights, np.inf)


def _of_segments(a: Array, b: Array, c: Array, d: Array) -> Array:
    """(N,) distance of the segments a-b and c-d. Source: Ericson, Real-Time Collision Detection, 5.1.9."""
    u, v, w = b - a, d - c, a - c
    uu, vv, uv = (u * u).sum(axis=1), (v * v).sum(axis=1), (u * v).sum(axis=1)
    uw, vw = (u * w).sum(axis=1), (v * w).sum(axis=1)
    safe_uu, safe_vv = np.where(uu > 0, uu, 1.0), np.where(vv > 0, vv, 1.0)
    across = uu * vv - uv * uv
    s = np.where(across > 1e-12 * uu * vv, (uv * vw - vv * uw) / np.where(across > 0, across, 1.0), 0.0).clip(0, 1)
    t = np.where(vv > 0, (uv * s + vw) / safe_vv, 0.0)
    clipped = t.clip(0, 1)
    s = np.where(t != clipped, (uv * clipped - uw) / safe_uu, s)
    s = np.where(uu > 0, s, 0.0).clip(0, 1)
    apart: Array = np.linalg.norm(w + s[:, None] * u - clipped[:, None] * v, axis=1)
    return apart


def _cuts(a: Array, b: Array, triangles: Array) -> NDArray[np.bool_]:
    """(N,): does the segment a-b go through a triangle? Source: Moeller and Trumbore, 1997."""
    along = b - a
    one, two = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    across = np.cross(along, two)
    scale = (one * across).sum(axis=1)
    known = scale != 0
    scale = np.where(known, scale, 1.0)
    to = a - triangles[:, 0]
    u = (to * across).sum(axis=1) / scale
    over = np.cross(to, one)
    v = (along * over).sum(axis=1) / scale
    t = (two * over).sum(axis=1) / scale
    inside: NDArray[np.bool_] = known & (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0) & (t <= 1)
    return inside


def measurer(kept: BinaryIO) -> Callable[[dict[str, Any]], float]:
    """As `brep.measure.measurer`, of a kept mesh."""
    mesh = Mesh.load(kept)

    def measure(request: dict[str, Any]) -> float:
        match request["what"]:
            case "distance":
                return distance(mesh, request["first"], request["second"])
            case "overlap":
                raise UnreadableFile("of a mesh, what two bodies share cannot be measured")
            case "extent":
                return extent(mesh, request["first"], request["direction"])
        return edge_distance(mesh, request["first"])

    return measure
