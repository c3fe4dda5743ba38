"""Pieces of one slot, cut in one pass and parted by holes or pockets since, are one slot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.axes import Axis, Wall, by_line
from querycad_segworker.features.shared.clearance import IsClear
from querycad_segworker.features.shared.frames import frame_of
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import ORIGIN, cross, dot, mid, parallel, scale, sub

from .depression import Depression, DepressionKind
from .keyways import SAME_LINE

REACH = 100.0
"""How far apart, in length tolerances, the keys of one line may be."""

THROUGH = 0.9
"""A slot longer than this share of a tube's wall goes through it: the curved outside cuts its sides a little short."""


def united_slots(
    brep: Brep,
    found: Sequence[Depression],
    tolerances: Tolerances,
    is_clear: IsClear,
    walls: Sequence[Wall] = (),
) -> list[Depression]:
    """The same depressions, those slots united that lie on one line with a clear way between them.

    Across the bore of a tube, slots in its wall are slots of their own.
    """
    tubes = _tubes(walls, tolerances)
    result = [d for d in found if d.kind is not DepressionKind.SLOT]
    for line in _by_line([d for d in found if d.kind is DepressionKind.SLOT], tolerances):
        kept: list[Depression] = []
        for slot in sorted(line, key=lambda slot: dot(slot.center, line[0].direction)):
            one_cut = bool(kept) and _one_cut(kept[-1], slot, tolerances)
            if one_cut and _across_bore(kept[-1], slot, tubes):
                refuse("slot", (*kept[-1].faces, *slot.faces), "two slots in the wall of a tube, across its bore")
                kept.append(slot)
                continue
            if one_cut and is_clear(kept[-1].center, slot.center):
                kept[-1] = _united(brep, kept[-1], slot)
            else:
                if one_cut:
                    refuse("slot", (*kept[-1].faces, *slot.faces), "two slots in line, with material between")
                kept.append(slot)
        result.extend(kept)
    return result


def _tubes(walls: Sequence[Wall], tolerances: Tolerances) -> list[tuple[Wall, Wall]]:
    """Bores, each with a round outside about it."""
    round_walls = [wall for wall in walls if wall.kind is SurfaceKind.CYLINDER and wall.encloses]
    return [
        (bore, wall)
        for bore in round_walls
        for wall in round_walls
        if bore.outward < 0 < wall.outward
        and bore.body == wall.body
        and bore.radius < wall.radius
        and bore.axis.same_line(wall.axis, tolerances)
    ]


def _across_bore(a: Depression, b: Depression, tubes: Sequence[tuple[Wall, Wall]]) -> bool:
    """Are the slots cut through the wall of a tube, on opposite sides of a bore that is wider than both are long?"""
    middle = mid(a.center, b.center)
    return any(
        bore.body == a.body
        and 2 * bore.radius > a.length + b.length
        and a.length > THROUGH * (outer.radius - bore.radius)
        and parallel(outer.axis.direction, a.normal, 1e-2)
        and outer.axis.radius_of(middle) <= SAME_LINE * a.width
        and outer.low - a.depth / 2 <= outer.axis.position(a.center) <= outer.high + a.depth / 2
        for bore, outer in tubes
    )


def _by_line(slots: Sequence[Depression], tolerances: Tolerances) -> list[list[Depression]]:
    """Slots whose floors have one centre line, together."""
    return by_line(
        sorted(slots, key=lambda slot: slot.faces),
        lambda slot: Axis(_floor_point(slot), slot.direction),
        slots[0].center if slots else ORIGIN,
        REACH * tolerances.length,
        partial(_one_cut, tolerances=tolerances),
    )


def _floor_point(slot: Depression) -> tuple[float, float, float]:
    return sub(slot.center, scale(slot.normal, slot.depth / 2))


def _one_cut(a: Depression, b: Depression, tolerances: Tolerances) -> bool:
    """Same body, floor plane, direction, centre line and width?"""
    near = 10 * tolerances.length
    if a.body != b.body or dot(a.normal, b.normal) < 1 - 1e-6 or not parallel(a.direction, b.direction, 1e-3):
        return False
    apart = sub(_floor_point(b), _floor_point(a))
    across = cross(a.normal, a.direction)
    return abs(dot(apart, a.normal)) <= near and abs(a.width - b.width) <= near and abs(dot(apart, across)) <= near


def _united(brep: Brep, slot: Depression, other: Depression) -> Depression:
    faces = {*slot.faces, *other.faces}
    frame = frame_of(brep, faces, slot.normal, None, slot.direction)
    return replace(
        slot,
        length=frame.size[0],
        opening=frame.point(0.5, 0.5, 1.0),
        center=frame.point(0.5, 0.5, 0.5),
        depth=frame.size[2],
        floor=tuple(sorted({*slot.floor, *other.floor})),
        faces=tuple(sorted(faces)),
    )
