"""How thick is the material? The wall thickness that most of the model's surface shares."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.mesh import Mesh
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, FaceRecord
from querycad_segworker.vectors import Box, box_union, dist, dot, sub
from querycad_segworker.visibility.raycast import Scene

SHARED_AREA = 0.6
"""A thickness is the material's when at least this share of the surface has it: edges and ends of a sheet have
another, and a machined block has no such thickness at all."""
SHEET_RATIO = 0.2
"""A sheet is thinner than this share of the model's second largest extent; thicker ones are blocks."""
SAME = 0.01
"""Thicknesses that differ by less than 1 % are one: far below sheet tolerances (EN 10051: some 5 %)."""
MOSTLY = 0.5
"""Plane faces speak for the whole where they are more than this share of the surface."""
NO_WALL = math.inf
"""Between faces that do not run alongside each other."""


@dataclass(frozen=True, slots=True)
class Thickness:
    """Wall thicknesses in metres: of the whole model, None where it has none, and of bodies by id."""

    model: float | None = None
    bodies: Mapping[int, float] = field(default_factory=dict)
    opposite_m2: Mapping[tuple[int, int], float] = field(default_factory=dict)
    """How much of a plane face has another plane face straight behind it, across the material? By ids of both."""

    def renumbered(self, owner: Sequence[int]) -> Thickness:
        """The same of a model whose face `i` is part of face `owner[i]`."""
        opposite: dict[tuple[int, int], float] = defaultdict(float)
        for (a, b), area_m2 in self.opposite_m2.items():
            opposite[owner[a], owner[b]] += area_m2
        return replace(self, opposite_m2=opposite)


NO_THICKNESS = Thickness()
"""Of what is no sheet and has no walls."""


@dataclass(frozen=True, slots=True, eq=False)
class _Depths:
    """What lies behind each of N triangles, seen from its middle straight into the material.

    faces, beyond: (N,) ids of their faces, and of those seen. areas_m2, walls_m: (N,), the latter `NO_WALL` where no
    wall lies between.
    """

    faces: NDArray[np.int32]
    beyond: NDArray[np.int32]
    areas_m2: NDArray[np.float64]
    walls_m: NDArray[np.float64]

    def of(self, chosen: NDArray[np.bool_]) -> _Depths:
        """Those of some triangles."""
        return _Depths(self.faces[chosen], self.beyond[chosen], self.areas_m2[chosen], self.walls_m[chosen])


def material_thickness(brep: Brep, mesh: Mesh, scene: Scene) -> Thickness:
    """Which thickness do the sheets or walls have that the model and each of its bodies are made of?

    From the middle of each triangle a ray goes straight into the material, to the face on the other side. Where the two
    run alongside each other, as parallel planes or coaxial cylinders do, their distance is the wall's, weighted by the
    triangle's area. Where no thickness is shared by most of all faces, the plane ones decide.
    """
    depths = _depths(brep, mesh, scene)
    owners = np.array([face.body for face in brep.faces], dtype=np.int64)[depths.faces]
    plane = np.array([face.kind is SurfaceKind.PLANE for face in brep.faces], dtype=np.bool_)
    whole = _shared(brep.box, depths, plane)
    opposite = _opposite(depths, plane)
    if len(brep.bodies) == 1:
        return Thickness(whole, {} if whole is None else {brep.bodies[0].id: whole}, opposite)
    found = {}
    for body in brep.bodies:
        box = box_union(brep.faces[f].box for f in body.faces)
        thickness = _shared(box, depths.of(owners == body.id), plane) if box is not None else None
        if thickness is not None:
            found[body.id] = thickness
    return Thickness(whole, found, opposite)


def _opposite(depths: _Depths, plane: NDArray[np.bool_]) -> dict[tuple[int, int], float]:
    """The areas of `Thickness.opposite_m2`."""
    chosen = np.isfinite(depths.walls_m) & plane[depths.faces] & plane[depths.beyond]
    pairs = np.stack([depths.faces[chosen], depths.beyond[chosen]], axis=1)
    unique, index = np.unique(pairs, axis=0, return_inverse=True)
    areas = np.bincount(index.ravel(), weights=depths.areas_m2[chosen], minlength=len(unique))
    return {(int(a), int(b)): float(area) for (a, b), area in zip(unique, areas, strict=True)}


def _depths(brep: Brep, mesh: Mesh, scene: Scene) -> _Depths:
    """What lies behind the triangles, but for those behind which nothing lies."""
    corners = mesh.vertices_m[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    doubled = np.linalg.norm(normals, axis=1)
    solid = doubled > 0
    faces = mesh.triangle_face[solid]
    normals = normals[solid] / doubled[solid, None]
    planes = np.array([face.axis if face.kind is SurfaceKind.PLANE else (0.0, 0.0, 0.0) for face in brep.faces])
    flat = planes[faces].any(axis=1) if len(faces) else np.zeros(0, dtype=np.bool_)
    normals[flat] = planes[faces[flat]]
    distances, beyond = scene.ahead(corners[solid].mean(axis=1), -normals)
    reached = np.isfinite(distances)
    faces, beyond, distances = faces[reached], beyond[reached], distances[reached]
    walls = np.full(len(faces), NO_WALL)
    pairs, index = np.unique(faces.astype(np.int64) * len(brep.faces) + beyond, return_inverse=True)
    if len(pairs):
        tolerances = Tolerances.for_diagonal(dist(*brep.box))
        pairs_of_faces = (divmod(int(pair), len(brep.faces)) for pair in pairs)
        gaps = np.array([_gap(brep.faces[a], brep.faces[b], tolerances) for a, b in pairs_of_faces])[index.ravel()]
        walls = np.where(np.isnan(gaps), distances, gaps)
    return _Depths(faces, beyond, doubled[solid][reached] / 2, walls)


def _gap(a: FaceRecord, b: FaceRecord, tolerances: Tolerances) -> float:
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
        coaxial = Axis(a.origin, a.axis).same_line(Axis(b.origin, b.axis), tolerances)
    if not coaxial or a.outward == b.outward:
        return NO_WALL
    if a.kind is SurfaceKind.CONE:
        alike = dot(a.axis, b.axis) > 0 and abs(a.half_angle - b.half_angle) <= 10 * tolerances.angle
        return dist(a.origin, b.origin) * math.sin(a.half_angle) if alike else NO_WALL
    if a.kind is SurfaceKind.TORUS:
        alike = dist(a.origin, b.origin) <= near and abs(a.radius - b.radius) <= near
        return abs(a.minor_radius - b.minor_radius) if alike else NO_WALL
    return abs(a.radius - b.radius)


def _shared(box: Box, depths: _Depths, plane: NDArray[np.bool_]) -> float | None:
    """The thickness that most of the surface shares; None where there is none, or where it is no sheet's."""
    extents = sorted(high - low for low, high in zip(*box, strict=True))
    flat = depths.of(plane[depths.faces])
    mostly_flat = flat.areas_m2.sum() > MOSTLY * depths.areas_m2.sum()
    shared = (_most_common(depths), _most_common(flat) if mostly_flat else None)
    return next((t for t in shared if t is not None and t <= SHEET_RATIO * extents[1]), None)


def _most_common(depths: _Depths) -> float | None:
    """The thickness that most of this surface shares: that of the largest part of it which has one to the digit."""
    order = np.argsort(depths.walls_m, kind="stable")
    walls, areas = depths.walls_m[order], depths.areas_m2[order]
    count = int(np.isfinite(walls).sum())
    if not count:
        return None
    sums = np.concatenate([[0.0], np.cumsum(areas)])
    ends = np.searchsorted(walls[:count], walls[:count] * (1 + SAME), side="right")
    shares = (sums[ends] - sums[:count]) / areas.sum()
    best = int(np.argmax(shares))
    if shares[best] < SHARED_AREA:
        return None
    alike = slice(best, ends[best])
    exact, owner = np.unique(np.round(walls[alike], 9), return_inverse=True)
    return float(exact[np.argmax(np.bincount(owner.ravel(), weights=areas[alike]))])
