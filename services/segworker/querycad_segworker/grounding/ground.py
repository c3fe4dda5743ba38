"""Grounding: from a typed query to part sets of one model, each with what speaks for and against it.

Nothing is dropped in silence: what restricts and cannot be checked is said, and counted by a feature.
"""

from __future__ import annotations

from querycad_contracts import Grounded, PartQuery

from .candidates import Request, Step, pruned
from .inventory import Inventory
from .placement import placed, seen
from .restrictions import colored, narrowed, sized, threaded
from .selection import counted, excepted, joined, ranked, single
from .senses import bases

STEPS: tuple[Step, ...] = (
    colored, threaded, narrowed, sized, placed, seen, excepted, joined, ranked, counted, single,
)  # fmt: skip
"""What happens to the parts that the noun means, in this order."""
KEPT = 64  # so many queries a model keeps grounded: those of a question are a dozen, each asked for once a program


def ground(inventory: Inventory, query: PartQuery, limit: int | None = None, depth: int = 0) -> list[Grounded]:
    """The part sets that a query can mean on this model, best first; never none: the last resort is the empty set."""
    if query.ids:
        return [_by_id(inventory, query)]
    known, said = inventory.grounded, () if query.words == tuple(query.noun.split()) else query.words
    query = query.model_copy(update={"words": said, "sense": 0})  # as questions and as programs ask: one query
    if (ways := known.get((query, depth))) is None:
        ways = known[query, depth] = _ways(inventory, query, depth)
        while len(known) > KEPT:
            known.popitem(last=False)
    return ways[:limit]


def _ways(inventory: Inventory, query: PartQuery, depth: int) -> list[Grounded]:
    request = Request(inventory, query, depth, lambda inner, most: ground(inventory, inner, most, depth + 1))
    ways = list(bases(request))
    for step in STEPS:
        ways = pruned([after for way in ways for after in step(request, way)])
    ways = [way for way in ways if way.parts or not {"sense_kin", "guessed"} & way.features.keys()]  # says nothing
    return [Grounded(parts=way.parts, features=way.features, unchecked=way.unchecked) for way in ways]


def _by_id(inventory: Inventory, query: PartQuery) -> Grounded:
    missing = [i for i in query.ids if i not in inventory.by_id]
    if missing:
        return Grounded(parts=(), features={"id_missing": 1.0}, reason=f"no part {', '.join(missing)}")
    return Grounded(parts=tuple(inventory.by_id[i] for i in query.ids), features={"by_id": 1.0})
