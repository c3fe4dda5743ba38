"""What a part is to the whole: central, repeated, deep."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from querycad_contracts import Part, Shape
from querycad_segworker.vectors import cross, dot, line_distance, norm, sub

CENTRAL_SHARE = 0.01
"""A part is central when its axis passes the middle of the model nearer than this share of the model's extent."""
MIN_FEET = 2
"""One thing on the ground is a base."""
FOOT_SHARE = 0.5
"""A foot takes less than this share of the model's ground plan; more is a base."""
UPRIGHT = 0.999
"""Cosine of the angle to the vertical below which an axis counts as upright: 2.5 degrees."""
HEAD_RATIO = 1.3
"""A head is this much wider than its shank: 1.5 times for ISO 4762 and ISO 4014 screws, less for long pins."""
DEEP_RATIO = 5.0
"""A hole deeper than five diameters counts as deep in drilling practice."""


def with_relations(parts: Sequence[Part], shape: Shape) -> list[Part]:
    """The same parts with tags for what they are to the whole.

    'central': its axis passes the model's middle. 'repeated': another hole has its size and direction. 'deep'.
    'grounded': it reaches the model's lowest level. 'foot': it does, as one of several bodies or protrusions that do,
    while others do not: what the rest stands on. 'head': the wide end of a screw. 'vertical', 'horizontal': its axis.
    """
    groups: dict[tuple[object, ...], list[str]] = defaultdict(list)
    for part in parts:
        if part.kind == "hole":
            groups[_size_key(part, shape)].append(part.id)
    feet, heads = _feet(parts, shape), _heads(parts)
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
        if part.axis is not None and abs(part.axis[2]) > UPRIGHT:
            tags.append("vertical")
        elif part.axis is not None and abs(part.axis[2]) < 1 - UPRIGHT:
            tags.append("horizontal")
        if part.id in heads:
            tags.append("head")
        if part.id in feet:
            tags.append("foot")
        result.append(part if len(tags) == len(part.tags) else part.model_copy(update={"tags": tuple(tags)}))
    return result


def _feet(parts: Sequence[Part], shape: Shape) -> set[str]:
    """Several solid bodies that reach the ground while others do not; else several protrusions that do."""
    for kinds in (("body",), ("boss", "prism", "protrusion")):
        candidates = _outermost([part for part in parts if part.kind in kinds])
        grounded = [part for part in candidates if _is_grounded(part, shape)]
        slim = [part for part in grounded if max(part.extents[:2]) < FOOT_SHARE * max(shape.extents[:2])]
        if len(slim) >= MIN_FEET and (kinds != ("body",) or len(slim) < len(candidates)):
            return {part.id for part in slim}
    return set()


def _outermost(parts: Sequence[Part]) -> list[Part]:
    """Those whose faces are not all faces of another one."""
    faces = [frozenset(part.faces) for part in parts]
    return [
        part
        for i, part in enumerate(parts)
        if not any(faces[i] < other or (faces[i] == other and j < i) for j, other in enumerate(faces) if j != i)
    ]


def _heads(parts: Sequence[Part]) -> set[str]:
    """The head of each screw-like body: the one clearly widest step or hexagon at one end of a slender boss."""
    heads = set()
    steps = [part for part in parts if part.kind in ("boss", "prism") and part.axis is not None]
    for shank in steps:
        if shank.kind != "boss" or "cylindrical" not in shank.tags or shank.axis is None or not shank.radius:
            continue
        for other in steps:
            if other.id == shank.id or other.width is None or other.axis is None or shank.height is None:
                continue
            coaxial = line_distance(other.center, shank.center, shank.axis) < 0.05 * shank.radius
            aligned = norm(cross(other.axis, shank.axis)) < 0.02
            wider = other.width > HEAD_RATIO * 2 * shank.radius
            apart = abs(dot(sub(other.center, shank.center), shank.axis))
            touching = abs(apart - (shank.height + (other.height or 0.0)) / 2) < 0.1 * shank.radius
            if coaxial and aligned and wider and touching and shank.height > (other.height or 0.0):
                heads.add(other.id)
    return heads


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
