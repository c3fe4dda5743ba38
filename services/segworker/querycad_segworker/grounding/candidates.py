"""Candidates: the part sets that a query can mean, and what speaks for each."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from querycad_contracts import Grounded, Part, PartKind, PartQuery
from querycad_language.weights import weights

from .inventory import Inventory

BEAM = 12  # so many candidates of a query are followed; the rest speaks against itself


@dataclass(frozen=True, slots=True)
class Candidate:
    """A set of parts that the query may mean, as far as it has been grounded."""

    parts: tuple[Part, ...]
    features: dict[str, float]
    unchecked: tuple[str, ...] = ()

    def to(self, parts: Sequence[Part], feature: str, value: float = 1.0, unchecked: str = "") -> Candidate:
        """The candidate with other parts and one more feature."""
        features = {**self.features, feature: self.features.get(feature, 0.0) + value}
        return Candidate(tuple(parts), features, (*self.unchecked, unchecked) if unchecked else self.unchecked)


@dataclass(frozen=True, slots=True)
class Request:
    """What is asked of which model. `depth`: in how many other queries this one stands."""

    inventory: Inventory
    query: PartQuery
    depth: int
    ground: Callable[[PartQuery, int], list[Grounded]]
    """Grounds a query within this one; gives at most so many candidates."""

    def best(self, query: PartQuery) -> Sequence[Part]:
        """The parts that a query within this one means."""
        found = self.ground(query, 1)
        return found[0].parts if found else ()


Step = Callable[[Request, Candidate], Iterable[Candidate]]
T = TypeVar("T")


def score(features: dict[str, float]) -> float:
    """How much speaks for a grounding: the fitted weights of its features, added up."""
    table = weights()
    return math.fsum(table.get(name, 0.0) * value for name, value in features.items())


def true_of(**features: bool) -> dict[str, float]:
    """The features that are so, each with 1."""
    return {name: 1.0 for name, holds in features.items() if holds}


def pruned(ways: Sequence[Candidate]) -> list[Candidate]:
    """The best candidates, of those to the same parts the best one."""
    best: dict[tuple[str, ...], Candidate] = {}
    for way in sorted(ways, key=lambda way: score(way.features), reverse=True):
        key = (*(part.id for part in way.parts), *way.unchecked)
        best.setdefault(key, way)
    told = [way for way in best.values() if "guessed" not in way.features][:BEAM]
    return told + [way for way in best.values() if "guessed" in way.features][:BEAM]


def through(
    ways: Sequence[Candidate], items: Iterable[T], step: Callable[[Candidate, T], Iterable[Candidate]]
) -> Sequence[Candidate]:
    """The candidates after a step for each of the items, one after the other."""
    for item in items:
        ways = [after for way in ways for after in step(way, item)]
    return ways


def kept(way: Candidate, kept: Sequence[Part], name: str, said: str) -> Sequence[Candidate]:
    """Those that a restriction keeps; where it keeps none: none at all, or all with the restriction unchecked."""
    if kept:
        return [way.to(kept, f"{name}_agrees")]
    if not way.parts:
        return [way]
    return [way.to((), f"{name}_empties"), way.to(way.parts, f"{name}_dropped", unchecked=said)]


def taken_for(said: str, kind: PartKind) -> str:
    """What is not checked where parts of this kind stand for what is said: "'lip', taken for an elevation"."""
    return f"'{said}', taken for a{'n' if kind[0] in 'aeiou' else ''} {kind}"
