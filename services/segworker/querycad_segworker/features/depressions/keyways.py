"""What is a depression cut into? Keyways in shafts and hubs, radial and axial slots."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import replace

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.adjacency import same_cylinder
from querycad_segworker.tolerances import reaches
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import cross, dist, dot, foot, line_distance, norm, parallel, sub

from .depression import ELONGATED, Depression, DepressionKind

KEY_SHARE = 0.6
"""A keyway is narrower than this share of its shaft's diameter: keys take about a quarter of it (DIN 6885), a third in
thin shafts. What is wider is a flat or the gap of a fork."""
HOST_SHARE = 0.4
"""The face that holds at least this share of a depression's rim is what it is cut into."""
FULL_RAD = math.radians(350)
"""A cylinder that covers more than this is whole; files cut it open along a seam."""
SAME_LINE = 0.1
"""A radial slot points at the axis to within this share of its width."""
SQUARE = 0.02
"""Sine of the angle by which its opening may lean towards the axis of the wall."""
CROWN_SHARE = 0.4
"""A crown is that much of the depth, at most, away from the edges: more is a flat."""
RING = 3
"""So many slots that point at one round face in a body of another outline are radial; two may do so by chance."""


def with_hosts(brep: Brep, found: list[Depression]) -> list[Depression]:
    """The same depressions, with tags for how they lie in what they are cut into.

    'keyway': a slot or long pocket with plane walls along the axis of the shaft or bore that it is cut into. 'axial':
    along the axis of its round body, or the round part of it that it opens to. 'radial': towards that axis, or that of
    the widest round face of a body with another outline where several do so, and not beyond it. What is cut into a
    round wall is as deep as it lies below the crown of that wall.
    """
    axes = {body.id: _round_axis(brep, body.faces) for body in brep.bodies}
    rings = _rings(found, {body.id: _widest(brep, body.faces) for body in brep.bodies if axes[body.id] is None})
    return [
        replace(
            d,
            tags=(*d.tags, *_place(brep, d, axes.get(d.body) or _rim(brep, d), d in rings)),
            depth=_depth_below_crown(brep, d),
        )
        for d in found
    ]


def _depth_below_crown(brep: Brep, found: Depression) -> float:
    """How deep does it lie below the round wall that it is cut into, in metres? Keyways are dimensioned so (DIN 6885).

    Where it runs out of the wall at both ends, only its two long edges are left, which lie below the crown of a shaft
    and beyond that of a bore.
    """
    if found.kind is DepressionKind.PASSAGE:
        return found.depth
    host = _host(brep, found)
    if host is None or host.kind is not SurfaceKind.CYLINDER:
        host = _rim(brep, found)  # of a notch in a disc most of the rim is on the disc's faces
    if host is None or found.width > KEY_SHARE * 2 * host.radius:
        return found.depth
    if abs(dot(found.normal, host.axis)) > SQUARE:
        return found.depth
    middle = dot(sub(found.center, foot(found.center, host.origin, host.axis)), found.normal)
    bottom = middle - found.depth / 2
    depth = host.radius - bottom if host.outward > 0 else -host.radius - bottom
    return depth if abs(depth - found.depth) < CROWN_SHARE * found.depth else found.depth


def _rings(found: list[Depression], axes: dict[int, FaceRecord | None]) -> list[Depression]:
    """Those that point at the axis of their body, as at least two others there do."""
    pointing = [d for d in found if (axis := axes.get(d.body)) is not None and _may_point(d) and _points_at(d, axis)]
    return [d for d in pointing if sum(other.body == d.body for other in pointing) >= RING]


def _place(brep: Brep, found: Depression, axis: FaceRecord | None, in_ring: bool) -> tuple[str, ...]:
    if not _may_point(found):
        return ()
    tags = []
    if found.kind is not DepressionKind.PASSAGE and brep.of_kind(SurfaceKind.PLANE, found.faces):
        host = _host(brep, found)
        if host is not None and host.kind is SurfaceKind.CYLINDER and parallel(host.axis, found.direction, 1e-2):
            if found.width <= KEY_SHARE * 2 * host.radius:
                tags.append("keyway")
    if axis is not None and parallel(found.direction, axis.axis, 1e-2):
        if line_distance(found.center, axis.origin, axis.axis) > found.width:
            tags.append("axial")
    elif in_ring or (axis is not None and _points_at(found, axis)):
        tags.append("radial")
    return tuple(tags)


def _may_point(found: Depression) -> bool:
    """Has it a direction of its own: a slot, a channel, what is long?"""
    if found.kind in (DepressionKind.POCKET, DepressionKind.PASSAGE):
        return reaches(found.length, ELONGATED * found.width)
    return found.kind in (DepressionKind.SLOT, DepressionKind.CHANNEL)


def _points_at(found: Depression, axis: FaceRecord) -> bool:
    """Does a depression run square to the axis, towards it, and not across it?"""
    on_axis = foot(found.center, axis.origin, axis.axis)
    if abs(dot(found.direction, axis.axis)) >= 1e-2 or dist(found.center, on_axis) <= 0.45 * found.length:
        return False
    return norm(cross(sub(found.center, on_axis), found.direction)) < SAME_LINE * found.width


def _host(brep: Brep, found: Depression) -> FaceRecord | None:
    """The face that most of the depression's convex rim borders on; pieces of one cylinder count together."""
    own = set(found.faces)
    rim: dict[int, float] = defaultdict(float)
    for face in found.faces:
        for edge, other in brep.neighbours(face):
            if other not in own and edge.convexity is EdgeConvexity.CONVEX:
                rim[other] += edge.length
    if not rim:
        return None
    best = brep.faces[max(rim, key=lambda face: rim[face])]
    shared = sum(length for i, length in rim.items() if i == best.id or same_cylinder(brep.faces[i], best))
    return best if shared >= HOST_SHARE * sum(rim.values()) else None


def _rim(brep: Brep, found: Depression) -> FaceRecord | None:
    """The widest outer cylinder that a depression opens to: the outside of a tube that is part of a larger body."""
    beside = (brep.faces[other] for face in found.faces for other in brep.beside(face, EdgeConvexity.CONVEX))
    outer = [face for face in beside if face.kind is SurfaceKind.CYLINDER and face.outward > 0]
    return max(outer, key=lambda face: face.radius, default=None)


def _widest(brep: Brep, faces: tuple[int, ...]) -> FaceRecord | None:
    """The widest full cylinder, inner or outer."""
    cylinders = brep.of_kind(SurfaceKind.CYLINDER, faces)
    full = (face for face in cylinders if face.sweep > FULL_RAD)
    return max(full, key=lambda face: face.radius, default=None)


def _round_axis(brep: Brep, faces: tuple[int, ...]) -> FaceRecord | None:
    """The widest outer cylinder on the axis of the largest one, of a body that is mostly round about it."""
    outer = [face for face in brep.of_kind(SurfaceKind.CYLINDER, faces) if face.outward > 0]
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
