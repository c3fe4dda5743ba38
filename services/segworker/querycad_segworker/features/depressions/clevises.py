"""The gap of a fork: two ribs or lugs side by side, with nothing between them, leave an open slot."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace

from querycad_segworker.features.protrusions.ribs import Rib
from querycad_segworker.features.shared.clearance import IsClear
from querycad_segworker.features.shared.frames import frame_of
from querycad_segworker.features.shared.reach import faces_span
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import FACING, reaches
from querycad_segworker.topology import Brep, FaceRecord
from querycad_segworker.vectors import add, dot, parallel, scale, sub

from .depression import Depression, DepressionKind, depression_in

OVERLAP = 0.5
"""Lugs that face each other over less than this share of the shorter one stand beside each other."""


def recognise_clevises(
    brep: Brep, ribs: Sequence[Rib], depressions: Sequence[Depression], is_clear: IsClear
) -> list[Depression]:
    """Which gaps between two lugs or ribs of one body are slots, though no floor joins their flanks?

    Their flanks face each other, the way between is free, and the gap is narrower than the flanks are long and high:
    a wider one is room between two walls. Flanks of `depressions` other than steps have their gap already.
    """
    taken = {face for found in depressions if found.kind is not DepressionKind.STEP for face in found.faces}
    free = [rib for rib in ribs if not taken.issuperset(rib.flanks)]
    found = []
    for a, b in itertools.combinations(free, 2):
        for flanks in _facing(brep, a, b):
            if taken.isdisjoint(flank.id for flank in flanks):
                slot = _between(brep, a, flanks, is_clear)
                if slot is not None:
                    found.append(slot)
    return found


def _facing(brep: Brep, a: Rib, b: Rib) -> Iterator[tuple[FaceRecord, FaceRecord]]:
    """The flanks of two parallel ribs that look at each other."""
    if a.body != b.body or dot(a.normal, b.normal) < FACING.opposed or not parallel(a.direction, b.direction, 0.02):
        return
    for i, j in itertools.product(a.flanks, b.flanks):
        first, second = brep.faces[i], brep.faces[j]
        if dot(first.axis, second.axis) < -FACING.opposed and dot(sub(second.point, first.point), first.axis) > 0:
            yield first, second


def _between(brep: Brep, rib: Rib, flanks: tuple[FaceRecord, FaceRecord], is_clear: IsClear) -> Depression | None:
    """The slot between two flanks, as long and as high as both face each other; None where they do not, or too wide."""
    first, second = flanks
    gap = dot(sub(second.point, first.point), first.axis)
    middle = scale(add(first.point, second.point), 0.5)
    for direction in (rib.direction, rib.normal):
        (low, high), (other_low, other_high) = (faces_span(brep, (flank.id,), direction) for flank in flanks)
        size = min(high, other_high) - max(low, other_low)
        if size < OVERLAP * min(high - low, other_high - other_low):
            return None
        if reaches(gap, size):
            refuse("slot", (first.id, second.id), "the gap is wider than the flanks are long or high")
            return None
        wanted = (min(high, other_high) + max(low, other_low)) / 2
        middle = add(middle, scale(direction, wanted - dot(middle, direction)))
    ends = [add(middle, scale(first.axis, side * gap / 2)) for side in (-0.98, 0.98)]
    if not is_clear(ends[0], ends[1]):
        refuse("slot", (first.id, second.id), "material lies between the flanks")
        return None
    frame = frame_of(brep, {first.id, second.id}, rib.normal, None, rib.direction)
    slot = depression_in(DepressionKind.SLOT, "rectangular", frame, (first.id, second.id), (), rib.body, is_open=True)
    return replace(slot, width=gap, tags=("fork",))
