"""What lies at the two ends of a hole: mouths, roundings, floors, drill points, other bores."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from querycad_contracts import Bottom, SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import same_cylinder
from querycad_segworker.features.shared.coaxial_stacks import (
    End,
    Stack,
    radius_at,
    roundings_beside,
    wall_range,
    winding,
)
from querycad_segworker.features.shared.walls import Axis, Wall, is_waist
from querycad_segworker.tolerances import reaches
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind
from querycad_segworker.vectors import dot, parallel, points_up, scale, span, sub

CORE_RATIO = 0.5
"""A boss inside the bore that fills more than this share of its depth leaves a ring: a groove, not a hole."""

WALL_SHARE = 0.5
"""A bore that takes more than this share of its body is the inside of a tube, and a hole into it goes through a wall;
a hole into a narrower one ends in it, as the ports of a manifold end in its gallery."""

ACROSS_RAD = math.radians(10.0)
"""A hole opens in, or ends in, a cylinder whose axis leaves its own by more than this."""

LEVEL = 1e-3
"""Sine of the angle by which a plane may lean and still be square to a hole."""

OBLIQUE_ANGLE = math.radians(3.0)
"""A hole this far from square on the face it opens in is oblique: more than drafts and position tolerances make."""


def opens_high(stack: Stack) -> bool:
    """Which of a through hole's two ends is the opening?

    The wider one; of two alike the one facing top, then front, then right, however the axis was stored.
    """
    ordered = sorted(stack.walls, key=lambda w: wall_range(stack.axis, w))
    low, high = radius_at(stack.axis, ordered[0], False), radius_at(stack.axis, ordered[-1], True)
    if abs(high - low) > 1e-3 * max(high, low):
        return high > low
    return points_up(stack.axis.direction)


def mouth_rounding(brep: Brep, stack: Stack, high: bool) -> tuple[tuple[int, ...], float, float] | None:
    """Which rounding leads from the wall to the outer face? (faces, position of its outer rim, radius there)."""
    faces, positions, radii = [], [], []
    for face_id in stack.beyond(high):
        face = brep.faces[face_id]
        coaxial = parallel(face.axis, stack.axis.direction, 1e-2) and stack.axis.radius_of(face.origin) < 1e-2 * max(
            face.radius, 1e-9
        )
        if face.kind is SurfaceKind.TORUS and face.outward > 0 and coaxial:
            faces.append(face_id)
            for e in brep.face_edges[face_id]:
                positions.append(stack.axis.position(brep.edges[e].mid))
                radii.append(stack.axis.radius_of(brep.edges[e].mid))
    if not faces:
        return None
    return tuple(faces), (max if high else min)(positions), max(radii)


def oblique_mouth(brep: Brep, stack: Stack, high: bool) -> float | None:
    """Where does the axis pierce the plane face that the hole opens in, when the two are not square to each other?"""
    planes = [brep.faces[f] for f in stack.beyond(high)]
    planes = [face for face in planes if face.kind is SurfaceKind.PLANE]
    face = max(planes, key=lambda f: f.area, default=None)
    if face is None:
        return None
    slope = dot(face.axis, stack.axis.direction)
    if not 0.2 < abs(slope) < math.cos(OBLIQUE_ANGLE):
        return None
    return dot(sub(face.point, stack.axis.origin), face.axis) / slope


def level_mouth(brep: Brep, stack: Stack, high: bool) -> float | None:
    """Where is the plane that an end opens in square for the most part, where the rest runs up that plane's fillets?

    A flange hole beside a hub is as deep as the flange is thick, also where it grazes the fillet between both.
    """
    beyond = set(stack.beyond(high))
    planes = {f for f in beyond if brep.faces[f].kind is SurfaceKind.PLANE}
    if len(planes) != 1 or beyond == planes:
        return None
    (plane,) = (brep.faces[f] for f in planes)
    fillets = {f for f in brep.beside(plane.id, EdgeConvexity.SMOOTH) if brep.faces[f].outward < 0}
    if not beyond - planes <= fillets or not parallel(plane.axis, stack.axis.direction, LEVEL):
        return None
    rim = (e for f in stack.last_wall(high).faces for e, other in brep.neighbours(f) if other == plane.id)
    return stack.axis.position(plane.point) if sum(winding(stack.axis, e) for e in rim) > math.pi else None


def round_mouth(brep: Brep, stack: Stack, high: bool) -> float | None:
    """Where does the axis pierce the cylinder that the hole opens in, across that one's axis? Of a pin's cross hole.

    Its rim is a saddle, of which different points are given in different files.
    """
    faces = [brep.faces[f] for f in stack.beyond(high)]
    first = next(iter(faces), None)
    if first is None or any(
        face.kind is not SurfaceKind.CYLINDER or (face.id != first.id and not same_cylinder(face, first))
        for face in faces
    ):
        return None
    if parallel(first.axis, stack.axis.direction, ACROSS_RAD):
        return None
    end = stack.high if high else stack.low
    near = min(_through(stack.axis, Axis.of(first), first.radius), key=lambda at: abs(at - end), default=None)
    return near if near is not None and abs(near - end) <= stack.last_wall(high).radius_high else None


def _through(line: Axis, around: Axis, radius: float) -> list[float]:
    """Where along a line, first to last, does it go through a cylinder? Nowhere, or twice."""
    along, out = around.direction, line.direction
    across = sub(out, scale(along, dot(out, along)))
    start = sub(line.origin, around.origin)
    start = sub(start, scale(along, dot(start, along)))
    # |start + t across| = radius
    a, b, c = dot(across, across), dot(start, across), dot(start, start) - radius**2
    root = b * b - a * c
    return [] if root < 0 or a <= 0 else [(-b - math.sqrt(root)) / a, (-b + math.sqrt(root)) / a]


class Bores:
    """The enclosing concave walls of a model: what a hole may run into."""

    def __init__(self, brep: Brep, walls: Sequence[Wall]) -> None:
        self._brep = brep
        self._wall_of: Mapping[int, Wall] = {
            face: wall for wall in walls if wall.outward < 0 and wall.encloses for face in wall.faces
        }
        self._extents: dict[tuple[int, Vector], float] = {}

    def ends_in(self, stack: Stack, high: bool) -> bool:
        """Does this end of the stack open into another bore, inside the material?"""
        beyond = stack.beyond(high)
        found = [self._wall_of.get(face) for face in beyond]
        return bool(found) and all(
            wall is not None
            and not parallel(wall.axis.direction, stack.axis.direction, ACROSS_RAD)
            and not self._is_inside_of_tube(wall, stack.axis)
            for wall in found
        )

    def pierced(self, stack: Stack, high: bool) -> float | None:
        """Where along its axis does the stack come through the wall of the bore it ends in? None: past its side."""
        beyond = stack.beyond(high)
        wall = next((self._wall_of[face] for face in beyond if face in self._wall_of), None)
        if wall is None or wall.kind is not SurfaceKind.CYLINDER:
            return None
        through = _through(stack.axis, wall.axis, wall.radius)
        return (through[0] if high else through[-1]) if through else None  # on its own side of the bore's axis

    def _is_inside_of_tube(self, bore: Wall, axis: Axis) -> bool:
        return 2 * bore.radius > WALL_SHARE * self._extent(bore.body, axis.direction)

    def _extent(self, body: int, direction: Vector) -> float:
        """How far does the body reach along a direction, in metres?"""
        key = (body, direction)
        if key not in self._extents:
            edges = [self._brep.edges[e] for e in self._brep.edges_of(self._brep.bodies[body].faces)]
            low, high = span((p for edge in edges for p in (edge.start, edge.mid)), direction)
            self._extents[key] = high - low
        return self._extents[key]


def drill_point(stack: Stack, opens_high: bool) -> Wall | None:
    """Which cone runs to a point at the closed end?"""
    inner = stack.last_wall(not opens_high)
    if inner.kind is SurfaceKind.CONE and radius_at(stack.axis, inner, not opens_high) <= 0.05 * inner.radius:
        return inner if len(stack.walls) > 1 else None
    return None


def is_pointed(stack: Stack, high: bool) -> bool:
    """Does this end of the stack run to a point, as a cone alone does?"""
    last = stack.last_wall(high)
    return last.kind is SurfaceKind.CONE and radius_at(stack.axis, last, high) <= 0.05 * last.radius


@dataclass(frozen=True, slots=True)
class Ball:
    """A hollow sphere at the end of a bore, wider than it. `end`: where along the axis it is as narrow as the bore."""

    face: int
    end: float


def ball_below(brep: Brep, stack: Stack, high: bool) -> Ball | None:
    """Which hollow ball, wider than the bore, closes this end of the stack? Its only rim is that of the bore."""
    beyond = stack.beyond(high)
    if len(beyond) != 1 or brep.faces[beyond[0]].kind is not SurfaceKind.SPHERE or brep.faces[beyond[0]].outward > 0:
        return None
    ball = brep.faces[beyond[0]]
    rim = brep.neighbours(ball.id)
    if not all(other in stack.faces and edge.convexity is EdgeConvexity.CONVEX for edge, other in rim):
        return None
    radius = radius_at(stack.axis, stack.last_wall(high), high)
    if stack.axis.radius_of(ball.origin) > 0.02 * ball.radius or radius > 1.001 * ball.radius:
        return None
    reach = math.sqrt(max(0.0, ball.radius**2 - radius**2))
    return Ball(ball.id, stack.axis.position(ball.origin) + (reach if high else -reach))


def closed_by_balls(brep: Brep, stack: Stack) -> Stack:
    """The same stack; where it opens into nothing but a hollow ball, it is closed there."""
    low = End.CLOSED if ball_below(brep, stack, False) is not None else stack.low_end
    high = End.CLOSED if ball_below(brep, stack, True) is not None else stack.high_end
    return replace(stack, low_end=low, high_end=high)


def bottom_of(brep: Brep, floor: Sequence[int], point: Wall | None) -> Bottom:
    """What is a closed end called?"""
    if point is not None:
        return Bottom.CONICAL
    kinds = [brep.faces[face].kind for face in floor]
    if SurfaceKind.SPHERE in kinds:
        return Bottom.SPHERICAL
    if SurfaceKind.CONE in kinds:
        return Bottom.CONICAL
    return Bottom.FLAT


def closing_faces(brep: Brep, stack: Stack, high: bool) -> tuple[int, ...]:
    """Which faces beyond an end may close it? Those of a window in the wall meet it in convex edges alone."""
    own = stack.faces
    return tuple(
        face
        for face in stack.beyond(high)
        if any(edge.convexity is not EdgeConvexity.CONVEX for edge, other in brep.neighbours(face) if other in own)
    )


def is_floor(brep: Brep, face_id: int, axis: Axis, radius: float) -> bool:
    """Does the face close this hole, rather than being a larger face that the hole only ends at?"""
    return axis.reach(brep.faces[face_id].box) <= 1.8 * radius


def flats_of(brep: Brep, stack: Stack) -> tuple[int, ...]:
    """Which flats does a D-shaped bore have? Planes along the axis whose long edges both lie in its wall."""
    own = stack.faces
    found = []
    for face_id in sorted({other for face in own for _, other in brep.neighbours(face)} - own):
        face = brep.faces[face_id]
        if face.kind is not SurfaceKind.PLANE or abs(dot(face.axis, stack.axis.direction)) > 1e-2:
            continue
        along = [
            (edge, other)
            for edge, other in brep.neighbours(face_id)
            if edge.kind is EdgeKind.LINE
            and parallel(edge.direction, stack.axis.direction, 1e-2)
            and edge.convexity is EdgeConvexity.CONCAVE
        ]
        if len(along) == 2 and all(other in own for _, other in along):
            found.append(face_id)
    return tuple(found)


def core_of(
    brep: Brep, floor: Sequence[int], axis: Axis, end: float, depth: float
) -> tuple[float, frozenset[int]] | None:
    """Which radius and walls has the coaxial boss that rises from the floor? None when there is none."""
    walls: dict[int, float] = {}
    for face_id in floor:
        feet = [f for f in roundings_beside(brep, face_id) if is_waist(brep.faces[f])]
        foot = {other for f in feet for other in brep.beside(f, EdgeConvexity.SMOOTH)}
        for other in foot.union(brep.beside(face_id, EdgeConvexity.CONCAVE)):
            face = brep.faces[other]
            if face.kind is SurfaceKind.PLANE or face.outward <= 0:
                continue
            if not parallel(face.axis, axis.direction, 1e-2) or axis.radius_of(face.origin) > 1e-2 * face.radius:
                continue
            reach = [abs(axis.position(brep.edges[e].mid) - end) for e in brep.face_edges[other]]
            if reaches(max(reach), CORE_RATIO * depth):
                walls[other] = face.radius
                walls |= dict.fromkeys((f for f in feet if other in brep.beside(f, EdgeConvexity.SMOOTH)), face.radius)
    return (max(walls.values()), frozenset(walls)) if walls else None
