"""How does a part stand to the place that a description names: in it, on it, beside it?"""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Part
from querycad_segworker.vectors import cross, line_distance, norm

from .nearby import Nearby

TOUCH_M = 1e-6
"""Boxes nearer than this meet: above kernel noise, far below drawing accuracy."""
MADE_OF = ("pattern", "gear")
"""Kinds that are nothing but their members: teeth that mesh lie in each other's boxes."""
STANDING_OUT = frozenset(("boss", "protrusion", "elevation", "prism", "rib", "body"))


def carries(place: Part, part: Part) -> bool:
    """Does the part open on or stand on the faces of the place, or is it made of some of them?"""
    return part.id in place.children or set(part.faces) < set(place.faces)


def is_inside(part: Part, place: Part) -> bool:
    """Does the place carry the part, or does the middle of the part or of its opening lie in the place's box?

    In a pattern of such parts, and in a gear of teeth, is what belongs to it.
    """
    if place.kind in MADE_OF and any(child.startswith(f"{part.kind}-") for child in place.children):
        return part.id in place.children
    points = [part.center] if part.opening is None else [part.center, part.opening]
    return (
        part.id in place.children
        or set(part.faces) < set(place.faces)
        or any(
            all(
                abs(c - middle) <= extent / 2 + TOUCH_M
                for c, middle, extent in zip(point, place.center, place.extents, strict=True)
            )
            for point in points
        )
    )


def next_to(found: Sequence[Part], holders: Sequence[Part], nearby: Nearby) -> list[Part]:
    """Those whose boxes meet that of a holder."""
    return [p for p, near in nearby.pairs(found, holders) if any(h.id != p.id and touches(p, h) for h in near)]


def held(found: Sequence[Part], relation: str, holders: Sequence[Part], nearby: Nearby) -> list[Part]:
    """Those that a holder carries; else those in its box; of what stands out, those that touch it."""
    pairs = nearby.pairs(found, holders)
    on = relation == "on"
    if carried := [p for p, near in pairs if any(carries(h, p) and not (on and _is_of(p, h)) for h in near)]:
        return carried
    if on:
        standing = [(p, near) for p, near in pairs if p.kind in STANDING_OUT or p.kind == "cylinder"]
        if upon := [p for p, near in standing if any(touches(p, h) and not is_inside(p, h) for h in near)]:
            return upon
    ids = {h.id for h in holders}
    own = {p.id for p in found if p.kind == "pattern" and not ids.isdisjoint(p.children)}
    inside = [p for p, near in pairs if p.id in own or any(is_inside(p, h) for h in near)]
    return inside if inside or not all(p.kind in STANDING_OUT for p in found) else next_to(found, holders, nearby)


def _is_of(part: Part, place: Part) -> bool:
    """Is what stands out made of the place itself, so that it is not on it: the outer cylinder of a disc?"""
    raised = part.kind in STANDING_OUT or part.kind == "cylinder"
    return raised and place.kind in STANDING_OUT - {"body"} and set(part.faces) <= set(place.faces)


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
