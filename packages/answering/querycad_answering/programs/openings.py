"""The openings of a passage: bores that cross inside, as in a tee or a cross of pipe, open at each of their ends."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Part, PartKind, PartQuery
from querycad_contracts.vectors import cross, dot, norm, sub

from .builder import Builder

_MOUTHS = ("opening", "open end", "mouth")


def count_openings(build: Builder, target: PartQuery) -> str | None:
    """The program's number of all openings of bores that cross; None where other parts are asked for, or they do not.

    An opening seen from a side is that of one hole, and so is one in a wall.
    """
    if target.noun not in _MOUTHS or target.sides or not _is_passage(build.of(target)):
        return None
    return f"sum(len(p.openings) for p in {build.parts(target)})"


def _is_passage(parts: Sequence[Part]) -> bool:
    """Are they bores, each of which crosses another one, and none of which begins or ends in a through one's wall?"""
    bores = len(parts) > 1 and all(part.kind is PartKind.HOLE and part.axis and part.radius for part in parts)
    return bores and all(any(_crosses(part, other) for other in parts if other is not part) for part in parts)


def _crosses(bore: Part, other: Part) -> bool:
    """Do their axes meet inside both; inside of what ends in the other, at its end?"""
    if bore.axis is None or other.axis is None:
        return False
    square = cross(bore.axis, other.axis)
    between = sub(other.center, bore.center)
    near = min(bore.radius or 0.0, other.radius or 0.0)
    if norm(square) < 0.01 or abs(dot(between, square)) > norm(square) * near:
        return False  # parallel, or past each other
    ends_there = "cross" in bore.tags
    reach = (bore.depth or 0.0) / 2 + (other.radius or 0.0) * ends_there
    return abs(dot(between, bore.axis)) < reach
