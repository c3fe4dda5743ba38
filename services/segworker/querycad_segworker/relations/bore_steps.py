"""Steps of bores, which ring grooves part."""

from __future__ import annotations

import math
from collections.abc import Sequence

from querycad_contracts import Part, Vector
from querycad_segworker.vectors import add, dot, scale

from .roles import Kinds


def step_walls(holes: Sequence[Part], widest: bool, kinds: Kinds) -> list[Part]:
    """The wall of the widest or the narrowest step of each hole, seen from where it opens; or its counterbore."""
    walls = []
    inner = sorted(kinds.get("cylinder"), key=lambda p: -(p.height or p.length or 0.0))
    grooved = {face for groove in kinds.get("groove") for face in groove.faces}
    inner = [p for p in inner if "inner" in p.tags and p.radius and not grooved.issuperset(p.faces)]
    sunk = kinds.get("counterbore", "spotface") if widest else []
    for hole in holes:
        pieces = [p for p in inner if set(p.faces) <= set(hole.faces)]
        longest = {round(p.radius or 0.0, 7): p for p in reversed(pieces)}
        own = {radius: over_rings(p, pieces, hole.axis) for radius, p in longest.items()}
        if len(own) > 1:
            opening = tuple(s for s in hole.sides if hole.normal and dot(s.outward, hole.normal) > 0.5)
            wall = own[max(own) if widest else min(own)]
            wall = next((p for p in sunk if set(wall.faces) <= set(p.faces)), wall)  # as deep as with its chamfer
            walls.append(wall.model_copy(update={"sides": opening or hole.sides}))
    return walls


def over_rings(step: Part, pieces: Sequence[Part], axis: Vector | None) -> Part:
    """A step of a bore as long as its pieces on both sides of a ring groove, where nothing narrower lies between.

    `pieces`: all inner cylinders of the bore; `axis`: its unit direction, in the frame of the file.
    """
    if axis is None or step.radius is None:
        return step
    spans = [(p.radius or 0.0, dot(p.center, axis), (p.height or 0.0) / 2) for p in pieces]
    like = [(at - half, at + half) for radius, at, half in spans if math.isclose(radius, step.radius)]
    low, high = min(like)[0], max(like)[1]
    if len(like) < 2 or any(low < at < high and radius < 0.999 * step.radius for radius, at, _ in spans):
        return step
    center = add(step.center, scale(axis, (low + high) / 2 - dot(step.center, axis)))
    return step.model_copy(update={"depth": high - low, "height": high - low, "length": high - low, "center": center})
