"""What is a depression cut into? Keyways in shafts and hubs, radial and axial slots."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import replace

from querycad_contracts import SurfaceKind
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import cross, dist, dot, foot, line_distance, norm, parallel, sub

from .depression import ELONGATED, Depression, DepressionKind

KEY_SHARE = 0.6
"""A keyway is narrower than this share of its shaft's diameter: keys take about a quarter of it (DIN 6885), a third in
thin shafts. What is wider is a flat or the gap of a fork."""
HOST_SHARE = 0.4
"""The face that holds at least this share of a depression's rim is what it is cut into."""
SAME_LINE = 0.1
"""A radial slot points at the axis to within this share of its width."""


def with_hosts(brep: Brep, found: list[Depression]) -> list[Depression]:
    """The same depressions, with tags for how they lie in what they are cut into.

    'keyway': a slot or long pocket along the axis of the shaft or bore that it is cut into. 'axial': along the axis
    of its round body, or the round part of it that it opens to. 'radial': towards that axis, and not beyond it.
    """
    axes = {body.id: _round_axis(brep, body.faces) for body in brep.bodies}
    return [replace(d, tags=(*d.tags, *_place(brep, d, axes.get(d.body) or _rim(brep, d)))) for d in found]


def _place(brep: Brep, found: Depression, axis: FaceRecord | None) -> tuple[str, ...]:
    slot = found.kind in (DepressionKind.SLOT, DepressionKind.CHANNEL)
    if not slot and not (found.kind in (DepressionKind.POCKET, DepressionKind.PASSAGE) and _is_long(found)):
        return ()
    tags = []
    if found.kind is not DepressionKind.PASSAGE:
        host = _host(brep, found)
        if host is not None and host.kind is SurfaceKind.CYLINDER and parallel(host.axis, found.direction, 1e-2):
            if found.width <= KEY_SHARE * 2 * host.radius:
                tags.append("keyway")
    if axis is None:
        return tuple(tags)
    on_axis = foot(found.center, axis.origin, axis.axis)
    away = dist(found.center, on_axis)
    if parallel(found.direction, axis.axis, 1e-2) and away > found.width:
        tags.append("axial")
    elif abs(dot(found.direction, axis.axis)) < 1e-2 and away > 0.45 * found.length:
        offset = norm(cross(sub(found.center, on_axis), found.direction))
        if offset < SAME_LINE * found.width:
            tags.append("radial")
    return tuple(tags)


def _is_long(found: Depression) -> bool:
    return found.length >= ELONGATED * found.width


def _host(brep: Brep, found: Depression) -> FaceRecord | None:
    """The face that most of the depression's convex rim borders on."""
    own = set(found.faces)
    rim: dict[int, float] = defaultdict(float)
    for face in found.faces:
        for edge, other in brep.neighbours(face):
            if other not in own and edge.convexity is EdgeConvexity.CONVEX:
                rim[other] += edge.length
    if not rim:
        return None
    best = max(rim, key=lambda face: rim[face])
    return brep.faces[best] if rim[best] >= HOST_SHARE * sum(rim.values()) else None


def _rim(brep: Brep, found: Depression) -> FaceRecord | None:
    """The widest outer cylinder that a depression opens to: the outside of a tube that is part of a larger body."""
    outer = [
        brep.faces[other]
        for face in found.faces
        for edge, other in brep.neighbours(face)
        if edge.convexity is EdgeConvexity.CONVEX
        and brep.faces[other].kind is SurfaceKind.CYLINDER
        and brep.faces[other].outward > 0
    ]
    return max(outer, key=lambda face: face.radius, default=None)


def _round_axis(brep: Brep, faces: tuple[int, ...]) -> FaceRecord | None:
    """The widest outer cylinder on the axis of the largest one, of a body that is mostly round about it."""
    outer = [brep.faces[f] for f in faces if brep.faces[f].kind is SurfaceKind.CYLINDER and brep.faces[f].outward > 0]
    if not outer:
        return None
    largest = max(outer, key=lambda face: face.area)
    near = SAME_LINE * largest.radius
    coaxial = [
        face
        for face in outer
        if parallel(face.axis, largest.axis, 1e-2) and line_distance(face.origin, largest.origin, largest.axis) < near
    ]
    widest = max(coaxial, key=lambda face: face.radius)
    # In the plane across the axis no other face reaches beyond: the corners of the box do by the square root of two.
    reach = max(norm(cross(sub(brep.faces[f].point, widest.origin), widest.axis)) for f in faces)
    return widest if reach <= widest.radius * math.sqrt(1.1) else None
