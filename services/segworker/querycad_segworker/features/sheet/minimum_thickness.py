"""How thin does the material get? The least distance across it, between faces that look away from each other."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping

import numpy as np

from querycad_contracts import SurfaceKind
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import dist, dot
from querycad_segworker.visibility.raycast import Scene

from .gaps import NO_WALL, Depths, web

FREEFORM_AREA = 0.02
"""A body with more of its surface than this in freeform faces has no least thickness that could be told exactly."""
OPPOSITE = -0.94
"""Cosine of the angle between outward normals beyond which two planes are sides of a wall: 20 degrees of taper. What is
less is a wedge, which has no thickness."""
INSIDE = 0.01
"""Share of the way to a triangle's middle, by which rays from its corners start inside it."""
NEAR = 1.25
"""A web is as thin as its surfaces come near each other, where a ray finds at most so many times that: else the two
faces do not lie beside each other there."""


def thinnest(brep: Brep, depths: Depths, scene: Scene) -> Mapping[int, float]:
    """The least thickness of each body in metres, by id; without those that have none, or are of freeform surfaces.

    Exact between parallel planes, coaxial surfaces, and beside holes; of tapered walls it is measured by rays at their
    thinnest corners, to 1 % of their size. Wedges and the ends of chamfers count as no wall.
    """
    tolerances = Tolerances.for_diagonal(dist(*brep.box))
    found: dict[int, float] = {}
    for a, b, ray, wall in _pairs(brep, depths, scene):
        first, second = brep.faces[a], brep.faces[b]
        if SurfaceKind.FREEFORM in (first.kind, second.kind):
            continue
        between = wall if wall != NO_WALL else web(first, second, tolerances)
        if between == NO_WALL and _tapered(brep, a, b):
            between = ray
        if ray > NEAR * between:
            continue
        if tolerances.length < between < found.get(first.body, NO_WALL):
            found[first.body] = between
    area, free = defaultdict[int, float](float), defaultdict[int, float](float)
    for face in brep.faces:
        area[face.body] += face.area
        free[face.body] += face.area * (face.kind is SurfaceKind.FREEFORM)
    return {body: least for body, least in found.items() if free[body] <= FREEFORM_AREA * area[body]}


def _pairs(brep: Brep, depths: Depths, scene: Scene) -> list[tuple[int, int, float, float]]:
    """Faces with what lies behind them, the shortest ray between the two, and their wall's thickness or `NO_WALL`."""
    keys = depths.faces.astype(np.int64) * len(brep.faces) + depths.beyond
    unique, index = np.unique(keys, return_inverse=True)
    shortest = np.full((2, len(unique)), NO_WALL)
    for row, lengths in zip(shortest, (depths.distances_m, depths.walls_m), strict=True):
        np.minimum.at(row, index.ravel(), lengths)
    met = zip(unique, *shortest, strict=True)
    pairs = [(*divmod(int(key), len(brep.faces)), float(ray), float(wall)) for key, ray, wall in met]
    tapered = np.array([_tapered(brep, a, b) for a, b, *_ in pairs], dtype=np.bool_)
    chosen = depths.of(tapered[index.ravel()]) if pairs else depths
    middles = chosen.corners_m.mean(axis=1)
    for corner in range(3 if tapered.any() else 0):
        starts = (1 - INSIDE) * chosen.corners_m[:, corner] + INSIDE * middles
        rays, beyond = scene.ahead(starts, -chosen.normals)
        again = zip(chosen.faces, beyond, rays, strict=True)
        pairs += [(int(a), int(b), float(ray), NO_WALL) for a, b, ray in again if math.isfinite(ray)]
    return pairs


def _tapered(brep: Brep, a: int, b: int) -> bool:
    """Are two planes sides of a wall, though not parallel ones?"""
    first, second = brep.faces[a], brep.faces[b]
    planes = first.kind is second.kind is SurfaceKind.PLANE
    leaning = planes and -0.999999 <= dot(first.axis, second.axis) <= OPPOSITE
    return leaning and all(other != b for _, other in brep.neighbours(a))  # where they meet it is a wedge
