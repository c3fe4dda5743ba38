"""What lies across the material: the face behind each triangle, and how far apart two faces are."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import FaceRecord
from querycad_segworker.vectors import dist, dot, sub

NO_WALL = math.inf
"""Between faces that do not run alongside each other."""


@dataclass(frozen=True, slots=True, eq=False)
class Depths:
    """What lies behind each of N triangles, seen from its middle straight into the material.

    faces, beyond: (N,) ids of their faces, and of those seen. areas_m2, distances_m, walls_m: (N,), the last `NO_WALL`
    where no wall lies between. corners_m: (N, 3, 3). normals: (N, 3), unit, out of the material.
    """

    faces: NDArray[np.int32]
    beyond: NDArray[np.int32]
    areas_m2: NDArray[np.float64]
    distances_m: NDArray[np.float64]
    walls_m: NDArray[np.float64]
    corners_m: NDArray[np.float64]
    normals: NDArray[np.float64]

    def of(self, chosen: NDArray[np.bool_]) -> Depths:
        """Those of some triangles."""
        return Depths(*(getattr(self, column.name)[chosen] for column in fields(self)))


def gap(a: FaceRecord, b: FaceRecord, tolerances: Tolerances) -> float:
    """How far apart are two faces that run alongside each other? `NO_WALL` where they do not, NaN for freeform ones."""
    if SurfaceKind.FREEFORM in (a.kind, b.kind):
        return math.nan
    if a.kind is not b.kind:
        return NO_WALL
    if a.kind is SurfaceKind.PLANE:
        return abs(dot(sub(a.point, b.point), a.axis)) if dot(a.axis, b.axis) < -0.999999 else NO_WALL
    near = 3 * tolerances.length
    if a.kind is SurfaceKind.SPHERE:
        coaxial = dist(a.origin, b.origin) <= near
    else:
        coaxial = Axis.of(a).same_line(Axis.of(b), tolerances)
    if not coaxial or a.outward == b.outward:
        return NO_WALL
    if a.kind is SurfaceKind.CONE:
        alike = dot(a.axis, b.axis) > 0 and abs(a.half_angle - b.half_angle) <= 10 * tolerances.angle
        return dist(a.origin, b.origin) * math.sin(a.half_angle) if alike else NO_WALL
    if a.kind is SurfaceKind.TORUS:
        alike = dist(a.origin, b.origin) <= near and abs(a.radius - b.radius) <= near
        return abs(a.minor_radius - b.minor_radius) if alike else NO_WALL
    return abs(a.radius - b.radius)


def web(a: FaceRecord, b: FaceRecord, tolerances: Tolerances) -> float:
    """How much material is left where a hole runs beside another one, a plane, or inside a round wall? Else `NO_WALL`.

    All axes are parallel; the least distance between the two surfaces, which may be negative where they cross.
    """
    hole, other = (a, b) if a.kind is SurfaceKind.CYLINDER and a.outward < 0 else (b, a)
    if hole.kind is not SurfaceKind.CYLINDER or hole.outward > 0:
        return NO_WALL
    if other.kind is SurfaceKind.PLANE and abs(dot(hole.axis, other.axis)) <= tolerances.angle:
        return abs(dot(sub(hole.origin, other.point), other.axis)) - hole.radius
    if other.kind is SurfaceKind.CYLINDER and abs(dot(hole.axis, other.axis)) >= 1 - tolerances.angle:
        apart = Axis.of(other).radius_of(hole.origin)
        return apart - hole.radius - other.radius if other.outward < 0 else other.radius - apart - hole.radius
    return NO_WALL
