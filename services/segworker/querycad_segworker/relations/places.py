"""How does a part stand to another one, its place: in it, carried by it, on its axis?"""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Part, PartKind
from querycad_segworker.vectors import cross, line_distance, norm

TOUCH_M = 1e-6
"""Boxes nearer than this meet: above kernel noise, far below drawing accuracy."""
RING_M = 0.1e-3
"""Parts of one ring differ by less than this in their distance from its axis: the last digit of drawings."""
LEAST_IN_RING = 3
"""Two parts stand beside a third, three around it."""


def carries(place: Part, part: Part) -> bool:
    """Does the part open on or stand on the faces of the place, or is it made of some of them?"""
    return part.id in place.children or set(part.faces) < set(place.faces)


def is_inside(part: Part, place: Part) -> bool:
    """Does the place carry the part, or does the middle of the part or of its opening lie in the place's box?

    In a pattern of such parts, and in a gear of teeth, is what belongs to it: boxes of teeth that mesh overlap. In a
    body is what has faces of it. Of what is round, it reaches into the wall, or lies on the axis.
    """
    if place.kind.is_group and any(child.startswith(f"{part.kind}-") for child in place.children):
        return part.id in place.children
    if place.kind is PartKind.BODY and part.kind is not PartKind.BODY and part.faces:
        return not set(part.faces).isdisjoint(place.faces)
    if carries(place, part):
        return True
    points = [part.center] if part.opening is None else [part.center, part.opening]
    boxed = any(
        all(
            abs(c - middle) <= extent / 2 + TOUCH_M
            for c, middle, extent in zip(point, place.center, place.extents, strict=True)
        )
        for point in points
    )
    return boxed and _within_radii(part, place)


def _within_radii(part: Part, place: Part) -> bool:
    """Does a part reach into the wall of what is round and stands out, or lie on its axis?"""
    if place.axis is None or not place.radii or not place.kind.stands_out:
        return True
    away, half = line_distance(part.center, place.center, place.axis), max(part.extents) / 2
    inner = min(place.radii) if len(place.radii) > 1 else 0.0
    return away < RING_M or (inner < away + half and away - half < max(place.radii))


def touches(part: Part, place: Part) -> bool:
    """Do the boxes of two parts meet?"""
    return all(
        abs(a - b) <= (e + f) / 2 + TOUCH_M
        for a, b, e, f in zip(part.center, place.center, part.extents, place.extents, strict=True)
    )


def coaxial(part: Part, other: Part) -> bool:
    """Do both lie on one axis, to a thousandth of the part?"""
    if part.axis is None or other.axis is None or norm(cross(part.axis, other.axis)) > 1e-3:
        return False
    return line_distance(other.center, part.center, part.axis) < 1e-3 * max(part.extents)


def encloses(part: Part, other: Part) -> bool:
    """Is it on the other's axis, and wider?"""
    return bool(part.radius and other.radius and part.radius > other.radius) and coaxial(part, other)


def surrounding(parts: Sequence[Part], place: Part) -> list[Part]:
    """Those that stand in a ring around the axis of the place: three and more, as far from it, their middle on it."""
    import numpy as np  # a tenth of a second, for the one word that asks for this

    if place.axis is None or not parts:
        return []
    arms = np.cross(np.array([part.center for part in parts]) - place.center, place.axis)  # (n, 3), off the axis
    away = np.linalg.norm(arms, axis=1)
    order = np.argsort(away, kind="stable")
    starts = np.flatnonzero(np.diff(away[order], prepend=-1.0) > RING_M)
    sizes = np.diff(starts, append=len(parts))
    middles = np.linalg.norm(np.add.reduceat(arms[order], starts) / sizes[:, None], axis=1)
    rings = (sizes >= LEAST_IN_RING) & (away[order][starts] > RING_M) & (middles < RING_M)
    found = set(order[np.repeat(rings, sizes)].tolist())
    return [part for i, part in enumerate(parts) if i in found] if found else []
