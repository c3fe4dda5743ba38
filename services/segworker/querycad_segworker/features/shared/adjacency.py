"""The adjacency of faces by concave edges, where fillets in corners count as the corners they round."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.reach import edges_span
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord, Loop, parted, spread
from querycad_segworker.vectors import line_distance, parallel

BEVEL_RAD = (math.radians(20.0), math.radians(70.0))
"""A chamfer turns by so much into the face whose edge it breaks, and again into the wall behind."""
HALF_CYLINDER_RAD = math.radians(179.0)
"""A rounding turns by less than half a circle: it joins two faces that meet at an angle."""


class ConcaveGraph:
    """Which faces meet in concave edges? `taken` are faces that other features own already."""

    def __init__(self, brep: Brep, taken: Collection[int]) -> None:
        self.brep = brep
        self.taken = frozenset(taken)
        self.concave: dict[int, set[int]] = defaultdict(set)
        self._flush: dict[int, set[int]] = defaultdict(set)
        self.bevels: set[int] = set()
        """Faces found to be chamfers of a mouth."""
        self._extents: dict[tuple[float, ...], float] = {}
        self.blends = {face.id for face in brep.faces if is_blend(brep, face)}
        for edge in brep.edges:
            if len(edge.faces) != 2:
                continue
            a, b = edge.faces
            inner_blend = any(i in self.blends and brep.faces[i].outward < 0 for i in (a, b))
            if edge.convexity is EdgeConvexity.SMOOTH and not inner_blend:
                inner_blend = edge.kind is EdgeKind.LINE and _is_round_end(brep.faces[a], brep.faces[b])
                if _are_flush(brep.faces[a], brep.faces[b]):
                    inner_blend = True
                    self._flush[a].add(b)
                    self._flush[b].add(a)
            if edge.convexity is EdgeConvexity.CONCAVE or (edge.convexity is EdgeConvexity.SMOOTH and inner_blend):
                self.concave[a].add(b)
                self.concave[b].add(a)

    def extent(self, body: int, direction: Vector) -> float:
        """How far does a body reach along a direction? Slots share few directions: each is measured once."""
        key = (body, *(round(abs(c), 4) for c in direction))
        if key not in self._extents:
            edges = self.brep.edges_of(self.brep.bodies[body].faces)
            low, high = edges_span(self.brep, edges, direction)
            self._extents[key] = high - low
        return self._extents[key]

    def flush(self, face: int) -> set[int]:
        """The pieces of one plane that a face is stored in, itself among them."""
        return spread((face,), lambda piece: self._flush[piece])

    def is_sharp(self, a: int, b: int) -> bool:
        """Do two faces meet in a concave edge, rather than tangentially?"""
        return b in self.brep.beside(a, EdgeConvexity.CONCAVE)

    def behind(self, host: FaceRecord, loop: Loop) -> set[int]:
        """The faces that sink in behind an inner loop of `host`; empty when it rises, or is the mouth of a hole."""
        first: set[int] = set()
        for e in loop.edges:
            edge = self.brep.edges[e]
            others = [i for i in edge.faces if i != host.id]
            if not others:
                return set()
            other = self.brep.faces[others[0]]
            rounding = edge.convexity is EdgeConvexity.SMOOTH and other.outward > 0
            if edge.convexity is not EdgeConvexity.CONVEX and not rounding:
                return set()
            first.add(other.id)
            if rounding:
                first.update(self.brep.beside(other.id, EdgeConvexity.SMOOTH))
        first.discard(host.id)
        first |= self._below_bevel(host, first)
        group = spread(first, lambda face: self._goes_on(face) - {host.id})
        return set() if first & self.taken and len(first) == len(first & self.taken) else group - self.taken

    def _below_bevel(self, host: FaceRecord, first: Collection[int]) -> set[int]:
        """The walls below a mouth that is chamfered all around: behind the lower, convex edges of the chamfer."""
        below: set[int] = set()
        for face in first:
            low, high = BEVEL_RAD
            record = self.brep.faces[face]
            turns = [edge.angle for edge, other in self.brep.neighbours(face) if other == host.id]
            if record.kind not in (SurfaceKind.PLANE, SurfaceKind.CONE) or not all(low <= t <= high for t in turns):
                return set()
            walls = {
                other
                for edge, other in self.brep.neighbours(face)
                if other != host.id and edge.convexity is EdgeConvexity.CONVEX and edge.angle <= high
            }
            if not walls:
                return set()
            below |= walls
        self.bevels |= set(first)
        return below

    def _goes_on(self, face: int) -> set[int]:
        """In concave corners, or where walls run into each other, as the flats and round ends of an obround do."""
        if self._bulges(face):
            return self.concave[face]
        smooth = self.brep.beside(face, EdgeConvexity.SMOOTH)
        return self.concave[face] | {other for other in smooth if not self._bulges(other)}

    def pieces(self, faces: Collection[int]) -> list[set[int]]:
        """Parts of `faces` that hang together by concave corners or smoothly.

        Where two cuts run into each other, the material between them keeps a convex edge: each piece is of one cut.
        """
        own = set(faces)

        def onwards(face: int) -> set[int]:
            beside = {
                other
                for edge, other in self.brep.neighbours(face)
                if edge.convexity is EdgeConvexity.SMOOTH or face in self.bevels or other in self.bevels
            }
            return (self.concave[face] | beside) & own

        return list(parted(sorted(own), onwards))

    def concave_groups(self, used: Collection[int]) -> list[set[int]]:
        """Groups of free faces that meet in concave edges, but not in those around a protrusion's foot.

        Round faces that bulge out are what two depressions have in common, such as the hub between the pockets of an
        arm: no group goes on behind one, and none has it that is not its alone.
        """
        rising = self._rising_links()
        taken = set(used)

        def onwards(face: int) -> set[int]:
            near = set() if self._bulges(face) else self.concave[face] - taken
            return {other for other in near if (face, other) not in rising}

        groups, seen = [], set(used)
        for start in sorted(self.concave):
            if start in seen or start in self.blends or self._bulges(start):
                continue
            group = spread((start,), onwards)
            group -= {face for face in group if self._bulges(face) and not self._is_within(face, group)}
            seen |= {face for face in group if not self._bulges(face)}
            if len(group) > 1:
                groups.append(group)
        return groups

    def _bulges(self, face: int) -> bool:
        return self.brep.faces[face].outward > 0

    def _is_within(self, bulge: int, group: Collection[int]) -> bool:
        """Is it a wall of this depression alone, bowed into it?"""
        return self.brep.faces[bulge].sweep <= math.pi and self.concave[bulge] <= set(group)

    def _rising_links(self) -> set[tuple[int, int]]:
        """Pairs of a face and a wall that rises from one of its inner loops: a protrusion, no depression."""
        links = set()
        for face in self.brep.faces:
            for loop in face.loops:
                if loop.outer:
                    continue
                for e in loop.edges:
                    for other in self.brep.edges[e].faces:
                        if other != face.id:
                            links.update({(face.id, other), (other, face.id)})
        return links


def _are_flush(a: FaceRecord, b: FaceRecord) -> bool:
    """Are these two planes that run on in each other?"""
    return a.kind is SurfaceKind.PLANE and b.kind is SurfaceKind.PLANE and a.id != b.id


def _is_round_end(a: FaceRecord, b: FaceRecord) -> bool:
    """Is one a flat and the other a concave half cylinder that it runs into, as in an obround or a U?"""
    kinds = {a.kind, b.kind}
    return kinds == {SurfaceKind.PLANE, SurfaceKind.CYLINDER} and all(f.outward <= 0 for f in (a, b))


def is_blend(brep: Brep, face: FaceRecord) -> bool:
    """Does the face only round an edge or corner? A partial cylinder, torus or sphere, tangent to two neighbours.

    Not so half a cylinder, also in several pieces: it is the end of an obround; nor a wall between two smaller rounds.
    """
    if face.kind not in (SurfaceKind.CYLINDER, SurfaceKind.TORUS, SurfaceKind.SPHERE):
        return False
    smooth = _smooth(brep, face.id)
    if face.kind is not SurfaceKind.CYLINDER:
        return len(smooth) >= 2
    pieces = {face.id, *(other for other in smooth if same_cylinder(face, brep.faces[other]))}
    if sum(brep.faces[piece].sweep for piece in pieces) > HALF_CYLINDER_RAD:
        return False
    around = {other: edge for piece in pieces for other, edge in _smooth(brep, piece).items() if other not in pieces}
    sides = [brep.faces[other] for other, edge in around.items() if edge.kind is EdgeKind.LINE]
    if len(sides) > 1 and all(s.kind is SurfaceKind.CYLINDER and s.radius < 0.99 * face.radius for s in sides):
        return False
    return len(around) >= 2


def _smooth(brep: Brep, face: int) -> dict[int, EdgeRecord]:
    return {other: edge for edge, other in brep.neighbours(face) if edge.convexity is EdgeConvexity.SMOOTH}


def breaks_edge(brep: Brep, face: FaceRecord, edge: EdgeRecord, other: FaceRecord) -> bool:
    """Does the `other` face beyond an edge round or bevel what a face would run into there? It is smaller."""
    if edge.convexity is EdgeConvexity.SMOOTH:
        return other.outward > 0 and is_blend(brep, other)
    if edge.convexity is not EdgeConvexity.CONVEX or other.area > face.area:
        return False
    low, high = BEVEL_RAD
    return low < edge.angle < high and other.kind in (SurfaceKind.PLANE, SurfaceKind.CONE)


def same_cylinder(a: FaceRecord, b: FaceRecord) -> bool:
    """Are these pieces of one cylinder?"""
    near = 1e-3 * a.radius
    if a.kind is not SurfaceKind.CYLINDER or b.kind is not a.kind or a.outward != b.outward:
        return False
    alike = abs(a.radius - b.radius) <= near and parallel(a.axis, b.axis, 1e-3)
    return alike and line_distance(b.origin, a.origin, a.axis) < near
