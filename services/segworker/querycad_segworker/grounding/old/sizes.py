"""Which of several parts: the large ones, the outer ones, those at an end, the one that stands out?"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence

from querycad_contracts import Part, Side
from querycad_segworker.vectors import dot, line_distance, norm, sub

from .lexicon import Adjective, Order
from .places import TOUCH_M
from .reading import Reading

LEFT_OUT_CONFIDENCE = 0.5
"""What is left when a word that describes could not be checked."""
SIZE_CONFIDENCE = 0.8
"""'Large' and 'small' are told by the gaps between the sizes that the model has."""
SAME_SIZE = 1.02
"""Sizes that differ by less than this ratio are one size: tolerances and roundings of drawings."""
CLEAR_GAP = 1.5
"""Sizes that differ by this ratio are large and small to anybody who looks."""
CORNER_SHARE = 0.5
"""In a corner is what lies at least half-way out to two edges."""


def outstanding(found: list[Part], reading: Reading, model: Part | None) -> list[Part]:
    """Which one is 'the bore' of several? The largest, with its likes; 'the short bore' is the shortest.

    Blends are all alike to whoever speaks of one: none of them stands out.
    """
    if len(found) < 2 or all(part.kind.breaks_edge for part in found):
        return found
    said = [adjective for adjective in reading.adjectives if adjective.order not in (None, "corner")]
    order, most = (said[-1].order or "size", said[-1].most) if said else ("size", True)
    kept = _extreme(found, lambda part: _compared(part, order, model), most)
    if not said:  # of holes that are equally wide, the longest
        kept = _extreme(kept, lambda part: measure(part, "length"), most=True)
    if len(kept) < len(found):
        which = "largest" if not said else f"most {said[-1].name}"
        reading.doubt(f"of {len(found)} the {which} was taken", SIZE_CONFIDENCE)
    return kept


def _extreme(found: list[Part], key: Callable[[Part], float], most: bool) -> list[Part]:
    """The first of an order, with those that are alike."""
    sizes = [key(part) for part in found]
    end = max(sizes) if most else min(sizes)
    return [part for part, size in zip(found, sizes, strict=True) if is_same(size, end)]


def at_ends(found: list[Part], sides: Sequence[Side], model: Part | None) -> list[Part]:
    """Those whose middles lie farthest towards each of the sides, give or take a fiftieth of the model."""
    for side in sides:
        if len(found) > 1 and model is not None:
            reach = [dot(part.center, side.outward) for part in found]
            near = 0.02 * max(model.extents)
            found = [part for part, at in zip(found, reach, strict=True) if at >= max(reach) - near]
    return found


def ordered(found: list[Part], adjective: Adjective, reading: Reading, model: Part | None) -> list[Part]:
    """Those that an adjective such as 'large' or 'outer' chooses among parts that differ in a measure or place."""
    assert adjective.order is not None
    if len(found) < 2 or model is None:
        return found
    if adjective.order == "corner":
        kept = [part for part in found if _out(part, model) >= CORNER_SHARE - 1e-6]
        if reading.count and len(kept) > reading.count:
            alike = [group for group in by_size(kept) if len(group) == reading.count]
            ranked = sorted(kept, key=lambda part: _out(part, model), reverse=True)[: reading.count]
            kept = max(alike, key=lambda group: min(_out(part, model) for part in group)) if alike else ranked
        if not kept:
            reading.doubt("'corner' could not be checked and was left out", LEFT_OUT_CONFIDENCE)
        return kept or found
    order = adjective.order
    kept = _end_of(found, lambda part: _compared(part, order, model), adjective.most, reading.count)
    if len(kept) < len(found):
        reading.doubt(f"'{adjective.name}' was taken as {len(kept)} of {len(found)}, by {adjective.order}",
                      SIZE_CONFIDENCE)  # fmt: skip
    return kept


def _compared(part: Part, order: Order, model: Part | None) -> float:
    """What do words of this order compare: a measure, or how far out the part is?"""
    return _off_center(part, model) if order == "distance" and model is not None else measure(part, order)


def _off_center(part: Part, model: Part) -> float:
    """How far is the part, or its axis, from the middle of the model?"""
    if part.axis is not None:
        return line_distance(part.center, model.center, part.axis)
    return norm(sub(part.center, model.center))


def _out(part: Part, model: Part) -> float:
    """How far out towards two edges does it lie: 0 in the middle of one, 1 in the corner?"""
    axis = part.axis
    offsets = [
        abs(c - m) / (e / 2) if e > 0 else 0.0 for c, m, e in zip(part.center, model.center, model.extents, strict=True)
    ]
    along = 2 if axis is None else max(range(3), key=lambda i: abs(axis[i]))
    return min(value for i, value in enumerate(offsets) if i != along)


def _end_of(found: list[Part], key: Callable[[Part], float], most: bool, count: int | None) -> list[Part]:
    """The parts at one end of an order: as many as counted, else those before the first clear gap, or the widest."""
    ranked = sorted(found, key=key, reverse=most)
    values = [key(part) for part in ranked]
    floor = 0.01 * max(values) + 1e-9
    steps = [(max(a, b) + floor) / (min(a, b) + floor) for a, b in itertools.pairwise(values)]
    if count and count < len(ranked) and steps[count - 1] > SAME_SIZE:
        return ranked[:count]
    widest = max(steps)
    if widest <= SAME_SIZE:
        return found
    first = next((i for i, step in enumerate(steps) if step >= CLEAR_GAP), steps.index(widest))
    return ranked[: first + 1]


def is_same(size: float, other: float) -> bool:
    """Do two sizes differ by less than tolerances and roundings?"""
    return max(size, other) <= SAME_SIZE * min(size, other) + TOUCH_M


def measure(part: Part, order: Order) -> float:
    """What a word such as 'long' compares; a part without that measure goes by its extents."""
    across = part.diameter or (part.length * part.width) ** 0.5 if part.length and part.width else part.diameter
    value = {
        "size": across,
        "length": part.depth if part.kind == "hole" else part.length or part.height,
        "width": part.width or part.diameter,
        "depth": part.depth,
        "height": part.height or part.extents[2],
        "thickness": part.thickness or part.diameter or part.width,
    }.get(order)
    return value if value is not None else max(part.extents)


def by_size(found: Sequence[Part]) -> list[list[Part]]:
    """Groups of parts of one kind and size, along parallel axes."""
    groups: list[list[Part]] = []
    for part in found:
        size = measure(part, "size")
        for group in groups:
            other = measure(group[0], "size")
            if part.kind == group[0].kind and max(size, other) <= SAME_SIZE * min(size, other):
                group.append(part)
                break
        else:
            groups.append([part])
    return groups
