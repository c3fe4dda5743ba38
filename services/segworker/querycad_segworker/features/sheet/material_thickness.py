"""How thick is the material? The wall thickness that most of the model's surface shares."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind
from querycad_segworker.mesh import Mesh
from querycad_segworker.tolerances import Tolerances, exceeds
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import Box, box_union, dist
from querycad_segworker.visibility.raycast import Scene

from .gaps import NO_WALL, Depths, gap
from .minimum_thickness import thinnest

SHARED_AREA = 0.6
"""A thickness is the material's when at least this share of the surface has it: edges and ends of a sheet have
another, and a machined block has no such thickness at all."""
SHEET_RATIO = 0.2
"""A sheet is thinner than this share of the model's second largest extent; thicker ones are blocks."""
SAME = 0.01
"""Thicknesses that differ by less than 1 % are one: far below sheet tolerances (EN 10051: some 5 %)."""
PIECES = 48
"""A triangle of a plane face is cut in pieces until none has more than one part in so many of the face: what lies
behind half of a face lies behind half of the pieces, to some per cent."""
CUTS = 4
"""Each cut makes four of one, at most so many times: 256 rays for a triangle."""
MOSTLY = 0.5
"""Plane faces speak for the whole where they are more than this share of the surface."""


@dataclass(frozen=True, slots=True)
class Thickness:
    """Wall thicknesses in metres: of the whole model, None where it has none, and of bodies by id."""

    model: float | None = None
    bodies: Mapping[int, float] = field(default_factory=dict)
    least: Mapping[int, float] = field(default_factory=dict)
    """Of the thinnest wall of each body, by id."""
    opposite_m2: Mapping[tuple[int, int], float] = field(default_factory=dict)
    """How much of a plane face has another plane face straight behind it, across the material? By ids of both."""

    def of_all(self, bodies: int) -> float | None:
        """The thinnest wall of a model of so many bodies; None where that of any is not known."""
        return min(self.least.values()) if self.least and len(self.least) == bodies else None

    def renumbered(self, owner: Sequence[int]) -> Thickness:
        """The same of a model whose face `i` is part of face `owner[i]`."""
        opposite: dict[tuple[int, int], float] = defaultdict(float)
        for (a, b), area_m2 in self.opposite_m2.items():
            opposite[owner[a], owner[b]] += area_m2
        return replace(self, opposite_m2=opposite)


NO_THICKNESS = Thickness()
"""Of what is no sheet and has no walls."""


def material_thickness(brep: Brep, mesh: Mesh, scene: Scene) -> Thickness:
    """Which thickness do the sheets or walls have that the model and each of its bodies are made of?

    From the middle of each triangle, or piece of one, a ray goes straight into the material, to the face on the other
    side. Where the two run alongside each other, as parallel planes or coaxial cylinders do, their distance is the
    wall's, weighted by the area. Where no thickness is shared by most of all faces, the plane ones decide.
    """
    depths = _depths(brep, mesh, scene)
    owners = np.array([face.body for face in brep.faces], dtype=np.int64)[depths.faces]
    plane = np.array([face.kind is SurfaceKind.PLANE for face in brep.faces], dtype=np.bool_)
    whole = _shared(brep.box, depths, plane)
    opposite, least = _opposite(depths, plane), thinnest(brep, depths, scene)
    if len(brep.bodies) == 1:
        return Thickness(whole, {} if whole is None else {brep.bodies[0].id: whole}, least, opposite)
    found = {}
    for body in brep.bodies:
        box = box_union(brep.faces[f].box for f in body.faces)
        thickness = _shared(box, depths.of(owners == body.id), plane) if box is not None else None
        if thickness is not None:
            found[body.id] = thickness
    return Thickness(whole, found, least, opposite)


def _opposite(depths: Depths, plane: NDArray[np.bool_]) -> dict[tuple[int, int], float]:
    """The areas of `Thickness.opposite_m2`."""
    chosen = np.isfinite(depths.walls_m) & plane[depths.faces] & plane[depths.beyond]
    pairs = np.stack([depths.faces[chosen], depths.beyond[chosen]], axis=1)
    unique, index = np.unique(pairs, axis=0, return_inverse=True)
    areas = np.bincount(index.ravel(), weights=depths.areas_m2[chosen], minlength=len(unique))
    return {(int(a), int(b)): float(area) for (a, b), area in zip(unique, areas, strict=True)}


def _depths(brep: Brep, mesh: Mesh, scene: Scene) -> Depths:
    """What lies behind the triangles, but for those behind which nothing lies."""
    corners, faces = _pieces(brep, mesh)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    doubled = np.linalg.norm(normals, axis=1)
    solid = doubled > 0
    faces = faces[solid]
    normals = normals[solid] / doubled[solid, None]
    planes = np.array([face.axis if face.kind is SurfaceKind.PLANE else (0.0, 0.0, 0.0) for face in brep.faces])
    flat = planes[faces].any(axis=1) if len(faces) else np.zeros(0, dtype=np.bool_)
    normals[flat] = planes[faces[flat]]
    middles = corners[solid].mean(axis=1)
    distances, beyond = scene.ahead(middles, -normals)
    reached = np.isfinite(distances)
    faces, beyond, distances = faces[reached], beyond[reached], distances[reached]
    _keep_to_body(brep, faces, beyond, middles[reached] - distances[:, None] * normals[reached])
    walls = np.full(len(faces), NO_WALL)
    pairs, index = np.unique(faces.astype(np.int64) * len(brep.faces) + beyond, return_inverse=True)
    if len(pairs):
        tolerances = Tolerances.for_diagonal(dist(*brep.box))
        pairs_of_faces = (divmod(int(pair), len(brep.faces)) for pair in pairs)
        gaps = np.array([gap(brep.faces[a], brep.faces[b], tolerances) for a, b in pairs_of_faces])[index.ravel()]
        walls = np.where(np.isnan(gaps), distances, gaps)
    starts = corners[solid][reached]
    return Depths(faces, beyond, doubled[solid][reached] / 2, distances, walls, starts, normals[reached])


def _pieces(brep: Brep, mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """The triangles as corners (N, 3, 3) and face ids (N,); those of plane faces in pieces, as `PIECES` says."""
    corners, faces = mesh.vertices_m[mesh.triangles], mesh.triangle_face
    most = np.array([f.area / PIECES if f.kind is SurfaceKind.PLANE else np.inf for f in brep.faces])
    for _ in range(CUTS):
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        large = np.linalg.norm(across, axis=1) / 2 > most[faces]
        if not large.any():
            break
        a, b, c = corners[large].transpose(1, 0, 2)
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        four = [np.stack(piece, axis=1) for piece in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
        corners = np.concatenate([corners[~large], *four])
        faces = np.concatenate([faces[~large], *[faces[large]] * 4])
    return corners, faces


def _keep_to_body(brep: Brep, faces: NDArray[np.int32], beyond: NDArray[np.int32], ends_m: NDArray[np.float64]) -> None:
    """Where another body lies against the own one, a ray ends at either: `beyond` is the own one's face afterwards.

    `ends_m`: (N, 3), where the rays from `faces` end.
    """
    bodies = np.array([face.body for face in brep.faces])
    lows, highs = (np.array([face.box[end] for face in brep.faces]) for end in (0, 1))
    tolerances = Tolerances.for_diagonal(dist(*brep.box))
    near = 10 * tolerances.length
    strange = np.flatnonzero(bodies[faces] != bodies[beyond])
    pairs, index = np.unique(np.stack([bodies[faces[strange]], beyond[strange]]), axis=1, return_inverse=True)
    for number, (body, other) in enumerate(pairs.T):
        own = (bodies == body) & (lows <= highs[other] + near).all(axis=1) & (highs >= lows[other] - near).all(axis=1)
        rays = strange[index.ravel() == number]
        for face in np.flatnonzero(own):
            if gap(brep.faces[face], brep.faces[other], tolerances) <= near:
                there = (ends_m[rays] >= lows[face] - near) & (ends_m[rays] <= highs[face] + near)
                beyond[rays[there.all(axis=1)]] = face


def _shared(box: Box, depths: Depths, plane: NDArray[np.bool_]) -> float | None:
    """The thickness that most of the surface shares; None where there is none, or where it is no sheet's."""
    extents = sorted(high - low for low, high in zip(*box, strict=True))
    flat = depths.of(plane[depths.faces])
    mostly_flat = flat.areas_m2.sum() > MOSTLY * depths.areas_m2.sum()
    shared = (_most_common(depths), _most_common(flat) if mostly_flat else None)
    return next((t for t in shared if t is not None and not exceeds(t, SHEET_RATIO * extents[1])), None)


def _most_common(depths: Depths) -> float | None:
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
