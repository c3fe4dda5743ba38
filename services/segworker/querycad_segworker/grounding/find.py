"""`find_parts`: the best grounding of a query or of free text, with a message where there is none."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from querycad_contracts import Grounded, Grounding, Part, PartQuery, Side
from querycad_language.describe import none_such
from querycad_language.phrases import noun_phrase

from .candidates import score, taken_for
from .ground import ground
from .inventory import Inventory, values_of
from .names import holds
from .printed import key

UNDERSTOOD_NOT = ("unknown_noun", "id_missing")  # features of a grounding whose noun nothing is known of
FAR = 0.8  # a sense so far from its word is told: a 'bolt' that is a hole


def find(inventory: Inventory, asked: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
    """Which parts are meant, in the best way to ground it, or that of its `sense`? Warnings say what is not checked."""
    query = asked if isinstance(asked, PartQuery) else noun_phrase(asked, inventory.names)
    plural = query.plural
    unnumbered = isinstance(asked, str) and (plural or not query.definite) and not query.count
    if unnumbered:  # 'hole' and 'holes' mean all of them, be it one, 'the hole' one
        query = query.model_copy(update={"plural": True})
    if sides is not None:
        query = query.model_copy(update={"sides": tuple(Side(side) for side in sides)})
    said = asked if isinstance(asked, str) else " ".join(query.words) or query.noun or "part"
    ways = ground(inventory, query)
    if unnumbered:
        wider = _wider(ways) if plural else []
        ways = [*wider, *sorted(ways, key=_by_score, reverse=True)]
    if isinstance(asked, str):
        ways = [way for way in ways if "guessed" not in way.features] or ways  # programs are not guessed for
    way = ways[min(query.sense, len(ways) - 1)]
    way = _printed(inventory, asked, way, sides) if isinstance(asked, str) else way
    unknown = [name for name in UNDERSTOOD_NOT if name in way.features]
    message = way.reason
    if unknown and not message:
        message = f"'{query.noun or said}' is not a part that is known here"
    elif not way.parts and not message:
        message = f"the model has no '{said.removeprefix('the ')}'"
        elsewhere = ground(inventory, query.model_copy(update={"sides": ()}))[0].parts if query.sides else ()
        if elsewhere:
            hidden = f"none visible from {' or '.join(query.sides)}"
            message = f"the model has {len(elsewhere)} x '{said.removeprefix('the ')}', but {hidden}"
    if not way.parts and (none := _none_such(inventory, query)):
        message = none
    far = way.features.get("sense_stretch", 0.0) >= FAR and query.noun
    taken = (taken_for(query.noun, way.parts[0].kind),) if far and way.parts else ()
    unchecked = tuple(dict.fromkeys((*way.unchecked, *taken)))
    warnings = tuple(f"not checked: {what}" for what in unchecked) if way.parts else ()
    return Grounding(
        description=said,
        sides=query.sides or None,
        parts=tuple(sorted(way.parts, key=_order)),
        understood=not unknown,
        nearest=() if way.parts or message.startswith("no ") else present(inventory),
        message="" if way.parts else message,
        warnings=warnings,
        ignored=() if {"unknown_named", "unknown_is_file", "printed"} & way.features.keys() else query.unknown,
        unchecked=unchecked,
    )


def _none_such(inventory: Inventory, query: PartQuery) -> str:
    """Why none is left of parts that are there: 'no hole is wider than 80 mm; they have 5 mm to 26 mm'."""
    plain = query.model_copy(update={"sizes": (), "colors": (), "sides": (), "plural": True})
    there = ground(inventory, plain)[0]
    if not there.parts:
        there = ground(inventory, plain.model_copy(update={"adjectives": ()}))[0]
    if not there.parts or "nothing" in there.features:
        return ""
    values = sorted(v for size in query.sizes[:1] for part in there.parts for v in values_of(part, size.measure))
    return none_such(query, (*values[:1], *values[-1:]))


def _printed(inventory: Inventory, asked: str, way: Grounded, sides: Sequence[Side] | None) -> Grounded:
    """What is printed of parts means these; but a word that bodies are called by, or a kind of part, means those."""
    said = key(asked)
    parts = inventory.printed.get(said, ())
    other = "sense_named" in way.features and not any(holds(part.name, (said,)) for part in way.parts)  # a 'bushing'
    bodies = not other and "unknown_whole" not in way.features and any(part.kind.is_whole for part in way.parts)
    if not parts or any(part.kind == said for part in way.parts):
        return way
    if bodies and "," not in asked and not parts[0].kind.is_whole:
        return way
    seen = [part for part in parts if sides is None or set(sides) & set(part.sides)]
    return Grounded(parts=tuple(seen), features={"printed": 1.0})


def _by_score(way: Grounded) -> tuple[float, float]:
    """Without a number one part is as good as several; of equals what the file itself calls so comes first."""
    return round(score({**way.features, "one_for_plural": 0.0}), 1), way.features.get("name_share", 0.0)


def _wider(ways: Sequence[Grounded]) -> list[Grounded]:
    """Where several were said and the best way has one: the first that has others of its kind beside it, as well told.

    No body is one of several: what else a word may mean of bodies is all of them.
    """
    best = max(ways, key=_by_score)
    if len(best.parts) != 1 or best.parts[0].kind.is_whole:
        return []
    (one,) = best.parts
    more = [way for way in ways if len(way.parts) > 1 and one in way.parts and _far(way) <= _far(best)]
    return [way for way in more if all(part.kind == one.kind for part in way.parts)][:1]


def _far(way: Grounded) -> tuple[int, float]:
    return len(way.unchecked), way.features.get("sense_stretch", 0.0)


def _order(part: Part) -> tuple[str, int]:
    kind, _, number = part.id.rpartition("-")
    return kind, int(number) if number.isdecimal() else 0


def present(inventory: Inventory) -> tuple[str, ...]:
    """The kinds of part that the model has, most frequent first; bodies last, as every model has one."""
    counts = Counter(part.kind for part in inventory.parts if not part.kind.is_whole)
    return (*[kind for kind, _ in counts.most_common(6)], *(("body",) if inventory.bodies else ()))
