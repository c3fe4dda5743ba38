"""How thick is the material? The wall thickness that most of the model's plane surface shares."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind
from querycad_segworker.mesh import Mesh
from querycad_segworker.render.raycast import Scene
from querycad_segworker.topology import Brep, FaceRecord
from querycad_segworker.vectors import Box, box_union

SHARED_AREA = 0.6
"""A thickness is the material's when at least this share of the plane surface has it: edges and ends of a sheet have
another, and a machined block has no such thickness at all."""
SHEET_RATIO = 0.2
"""A sheet is thinner than this share of the model's second largest extent; thicker ones are blocks."""
SAME = 0.01
"""Thicknesses that differ by less than 1 % are one: far below sheet tolerances (EN 10051: some 5 %)."""


@dataclass(frozen=True, slots=True)
class Thickness:
    """Wall thicknesses in metres: of the whole model, None where it has none, and of bodies by id."""

    model: float | None = None
    bodies: Mapping[int, float] = field(default_factory=dict)


NO_THICKNESS = Thickness()
"""Of what is no sheet and has no walls."""


def material_thickness(brep: Brep, mesh: Mesh, scene: Scene) -> Thickness:
    """Which thickness do the sheets or walls have that the model and each of its bodies are made of?

    From the middle of each triangle of a plane face a ray goes straight into the material; what counts is the distance
    to the opposite plane face, which is exact for parallel planes, weighted by the triangle's area.
    """
    plane = np.array([face.kind is SurfaceKind.PLANE for face in brep.faces], dtype=np.bool_)
    chosen = plane[mesh.triangle_face]
    corners = mesh.vertices_m[mesh.triangles[chosen]]
    if not len(corners):
        return Thickness()
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(cross, axis=1) / 2
    solid = areas > 0
    corners, areas = corners[solid], areas[solid]
    faces = mesh.triangle_face[chosen][solid]
    normals = np.array([face.axis for face in brep.faces])[faces]
    distances = scene.reach(corners.mean(axis=1), -normals)
    reached = np.isfinite(distances)
    distances, areas = distances[reached], areas[reached]
    owners = np.array([face.body for face in brep.faces])[faces][reached]
    whole = _shared(brep.faces, brep.box, distances, areas)
    if len(brep.bodies) == 1:
        return Thickness(whole, {} if whole is None else {brep.bodies[0].id: whole})
    found = {}
    for body in brep.bodies:
        own = owners == body.id
        members = [brep.faces[f] for f in body.faces]
        box = box_union(face.box for face in members)
        thickness = _shared(members, box, distances[own], areas[own]) if box is not None else None
        if thickness is not None:
            found[body.id] = thickness
    return Thickness(whole, found)


def _shared(
    faces: Sequence[FaceRecord], box: Box, distances: NDArray[np.float64], areas: NDArray[np.float64]
) -> float | None:
    """The thickness that most of the plane surface shares; None where there is none, or where it is no sheet's."""
    if not len(distances):
        return None
    order = np.argsort(distances)
    distances, areas = distances[order], areas[order]
    sums = np.concatenate([[0.0], np.cumsum(areas)])
    ends = np.searchsorted(distances, distances * (1 + SAME), side="right")
    shares = (sums[ends] - sums[:-1]) / areas.sum()
    best = int(np.argmax(shares))
    extents = sorted(high - low for low, high in zip(*box, strict=True))
    thickness = float(np.average(distances[best : ends[best]], weights=areas[best : ends[best]]))
    if shares[best] < SHARED_AREA or thickness > SHEET_RATIO * extents[1]:
        return None
    return _exact(faces, thickness)


def _exact(faces: Sequence[FaceRecord], thickness: float) -> float:
    """The distance of that pair of parallel plane faces which comes nearest: rays are single precision."""
    planes = sorted(
        (face for face in faces if face.kind is SurfaceKind.PLANE), key=lambda face: face.area, reverse=True
    )[:40]
    gaps = [
        abs(sum(n * (p - q) for n, p, q in zip(a.axis, a.point, b.point, strict=True)))
        for i, a in enumerate(planes)
        for b in planes[i + 1 :]
        if sum(x * y for x, y in zip(a.axis, b.axis, strict=True)) < -0.999999
    ]
    near = [gap for gap in gaps if abs(gap - thickness) <= SAME * thickness]
    return min(near, key=lambda gap: abs(gap - thickness)) if near else thickness
