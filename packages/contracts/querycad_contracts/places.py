"""Is a part in another one, its place: for the words of a question and for programs alike."""

from __future__ import annotations

from .geometry import Part, PartKind
from .vectors import cross, norm, sub

TOUCH_M = 1e-6
"""Boxes nearer than this meet: above kernel noise, far below drawing accuracy."""
RING_M = 0.1e-3
"""Parts of one ring differ by less than this in their distance from its axis: the last digit of drawings."""


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
    away = norm(cross(sub(part.center, place.center), place.axis))
    half = max(part.extents) / 2
    inner = min(place.radii) if len(place.radii) > 1 else 0.0
    return away < RING_M or (inner < away + half and away - half < max(place.radii))
