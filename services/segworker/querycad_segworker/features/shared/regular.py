"""Regular outlines: how wide is a hexagon, octagon or square across its flats and across its corners?"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import same_cylinder
from querycad_segworker.features.shared.reach import faces_span
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, FaceRecord
from querycad_segworker.vectors import across, add, dot, parallel, scale, sub

BROKEN = 0.4
"""A plane at a corner narrower than this share of the sides breaks it and gives the outline no name."""
LEVEL_M = 1e-6
"""Pieces of one side lie in one plane but for this."""
EVEN = 0.01
"""Sides of a regular outline are at equal distances but for this share."""
TURN_RAD = math.radians(1.0)
"""And at equal angles, but for so much."""
CUT_IN = 0.995
"""Planes farther out than this share of the radius are tangent to a shaft and no flats on it."""
UPRIGHT = 0.02
"""Sine of the angle by which a side may lean."""
CORNER_CHAMFER_RAD = (math.radians(10.0), math.radians(45.5))
"""To the end face: corners of nuts and heads are chamfered by 15 to 30 degrees (ISO 4032, ISO 4014), by hand by 45."""


def end_of_corner_chamfer(brep: Brep, face: FaceRecord) -> int | None:
    """On which end face of a prism does this cone break the corners? None where it is no such cone.

    It lies between an end face, square to its axis, and sides along the axis that are all as far from it.
    """
    low, high = CORNER_CHAMFER_RAD
    if face.kind is not SurfaceKind.CONE or face.outward < 0 or not low <= math.pi / 2 - face.half_angle <= high:
        return None
    ends, offsets = set[int](), list[float]()
    for edge, other in brep.neighbours(face.id):
        beside = brep.faces[other]
        if edge.convexity in (EdgeConvexity.SEAM, EdgeConvexity.SMOOTH):
            continue
        if edge.convexity is not EdgeConvexity.CONVEX:
            return None
        if beside.kind is SurfaceKind.PLANE and parallel(beside.axis, face.axis, UPRIGHT):
            ends.add(other)
        elif beside.kind is SurfaceKind.PLANE and abs(dot(beside.axis, face.axis)) < UPRIGHT:
            offsets.append(dot(sub(beside.point, face.origin), beside.axis))
        elif not (beside.kind is SurfaceKind.CYLINDER and parallel(beside.axis, face.axis, UPRIGHT)):
            return None
    even = len(offsets) > 1 and max(offsets) - min(offsets) < EVEN * max(offsets)
    return ends.pop() if even and len(ends) == 1 else None


def across_flats_and_corners(brep: Brep, faces: Iterable[int], axis: Vector) -> tuple[float, float] | None:
    """How wide is the regular outline that the plane faces along `axis` make, in metres? (flats, corners)

    With an even number of sides, all at one distance from the middle and at equal angles; None for anything else.
    Across corners it is wider by 1 / cos(pi / sides), also where the corners are broken.
    """
    sides = _sides(brep, faces, axis)
    count = len(sides)
    if count < 4 or count % 2:
        return None
    half = count // 2
    step = 2 * math.pi / count
    angles = [side.angle for side in sides]
    if any(abs(b - a - step) > TURN_RAD for a, b in zip(angles, [*angles[1:], angles[0] + 2 * math.pi], strict=True)):
        return None
    widths = [abs(sides[i].level + sides[i + half].level) for i in range(half)]
    if max(widths) - min(widths) > EVEN * max(widths) or not _go_around(sides, half):
        return None
    flats = sum(widths) / half
    return flats, flats / math.cos(math.pi / count)


@dataclass(frozen=True, slots=True)
class _Side:
    """A plane along an axis, as seen along that: the angle of its normal, its distance from the origin, its ends."""

    angle: float
    level: float
    low: float
    high: float


def _go_around(sides: Sequence[_Side], half: int) -> bool:
    """Does each side lie before the middle? The flanks of the arms of a star lie beside it."""
    (x, cos_x, sin_x), (y, cos_y, sin_y) = (
        ((sides[i].level - sides[i + half].level) / 2, math.cos(sides[i].angle), math.sin(sides[i].angle))
        for i in (0, 1)
    )
    turn = cos_x * sin_y - sin_x * cos_y
    middle = ((x * sin_y - y * sin_x) / turn, (y * cos_x - x * cos_y) / turn)
    feet = (middle[1] * math.cos(side.angle) - middle[0] * math.sin(side.angle) for side in sides)
    return all(side.low <= foot <= side.high for side, foot in zip(sides, feet, strict=True))


def _sides(brep: Brep, faces: Iterable[int], axis: Vector) -> list[_Side]:
    """The outermost plane of each direction along the axis, by the angle of its normal.

    The inner faces of a square tube look the same ways as its outer ones. What is by far narrower than the widest side
    breaks a corner.
    """
    u, v = across(axis)
    found: list[_Side] = []
    for i in faces:
        face = brep.faces[i]
        if face.kind is not SurfaceKind.PLANE or abs(dot(face.axis, axis)) > UPRIGHT:
            continue
        x, y = dot(face.axis, u), dot(face.axis, v)
        along = add(scale(u, -y), scale(v, x))
        side = _Side(
            math.atan2(y, x),
            dot(face.point, face.axis),
            *faces_span(brep, (i,), along),
        )
        alike = (one for one in found if abs(math.remainder(side.angle - one.angle, 2 * math.pi)) < TURN_RAD)
        known = next(alike, None)
        if known is not None and known.level > side.level - LEVEL_M:
            level = known.level < side.level + LEVEL_M
            side = replace(known, low=min(known.low, side.low), high=max(known.high, side.high)) if level else known
        found = [side, *(one for one in found if one is not known)]
    widest = max((side.high - side.low for side in found), default=0.0)
    return sorted((s for s in found if s.high - s.low >= BROKEN * widest), key=lambda side: side.angle)


def flats_on_round(brep: Brep, walls: Iterable[int], axis: Vector) -> float | None:
    """How wide is a round step or bore across its flats, in metres? None without any.

    Flats are planes along the axis that meet the round wall in sharp edges: of two alike from one to the other, as a
    wrench takes hold of them; of a single one, which makes a D, to the round opposite. What is flat beside a round end
    of a lever, or where a shaft meets an eye, joins its wall in concave edges.
    """
    own = [i for i in walls if brep.faces[i].kind is SurfaceKind.CYLINDER]
    flats = {
        other
        for i in own
        for edge, other in brep.neighbours(i)
        if edge.kind is EdgeKind.LINE
        and edge.convexity is _sharp(brep.faces[i])
        and brep.faces[other].kind is SurfaceKind.PLANE
        and abs(dot(brep.faces[other].axis, axis)) <= UPRIGHT
    }
    if not flats:
        return None
    if len(flats) == 1:
        (flat,) = (brep.faces[i] for i in flats)
        depth = depth_of_flat(brep, flat)
        return None if depth is None else 2 * brep.faces[own[0]].radius - depth
    wall = brep.faces[own[0]]
    planes = [
        (brep.faces[i].axis, dot(sub(brep.faces[i].point, wall.origin), brep.faces[i].axis)) for i in sorted(flats)
    ]
    for i, (normal, level) in enumerate(planes):
        reach = wall.outward * level
        for other, opposed in planes[i + 1 :]:
            opposite = dot(normal, other) < 0 and parallel(normal, other, UPRIGHT)
            if opposite and 0 < reach < CUT_IN * wall.radius and abs(level - opposed) <= EVEN * reach:
                return reach + wall.outward * opposed
    return None


def _sharp(wall: FaceRecord) -> EdgeConvexity:
    """The edges of a flat on a shaft, or of one that stands into a bore."""
    return EdgeConvexity.CONVEX if wall.outward > 0 else EdgeConvexity.CONCAVE


def depth_of_flat(brep: Brep, face: FaceRecord) -> float | None:
    """How deep does a flat cut into a round shaft, or stand into a D-shaped bore, in metres? None where it is no flat.

    It is a plane along the axis that meets most of a cylinder in two sharp edges, between that and the axis: the end of
    a thread, square to its flanks, meets it in one.
    """
    met: list[FaceRecord] = []
    for edge, other in brep.neighbours(face.id):
        wall = brep.faces[other]
        round_wall = wall.kind is SurfaceKind.CYLINDER and edge.kind is EdgeKind.LINE
        beside = round_wall and edge.convexity is _sharp(wall)
        if not beside or abs(dot(face.axis, wall.axis)) > UPRIGHT:
            continue
        reach = wall.outward * dot(sub(face.point, wall.origin), face.axis)
        if not 0 < reach < CUT_IN * wall.radius:
            continue
        met.append(wall)
        if sum(same_cylinder(wall, piece) for piece in met) < 2:
            continue
        own = brep.of_kind(SurfaceKind.CYLINDER, brep.bodies[wall.body].faces)
        if sum(piece.sweep for piece in own if same_cylinder(wall, piece)) > math.pi:
            return wall.radius - reach
    return None


def is_d(brep: Brep, flat: FaceRecord, shoulder: FaceRecord) -> bool:
    """Is it the single flat that makes a round shaft a D, up to this shoulder square to the shaft?

    Two flats, across which a wrench takes hold, make no D.
    """
    beside = (
        brep.faces[other]
        for edge, other in brep.neighbours(flat.id)
        if edge.kind is EdgeKind.LINE and parallel(edge.direction, shoulder.axis, UPRIGHT)
    )
    round_ = all(f.kind is SurfaceKind.CYLINDER and parallel(f.axis, shoulder.axis, UPRIGHT) for f in beside)
    if not round_ or depth_of_flat(brep, flat) is None:
        return False
    others = brep.of_kind(SurfaceKind.PLANE, brep.bodies[flat.body].faces)
    opposed = (other for other in others if dot(other.axis, flat.axis) < 0 and parallel(other.axis, flat.axis, UPRIGHT))
    return all(depth_of_flat(brep, other) is None for other in opposed)
