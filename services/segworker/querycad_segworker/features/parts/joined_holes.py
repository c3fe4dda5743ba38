"""Counterbores across two bodies: a wide hole in a plate over a narrow one in what the plate is screwed to."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import Bottom, Part, PartKind, Vector
from querycad_segworker.features.shared.part_measures import geometry, millimetres
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import dist, dot, line_distance, parallel, scale, sub

HEAD_ROOM = 1.6
"""A counterbore takes a head: 1.7 times the clearance hole of ISO 4762 screws. A clearance hole over a core hole is
wider by 1.3 to 1.5."""
DEEP = 1.5
"""A counterbore is no deeper than this many of its diameters."""


def with_joined_counterbores(parts: Sequence[Part], brep: Brep, tolerances: Tolerances) -> list[Part]:
    """The same parts; a hole that a wider one in another body ends at, on one axis, is counterbored by that.

    The wider one stays a hole of its body, and is a counterbore besides, which the narrow one carries.
    """
    if len(brep.bodies) < 2:
        return list(parts)
    holes = [part for part in parts if part.kind == "hole" and part.opening is not None and part.axis is not None]
    found: dict[str, list[Part]] = {}
    for wide in (hole for hole in holes if "through" in hole.tags and "stepped" not in hole.tags):
        for narrow in holes:
            if _takes_head(wide, narrow) and _meet(wide, narrow, brep, tolerances):
                found.setdefault(narrow.id, []).append(wide)
    made: list[Part] = []
    result = []
    for part in parts:
        over = found.get(part.id, [])
        if over:
            own = [_counterbore(part, wide, len(made) + i) for i, wide in enumerate(over, start=1)]
            made += own
            tags = tuple(dict.fromkeys((*part.tags, "counterbored")))
            part = part.model_copy(update={"tags": tags, "children": (*part.children, *(one.id for one in own))})
        result.append(part)
    return [*result, *made]


def _takes_head(wide: Part, narrow: Part) -> bool:
    if not wide.diameter or not narrow.diameter or not wide.depth:
        return False
    return wide.diameter >= HEAD_ROOM * narrow.diameter and wide.depth <= DEEP * wide.diameter


def _meet(wide: Part, narrow: Part, brep: Brep, tolerances: Tolerances) -> bool:
    """Are they in two bodies that touch there, on one axis?"""
    assert wide.axis is not None
    assert narrow.axis is not None
    if brep.faces[wide.faces[0]].body == brep.faces[narrow.faces[0]].body:
        return False
    near = 10 * tolerances.length
    if not parallel(wide.axis, narrow.axis, 1e-2) or line_distance(narrow.center, wide.center, wide.axis) > near:
        return False
    middle = abs(dot(sub(narrow.center, wide.center), wide.axis))
    return abs(middle - ((wide.depth or 0.0) + (narrow.depth or 0.0)) / 2) <= near


def _counterbore(narrow: Part, wide: Part, number: int) -> Part:
    """The wider hole as a counterbore of the narrow one; it opens away from that."""
    assert wide.axis is not None
    assert wide.depth is not None
    assert wide.diameter is not None
    away = dot(sub(wide.center, narrow.center), wide.axis) > 0
    out: Vector = wide.axis if away else scale(wide.axis, -1.0)
    ends = [tuple(c + s * n * wide.depth / 2 for c, n in zip(wide.center, out, strict=True)) for s in (1, -1)]
    opening = max(ends, key=lambda end: dist((end[0], end[1], end[2]), narrow.center))
    return wide.model_copy(
        update={
            "id": f"counterbore-j{number}",
            "kind": PartKind.COUNTERBORE,
            "tags": ("circular", "inner", "cylindrical", "joined"),
            "label": f"counterbore across two bodies, diameter {millimetres(wide.diameter)}, "
            f"depth {millimetres(wide.depth)}",
            "normal": out,
            "opening": opening,
            "bottom": Bottom.FLAT,
            "length": wide.depth,
            "evidence": geometry(f"a wider hole in the body over {narrow.id}, on one axis"),
        }
    )
