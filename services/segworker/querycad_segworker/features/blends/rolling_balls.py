"""Freeform fillets and rounds: faces that a ball leaves which rolls along two others, also while it grows."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeRecord, FaceRecord
from querycad_segworker.vectors import add, cross, dist, dot, foot, norm, scale, sub, unit

SAME_WAY = 0.99
"""Cosine between the chord over a blend and the difference of the normals at its ends: 8 degrees. Of a rolling ball
both run alike, as its centre lies at one radius along either normal."""
MIN_TURN = 0.17
"""Sine of half the angle between the normals: below 20 degrees a face is the body's own curve, no rounded edge."""
CONSTANT = 0.03
"""Radii that differ by less than this share are those of one ball: converted files are off by up to 1 %."""
NARROW = 1.0
"""A blend is narrower than it is long."""


@dataclass(frozen=True, slots=True)
class RolledFace:
    """What a ball left along an edge. Metres. `kind`: 'fillet' in a corner, 'round' on an edge."""

    kind: str
    radii: tuple[float, float]
    """The smallest and the largest."""

    @property
    def is_variable(self) -> bool:
        """Does the radius change along the edge?"""
        low, high = self.radii
        return high - low > CONSTANT * high


def rolled_face(brep: Brep, face: FaceRecord) -> RolledFace | None:
    """Did a ball leave this freeform face, rolling along two faces that it is tangent to?

    The two are planes, cylinders, cones, spheres or tori. Where the ball touches them at p and q, with normals n and m,
    its centre is p - r n = q - r m for a round: p - q is r (n - m), with the other sign for a fillet.
    """
    if face.kind is not SurfaceKind.FREEFORM:
        return None
    sides = _tangent_sides(brep, face)
    best: RolledFace | None = None
    for (a, first), (b, second) in itertools.combinations(sides, 2):
        if a.id == b.id:
            continue
        radii: list[float] = []
        for p, q in _across(first, second):
            n, m = normal_at(a, p), normal_at(b, q)
            if n is None or m is None:
                continue
            chord, turn = sub(p, q), sub(n, m)
            if norm(turn) < 2 * MIN_TURN or norm(chord) <= 0:
                continue
            along = dot(unit(chord), unit(turn))
            if abs(along) >= SAME_WAY:
                radii.append(norm(chord) / norm(turn) * (1.0 if along > 0 else -1.0))
        same_sign = radii and (min(radii) > 0 or max(radii) < 0)
        if not same_sign or norm(sub(first.mid, second.mid)) > NARROW * max(first.length, second.length):
            continue
        sizes = sorted(abs(r) for r in radii)
        best = RolledFace("round" if radii[0] > 0 else "fillet", (sizes[0], sizes[-1]))
    if best is None and len(sides) > 1:
        refuse("fillet", (face.id,), "a freeform face tangent to two others, but not as a rolling ball leaves it")
    return best


def _tangent_sides(brep: Brep, face: FaceRecord) -> list[tuple[FaceRecord, EdgeRecord]]:
    """The faces that a face runs into tangentially, each with the longest edge between; longest edges first."""
    longest: dict[int, EdgeRecord] = {}
    for edge, other in brep.neighbours(face.id):
        known = longest.get(other)
        if edge.convexity is EdgeConvexity.SMOOTH and (known is None or known.length < edge.length):
            longest[other] = edge
    sides = [(brep.faces[other], edge) for other, edge in longest.items()]
    return sorted(sides, key=lambda side: (-side[1].length, side[0].id))


def _across(a: EdgeRecord, b: EdgeRecord) -> list[tuple[Vector, Vector]]:
    """Points on both edges that face each other: their ends and middles."""
    straight = dist(a.start, b.start) + dist(a.end, b.end) <= dist(a.start, b.end) + dist(a.end, b.start)
    ends: Sequence[Vector] = (b.start, b.end) if straight else (b.end, b.start)
    return [(a.start, ends[0]), (a.mid, b.mid), (a.end, ends[1])]


def normal_at(face: FaceRecord, point: Vector) -> Vector | None:
    """Which way does the face look at one of its points? Outward unit normal; None for freeform faces."""
    match face.kind:
        case SurfaceKind.PLANE:
            return face.axis
        case SurfaceKind.SPHERE:
            return scale(unit(sub(point, face.origin)), float(face.outward))
        case SurfaceKind.CYLINDER:
            return scale(unit(sub(point, foot(point, face.origin, face.axis))), float(face.outward))
        case SurfaceKind.CONE:
            slant = unit(sub(point, face.origin))  # the origin is the apex
            across = cross(cross(slant, face.axis), slant)
            return scale(unit(across), -float(face.outward))
        case SurfaceKind.TORUS:
            arm = unit(sub(point, foot(point, face.origin, face.axis)))
            return scale(unit(sub(point, add(face.origin, scale(arm, face.radius)))), float(face.outward))
        case _:
            return None
