"""Edge treatments: fillets and rounds of one radius, and chamfers of one width."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import is_blend
from querycad_segworker.features.shared.part_measures import faces_box
from querycad_segworker.features.shared.reach import faces_span
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.regular import end_of_corner_chamfer
from querycad_segworker.features.shared.shaft_steps import ALIKE
from querycad_segworker.tolerances import Tolerances, reaches
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord, spread
from querycad_segworker.vectors import (
    ORIGIN,
    Box,
    box_center,
    cross,
    dist,
    dot,
    line_distance,
    parallel,
    span,
    sub,
    unit,
)

from .rolling_balls import RolledFace, rolled_face

CHAMFER_ANGLES_RAD = (math.radians(20.0), math.radians(70.0))
"""A chamfer turns by this much against each neighbour: 45 degrees as a rule, 30 and 60 on lead-ins."""
BROKEN_EDGE_RAD = (math.radians(60.0), math.radians(120.0))
"""A chamfer breaks an edge at about a right angle; the roof of a prism and the flanks of a wedge do not."""
CHAMFER_NEIGHBOURS = 1.5
"""Both faces that a chamfer joins reach further than its width by this factor; the sides of a polygon do not."""
CORNER_SHARE = 0.5
"""What takes more than two thirds of a face away, along its edge, shapes the body rather than breaking its edge. At 45
degrees a strip takes its leg away; one that leans more to one side is counted by its width."""
MAX_SECTION = 0.26
"""A right-angled triangle has at most a quarter of its hypotenuse's square as area."""
SAME_TURN_RAD = math.radians(3.0)
"""Corners of a polygon agree in their angle by more than this."""
CHAMFER_CONE = 1.5
"""A cone this much wider at one end than at the other is a cone, tip or countersink; edges of shafts and bores are
broken by 10 to 30 %."""


@dataclass(frozen=True, slots=True)
class Blend:
    """A chain of blend faces. Metres. `radius` is 0 for a chamfer, whose `width` is measured across its face."""

    kind: str
    """'fillet' in a concave corner, 'round' on a convex edge, 'chamfer'."""
    radius: float
    width: float
    center: Vector
    box: Box
    faces: tuple[int, ...]
    angle: float | None = None
    """Radians, of a chamfer: to the larger of the two faces that it joins; 45 degrees as a rule."""
    radii: tuple[float, ...] = ()
    """The smallest and the largest, where the radius changes along the edge; `radius` is their middle then."""


def recognise_blends(brep: Brep, taken: Collection[int], tolerances: Tolerances) -> list[Blend]:
    """Which fillets, rounds and chamfers does the model have? Neighbouring ones of one size are one; lowest id first.

    So are the pieces of a cone that breaks the corners of a prism at one end.

    `taken`: faces of holes and bosses, whose own chamfers belong to them; rounded rims and feet are parts as well.
    """
    kinds: dict[int, tuple[str, float]] = {}
    balls: dict[int, RolledFace] = {}
    strips: dict[int, _Strip] = {}
    corners: dict[int, int] = {}
    for face in brep.faces:
        if face.id in taken and not _is_rim(brep, face):
            continue
        if is_blend(brep, face):
            radius = face.minor_radius if face.kind is SurfaceKind.TORUS else face.radius
            kinds[face.id] = ("fillet" if face.outward < 0 else "round", radius)
        elif (end := end_of_corner_chamfer(brep, face)) is not None:
            corners[face.id] = end
        elif (rolled := rolled_face(brep, face)) is not None:
            kinds[face.id] = (rolled.kind, sum(rolled.radii) / 2)
            balls[face.id] = rolled
        elif (strip := _chamfer(brep, face)) is not None:
            strips[face.id] = strip
    kinds |= {face: ("chamfer", strip.width) for face, strip in _breaking_edges(strips).items()}
    found, seen = _corner_chamfers(brep, corners), set[int]()
    for start in sorted(kinds):
        if start in seen:
            continue
        kind, size = kinds[start]
        chain = _chain(brep, start, kinds, tolerances)
        seen |= chain
        radii = [r for i in chain if i in balls and balls[i].is_variable for r in balls[i].radii]
        blend = _blend(brep, kind, size, chain)
        found.append(replace(blend, radii=(min(radii), max(radii))) if radii else blend)
    return sorted(found, key=lambda blend: blend.faces)


def _corner_chamfers(brep: Brep, ends: Mapping[int, int]) -> list[Blend]:
    """The cones that break the corners of prisms, all pieces at one end face together. `ends`: that of each piece."""
    found = []
    for end in sorted(set(ends.values())):
        pieces = {piece for piece, own in ends.items() if own == end}
        cone = brep.faces[min(pieces)]
        low, high = faces_span(brep, pieces, cone.axis)
        blend = _blend(brep, "chamfer", (high - low) / math.cos(cone.half_angle), pieces)
        found.append(replace(blend, angle=math.pi / 2 - cone.half_angle))
    return found


def _is_rim(brep: Brep, face: FaceRecord) -> bool:
    """Does a rounding go all around an axis, between two circles about it?"""
    if face.kind is not SurfaceKind.TORUS or not is_blend(brep, face):
        return False
    centers = [edge.center if edge.closed else None for edge, other in brep.neighbours(face.id) if other != face.id]
    near = 0.01 * face.minor_radius
    return all(center is not None and line_distance(center, face.origin, face.axis) < near for center in centers)


def _chain(brep: Brep, start: int, kinds: Mapping[int, tuple[str, float]], tolerances: Tolerances) -> set[int]:
    """The faces of the first one's kind and size that hang together with it."""
    kind, size = kinds[start]
    near = max(0.01 * size, 3 * tolerances.length)

    def onwards(face: int) -> Iterator[int]:
        for _, other in brep.neighbours(face):
            if other in kinds and kinds[other][0] == kind and abs(kinds[other][1] - size) <= near:
                yield other

    return spread((start,), onwards)


def _blend(brep: Brep, kind: str, size: float, chain: set[int]) -> Blend:
    box = faces_box(brep, chain)
    return Blend(
        kind=kind,
        radius=0.0 if kind == "chamfer" else size,
        width=size,
        center=box_center(box),
        box=box,
        faces=tuple(sorted(chain)),
        angle=_angle(brep, min(chain)) if kind == "chamfer" else None,
    )


@dataclass(frozen=True, slots=True)
class _Side:
    """What a chamfer meets along one of its long edges: the face there, its reach from that edge, the turn into it."""

    face: FaceRecord
    reach: float
    turn: float


def _angle(brep: Brep, face: int) -> float:
    """The turn from a chamfer into the largest face beside it."""
    low, high = CHAMFER_ANGLES_RAD
    sides = [(brep.faces[other].area, edge.angle) for edge, other in brep.neighbours(face) if low <= edge.angle <= high]
    return max(sides, default=(0.0, 0.0))[1]


@dataclass(frozen=True, slots=True)
class _Strip:
    """A chamfer: its width, metres, and the two faces whose edge it breaks."""

    width: float
    beside: set[int]
    is_corner: bool
    """It takes away so much of them that it is a corner cut off, as of a plate."""


def _breaking_edges(strips: Mapping[int, _Strip]) -> dict[int, _Strip]:
    """Those whose own edges no others break: no face between two of them, nor a cut corner beside a narrower one."""
    kept = {face: strip for face, strip in strips.items() if not strips.keys() >= strip.beside}
    narrow = {face for face, strip in kept.items() if not strip.is_corner}
    found = {face: strip for face, strip in kept.items() if not strip.is_corner or narrow.isdisjoint(strip.beside)}
    for face in strips.keys() - found.keys():
        refuse("chamfer", (face,), "its own edges are broken by chamfers")
    return found


def _chamfer(brep: Brep, face: FaceRecord) -> _Strip | None:
    """The plane or conical strip that breaks an edge, or None when the face is no chamfer.

    It turns by 20 to 70 degrees into each of two faces, and those would meet at about a right angle without it. They
    reach further than the strip is wide, as on the cut corner of a plate too. Beside a strip that is longer than it
    takes away of either, and carries nothing, half as far as that is enough, unless all are sides of one polygon.
    """
    if face.kind is SurfaceKind.PLANE:
        edges = [brep.edges[e] for e in face.loops[0].edges] if face.loops else []
    elif face.kind is SurfaceKind.CONE and face.outward > 0 and len(face.loops) <= 2:
        edges = [brep.edges[e] for e in brep.face_edges[face.id]]
    else:
        return None
    sides = _slanted_sides(face, edges)
    pair = _long_sides(brep, face, sides)
    if pair is None:
        return None
    (first, second), length = pair, (_length(pair[0]) + _length(pair[1])) / 2
    width = _across(brep, face, sides)
    if width is None:
        width = face.area / length if length > 0 else math.inf
    a, b = (_side(brep, face, edges_along) for edges_along in (first, second))
    if _length(second) < 0.5 * _length(first) or a.face.id == b.face.id:
        return None
    reason = _shapes_body(brep, face, (first, second), (a, b), width, length)
    if reason is None:
        is_corner = face.kind is SurfaceKind.PLANE and not reaches(min(a.reach, b.reach), CHAMFER_NEIGHBOURS * width)
        return _Strip(width, {a.face.id, b.face.id}, is_corner)
    refuse("chamfer", (face.id,), reason)
    return None


def _shapes_body(
    brep: Brep,
    face: FaceRecord,
    edges: tuple[list[EdgeRecord], list[EdgeRecord]],
    sides: tuple[_Side, _Side],
    width: float,
    length: float,
) -> str | None:
    """Why does a slanted strip between two faces shape the body rather than break its edge? None where it breaks it."""
    (first, second), (a, b) = edges, sides
    if face.kind is SurfaceKind.CONE:
        slim = reaches(min(a.face.area, b.face.area), CHAMFER_NEIGHBOURS * face.area)
        narrow = face.radius <= CHAMFER_CONE * face.minor_radius
        return None if slim and narrow else "a cone as large as what is beside it shapes the body"
    low, high = BROKEN_EDGE_RAD
    if not (low <= a.turn + b.turn <= high and _runs_alike(first[0], second[0])):
        return "the two faces beside it would not meet at about a right angle"
    if _has_end_wall(brep, face, width):
        return "it ends at a wall that belongs to the cut: a step"
    if reaches(min(a.reach, b.reach), CHAMFER_NEIGHBOURS * width):
        return None
    even = abs(a.turn - b.turn) < SAME_TURN_RAD  # at 45 degrees, where drawings give the leg: C15
    takes = width * math.cos(a.turn) if even else width
    whole_corner = reaches(length, takes) and reaches(min(a.reach, b.reach), CORNER_SHARE * takes)
    if whole_corner and not _carries(brep, face) and not _is_polygon(brep, face, first, second, width):
        return None
    return "it takes so much of the faces beside it that it shapes the body"


def _across(brep: Brep, face: FaceRecord, sides: Sequence[Sequence[EdgeRecord]]) -> float | None:
    """How far is it from long edge to long edge of a strip, whatever pierces it? None unless straight or round.

    Infinite where the face goes on beyond the edges: they bound no strip, but a slot in the face.
    """
    a, b = sides[0][0], sides[1][0]
    if a.kind is EdgeKind.LINE is b.kind:
        across = unit(cross(face.axis, a.direction))
        low, high = span((edge.mid for side in sides for edge in side if _runs_alike(edge, a)), across)
        first, last = faces_span(brep, (face.id,), across)
        return high - low if last - first <= ALIKE * (high - low) else math.inf
    if a.kind is EdgeKind.CIRCLE is b.kind and a.center is not None and b.center is not None:
        return math.hypot(dist(a.center, b.center), (a.radius or 0.0) - (b.radius or 0.0))
    return None


def _carries(brep: Brep, face: FaceRecord) -> bool:
    """Does something stand on it?"""
    inner = {e for loop in face.loops if not loop.outer for e in loop.edges}
    return any(brep.edges[e].convexity is EdgeConvexity.CONCAVE for e in inner)


def _slanted_sides(face: FaceRecord, edges: Sequence[EdgeRecord]) -> list[list[EdgeRecord]]:
    """The edges along which a face turns like a chamfer, by the face on their other side; longest first."""
    low, high = CHAMFER_ANGLES_RAD
    by_face: dict[int, list[EdgeRecord]] = defaultdict(list)
    for edge in edges:
        if edge.convexity is EdgeConvexity.CONVEX and low <= edge.angle <= high:
            by_face[next(i for i in edge.faces if i != face.id)].append(edge)
    return sorted(by_face.values(), key=_length, reverse=True)


def _long_sides(
    brep: Brep, face: FaceRecord, sides: Sequence[list[EdgeRecord]]
) -> tuple[list[EdgeRecord], list[EdgeRecord]] | None:
    """The longest side and the longest one across from it: there a plane strip turns the other way."""

    def turn(side: Sequence[EdgeRecord]) -> Vector:
        beyond = brep.faces[next(i for i in side[0].faces if i != face.id)]
        flat = beyond.kind is SurfaceKind.PLANE is face.kind
        return cross(face.axis, beyond.axis) if flat else ORIGIN

    return next(((sides[0], side) for side in sides[1:] if dot(turn(sides[0]), turn(side)) <= 0), None)


def _length(edges: Sequence[EdgeRecord]) -> float:
    return sum(edge.length for edge in edges)


def _side(brep: Brep, face: FaceRecord, edges: Sequence[EdgeRecord]) -> _Side:
    other = brep.faces[next(i for i in edges[0].faces if i != face.id)]
    along = edges[0].direction
    across = cross(other.axis, along)
    reaches = [abs(dot(sub(p, edges[0].mid), across)) for e in brep.face_edges[other.id] for p in brep.edges[e].points]
    return _Side(other, max(reaches, default=0.0), edges[0].angle)


def _has_end_wall(brep: Brep, face: FaceRecord, width: float) -> bool:
    """Does it end at a wall that is no larger than the section cut off, hence part of the cut? Then it is a step."""
    return any(
        edge.convexity is EdgeConvexity.CONCAVE and brep.faces[other].area <= MAX_SECTION * width * width
        for edge, other in brep.neighbours(face.id)
    )


def _runs_alike(a: EdgeRecord, b: EdgeRecord) -> bool:
    """Are both straight and parallel?"""
    straight = a.kind is EdgeKind.LINE and b.kind is EdgeKind.LINE
    return straight and parallel(a.direction, b.direction, math.radians(2.0))


def _is_polygon(
    brep: Brep, face: FaceRecord, first: Sequence[EdgeRecord], second: Sequence[EdgeRecord], width: float
) -> bool:
    """Does the outline go on turning by the same angle, behind sides that are hardly wider than this one?"""
    along = first[0].direction
    for edges in (first, second):
        side = _side(brep, face, edges)
        next_turns = [
            edge.angle
            for edge, other in brep.neighbours(side.face.id)
            if other != face.id
            and edge.kind is EdgeKind.LINE
            and edge.convexity is EdgeConvexity.CONVEX
            and parallel(edge.direction, along, math.radians(2.0))
        ]
        long = reaches(side.reach, CHAMFER_NEIGHBOURS * width)
        if long or not any(abs(turn - side.turn) < SAME_TURN_RAD for turn in next_turns):
            return False
    return True
