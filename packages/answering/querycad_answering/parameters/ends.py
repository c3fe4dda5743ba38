"""From which end is a part approached? The ends of its axis: a hole's openings, the free ends of what stands out."""

from __future__ import annotations

from dataclasses import dataclass

from querycad_contracts import Bottom, Part, Side, Vector
from querycad_contracts.vectors import add, dot, norm, scale, sub, unit

FACING = 0.7
"""Cosine of the angle between an end's way out and a side, at which the end still is on that side: 45 degrees."""
SAME_PLACE = 1e-6
"""Metres."""


@dataclass(frozen=True, slots=True)
class End:
    """Where a part's axis ends, and which way is out there."""

    point: Vector
    outward: Vector


@dataclass(frozen=True, slots=True)
class Ends:
    """The ends of a part that may be meant, the likeliest first; each is as likely where `told_apart` is False."""

    ends: tuple[End, ...]
    told_apart: bool = True


def ends_of(part: Part, side: Side | None, place: Vector | None) -> Ends:
    """At which end is the part come at? `side` chooses one, or `place` where it is one of them.

    A hole opens where recognition says; one that goes through opens twice, and only a counterbore or countersink says
    where it is entered. A part that is named by neither an end nor an axis, such as a block, is come at from `side`.
    """
    ends = _ends(part)
    if side is not None:
        facing = [end for end in ends if dot(end.outward, side.outward) > FACING]
        return Ends(tuple(facing) or _towards(part, side, ends))
    if place is not None:
        at = [end for end in ends if norm(sub(end.point, place)) < SAME_PLACE]
        if at:
            return Ends(tuple(at))
    entered = {"counterbored", "countersunk", "spotfaced"} & set(part.tags)
    return Ends(tuple(ends), told_apart=len(ends) < 2 or bool(entered))


def is_end(part: Part, place: Vector) -> bool:
    """Is the place one of the part's ends, whichever?"""
    return any(norm(sub(end.point, place)) < SAME_PLACE for end in _ends(part))


def _ends(part: Part) -> list[End]:
    out = part.normal or part.axis
    if part.opening is not None and out is not None:
        found = [End(part.opening, unit(out))]
        if part.bottom is Bottom.THROUGH and part.depth is not None:
            found.append(End(sub(part.opening, scale(unit(out), part.depth)), scale(unit(out), -1.0)))
        return found
    if part.tips:
        ways = [(tip, sub(tip, part.center)) for tip in part.tips]
        return [End(tip, unit(way)) for tip, way in ways if norm(way) > SAME_PLACE]
    if part.normal is not None:
        return [End(part.center, unit(part.normal))]
    return []


def _towards(part: Part, side: Side, ends: list[End]) -> tuple[End, ...]:
    """Where the part's box ends towards a side; nothing for a part whose own ends are on other sides."""
    if ends:
        return ()
    out = side.outward
    half = sum(abs(a * b) for a, b in zip(part.extents, out, strict=True)) / 2
    return (End(add(part.center, scale(out, half)), out),)
