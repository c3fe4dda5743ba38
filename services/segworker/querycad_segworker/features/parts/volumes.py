"""How much material was taken out, or stands out? Volumes of depressions, closed voids and protrusions."""

from __future__ import annotations

import math

import numpy as np

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.depressions.depression import Depression, DepressionKind
from querycad_segworker.features.protrusions.protrusions import Protrusion
from querycad_segworker.features.shared.face_regions import Moments
from querycad_segworker.mesh import Mesh
from querycad_segworker.topology import Brep, EdgeKind, EdgeRecord, Loop
from querycad_segworker.vectors import cross, dist, dot, scale, sub

WHOLE = 0.02
"""Below this share of their area, faces that close a ring cancel out: what is left is the opening's."""
ROUND_ABOUT = frozenset(("keyway", "t_slot", "dovetail", "woodruff"))
"""Slots that do not fill the box of their measures."""
UPRIGHT = 1e-3
"""Cosine below which a wall stands square on the floor."""


class Volumes:
    """Measures depressions by the divergence theorem: exact on planes, cylinders and spheres, else by triangles.

    Upright walls around a floor or rim of lines and arcs are measured exactly, as area times depth.
    """

    def __init__(self, brep: Brep, mesh: Mesh | None) -> None:
        self._brep = brep
        self.moments = _moments(brep, mesh) if mesh is not None else None

    def of(self, found: Depression) -> float | None:
        """How large is the space, in cubic metres? None where its openings do not lie in planes."""
        if found.is_open:
            straight = found.outline == "rectangular" and found.kind is not DepressionKind.STEP
            straight = straight and not ROUND_ABOUT.intersection(found.tags)
            return found.length * found.width * found.depth if straight else None
        prism = self._prism(found)
        if prism is not None:
            return prism
        if self.moments is None:
            return None
        fluxes, areas = self.moments.flux_m3, self.moments.area_m2
        faces, center = list(found.faces), np.array(found.center)
        area = areas[faces].sum(axis=0)
        flux = float(fluxes[faces].sum() - area @ center)
        size = float(sum(self._brep.faces[f].area for f in faces))
        if found.kind is DepressionKind.CAVITY:
            return abs(flux) / 3
        if found.kind is DepressionKind.PASSAGE:
            return abs(flux) / 2 if float(np.linalg.norm(area)) < WHOLE * size else None
        return abs(flux - float(area @ (np.array(found.opening) - center))) / 3

    def of_protrusion(self, found: Protrusion) -> float | None:
        """How much material stands out, in cubic metres? None where its faces do not close on a plane."""
        if self.moments is None:
            return None
        fluxes, areas = self.moments.flux_m3, self.moments.area_m2
        faces, base = list(found.faces), np.array(found.base)
        area = areas[faces].sum(axis=0)
        size = float(sum(self._brep.faces[f].area for f in faces))
        up = float(area @ np.array(found.normal))
        if up < WHOLE * size or float(np.linalg.norm(area - up * np.array(found.normal))) > WHOLE * size:
            return None
        return float(fluxes[faces].sum() - base @ area) / 3

    def _prism(self, found: Depression) -> float | None:
        """Area of the floor times depth, where all walls are upright and the floor is one plane of lines and arcs."""
        if found.kind is not DepressionKind.POCKET or len(found.floor) != 1:
            return None
        floor = self._brep.faces[found.floor[0]]
        for face in (self._brep.faces[f] for f in found.faces if f != floor.id):
            plane = face.kind is SurfaceKind.PLANE and abs(dot(face.axis, found.normal)) < UPRIGHT
            round_wall = face.kind is SurfaceKind.CYLINDER and abs(dot(face.axis, found.normal)) > 1 - UPRIGHT
            if not plane and not round_wall:
                return None
        if floor.kind is not SurfaceKind.PLANE or not floor.loops or dot(floor.axis, found.normal) < 1 - UPRIGHT:
            return None
        if any(not loop.outer for loop in floor.loops) and any(self._rises(loop, floor.id) for loop in floor.loops):
            return None
        area = loop_area(self._brep, floor.loops[0], floor.axis)
        return area * found.depth if area is not None else None

    def _rises(self, loop: Loop, floor: int) -> bool:
        """Does something stand on the floor within this loop?"""
        own = (other for e in loop.edges for other in self._brep.edges[e].faces if other != floor)
        return not loop.outer and any(self._brep.faces[other].outward > 0 for other in own)


def loop_area(brep: Brep, loop: Loop, normal: Vector) -> float | None:
    """Which area does a plane loop of lines and arcs enclose, in m2? None with other curves."""
    edges = [brep.edges[e] for e in loop.edges]
    if any(edge.kind is EdgeKind.OTHER for edge in edges):
        return None
    if len(edges) == 1:
        return math.pi * edges[0].radius ** 2 if edges[0].radius and edges[0].closed else None
    path = _path(edges)
    origin, total = path[0][0], 0.0
    for start, edge, end in path:
        total += dot(cross(sub(start, origin), sub(end, origin)), normal) / 2
        if edge.radius:
            angle = edge.length / edge.radius
            bulge = dot(cross(sub(edge.mid, start), sub(end, edge.mid)), normal)
            total += math.copysign(edge.radius**2 / 2 * (angle - math.sin(angle)), bulge)
    return abs(total)


def _path(edges: list[EdgeRecord]) -> list[tuple[Vector, EdgeRecord, Vector]]:
    """The edges one after the other, each with where the loop enters and leaves it."""
    left = list(edges)
    edge = left.pop()
    path = [(edge.start, edge, edge.end)]
    while left:
        at = path[-1][2]
        edge = min(left, key=lambda e: min(dist(e.start, at), dist(e.end, at)))
        left.remove(edge)
        forward = dist(edge.start, at) <= dist(edge.end, at)
        path.append((edge.start, edge, edge.end) if forward else (edge.end, edge, edge.start))
    return path


def _moments(brep: Brep, mesh: Mesh) -> Moments:
    a, b, c = (mesh.vertices_m[mesh.triangles[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a) / 2
    flux, area = np.zeros(len(brep.faces)), np.zeros((len(brep.faces), 3))
    np.add.at(flux, mesh.triangle_face, np.einsum("ij,ij->i", (a + b + c) / 3, normals))
    np.add.at(area, mesh.triangle_face, normals)
    for face in brep.faces:
        if face.kind is SurfaceKind.PLANE:
            flux[face.id] = face.area * dot(face.point, face.axis)
            area[face.id] = scale(face.axis, face.area)
        elif face.kind in (SurfaceKind.CYLINDER, SurfaceKind.SPHERE):
            # Points are origin plus radius times normal, plus for a cylinder a way along the axis, across the normal.
            flux[face.id] = face.outward * face.radius * face.area + dot(face.origin, tuple(area[face.id]))
    return Moments(flux, area)
