"""What a part is to the whole: central, repeated, deep."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from querycad_contracts import Part, Shape
from querycad_segworker.vectors import line_distance

CENTRAL_SHARE = 0.01
"""A part is central when its axis passes the middle of the model nearer than this share of the model's extent."""
MIN_FEET = 2
"""One thing on the ground is a base."""
FOOT_SHARE = 0.5
"""A foot takes less than this share of the model's ground plan; more is a base."""
DEEP_RATIO = 5.0
"""A hole deeper than five diameters counts as deep in drilling practice."""


def with_relations(parts: Sequence[Part], shape: Shape) -> list[Part]:
    """The same parts with tags for what they are to the whole.

    'central': its axis passes the model's middle. 'repeated': another hole has its size and direction. 'deep'.
    'grounded': it reaches the model's lowest level. 'foot': it does, as one of several bodies or protrusions that do,
    while others do not: what the rest stands on.
    """
    groups: dict[tuple[object, ...], list[str]] = defaultdict(list)
    for part in parts:
        if part.kind == "hole":
            groups[_size_key(part, shape)].append(part.id)
    feet = _feet(parts, shape)
    repeated = {part_id for members in groups.values() if len(members) > 1 for part_id in members}
    result = []
    for part in parts:
        tags = list(part.tags)
        if part.axis is not None and _is_central(part, shape):
            tags.append("central")
        if part.id in repeated:
            tags.append("repeated")
        if part.kind == "hole" and part.depth and part.diameter and part.depth > DEEP_RATIO * part.diameter:
            tags.append("deep")
        if _is_grounded(part, shape):
            tags.append("grounded")
        if part.id in feet:
            tags.append("foot")
        result.append(part if len(tags) == len(part.tags) else part.model_copy(update={"tags": tuple(tags)}))
    return result


def _feet(parts: Sequence[Part], shape: Shape) -> set[str]:
    """Several solid bodies that reach the ground while others do not; else several protrusions that do."""
    for kinds in (("body",), ("boss", "prism", "protrusion")):
        candidates = [part for part in parts if part.kind in kinds]
        grounded = [part for part in candidates if _is_grounded(part, shape)]
        slim = [part for part in grounded if max(part.extents[:2]) < FOOT_SHARE * max(shape.extents[:2])]
        if len(slim) >= MIN_FEET and (kinds != ("body",) or len(slim) < len(candidates)):
            return {part.id for part in slim}
    return set()


def _is_grounded(part: Part, shape: Shape) -> bool:
    lowest = shape.center[2] - shape.extents[2] / 2
    return part.center[2] - part.extents[2] / 2 - lowest <= CENTRAL_SHARE * shape.extents[2]


def _is_central(part: Part, shape: Shape) -> bool:
    assert part.axis is not None
    return line_distance(shape.center, part.center, part.axis) <= CENTRAL_SHARE * max(shape.extents)


def _size_key(part: Part, shape: Shape) -> tuple[object, ...]:
    """Same radius to a thousandth of the model, same direction along either way."""
    assert part.axis is not None
    assert part.radius is not None
    step = 1e-4 * max(shape.extents)
    sign = 1.0 if part.axis > tuple(-c for c in part.axis) else -1.0
    return (round(part.radius / step), *(round(sign * c, 2) + 0.0 for c in part.axis))
