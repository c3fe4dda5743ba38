"""How much material is left: behind the bottom of what is blind, and beside a hole to the nearest outer face."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Part, SurfaceKind, Vector
from querycad_segworker.features.shared.clearance import Ahead
from querycad_segworker.mesh import Mesh
from querycad_segworker.topology import Brep, FaceRecord
from querycad_segworker.vectors import add, cross, dot, line_distance, norm, perpendicular, scale, sub, unit

Points = NDArray[np.float64]
BLIND = ("hole", "pocket")
MOST_STARTS = 24
"""Rays from one bottom, from the middles of its largest triangles."""
AROUND = 16
"""Rays around a hole, every 22 degrees, at each of `LEVELS`: what is plane or round about a parallel axis is then met
straight on, so that they need only find the face."""
LEVELS = (0.1, 0.9)
"""Shares of a hole's depth."""
SQUARE = 1e-3
"""Sine of the angle by which a face may lean and still run alongside a hole."""
FACES_UP = 0.9
"""Cosine of the angle within which a face is a bottom."""


@dataclass(frozen=True, slots=True)
class _Ray:
    """From a point on a part's axis or bottom into the material."""

    part: int
    start: Vector
    towards: Vector


def with_material_left(parts: Sequence[Part], brep: Brep, mesh: Mesh | None, ahead: Ahead | None) -> list[Part]:
    """The same parts with `bottom_thickness` and `wall_distance`, where straight ways into the material leave it again.

    Exact where they leave through a plane, or, sideways, through a cylinder along the hole; else as the triangles are.
    """
    if mesh is None or ahead is None:
        return list(parts)
    below = _least(parts, brep, ahead, _down(parts, brep, mesh), frozenset())
    cut = {face for part in parts if part.kind.cuts_in for face in part.faces}
    beside = _sideways(parts, brep, ahead, cut)
    result = []
    for i, part in enumerate(parts):
        found = {"bottom_thickness": below.get(i), "wall_distance": beside.get(i)}
        update = {name: value for name, value in found.items() if value is not None}
        result.append(part.model_copy(update=update) if update else part)
    return result


def _down(parts: Sequence[Part], brep: Brep, mesh: Mesh) -> list[_Ray]:
    """From all over the bottoms of what is blind, away from the opening; from the tip of a drill point, too."""
    triangles: dict[int, list[int]] = defaultdict(list)
    wanted: dict[int, list[FaceRecord]] = {}
    for i, part in enumerate(parts):
        blind = part.kind in BLIND and part.bottom in ("flat", "conical", "spherical") and part.normal is not None
        if blind:
            wanted[i] = [brep.faces[f] for f in part.faces]
    if not wanted:
        return []
    bottoms = {face.id for faces in wanted.values() for face in faces if face.kind is SurfaceKind.PLANE}
    for t in np.flatnonzero(np.isin(mesh.triangle_face, list(bottoms))):
        triangles[int(mesh.triangle_face[t])].append(int(t))
    rays = []
    for i, faces in wanted.items():
        out = parts[i].normal
        assert out is not None
        down = scale(out, -1.0)
        for face in faces:
            if face.kind is SurfaceKind.CONE and parts[i].bottom == "conical" and dot(face.axis, out) > FACES_UP:
                rays.append(_Ray(i, face.origin, down))
            elif face.kind is SurfaceKind.SPHERE and parts[i].bottom == "spherical":
                rays.append(_Ray(i, add(face.origin, scale(down, face.radius)), down))
            elif face.kind is SurfaceKind.PLANE and dot(face.axis, out) > FACES_UP:
                corners = mesh.vertices_m[mesh.triangles[triangles[face.id]]]
                sizes = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
                for t in np.argsort(-sizes)[:MOST_STARTS]:
                    x, y, z = corners[t].mean(axis=0).tolist()
                    rays.append(_Ray(i, (x, y, z), down))
    return rays


def _sideways(parts: Sequence[Part], brep: Brep, ahead: Ahead, cut: Set[int]) -> dict[int, float]:
    """By index of a hole: from its wall to the nearest face outside, of those that belong to nothing that is cut in."""
    holes = [i for i, part in enumerate(parts) if part.kind == "hole" and part.axis and part.depth and part.opening]
    all_round = _at_wall(parts, brep, ahead, [ray for i in holes for ray in _around(i, parts[i])])
    straight = []
    for ray, (_, face) in zip(all_round, _met(all_round, ahead), strict=True):
        way = None if face < 0 or face in cut else _straight(parts[ray.part], brep.faces[face])
        if way is not None:
            straight.append(_Ray(ray.part, _on_axis(parts[ray.part], ray.start), way))
    rays = [*all_round, *_at_wall(parts, brep, ahead, list(dict.fromkeys(straight)))]
    return _least(parts, brep, ahead, rays, cut)


def _at_wall(parts: Sequence[Part], brep: Brep, ahead: Ahead, rays: Sequence[_Ray]) -> list[_Ray]:
    """The same rays from where they meet the wall of their own hole on; without those that do not."""
    return [
        _Ray(ray.part, add(ray.start, scale(ray.towards, _exactly(ray, brep.faces[face], distance))), ray.towards)
        for ray, (distance, face) in zip(rays, _met(rays, ahead), strict=True)
        if face in parts[ray.part].faces
    ]


def _on_axis(hole: Part, point: Vector) -> Vector:
    assert hole.axis is not None
    return add(hole.center, scale(hole.axis, dot(sub(point, hole.center), hole.axis)))


def _around(index: int, hole: Part) -> Iterator[_Ray]:
    """From its axis to all sides."""
    assert hole.opening is not None
    assert hole.normal is not None
    assert hole.depth is not None
    x = perpendicular(hole.normal)
    y = cross(hole.normal, x)
    for level in LEVELS:
        start = add(hole.opening, scale(hole.normal, -level * hole.depth))
        for angle in np.arange(AROUND) * (2 * np.pi / AROUND):
            yield _Ray(index, start, add(scale(x, float(np.cos(angle))), scale(y, float(np.sin(angle)))))


def _straight(hole: Part, face: FaceRecord) -> Vector | None:
    """The shortest way from the hole's axis to what a face lies on, where that runs alongside; None elsewhere."""
    assert hole.axis is not None
    if face.kind is SurfaceKind.PLANE and abs(dot(face.axis, hole.axis)) < SQUARE:
        return face.axis
    if face.kind is SurfaceKind.CYLINDER and norm(cross(face.axis, hole.axis)) < SQUARE:
        apart = sub(hole.center, face.origin)
        aside = sub(apart, scale(face.axis, dot(apart, face.axis)))
        return unit(aside) if norm(aside) > SQUARE * face.radius else None
    return None


def _least(
    parts: Sequence[Part], brep: Brep, ahead: Ahead, rays: Sequence[_Ray], without: Set[int]
) -> dict[int, float]:
    """By index of a part: how far it is along the shortest of its rays to the other side of the material.

    `without`: faces that do not count.
    """
    least: dict[int, float] = {}
    for ray, (distance, face) in zip(rays, _met(rays, ahead), strict=True):
        if face < 0 or face in parts[ray.part].faces or face in without:
            continue
        exact = _exactly(ray, brep.faces[face], distance)
        if exact > 0.0:
            least[ray.part] = min(exact, least.get(ray.part, exact))
    return least


def _exactly(ray: _Ray, face: FaceRecord, distance: float) -> float:
    """How far is it along the ray to the face that it was found to meet?"""
    if face.kind is SurfaceKind.PLANE and abs(dot(face.axis, ray.towards)) > SQUARE:
        return dot(sub(face.point, ray.start), face.axis) / dot(face.axis, ray.towards)
    if face.kind is SurfaceKind.CYLINDER and abs(dot(face.axis, ray.towards)) < SQUARE:
        aside = line_distance(ray.start, face.origin, face.axis)
        toward = sub(face.origin, ray.start)
        ahead_of = dot(toward, ray.towards)
        off = max(0.0, aside**2 - ahead_of**2)
        if off < face.radius**2:
            root = math.sqrt(face.radius**2 - off)
            return min((ahead_of - root, ahead_of + root), key=lambda value: abs(value - distance))
    return distance


def _met(rays: Sequence[_Ray], ahead: Ahead) -> list[tuple[float, int]]:
    """How far ahead is the next surface, and which face is it?"""
    if not rays:
        return []
    distances, faces = ahead([ray.start for ray in rays], [ray.towards for ray in rays])
    return list(zip(distances.tolist(), faces.tolist(), strict=True))
