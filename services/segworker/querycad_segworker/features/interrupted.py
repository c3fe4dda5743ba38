"""Round walls that slots, flats or keyways interrupt: the pieces of one cylinder around the material are one wall."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import SurfaceKind
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.vectors import ORIGIN, dot, foot

from .axes import SWEEP, Wall

MAX_PIECES = 12
"""More pieces than this are the tips of teeth."""
OVERLAP = 0.5
"""Pieces of one cylinder lie beside each other: they share this part of the shorter one's length."""


def with_interrupted(walls: Sequence[Wall], tolerances: Tolerances) -> list[Wall]:
    """The same walls, where the pieces of one outer cylinder are one wall when together they enclose it."""
    buckets: dict[tuple[int, str], list[int]] = defaultdict(list)
    for i, wall in enumerate(walls):
        if wall.kind is SurfaceKind.CYLINDER and wall.outward > 0 and not wall.encloses:
            buckets[(wall.body, f"{wall.radius:.3g}")].append(i)
    merged: dict[int, Wall] = {}
    gone: set[int] = set()
    for indices in buckets.values():
        for group in _by_line(walls, indices, tolerances):
            pieces = [walls[i] for i in group]
            if 1 < len(pieces) <= MAX_PIECES and sum(piece.sweep for piece in pieces) > math.radians(200):
                merged[min(group)] = _one(pieces)
                gone.update(group)
    return [merged.get(i, wall) for i, wall in enumerate(walls) if i in merged or i not in gone]


def _by_line(walls: Sequence[Wall], indices: Sequence[int], tolerances: Tolerances) -> list[list[int]]:
    """Those on one axis and side by side, together. Sorted by where their lines pass, only few need comparing."""
    keys = {i: dot(foot(ORIGIN, walls[i].axis.origin, walls[i].axis.direction), SWEEP) for i in indices}
    order = sorted(indices, key=lambda i: (keys[i], i))
    groups: list[list[int]] = []
    taken: set[int] = set()
    for rank, i in enumerate(order):
        if i in taken:
            continue
        group = [i]
        for j in order[rank + 1 :]:
            if keys[j] - keys[i] > 10 * tolerances.length:
                break
            if j not in taken and _beside(walls[i], walls[j], tolerances):
                taken.add(j)
                group.append(j)
        groups.append(group)
    return groups


def _beside(a: Wall, b: Wall, tolerances: Tolerances) -> bool:
    if abs(a.radius - b.radius) > 3 * tolerances.length or not a.axis.same_line(b.axis, tolerances):
        return False
    low, high = sorted((a.axis.position(b.axis.at(b.low)), a.axis.position(b.axis.at(b.high))))
    return min(high, a.high) - max(low, a.low) > OVERLAP * min(a.height, b.height)


def _one(pieces: Sequence[Wall]) -> Wall:
    first = pieces[0]
    ends = [first.axis.position(p.axis.at(end)) for p in pieces for end in (p.low, p.high)]
    return replace(
        first,
        low=min(ends),
        high=max(ends),
        sweep=min(sum(piece.sweep for piece in pieces), 2 * math.pi),
        faces=tuple(sorted(face for piece in pieces for face in piece.faces)),
    )
