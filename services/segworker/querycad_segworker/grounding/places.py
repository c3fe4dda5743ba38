"""How does a part stand to the place that a description names: in it, on it, beside it, between two of them?"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from querycad_contracts import Part
from querycad_segworker.vectors import cross, dot, line_distance, norm, sub

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


def next_to(found: Sequence[Part], holders: Sequence[Part]) -> list[Part]:
    """Those whose boxes meet that of a holder."""
    return [p for p in found if any(h.id != p.id and touches(p, h) for h in holders)]


def held(found: Sequence[Part], relation: str, holders: Sequence[Part]) -> list[Part]:
    """Those that a holder carries; else those in its box; of what stands out, those that touch it."""
    if carried := [p for p in found if any(carries(h, p) and not (relation == "on" and _is_of(p, h)) for h in holders)]:
        return carried
    if relation == "on":
        standing = [p for p in found if p.kind in STANDING_OUT or p.kind == "cylinder"]
        on = [p for p in standing if any(touches(p, h) and not is_inside(p, h) for h in holders)]
        if on:
            return on
    inside = [p for p in found if any(is_inside(p, h) or (p.kind == "pattern" and h.id in p.children) for h in holders)]
    return inside if inside or not all(p.kind in STANDING_OUT for p in found) else next_to(found, holders)


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


def lies_between(part: Part, others: Sequence[Part], whole: bool = False) -> bool:
    """Does the middle of the part lie between those of two others, no farther aside than they reach?

    The `whole` part: it is no longer that way than they are apart, as the wall between two windows, not their plate.
    """
    for a, b in itertools.combinations(others, 2):
        apart, ahead = sub(b.center, a.center), sub(part.center, a.center)
        length = norm(apart)
        reach = sum(e * abs(c) for e, c in zip(part.extents, apart, strict=True))
        if length < TOUCH_M or not 0.0 < dot(ahead, apart) < length**2 or (whole and reach > length**2):
            continue
        boxed = all(
            min(a.center[i] - a.extents[i] / 2, b.center[i] - b.extents[i] / 2) - TOUCH_M
            <= part.center[i]
            <= max(a.center[i] + a.extents[i] / 2, b.center[i] + b.extents[i] / 2) + TOUCH_M
            for i in range(3)
        )
        if boxed:
            return True
    return False


def coaxial(part: Part, other: Part) -> bool:
    """Do both lie on one axis, to a thousandth of the part?"""
    if part.axis is None or other.axis is None or norm(cross(part.axis, other.axis)) > 1e-3:
        return False
    return line_distance(other.center, part.center, part.axis) < 1e-3 * max(part.extents)


def encloses(part: Part, other: Part) -> bool:
    """Is it on the other's axis, and wider?"""
    return coaxial(part, other) and bool(part.radius and other.radius and part.radius > other.radius)
