"""Which of some parts come first in an order, and which are alike? By their measures and middles."""

from __future__ import annotations

import math
from bisect import bisect_left, insort
from collections import defaultdict
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise

from querycad_contracts import Part, PartKind, Side
from querycad_segworker.vectors import dot, line_distance, norm, sub

CORNER_SHARE = 0.5
"""In a corner is what lies at least half-way out to two edges."""
SAME_SIZE = 1.02
"""Sizes that differ by less than this ratio are one size: tolerances and roundings of drawings."""
WIDE = 0.7
"""A flange or plate is at least this wide, compared with the widest."""
_NO_SIZE = 1e-9
"""Metres by which no sizes differ."""
_ON_PAPER = {Side.TOP: Side.BACK, Side.BOTTOM: Side.FRONT}  # what is up and down in the view from above
_SOLIDS = frozenset(kind for kind in PartKind if kind.stands_out) - {PartKind.ELEVATION}


def off_center(part: Part, model: Part) -> float:
    """How far is the axis of a part, or its middle, from the middle of the model?"""
    if part.axis is not None:
        return line_distance(part.center, model.center, part.axis)
    return norm(sub(part.center, model.center))


def out_to_corner(part: Part, model: Part) -> float:
    """How far out towards two edges does it lie: 0 in the middle of one, 1 in the corner?"""
    offsets = [
        abs(c - m) / (e / 2) if e > 0 else 0.0 for c, m, e in zip(part.center, model.center, model.extents, strict=True)
    ]
    axis = part.axis or (0.0, 0.0, 1.0)
    along = max(range(3), key=lambda i: abs(axis[i]))
    return min(value for i, value in enumerate(offsets) if i != along)


def first(found: Sequence[Part], value: Callable[[Part], float], near: float) -> list[Part]:
    """Those with the highest value, and with one near to it."""
    values = [value(part) for part in found]
    return [part for part, own in zip(found, values, strict=True) if own >= max(values) - near]


def at_end(found: Sequence[Part], sides: Sequence[Side], near: float) -> list[Part]:
    """Those whose middles lie farthest towards each of the sides, and those near to them.

    'The top left hole' of a plate that lies flat is the one at the back, as on a drawing of it.
    """
    kept = list(found)
    for side in sides:
        farthest = first(kept, partial(_towards, side), near)
        if len(farthest) == len(kept) and len(sides) > 1 and side in _ON_PAPER:
            farthest = first(kept, partial(_towards, _ON_PAPER[side]), near)
        kept = farthest
    return kept


def beyond_middle(found: Sequence[Part], sides: Sequence[Side], model: Part, near: float) -> bool:
    """Do all lie in the other half of the model than one of the sides, not near to its middle?"""
    return any(all(_towards(side, p) < _towards(side, model) - near for p in found) for side in sides)


def _towards(side: Side, part: Part) -> float:
    return dot(part.center, side.outward)


def size(part: Part) -> float:
    """How large is a part: across what is round, else by its sides?"""
    return measured(part, "size")


def measured(part: Part, order: str) -> float:
    """What a word such as 'long' compares; a part without that measure goes by its extents."""
    across = part.diameter or ((part.length * part.width) ** 0.5 if part.length and part.width else None)
    value = {
        "size": across,
        "length": part.depth if part.kind == "hole" else part.length or part.height,
        "width": part.width or part.diameter,
        "depth": part.depth,
        "height": part.height or part.extents[2],
        "volume": part.volume,
        "mass": part.volume,  # bodies have no density of their own
        "area": part.area,
        "thickness": part.thickness or part.diameter or part.width,
    }.get(order)
    return value if value is not None else max(part.extents)


def compared(found: Sequence[Part], order: str) -> list[float]:
    """What a word compares of several parts: of round ones of which only some are discs the diameter."""
    mixed = order == "thickness" and any(p.thickness is None for p in found) and all(p.diameter for p in found)
    return [measured(part, "size" if mixed else order) for part in found]


def ordered(found: Sequence[Part], order: str, most: bool, count: int | None, model: Part) -> list[Part]:
    """Those that a word such as 'large' or 'outer' chooses among parts that differ in a measure or place."""
    if len(found) < 2:
        return list(found)
    if order == "corner":
        return [part for part in found if out_to_corner(part, model) >= CORNER_SHARE - 1e-6] or list(found)
    values = [off_center(p, model) for p in found] if order == "distance" else compared(found, order)
    return end_of(found, values, most, count)


def end_of(found: Sequence[Part], values: Sequence[float], most: bool, count: int | None) -> list[Part]:
    """The parts at one end of an order: as many as counted, else those before the first clear gap, or the widest."""
    ranked = sorted(zip(found, values, strict=True), key=lambda pair: pair[1], reverse=most)
    sizes = [value for _, value in ranked]
    floor = 0.01 * max(sizes) + 1e-9
    steps = [(max(a, b) + floor) / (min(a, b) + floor) for a, b in pairwise(sizes)]
    if count and count < len(ranked) and steps[count - 1] > SAME_SIZE:
        return [part for part, _ in ranked[:count]]
    widest = max(steps)
    if widest <= SAME_SIZE:
        return list(found)
    first = next((i for i, step in enumerate(steps) if step >= 1.5), steps.index(widest))
    return [part for part, _ in ranked[: first + 1]]


def extreme(found: Sequence[Part], values: Sequence[float], most: bool, nth: int = 1, count: int = 1) -> list[Part]:
    """The first `count`, or the `nth`, of an order, with those that are alike."""
    order = sorted(zip(values, range(len(found)), strict=True), reverse=most)
    if count > 1:
        return [found[i] for _, i in order[:count]]
    ranked: list[float] = []
    for value, _ in order:
        if not ranked or abs(value - ranked[-1]) > 1e-6 + 1e-4 * abs(value):
            ranked.append(value)
    limits = ranked[nth - 1 : nth]
    return [
        part
        for part, value in zip(found, values, strict=True)
        if any(abs(value - limit) <= 1e-6 + 1e-4 * abs(limit) for limit in limits)
    ]


def by_size(found: Sequence[Part]) -> list[list[Part]]:
    """Groups of parts of one kind and size: each is like the first one of its group."""
    groups: list[list[Part]] = []
    firsts: dict[PartKind, list[tuple[float, int]]] = defaultdict(list)
    for part in found:
        own, known = size(part), firsts[part.kind]
        low = bisect_left(known, ((own - _NO_SIZE) / SAME_SIZE, -1))
        high = bisect_left(known, (own * SAME_SIZE + _NO_SIZE, len(groups)))
        if low < high:
            groups[min(group for _, group in known[low:high])].append(part)
        else:
            insort(known, (own, len(groups)))
            groups.append([part])
    return groups


def picked(found: list[Part], pick: str, bodies: Sequence[Part]) -> list[Part]:
    """Those of the parts that a word picks: the 'largest', the 'lowest', the 'tall', the size that 'most' have."""
    if not found:
        return found
    match pick:
        case "elongated":
            return [part for part in found if part.kind == "slot" or {"elongated", "obround"} & set(part.tags)]
        case "standing" | "tall" | "low":
            found = [part for part in found if _stands(part, bodies)]
            heights = [part.height or 0.0 for part in found] or [0.0]
            low = max(heights) / 2 if pick == "tall" else 0.0
            high = 2 * min(heights) if pick == "low" else math.inf
            return [part for part in found if low <= (part.height or 0.0) <= high]
        case "most":
            group = max(by_size(found), key=len)
            return group if len(group) > 2 else []
        case "lowest":
            near = 0.02 * max(part.extents[2] for part in found) + 1e-9
            return first(found, lambda part: part.extents[2] / 2 - part.center[2], near)
    sizes = [size(part) for part in found]
    if pick == "smallest":
        return first(found, lambda part: -size(part), 1e-3 * min(sizes))
    return first(found, size, (1e-3 if pick == "largest" else 1 - WIDE) * max(sizes))


def _stands(part: Part, bodies: Sequence[Part]) -> bool:
    """Does it stand out of its body, instead of being the body's own outline?"""
    body = next((b for b in bodies if set(part.faces) <= set(b.faces)), None)
    if body is None or body.diameter is None or part.diameter is None:
        return True
    return part.diameter < body.diameter / SAME_SIZE


def without_twins(found: list[Part]) -> list[Part]:
    """Without those that are another one over again, as a protrusion is a block: most of their faces are the same."""
    kept: list[Part] = []
    for part in found:
        faces = set(part.faces)
        twins = (p for p in kept if p.kind != part.kind and {p.kind, part.kind} <= _SOLIDS)
        if not any(2 * len(faces & set(p.faces)) > min(len(faces), len(p.faces)) for p in twins):
            kept.append(part)
    return kept
