"""Regions of faces that convex or concave edges close off: whatever sinks in or stands out, named or not."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeRecord, linked
from querycad_segworker.vectors import ORIGIN, add, box_extents, box_union, mean, scale

from .adjacency import is_blend

MINOR = 0.5
"""What has a larger share of its body's surface, or of the box around it, is the body: the rest stands on it."""
FACING_IN = 0.3
"""Walls of a hollow look at each other, those of what stands out away from each other: by so much of their whole, 1
where all do. A step with one wall has 1, a floor around something that stands on it less than 0."""
UPRIGHT = 0.7
"""Faces that lean less than 45 degrees off the direction of a region are its walls."""
AROUND = 0.02
"""Below this share of their area, faces that look in all directions cancel out: they go around, or right through."""
BOW = 0.02
"""A single curved face bows by this share of its width at least, on the average; less is a face that is not flat."""
CURVED = (SurfaceKind.CYLINDER, SurfaceKind.SPHERE, SurfaceKind.TORUS, SurfaceKind.FREEFORM)
"""Faces that can be a hollow or a bump by themselves; cones break edges."""


@dataclass(frozen=True, slots=True)
class Moments:
    """Integrals over each face, from the mesh or exact.

    flux_m3: (F,) float64, of point times outward normal. area_m2: (F, 3) float64, of the outward normal.
    """

    flux_m3: NDArray[np.float64]
    area_m2: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Region:
    """Faces that sink in or stand out, closed off by `border`, ids of edges.

    `opening`: the unit direction that they look to on the whole; None where they go around something, or through it.
    """

    faces: frozenset[int]
    border: tuple[int, ...]
    opening: Vector | None
    sinks: bool


def closed_regions(brep: Brep, moments: Moments, cut: Collection[int]) -> list[Region]:
    """All maximal regions of the solids, hollows first, each kind by lowest face id.

    Hollows end at convex edges, what stands out at concave ones; neither ends where faces meet smoothly. A round
    counts as the convex edge that it breaks, a fillet as the concave one. The foot of what stands out makes no hollow
    of the floor around it. `cut`: faces of known cuts, which do not join what they are cut into to what lies behind.
    """
    graph = _Graph(brep, moments)
    first = graph.hollows(frozenset())
    ways = {face for region in first if region.opening is None for face in region.faces}
    standing = graph.standing(ways.union(cut))
    feet = frozenset(edge for region in standing for edge in region.border)
    return [*(graph.hollows(feet) if feet else first), *standing]


class _Graph:
    """The faces of all solids with the edges between them."""

    def __init__(self, brep: Brep, moments: Moments) -> None:
        self._brep = brep
        self._moments = moments
        self._solid = {face for body in brep.bodies if body.is_solid for face in body.faces}
        blends = {face for face in self._solid if is_blend(brep, brep.faces[face])}
        self._rounds = {face for face in blends if brep.faces[face].outward > 0}
        self._fillets = {face for face in blends if brep.faces[face].outward < 0}

    def hollows(self, feet: Collection[int]) -> list[Region]:
        """What sinks in; `feet`: edges at which something stands out."""
        ends = (EdgeConvexity.CONVEX, EdgeConvexity.FREE)
        groups = self._groups(self._solid - self._rounds, ends, feet)
        return [region for group in groups if (region := self._hollow(group, feet)) is not None]

    def standing(self, cut: Collection[int]) -> list[Region]:
        """What stands out; `cut`: faces of what is cut in."""
        ends = (EdgeConvexity.CONCAVE, EdgeConvexity.FREE)
        groups = self._groups(self._solid - self._fillets - set(cut), ends, ())
        return [region for group in groups if (region := self._outstanding(group)) is not None]

    def _groups(
        self, faces: Iterable[int], ends: Sequence[EdgeConvexity], closed: Collection[int]
    ) -> Iterator[frozenset[int]]:
        own = set(faces)
        pairs = [
            edge.faces
            for edge in self._brep.edges
            if len(edge.faces) == 2
            and edge.convexity not in ends
            and edge.id not in closed
            and own.issuperset(edge.faces)
        ]
        return map(frozenset, linked(own, pairs))

    def _hollow(self, group: frozenset[int], feet: Collection[int]) -> Region | None:
        links = [(edge, other) for face in group for edge, other in self._brep.neighbours(face)]
        border = {edge.id for edge, other in links if other not in group}
        at_foot = {face for e in border.intersection(feet) for face in self._brep.edges[e].faces}
        if not border or group <= self._fillets & at_foot:
            return None  # a void, a body without a convex edge, the foot of something
        sharp = any(e.convexity is EdgeConvexity.CONCAVE and b in group and e.id not in feet for e, b in links)
        fillets = group & self._fillets - at_foot
        region = self._region(group, border, sinks=True)
        if sharp or (fillets and fillets < group):
            return region if self._facing_in(region) > FACING_IN else None
        return region if self._bows(region) > BOW else None

    def _outstanding(self, group: frozenset[int]) -> Region | None:
        body = self._brep.bodies[self._brep.faces[min(group)].body]
        if sum(self._brep.faces[face].area for face in group) > MINOR * body.area:
            return None
        if self._room(group) > MINOR * self._room(body.faces):
            return None
        links = [(edge, other) for face in group for edge, other in self._brep.neighbours(face)]
        border = {edge.id for edge, other in links if self._is_foot(edge, other, group)}
        if not border:
            return None
        region = self._region(group, border, sinks=False)
        if any(edge.convexity is EdgeConvexity.CONVEX and other in group for edge, other in links):
            return region if self._facing_in(region) < -FACING_IN else None
        closed = all(other in group or edge.id in border for edge, other in links)
        return region if closed and self._bows(region) < -BOW else None

    def _room(self, faces: Iterable[int]) -> float:
        """How much do these faces span, m3?"""
        box = box_union(self._brep.faces[face].box for face in faces)
        return 0.0 if box is None else math.prod(box_extents(box))

    def _is_foot(self, edge: EdgeRecord, other: int, group: Collection[int]) -> bool:
        return other not in group and (edge.convexity is EdgeConvexity.CONCAVE or other in self._fillets)

    def _region(self, group: frozenset[int], border: Collection[int], *, sinks: bool) -> Region:
        area = self._moments.area_m2[sorted(group)].sum(axis=0)
        length = float(np.linalg.norm(area))
        around = length <= AROUND * sum(self._brep.faces[face].area for face in group)
        x, y, z = (float(c) for c in area)
        opening = None if around or not length else (x / length, y / length, z / length)
        return Region(group, tuple(sorted(border)), opening, sinks)

    def _facing_in(self, region: Region) -> float:
        """How much do the walls look at the middle of the region, from -1 to 1? Of all faces, where none is a wall."""
        faces = sorted(region.faces)
        towards = self._towards(faces, self._middle(self._brep.edges_of(faces)))
        if region.opening is not None:
            sizes = np.array([self._brep.faces[face].area for face in faces])
            walls = np.abs(self._moments.area_m2[faces] @ np.array(region.opening)) < UPRIGHT * sizes
            towards = towards[walls] if walls.any() else towards
        whole = float(np.abs(towards).sum())
        return float(towards.sum()) / whole if whole > 0 else 0.0

    def _bows(self, region: Region) -> float:
        """How deep is a hollow of curved faces, on the average, by its width? Below zero where it bulges out."""
        if region.opening is None or not all(self._brep.faces[face].kind in CURVED for face in region.faces):
            return 0.0
        faces = sorted(region.faces)
        mouth = float(np.linalg.norm(self._moments.area_m2[faces].sum(axis=0)))
        rim = [self._brep.edges[e] for e in region.border]
        lid = mean([p for edge in rim for p in (edge.start, edge.mid if edge.closed else edge.end)])
        return float(self._towards(faces, lid).sum()) / (3 * mouth * math.sqrt(mouth))

    def _middle(self, edges: Iterable[int]) -> Vector:
        """The middle of some edges, each by its length."""
        middle, whole = ORIGIN, 0.0
        for edge in (self._brep.edges[e] for e in edges):
            middle = add(middle, scale(add(add(edge.start, edge.end), scale(edge.mid, 2.0)), edge.length / 4))
            whole += edge.length
        return scale(middle, 1.0 / whole) if whole > 0 else middle

    def _towards(self, faces: Sequence[int], point: Vector) -> NDArray[np.float64]:
        """Of each face: the integral of the way to a point along its outward normal, m3."""
        towards: NDArray[np.float64] = self._moments.area_m2[faces] @ np.array(point) - self._moments.flux_m3[faces]
        return towards
