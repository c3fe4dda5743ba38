"""How thick is the material? The wall thickness that most of the model's plane surface shares."""

from __future__ import annotations

import numpy as np

from querycad_contracts import SurfaceKind
from querycad_segworker.mesh import Mesh
from querycad_segworker.render.raycast import Scene
from querycad_segworker.topology import Brep

SHARED_AREA = 0.6
"""A thickness is the material's when at least this share of the plane surface has it: edges and ends of a sheet have
another, and a machined block has no such thickness at all."""
SHEET_RATIO = 0.2
"""A sheet is thinner than this share of the model's second largest extent; thicker ones are blocks."""
SAME = 0.01
"""Thicknesses that differ by less than 1 % are one: far below sheet tolerances (EN 10051: some 5 %)."""


def material_thickness(brep: Brep, mesh: Mesh, scene: Scene) -> float | None:
    """Which thickness does the sheet material have, in metres? None when the model is no sheet.

    From the middle of each triangle of a plane face a ray goes straight into the material; what counts is the distance
    to the opposite plane face, which is exact for parallel planes, weighted by the triangle's area.
    """
    plane = np.array([face.kind is SurfaceKind.PLANE for face in brep.faces], dtype=np.bool_)
    chosen = plane[mesh.triangle_face]
    corners = mesh.vertices_m[mesh.triangles[chosen]]
    if not len(corners):
        return None
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(cross, axis=1) / 2
    solid = areas > 0
    corners, areas = corners[solid], areas[solid]
    faces = mesh.triangle_face[chosen][solid]
    normals = np.array([face.axis for face in brep.faces])[faces]
    distances = scene.reach(corners.mean(axis=1), -normals)
    distances, areas = distances[np.isfinite(distances)], areas[np.isfinite(distances)]
    if not len(distances):
        return None
    order = np.argsort(distances)
    distances, areas = distances[order], areas[order]
    total = areas.sum()
    sums = np.concatenate([[0.0], np.cumsum(areas)])
    ends = np.searchsorted(distances, distances * (1 + SAME), side="right")
    shares = (sums[ends] - sums[:-1]) / total
    best = int(np.argmax(shares))
    extents = sorted(high - low for low, high in zip(*brep.box, strict=True))
    thickness = float(np.average(distances[best : ends[best]], weights=areas[best : ends[best]]))
    if shares[best] < SHARED_AREA or thickness > SHEET_RATIO * extents[1]:
        return None
    return _exact(brep, thickness)


def _exact(brep: Brep, thickness: float) -> float:
    """The distance of that pair of parallel plane faces which comes nearest: rays are single precision."""
    planes = sorted(
        (face for face in brep.faces if face.kind is SurfaceKind.PLANE), key=lambda face: face.area, reverse=True
    )[:40]
    gaps = [
        abs(sum(n * (p - q) for n, p, q in zip(a.axis, a.point, b.point, strict=True)))
        for i, a in enumerate(planes)
        for b in planes[i + 1 :]
        if sum(x * y for x, y in zip(a.axis, b.axis, strict=True)) < -0.999999
    ]
    near = [gap for gap in gaps if abs(gap - thickness) <= SAME * thickness]
    return min(near, key=lambda gap: abs(gap - thickness)) if near else thickness
