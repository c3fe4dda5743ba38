"""What the parts are that words were taken for, in rough steps: the words of questions are paired with them.

A pin stands out more often than it is cut in, a drain hole is low, a pilot hole small: how likely each is, is fitted.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator

from querycad_contracts import Grounded, Part

NUMBERS = (2, 3, 4, 5, 9)
"""How many parts there are, in steps."""
LENGTHS = (0.03, 0.06, 0.12, 0.25, 0.5, 0.8, 0.97)
"""How long a part is, as a share of the model's diagonal."""
DIAMETERS = (0.02, 0.04, 0.08, 0.16, 0.32)
"""How wide a round part is, as a share of it."""
SLENDERNESS = (0.25, 0.75, 1.5, 3.0)
"""How deep or high a round part is, in diameters."""
FLATNESS = (0.1, 0.3, 0.7)
"""The least extent of a part that is not round, as a share of the middle one."""
ELONGATION = (1.3, 2.5, 5.0)
"""Its largest extent, in middle ones."""
PLACES = (0.2, 0.45, 0.55, 0.8)
"""Where the middle of a part is, between the ends of the model along an axis."""
LEVEL = 0.02
"""Parts are at one place along an axis where their middles lie within this share of the model's extent."""
CENTRAL = 0.05
"""The middle of a part is that of the model within this share of the diagonal."""
ALONG = 0.99
"""Cosine of the angle to an axis within which a part's own axis is that one."""
MOST_STEPS = 3


def part_traits(way: Grounded, whole: Part) -> tuple[str, ...]:
    """Of all parts of one way to take a noun phrase; `whole` stands for the model."""
    if not way.parts:
        return ("empty",)
    return tuple(dict.fromkeys((*_kinds(way.parts), *_sizes(way.parts, whole), *_places(way.parts, whole))))


def _kinds(parts: tuple[Part, ...]) -> Iterator[str]:
    kinds = {str(part.kind) for part in parts}
    yield f"is {kinds.pop() if len(kinds) == 1 else 'mixed'}"
    yield from (f"is {tag}" for tag in sorted(set.intersection(*(set(part.tags) for part in parts))))
    yield from (f"bottom {bottom}" for bottom in sorted({str(part.bottom) for part in parts}))
    yield f"number {bisect_right(NUMBERS, len(parts))}"


def _sizes(parts: tuple[Part, ...], whole: Part) -> Iterator[str]:
    diagonal, first = math.hypot(*whole.extents) or 1.0, parts[0]
    yield f"length {bisect_right(LENGTHS, max(max(part.extents) for part in parts) / diagonal)}"
    radius = max(first.radii, default=first.radius or 0.0)
    if radius:
        yield f"diameter {bisect_right(DIAMETERS, 2 * radius / diagonal)}"
        yield f"steps {min(MOST_STEPS, len(first.radii) or 1)}"
        if reach := first.depth or first.height:
            yield f"slender {bisect_right(SLENDERNESS, reach / (2 * radius))}"
        return
    low, middle, high = sorted(first.extents)
    if middle > 0:
        yield f"flat {bisect_right(FLATNESS, low / middle)}"
        yield f"long {bisect_right(ELONGATION, high / middle)}"


def _places(parts: tuple[Part, ...], whole: Part) -> Iterator[str]:
    along = parts[0].axis or parts[0].normal
    if along is not None:
        main = max(range(3), key=lambda i: abs(along[i]))
        yield f"along {'xyz'[main] if abs(along[main]) > ALONG else 'none'}"
    for i, axis in enumerate("xyz"):
        extent, low = whole.extents[i] or 1.0, whole.center[i] - whole.extents[i] / 2
        at = [(part.center[i] - low) / extent for part in parts]
        yield f"{axis} {bisect_right(PLACES, at[0]) if max(at) - min(at) < LEVEL else 'several'}"
    if math.dist(parts[0].center, whole.center) < CENTRAL * (math.hypot(*whole.extents) or 1.0):
        yield "central"
    sides = {str(side) for part in parts for side in part.sides}
    yield f"sides {len(sides)}"
    if len(sides) == 1:
        yield f"side {sides.pop()}"
