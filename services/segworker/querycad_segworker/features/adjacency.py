"""The adjacency of faces by concave edges, where fillets in corners count as the corners they round."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Iterable

from querycad_contracts import SurfaceKind
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord, Loop


class ConcaveGraph:
    """Which faces meet in concave edges? `taken` are faces that other features own already."""

    def __init__(self, brep: Brep, taken: Collection[int]) -> None:
        self.brep = brep
        self.taken = frozenset(taken)
        self.concave: dict[int, set[int]] = defaultdict(set)
        self.blends = {face.id for face in brep.faces if is_blend(brep, face)}
        for edge in brep.edges:
            if len(edge.faces) != 2:
                continue
            a, b = edge.faces
            inner_blend = any(i in self.blends and brep.faces[i].outward < 0 for i in (a, b))
            if edge.convexity is EdgeConvexity.CONCAVE or (edge.convexity is EdgeConvexity.SMOOTH and inner_blend):
                self.concave[a].add(b)
                self.concave[b].add(a)

    def is_sharp(self, a: int, b: int) -> bool:
        """Do two faces meet in a concave edge, rather than tangentially?"""
        return any(other == b and edge.convexity is EdgeConvexity.CONCAVE for edge, other in self.brep.neighbours(a))

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
                first.update(n for link, n in self.brep.neighbours(other.id) if link.convexity is EdgeConvexity.SMOOTH)
        first.discard(host.id)
        group = self._spread(first, stop={host.id})
        return set() if first & self.taken and len(first) == len(first & self.taken) else group - self.taken

    def _spread(self, start: Iterable[int], stop: set[int]) -> set[int]:
        group, todo = set(start), list(start)
        while todo:
            face = todo.pop()
            near = set(self.concave[face])
            if not (face in self.blends and self.brep.faces[face].outward > 0):
                near |= {
                    other
                    for edge, other in self.brep.neighbours(face)
                    if edge.convexity is EdgeConvexity.SMOOTH and self._same_wall(face, other)
                }
            for other in near - group - stop:
                group.add(other)
                todo.append(other)
        return group

    def _same_wall(self, a: int, b: int) -> bool:
        """Walls that run into each other tangentially, as the flats and round ends of an obround do."""
        return all(self.brep.faces[i].outward <= 0 for i in (a, b))

    def concave_groups(self, used: Collection[int]) -> list[set[int]]:
        """Groups of free faces that meet in concave edges, but not in those around a protrusion's foot."""
        rising = self._rising_links()
        groups, seen = [], set(used)
        for start in sorted(self.concave):
            if start in seen or start in self.blends:
                continue
            group, todo = {start}, [start]
            while todo:
                face = todo.pop()
                for other in self.concave[face] - group - set(used):
                    if (face, other) not in rising:
                        group.add(other)
                        todo.append(other)
            seen |= group
            if len(group) > 1:
                groups.append(group)
        return groups

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


def is_blend(brep: Brep, face: FaceRecord) -> bool:
    """Does the face only round an edge or corner? A partial cylinder, torus or sphere, tangent to two neighbours."""
    if face.kind not in (SurfaceKind.CYLINDER, SurfaceKind.TORUS, SurfaceKind.SPHERE):
        return False
    if face.kind is SurfaceKind.CYLINDER and face.sweep > math.radians(179.0):
        return False
    smooth = {other for edge, other in brep.neighbours(face.id) if edge.convexity is EdgeConvexity.SMOOTH}
    return len(smooth) >= 2
