"""Dimples: shallow hollows that a ball would leave, for detents and set screws."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord, spread
from querycad_segworker.vectors import add, dist, dot, norm, parallel, scale, sub, unit


@dataclass(frozen=True, slots=True)
class Dimple:
    """One dimple. Metres, frame of the file. `normal` points out of it, from `bottom` to `opening`."""

    ball_radius: float
    rim_radius: float
    depth: float
    opening: Vector
    bottom: Vector
    normal: Vector
    faces: tuple[int, ...]


def recognise_dimples(brep: Brep, taken: Collection[int]) -> list[Dimple]:
    """Which dimples does the model have? Sorted by lowest face id. `taken`: faces of holes, whose bottoms may be round.

    A dimple is a concave sphere whose whole rim is one circle that meets the face around it in a convex edge.
    """
    found: list[Dimple] = []
    seen = set(taken)
    for face in brep.faces:
        if face.kind is not SurfaceKind.SPHERE or face.outward >= 0 or face.id in seen:
            continue
        group = _same_ball(brep, face.id)
        seen |= group
        rim = [edge for f in group for edge, other in brep.neighbours(f) if other not in group]
        circles = [e for e in rim if e.center is not None and e.axis is not None and e.radius is not None]
        if not rim or len(circles) < len(rim) or any(e.convexity is not EdgeConvexity.CONVEX for e in rim):
            refuse("dimple", group, "its rim is not one convex circle")
            continue
        first = circles[0]
        assert first.center is not None
        assert first.axis is not None
        assert first.radius is not None
        apart = max(norm(sub(e.center or first.center, first.center)) for e in circles)
        if apart > 1e-3 * first.radius or not all(parallel(e.axis or first.axis, first.axis, 1e-3) for e in circles):
            refuse("dimple", group, "its rim is not one convex circle")
            continue
        # The middle of the faces lies deeper than the rim: that tells which way out is.
        out = first.axis if dot(sub(first.center, face.point), first.axis) > 0 else scale(first.axis, -1.0)
        out = unit(out)
        bottom = add(face.origin, scale(out, -face.radius))
        found.append(
            Dimple(
                ball_radius=face.radius,
                rim_radius=first.radius,
                depth=dot(sub(first.center, bottom), out),
                opening=first.center,
                bottom=bottom,
                normal=out,
                faces=tuple(sorted(group)),
            )
        )
    return found


def _same_ball(brep: Brep, start: int) -> set[int]:
    """The faces of one sphere that a CAD system split."""
    ball = brep.faces[start]

    def is_same(face: FaceRecord) -> bool:
        return face.kind is SurfaceKind.SPHERE and dist(face.origin, ball.origin) < 1e-3 * ball.radius

    def onwards(face: int) -> list[int]:
        return [other for other in brep.beside(face, EdgeConvexity.SMOOTH) if is_same(brep.faces[other])]

    return spread((start,), onwards)
