"""Which parts can have to do with a part by where they are? Few: of many parts and many places few pairs are left."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from querycad_contracts import Part, Vector
from querycad_segworker.vectors import box_of, box_union, norm, sub

SLACK_M = 1e-5
"""Boxes this near to each other may meet: well above the tolerance of `places.touches`."""


@dataclass(frozen=True, slots=True)
class _Node:
    """A box, and what is in it: a part, or two halves."""

    low: Vector
    high: Vector
    holds: Part | tuple[_Node, _Node]


class Nearby:
    """A tree of the boxes of all parts. What it gives for a part is kept."""

    def __init__(self, parts: Sequence[Part]) -> None:
        self._ids = tuple(part.id for part in parts)
        self._tree = _halved([_leaf(part) for part in parts]) if parts else None
        self._of: dict[str, tuple[str, ...]] = {}
        self._carriers: dict[str | int, list[str]] = {}
        for part in parts:
            keys: tuple[str | int, ...] = (*part.children, *part.faces)
            for carried in keys:
                self._carriers.setdefault(carried, []).append(part.id)

    def pairs(self, found: Sequence[Part], places: Sequence[Part]) -> list[tuple[Part, list[Part]]]:
        """Each part with those of the places that it may touch, lie in or be carried by: it does so to no others."""
        among = {place.id: place for place in places}
        return [(part, [among[i] for i in self._near(part) if i in among]) for part in found]

    def _near(self, part: Part) -> tuple[str, ...]:
        if part.id not in self._of:
            keys: tuple[str | int, ...] = (part.id, *part.faces)
            near = [*self._meeting(part), *(i for key in keys for i in self._carriers.get(key, ()))]
            self._of[part.id] = tuple(dict.fromkeys(near)) if part.faces else self._ids  # no faces are among any
        return self._of[part.id]

    def _meeting(self, part: Part) -> list[str]:
        box = _leaf(part)
        low, high = box_of((box.low, box.high, part.opening or part.center)) or (box.low, box.high)
        found: list[str] = []
        waiting = [] if self._tree is None else [self._tree]
        while waiting:
            node = waiting.pop()
            if not all(a <= b and c <= d for a, b, c, d in zip(node.low, high, low, node.high, strict=True)):
                continue
            if isinstance(node.holds, Part):
                found.append(node.holds.id)
            else:
                waiting += node.holds
        return found


def _leaf(part: Part) -> _Node:
    x, y, z = (extent / 2 + SLACK_M for extent in part.extents)
    a, b, c = part.center
    return _Node((a - x, b - y, c - z), (a + x, b + y, c + z), part)


def _halved(nodes: list[_Node]) -> _Node:
    """The tree of at least one box: halved across its longest side."""
    if len(nodes) == 1:
        return nodes[0]
    low, high = box_union((node.low, node.high) for node in nodes) or (nodes[0].low, nodes[0].high)
    along = max(range(3), key=lambda i: high[i] - low[i])
    nodes.sort(key=lambda node: node.low[along] + node.high[along])
    half = len(nodes) // 2
    return _Node(low, high, (_halved(nodes[:half]), _halved(nodes[half:])))


def to_nearest(places: Sequence[Part]) -> Callable[[Part], float]:
    """How far is the middle of a part from that of the nearest of at least one place? Outwards along x."""
    order = sorted(place.center for place in places)

    def nearest(part: Part) -> float:
        start, far = bisect(order, part.center), float("inf")
        for way in (range(start, len(order)), range(start - 1, -1, -1)):
            for i in way:
                if abs(order[i][0] - part.center[0]) > far:
                    break
                far = min(far, norm(sub(part.center, order[i])))
        return far

    return nearest
