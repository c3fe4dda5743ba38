"""Which walls are one bore or one shaft? Coaxial walls that follow each other along one axis form a stack."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import combinations, pairwise

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeRecord, FaceRecord, Loop, linked
from querycad_segworker.vectors import cross, dot, norm, parallel, wrapped

from .axes import ENCLOSES_RAD
from .walls import Axis, Wall

SQUARE = 1e-2
"""Sine of the angle by which a shoulder may lean against the plane square to the axis."""


class End(StrEnum):
    """What a stack runs into at one end."""

    OPEN = "open"
    """A convex rim: the outside, for a bore; a free tip, for a shaft."""
    CLOSED = "closed"
    """A concave corner: a bottom, for a bore; the material it stands on, for a shaft."""


@dataclass(frozen=True, slots=True)
class Stack:
    """Coaxial walls in order of position along `axis`, with what closes them.

    `shoulders` are the ring faces between walls, `low_faces` and `high_faces` the faces beyond the two ends.
    """

    axis: Axis
    walls: tuple[Wall, ...]
    shoulders: tuple[int, ...]
    low_end: End
    high_end: End
    low_faces: tuple[int, ...]
    high_faces: tuple[int, ...]

    @property
    def faces(self) -> set[int]:
        """Which faces are its walls?"""
        return {face for wall in self.walls for face in wall.faces}

    @property
    def open_both(self) -> bool:
        """Is it open at both ends?"""
        return self.low_end is End.OPEN and self.high_end is End.OPEN

    def beyond(self, high: bool) -> tuple[int, ...]:
        """Which faces lie beyond its high, or low, end?"""
        return self.high_faces if high else self.low_faces

    def last_wall(self, high: bool) -> Wall:
        """Which wall reaches farthest to its high, or low, end?"""
        return max(self.walls, key=lambda w: wall_range(self.axis, w)[1] if high else -wall_range(self.axis, w)[0])

    @property
    def low(self) -> float:
        """Where does it begin along its axis?"""
        return min(wall_range(self.axis, wall)[0] for wall in self.walls)

    @property
    def high(self) -> float:
        """Where does it end along its axis?"""
        return max(wall_range(self.axis, wall)[1] for wall in self.walls)


def wall_range(axis: Axis, wall: Wall) -> tuple[float, float]:
    """From where to where does the wall reach along `axis`, which is coaxial to it?"""
    a, b = axis.position(wall.axis.at(wall.low)), axis.position(wall.axis.at(wall.high))
    return min(a, b), max(a, b)


def radius_at(axis: Axis, wall: Wall, high: bool) -> float:
    """What is the wall's radius at its low or high end along `axis`?"""
    same_way = dot(axis.direction, wall.axis.direction) > 0
    return wall.radius_high if high == same_way else wall.radius_low


def stacks(
    brep: Brep,
    walls: Sequence[Wall],
    tolerances: Tolerances,
    belongs: Callable[[Wall], bool],
    *,
    over_roundings: bool = False,
) -> list[Stack]:
    """Which stacks do those walls form for which `belongs` is true?

    Two coaxial walls follow each other when they share an edge, or when a plane ring around the axis joins one
    to the other: a shoulder, whose one boundary is the first wall's rim and whose other boundary is the second's.
    `over_roundings`: also where fillets and roundings around the axis lead from wall to shoulder.
    """
    members = [wall for wall in walls if belongs(wall)]
    owner = {face: i for i, wall in enumerate(members) for face in wall.faces}
    if over_roundings:
        owner |= _roundings(brep, members, owner, tolerances)
    pairs: list[tuple[int, int]] = []
    shoulders: dict[int, set[int]] = defaultdict(set)
    for edge in brep.edges:
        if len(edge.faces) == 2:
            a, b = owner.get(edge.faces[0]), owner.get(edge.faces[1])
            if a is not None and b is not None and a != b and members[a].axis.same_line(members[b].axis, tolerances):
                pairs.append((a, b))
    for face in brep.faces:
        if face.kind is SurfaceKind.PLANE:
            joined = _joined_by(face, brep, members, owner, tolerances)
            pairs += pairwise(joined)
            for i in joined:
                shoulders[i].add(face.id)
    result = []
    for group in linked(range(len(members)), pairs):
        rings = {face for i in group for face in shoulders[i]}
        result.append(_stack(brep, [members[i] for i in group], rings))
    return result


def _roundings(brep: Brep, members: Sequence[Wall], owner: dict[int, int], tolerances: Tolerances) -> dict[int, int]:
    """Tori around a wall's axis that run into it tangentially: each belongs to that wall."""
    found: dict[int, int] = {}
    for i, wall in enumerate(members):
        for face in wall.faces:
            for other in roundings_beside(brep, face):
                torus = brep.faces[other]
                if other not in owner and wall.axis.same_line(Axis.of(torus), tolerances):
                    found[other] = i
    return found


def roundings_beside(brep: Brep, face: int) -> list[int]:
    """Which tori run into a face tangentially, as fillets and rounded rims do?"""
    smooth = brep.beside(face, EdgeConvexity.SMOOTH)
    return [other for other in smooth if brep.faces[other].kind is SurfaceKind.TORUS]


def _joined_by(
    face: FaceRecord, brep: Brep, members: Sequence[Wall], owner: dict[int, int], tolerances: Tolerances
) -> set[int]:
    """The two coaxial walls between which a plane face is the shoulder: its outer boundary and one inside it are rims.

    Other holes in the ring, as those of a flange, do not part the walls. Nor does a slit or a cross hole that opens the
    ring: then both rims are parts of one boundary, and go around the axis for more than `ENCLOSES_RAD`.
    """
    outer = [i for loop in face.loops if loop.outer for i in _rim_of(face, loop, brep, members, owner)]
    inner = [i for loop in face.loops if not loop.outer for i in _rim_of(face, loop, brep, members, owner)]
    for first in outer:
        for second in inner:
            if first != second and members[first].axis.same_line(members[second].axis, tolerances):
                return {first, second}
    turns: dict[int, float] = defaultdict(float)
    for e in face.loops[0].edges if face.loops else ():
        for i in {owner[other] for other in brep.edges[e].faces if other != face.id and other in owner}:
            if parallel(face.axis, members[i].axis.direction, SQUARE):
                turns[i] += winding(members[i].axis, brep.edges[e])
    for first, second in combinations([i for i, turn in turns.items() if turn > ENCLOSES_RAD], 2):
        if members[first].axis.same_line(members[second].axis, tolerances):
            return {first, second}
    return set()


def _rim_of(face: FaceRecord, loop: Loop, brep: Brep, members: Sequence[Wall], owner: dict[int, int]) -> set[int]:
    """The wall at right angles to the plane face whose rim this boundary is, for more than half of its length."""
    length = covered = 0.0
    walls_of_loop = set[int]()
    for e in loop.edges:
        edge = brep.edges[e]
        length += edge.length
        others = [owner[other] for other in edge.faces if other != face.id and other in owner]
        covered += edge.length if others else 0.0
        walls_of_loop.update(i for i in others if parallel(face.axis, members[i].axis.direction, SQUARE))
    return walls_of_loop if len(walls_of_loop) == 1 and covered >= 0.5 * length else set()


def _stack(brep: Brep, group: list[Wall], shoulders: set[int]) -> Stack:
    lead = max(group, key=lambda wall: (wall.kind is SurfaceKind.CYLINDER, wall.height * wall.sweep))
    axis = lead.axis
    ordered = sorted(group, key=lambda wall: wall_range(axis, wall))
    inside = {face for wall in ordered for face in wall.faces} | shoulders
    low_end, low_faces = _end(brep, axis, inside, ordered, at_high=False)
    high_end, high_faces = _end(brep, axis, inside, ordered, at_high=True)
    return Stack(axis, tuple(ordered), tuple(sorted(shoulders)), low_end, high_end, low_faces, high_faces)


def _end(
    brep: Brep, axis: Axis, inside: set[int], ordered: Sequence[Wall], *, at_high: bool
) -> tuple[End, tuple[int, ...]]:
    """Open or closed, by the angle around the axis that convex and concave edges cover at this end."""
    wall = ordered[-1] if at_high else ordered[0]
    if at_high:
        wall = max(ordered, key=lambda w: wall_range(axis, w)[1])
    if radius_at(axis, wall, at_high) <= 1e-3 * wall.radius:
        return End.CLOSED, ()
    middle = sum(wall_range(axis, wall)) / 2
    score = {End.OPEN: 0.0, End.CLOSED: 0.0}
    beyond: dict[int, float] = defaultdict(float)
    for face in wall.faces:
        for e in brep.face_edges[face]:
            edge = brep.edges[e]
            others = [f for f in edge.faces if f not in inside]
            if not others or (axis.position(_edge_middle(edge)) > middle) != at_high:
                continue
            turn = winding(axis, edge)
            beyond[others[0]] += turn
            kind = _verdict(brep, edge, others[0], brep.faces[face])
            if kind is not None:
                score[kind] += turn
    if not any(score.values()):
        return End.OPEN, tuple(sorted(beyond))
    return max(score, key=lambda end: score[end]), tuple(sorted(f for f, turn in beyond.items() if turn > 0.1))


def _edge_middle(edge: EdgeRecord) -> Vector:
    return edge.center if edge.center is not None and edge.closed else edge.mid


def _verdict(brep: Brep, edge: EdgeRecord, beyond: int, wall: FaceRecord) -> End | None:
    """Does this edge speak for an open or a closed end? Across a smooth edge the blend's own curvature decides.

    A hollow torus at the end of a bore rounds the corner to its floor.
    """
    if edge.convexity is EdgeConvexity.CONVEX:
        return End.OPEN
    if edge.convexity is EdgeConvexity.CONCAVE:
        return End.CLOSED
    if edge.convexity is not EdgeConvexity.SMOOTH:
        return None
    face = brep.faces[beyond]
    if face.kind in (SurfaceKind.TORUS, SurfaceKind.SPHERE, SurfaceKind.CYLINDER, SurfaceKind.CONE):
        return End.OPEN if face.outward > 0 else End.CLOSED
    if wall.kind is SurfaceKind.TORUS and wall.outward < 0 and face.kind is SurfaceKind.PLANE:
        return End.CLOSED
    return None


def winding(axis: Axis, edge: EdgeRecord) -> float:
    """Which angle around the axis does the edge cover? A closed edge that does not go around the axis covers none."""
    if edge.center is not None and edge.axis is not None and edge.radius:
        on_axis = axis.radius_of(edge.center) <= 0.05 * edge.radius and norm(cross(edge.axis, axis.direction)) < 0.1
        if on_axis:
            return min(edge.length / edge.radius, 2 * math.pi)
    first = wrapped(axis.angle_of(edge.mid) - axis.angle_of(edge.start))
    second = wrapped(axis.angle_of(edge.end) - axis.angle_of(edge.mid))
    if edge.closed:
        return 2 * math.pi if abs(first) > math.radians(120) else 0.0
    return abs(first + second)
