"""Ways to ground a query, and what speaks for each."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from querycad_contracts import Grounded, Part, PartQuery
from querycad_language.weights import weights

from .inventory import Inventory

BEAM = 12
"""So many ways to ground a query are followed; the rest speaks against itself."""


@dataclass(frozen=True, slots=True)
class Way:
    """One way to ground the query, as far as it has come."""

    parts: tuple[Part, ...]
    features: dict[str, float]
    unchecked: tuple[str, ...] = ()

    def to(self, parts: Sequence[Part], feature: str, value: float = 1.0, unchecked: str = "") -> Way:
        """The way with other parts and one more feature."""
        features = {**self.features, feature: self.features.get(feature, 0.0) + value}
        return Way(tuple(parts), features, (*self.unchecked, unchecked) if unchecked else self.unchecked)


@dataclass(frozen=True, slots=True)
class Request:
    """What is asked of which model. `depth`: in how many other queries this one stands."""

    inventory: Inventory
    query: PartQuery
    depth: int
    ground: Callable[[PartQuery, int], list[Grounded]]
    """Grounds a query within this one; gives at most so many ways."""

    def best(self, query: PartQuery) -> Sequence[Part]:
        """The parts that a query within this one means."""
        found = self.ground(query, 1)
        return found[0].parts if found else ()


Step = Callable[[Request, Way], Iterable[Way]]
T = TypeVar("T")


def score(features: dict[str, float]) -> float:
    """How much speaks for a grounding: the fitted weights of its features, added up."""
    table = weights()
    return math.fsum(table.get(name, 0.0) * value for name, value in features.items())


def pruned(ways: Sequence[Way]) -> list[Way]:
    """The best ways, of those to the same parts the best one."""
    best: dict[tuple[str, ...], Way] = {}
    for way in sorted(ways, key=lambda way: score(way.features), reverse=True):
        key = (*(part.id for part in way.parts), *way.unchecked)
        best.setdefault(key, way)
    return list(best.values())[:BEAM]


def through(ways: Sequence[Way], items: Iterable[T], step: Callable[[Way, T], Iterable[Way]]) -> Sequence[Way]:
    """The ways after a step for each of the items, one after the other."""
    for item in items:
        ways = [after for way in ways for after in step(way, item)]
    return ways


def kept(way: Way, kept: Sequence[Part], name: str, said: str) -> Sequence[Way]:
    """Those that a restriction keeps; where it keeps none: none at all, or all with the restriction unchecked."""
    if kept:
        return [way.to(kept, f"{name}_agrees")]
    if not way.parts:
        return [way]
    return [way.to((), f"{name}_empties"), way.to(way.parts, f"{name}_dropped", unchecked=said)]
