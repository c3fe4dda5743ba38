"""Grounding: from a typed query to part sets of one model, each with what speaks for and against it.

Nothing is dropped in silence: what restricts and cannot be checked is said, and counted by a feature. Which of the sets is
meant is ranked by fitted weights (`querycad_language.weights`), here for a query alone, in answering with the question.
"""

from __future__ import annotations

import colorsys
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from querycad_contracts import Grounded, Measure, Part, PartQuery, Place, Rank, Relation, SizeFilter
from querycad_language.lexicon import Sense, lexicon
from querycad_language.weights import weights
from querycad_segworker.vectors import dot, norm, sub

from .inventory import THREAD_TOLERANCE_M, Inventory, by_size, extreme, measured, values_of
from .names import all_words
from .places import coaxial, encloses, held, is_inside, lies_between, next_to, touches

BEAM = 12
"""So many ways to ground a query are followed; the rest speaks against itself."""
MOST_GROUPS = 5
"""Of more sizes only the largest is a reading of 'the hole': nobody means the fourth of nine."""
DRAWN_M = 0.05e-3
"""Stated sizes are met to drawing accuracy, or to half of their last digit."""
NEAR = 0.02
"""A nominal size may differ by this share from what is modelled."""


@dataclass(frozen=True, slots=True)
class _Way:
    """One way to ground the query, as far as it has come."""

    parts: tuple[Part, ...]
    features: dict[str, float]
    unchecked: tuple[str, ...] = ()

    def to(self, parts: Sequence[Part], feature: str, value: float = 1.0, unchecked: str = "") -> _Way:
        """The way with other parts and one more feature."""
        features = {**self.features, feature: self.features.get(feature, 0.0) + value}
        return _Way(tuple(parts), features, (*self.unchecked, unchecked) if unchecked else self.unchecked)


def ground(inventory: Inventory, query: PartQuery, limit: int = BEAM, depth: int = 0) -> list[Grounded]:
    """The part sets that a query can mean on this model, best first; never none: the last resort is the empty set."""
    if query.ids:
        return [_by_id(inventory, query)]
    ways = list(_bases(inventory, query))
    for step in (
        _colored,
        _threaded,
        _narrowed,
        _sized,
        _placed,
        _seen,
        _excepted,
        _joined,
        _ranked,
        _counted,
        _single,
    ):
        ways = _pruned([after for way in ways for after in step(inventory, query, way, depth)])
    return [Grounded(parts=way.parts, features=way.features, unchecked=way.unchecked) for way in ways[:limit]]


def score(features: dict[str, float]) -> float:
    """How much speaks for a grounding: the fitted weights of its features, added up."""
    table = weights()
    return math.fsum(table.get(name, 0.0) * value for name, value in features.items())


def _pruned(ways: list[_Way]) -> list[_Way]:
    best: dict[tuple[str, ...], _Way] = {}
    for way in sorted(ways, key=lambda way: score(way.features), reverse=True):
        key = (*(part.id for part in way.parts), *way.unchecked)
        best.setdefault(key, way)
    return list(best.values())[:BEAM]


def _by_id(inventory: Inventory, query: PartQuery) -> Grounded:
    parts = tuple(inventory.by_id[i] for i in query.ids if i in inventory.by_id)
    missing = [i for i in query.ids if i not in inventory.by_id]
    features = {"by_id": 1.0} if not missing else {"id_missing": 1.0}
    return Grounded(
        parts=parts if not missing else (), features=features, reason=f"no part {', '.join(missing)}" if missing else ""
    )


# What the noun means


def _bases(inventory: Inventory, query: PartQuery) -> Iterator[_Way]:
    """Every sense of the noun that the model has parts for, names of bodies, and the whole model."""
    noun = lexicon().nouns.get(query.noun) if query.known else None
    words = [word for word in query.words if word not in ("the",)] or query.noun.split()
    found = False
    for body_words in {tuple(words), tuple(query.noun.split())}:
        named = inventory.body_named(body_words)
        if named:
            best = max(score for _, score in named)
            bodies = [body for body, score in named if score == best]
            found = True
            yield _Way(tuple(bodies), {"by_name": 1.0, "name_share": best, "name_all": float(best == 1.0)})
    if inventory.model is not None and inventory.file_named(words):
        found = True
        yield _Way((inventory.model,), {"file_named": 1.0, "whole_sense": 1.0, "named_words": float(len(words) > 1)})
    if noun is not None:
        yield from _senses(inventory, noun.senses, noun.product)
        bare = query.definite and not (
            query.plural or query.places or query.sides or query.ends or query.ranks or query.sizes
        )
        if bare and inventory.alone and inventory.model is not None and not noun.product:
            yield _Way((inventory.model,), {"whole_generic": 1.0, "whole_sense": 1.0})  # 'the pin' is all there is
        return
    if not query.noun:
        holes = inventory.kinds.get("hole")
        yield _Way(tuple(holes or inventory.parts), {"no_noun": 1.0})
        return
    if not found:
        last = lexicon().nouns.get(words[-1]) if words else None
        if last is not None and len(words) > 1:
            for way in _senses(inventory, last.senses, last.product):
                yield way.to(way.parts, "unknown_words", float(len(words) - 1), f"'{' '.join(words[:-1])}'")
        if inventory.model is not None and not query.plural:
            yield _Way((inventory.model,), {"unknown_whole": 1.0, "whole_sense": 1.0})
        yield _Way((), {"unknown_noun": 1.0}, (f"'{query.noun}'",))


def _senses(inventory: Inventory, senses: Sequence[Sense], product: bool) -> Iterator[_Way]:
    seen: set[tuple[str, ...]] = set()
    rank = 0
    for sense in senses:
        parts = inventory.of_sense(sense)
        key = tuple(part.id for part in parts)
        if not parts or key in seen:
            continue
        seen.add(key)
        features = {"sense_stretch": sense.stretch, "sense_rank": float(rank)}
        rank += 1
        if sense.name:
            features["sense_named"] = 1.0
        if parts[0].kind == "model":
            features["whole_sense"] = 1.0
            if inventory.alone:
                features["whole_alone"] = 1.0
        yield _Way(tuple(parts), features)
    if product and inventory.model is not None and not any("model" in sense.kind for sense in senses):
        yield _Way((inventory.model,), {"whole_sense": 1.0, "sense_stretch": 0.5})
    if rank == 0:
        yield _Way((), {"nothing": 1.0})


# What restricts


def _kept(way: _Way, kept: Sequence[Part], name: str, said: str) -> Iterator[_Way]:
    """Those that a restriction keeps; where it keeps none: none at all, or all with the restriction unchecked."""
    if kept:
        yield way.to(kept, f"{name}_agrees")
        return
    if not way.parts:
        yield way
        return
    yield way.to((), f"{name}_empties")
    yield way.to(way.parts, f"{name}_dropped", unchecked=said)


def _colored(inventory: Inventory, query: PartQuery, way: _Way, _: int) -> Iterator[_Way]:
    if not query.colors:
        yield way
        return
    hues = lexicon().hues
    color = query.colors[0]
    yield from _kept(way, [p for p in way.parts if _has_color(p.color, color, hues)], "color", f"'{color}'")
    if query.noun in ("", "body", "object"):
        bodies = [b for b in inventory.bodies if _has_color(b.color, color, hues)]
        if bodies and not any(b in way.parts for b in bodies):
            yield way.to(bodies, "color_agrees")


def _threaded(inventory: Inventory, query: PartQuery, way: _Way, _: int) -> Iterator[_Way]:
    if not query.threads:
        yield way
        return
    name = query.threads[0]
    nominal = lexicon().threads.get(name) or lexicon().threads.get(name.partition("x")[0]) or ()
    size = float(name[1:].partition("x")[0]) * 1e-3 if name[0] == "m" else 0.0
    marked = [
        p
        for p in way.parts
        if p.kind == "body" and any(w == name or w.startswith(f"{name}x") for w in all_words(p.name))
    ]
    fitting = [
        p
        for p in way.parts
        if any(abs(v - d) <= THREAD_TOLERANCE_M for v in values_of(p, Measure.DIAMETER) for d in (*nominal, size))
    ]
    yield from _kept(way, marked or fitting, "thread", f"'{name}'")


def _narrowed(inventory: Inventory, query: PartQuery, way: _Way, _: int) -> Iterator[_Way]:
    """Adjectives, and what the parts must not have; words that are not known, which the names of bodies may hold."""
    ways = [way]
    for name in query.adjectives:
        ways = [after for one in ways for after in _adjective(inventory, query, one, name)]
    for name in query.lacking:
        adjective = lexicon().adjectives.get(name)
        if adjective is not None:
            tags = (*adjective.tags, *adjective.fallback[: 0 if adjective.loose else None])
            ways = [one.to([p for p in one.parts if not inventory.has(p, tags)], "lacking") for one in ways]
    if query.unknown:
        for one in ways:
            marked = [
                p for p in one.parts if p.kind == "body" and all(word in all_words(p.name) for word in query.unknown)
            ]
            whole = inventory.file_named(query.unknown)
            if marked:
                yield one.to(marked, "unknown_named")
            elif whole:
                yield one.to(one.parts, "unknown_is_file")
            else:
                said = f"'{' '.join(query.unknown)}'"
                yield one.to(one.parts, "unknown_words", float(len(query.unknown)), said)
                groups = by_size(one.parts)
                for group in groups if 1 < len(groups) < 5 and query.plural else ():  # the word may say which size
                    yield one.to(group, "unknown_group", 1.0, said)
        return
    yield from ways


def _adjective(inventory: Inventory, query: PartQuery, way: _Way, name: str) -> Iterator[_Way]:
    adjective = lexicon().adjectives.get(name)
    if adjective is None or not way.parts:
        yield way
        return
    kept = [p for p in way.parts if inventory.has(p, adjective.tags)] if adjective.tags else []
    wider = [p for p in way.parts if inventory.has(p, adjective.fallback)] if adjective.fallback else []
    if adjective.whole:
        yield way.to(way.parts, "whole_adjective" if way.features.get("whole_sense") else "adjective_nothing")
    elif kept and not (adjective.order and len(kept) == len(way.parts)):
        yield way.to(kept, "adjective_agrees")
    elif wider:
        yield way.to(wider, "adjective_wider")
    elif adjective.order:
        ordered = inventory.ordered(way.parts, adjective, query.count)
        narrowed = len(ordered) < len(way.parts)
        yield way.to(ordered, "adjective_order" if narrowed else "adjective_nothing")
        if narrowed:
            yield way.to(way.parts, "adjective_dropped", unchecked=f"'{name}'")
    elif adjective.lacks:
        yield way.to([p for p in way.parts if not inventory.has(p, adjective.lacks)], "adjective_agrees")
    elif not adjective.tags:
        yield way.to(way.parts, "adjective_unchecked" if adjective.unchecked else "adjective_nothing")
    else:
        yield way.to(way.parts, "adjective_loose" if adjective.loose else "adjective_dropped", unchecked=f"'{name}'")
        if not adjective.loose:
            yield way.to((), "adjective_empties")


def _sized(inventory: Inventory, query: PartQuery, way: _Way, _: int) -> Iterator[_Way]:
    ways = [way]
    for size in query.sizes:
        ways = [after for one in ways for after in _of_size(one, size)]
    yield from ways


def _of_size(way: _Way, size: SizeFilter) -> Iterator[_Way]:
    said = f"'{size.low * 1e3:.4g} mm'"
    exact = [p for p in way.parts if any(compares(v, size) for v in values_of(p, size.measure))]
    if exact or size.relation not in (Relation.EQUAL, Relation.ABOUT):
        yield from _kept(way, exact, "size", said)
        return
    near = [p for p in way.parts if any(abs(v - size.low) <= NEAR * size.low for v in values_of(p, size.measure))]
    if near:
        yield way.to(near, "size_near")
        return
    other = (
        [p for p in way.parts if any(compares(v, size) for m in Measure for v in values_of(p, m))]
        if size.measure
        else []
    )
    if other:
        yield way.to(other, "size_of_other_measure")
    yield from _kept(way, [], "size", said)


def compares(value: float, size: SizeFilter) -> bool:
    """Does a value compare so with a stated size? Metres; equal is within drawing accuracy or half a per cent."""
    slack = 1e-6
    match size.relation:
        case Relation.EQUAL:
            return abs(value - size.low) <= max(DRAWN_M if size.low > 1e-3 else 0.05 * size.low, 0.002 * size.low)
        case Relation.ABOUT:
            return abs(value - size.low) <= 0.1 * size.low
        case Relation.UNEQUAL:
            return abs(value - size.low) > DRAWN_M
        case Relation.LESS:
            return value < size.low - slack
        case Relation.AT_MOST:
            return value <= size.low + slack
        case Relation.MORE:
            return value > size.low + slack
        case Relation.AT_LEAST:
            return value >= size.low - slack
        case Relation.BETWEEN:
            low, high = sorted((size.low, size.high or size.low))
            return low - slack <= value <= high + slack


# Where they are


def _placed(inventory: Inventory, query: PartQuery, way: _Way, depth: int) -> Iterator[_Way]:
    ways = [way]
    for place in query.places:
        ways = _pruned([after for one in ways for after in _at_place(inventory, one, place, depth)])
    yield from ways


def _at_place(inventory: Inventory, way: _Way, place: Place, depth: int) -> Iterator[_Way]:
    if place.what is None or not way.parts or depth > 3:
        yield way
        return
    name = "compound" if not place.relation else "trait" if place.relation == "with" else "place"
    said = f"'{place.relation} {place.what.noun}'".replace("' ", "'")
    holders = ground(inventory, place.what, limit=3, depth=depth + 1)
    found = False
    for grounded in holders:
        if not grounded.parts:
            continue
        if grounded.parts[0].kind == "model":
            found = True
            yield way.to(way.parts, f"{name}_whole", 1.0)
            continue
        parts = [p for p in grounded.parts if not place.side or place.side in p.sides or inventory.alone]
        kept = related(way.parts, place.relation, parts or list(grounded.parts))
        if place.side is not None:
            kept = [p for p in kept if place.side in p.sides] or kept
        if place.negated:
            kept = [p for p in way.parts if p not in kept]
        if kept:
            found = True
            worth = _way_of(grounded)
            yield replace(
                way.to(kept, f"{name}_holds"),
                features={
                    **way.to(kept, f"{name}_holds").features,
                    f"{name}_score": way.features.get(f"{name}_score", 0.0) + worth,
                },
            )
    if place.relation == "for":
        yield way.to(way.parts, "purpose")
        return
    known = any(grounded.parts for grounded in holders)
    yield way.to(way.parts, f"{name}_dropped" if known else f"{name}_unknown", unchecked=said)
    if not found and known:
        yield way.to((), f"{name}_empties")
    elif not known and place.relation == "with":
        yield way.to(() if not place.negated else way.parts, f"{name}_empties")


def _way_of(grounded: Grounded) -> float:
    """What speaks for a holder, as one number that is 0 for a plain one."""
    return max(-5.0, min(1.0, score(grounded.features)))


def related(found: Sequence[Part], relation: str, holders: Sequence[Part]) -> list[Part]:
    """Those that stand so to one of the holders; none where the relation is not known."""
    others = [h for h in holders]
    match relation:
        case "with":
            having = [p for p in found if any(h.id != p.id and is_inside(h, p) for h in others)]
            return having or next_to(found, others)
        case "near":
            return next_to(found, others)
        case "between":
            return (
                [p for p in found if p.id not in {h.id for h in others} and lies_between(p, others)]
                if len(others) > 1
                else []
            )
        case "around":
            around = [p for p in found if any(encloses(p, h) for h in others)]
            return around or [p for p in found if p.kind in ("fillet", "round", "chamfer") and next_to([p], others)]
        case "above" | "below" | "left" | "right" | "front" | "behind":
            axis, sign = {
                "above": (2, 1),
                "below": (2, -1),
                "left": (0, -1),
                "right": (0, 1),
                "front": (1, -1),
                "behind": (1, 1),
            }[relation]
            return [
                p
                for p in found
                if any(h.id != p.id and sign * (p.center[axis] - h.center[axis]) > 5e-5 for h in others)
            ]
        case "opposite":
            return [
                p
                for p in found
                if any(h.id != p.id and p.normal and h.normal and dot(p.normal, h.normal) < -0.9 for h in others)
            ]
        case "through":
            return held(found, "in", others) or [p for p in found if any(touches(p, h) for h in others)]
        case "":
            own = held(found, "", others)
            return (
                own
                or [p for p in found if any(coaxial(p, h) and touches(p, h) for h in others)]
                or next_to(found, others)
            )
        case _:
            own = held(found, "of" if relation == "for" else relation, others)
            return own or [p for p in found if any(h.id in p.children for h in others)]


def _seen(inventory: Inventory, query: PartQuery, way: _Way, _: int) -> Iterator[_Way]:
    """Those visible from the sides; at that end; facing there. 'The left leg' is the leftmost one."""
    ways = [way]
    if query.ends and way.parts:
        named = [p for p in way.parts if any(side.value in all_words(p.name) for side in query.ends)]
        ends = inventory.at_end(way.parts, query.ends)
        seen = [p for p in way.parts if set(query.ends) & set(p.sides)]
        facing = inventory.facing(way.parts, query.ends)
        ways = [way.to(named, "end_named")] if named else [way.to(ends, "end_adjective")]
        if seen and not named and len(seen) < len(way.parts):
            ways.append(way.to(seen, "end_seen"))
        if facing and not named:
            ways.append(way.to(facing, "end_facing"))
    if query.sides:
        ways = [after for one in ways for after in _from_sides(inventory, query, one)]
    if query.unseen:
        ways = [one.to([p for p in one.parts if not set(query.unseen) & set(p.sides)], "side_agrees") for one in ways]
    yield from ways


def _from_sides(inventory: Inventory, query: PartQuery, way: _Way) -> Iterator[_Way]:
    if not way.parts:
        yield way
        return
    seen = [p for p in way.parts if set(query.sides) & set(p.sides)]
    if seen:
        yield way.to(seen, "side_agrees")
        standing = inventory.facing(seen, query.sides)
        if standing and len(standing) < len(seen):
            yield way.to(standing, "side_facing")
    else:
        yield way.to((), "side_empties")
    facing = inventory.facing(way.parts, query.sides)
    if facing and not seen:
        yield way.to(facing, "side_facing_unseen")
    ends = inventory.at_end(way.parts, query.sides)
    if ends and len(ends) < len(way.parts):
        yield way.to(ends, "side_end" if not seen else "side_end_instead")


# Which of them


def _excepted(inventory: Inventory, query: PartQuery, way: _Way, depth: int) -> Iterator[_Way]:
    kept = list(way.parts)
    features = way
    for other in query.excluded:
        if other.noun == "" or other.noun in ("one", "ones"):
            other = other.model_copy(update={"noun": query.noun, "known": query.known})
        best = ground(inventory, other, limit=1, depth=depth + 1)
        ids = {part.id for part in best[0].parts} if best else set()
        left = [p for p in kept if p.id not in ids]
        features = features.to(left, "excluded" if len(left) < len(kept) else "excluded_nothing")
        kept = left
    yield _Way(tuple(kept), features.features, features.unchecked)


def _joined(inventory: Inventory, query: PartQuery, way: _Way, depth: int) -> Iterator[_Way]:
    parts = list(way.parts)
    for other in query.also:
        shared = other.model_copy(update={"sides": other.sides or query.sides})
        best = ground(inventory, shared, limit=1, depth=depth + 1)
        parts += [p for p in (best[0].parts if best else ()) if p.id not in {q.id for q in parts}]
    yield way if not query.also else way.to(parts, "joined")


def _ranked(inventory: Inventory, query: PartQuery, way: _Way, depth: int) -> Iterator[_Way]:
    for rank in query.ranks:
        if len(way.parts) > 1:
            kept = _first_of(inventory, way.parts, rank, depth)
            way = way.to(kept or way.parts, "ranked" if kept else "rank_dropped")
        elif way.parts:
            way = way.to(way.parts, "rank_of_one")
    yield way


def _first_of(inventory: Inventory, parts: Sequence[Part], rank: Rank, depth: int) -> list[Part]:
    key: Callable[[Part], float]
    if rank.side is not None:
        side = rank.side
        return extreme(parts, [round(dot(p.center, side.outward), 7) for p in parts], True, rank.nth, rank.count)
    if rank.near is not None:
        best = ground(inventory, rank.near, limit=1, depth=depth + 1)
        others = [o for o in (best[0].parts if best else ()) if o.kind != "model"]
        if not others:
            return []
        parts = [p for p in parts if p.id not in {o.id for o in others}]
        if not parts:
            return []
        return extreme(
            parts, [min(norm(sub(p.center, o.center)) for o in others) for p in parts], rank.most, rank.nth, rank.count
        )
    if rank.edge:
        known = [(p, p.edge_distance) for p in parts if p.edge_distance is not None]
        return (
            extreme([p for p, _ in known], [d for _, d in known if d is not None], rank.most, rank.nth, rank.count)
            if known
            else []
        )
    order = {Measure.MAGNITUDE: "size", Measure.DIAMETER: "size", Measure.RADIUS: "size"}.get(
        rank.measure or Measure.MAGNITUDE, (rank.measure or "size")
    )
    if order == "height" and all(p.kind == "hole" for p in parts):  # 'the highest hole' by where it is
        return extreme(parts, [p.center[2] for p in parts], rank.most, rank.nth, rank.count)
    values = [
        max(p.radii)
        if order == "size" and p.radii and rank.most
        else min(p.radii)
        if order == "size" and p.radii
        else measured(p, str(order))
        for p in parts
    ]
    return extreme(parts, values, rank.most, rank.nth, rank.count)


def _counted(inventory: Inventory, query: PartQuery, way: _Way, _: int) -> Iterator[_Way]:
    if not query.count or query.ranks:
        yield way
        return
    if len(way.parts) == query.count:
        yield way.to(way.parts, "count_agrees")
        return
    groups = [group for group in by_size(way.parts) if len(group) == query.count]
    for group in groups[:3]:
        yield way.to(group, "count_group", 1.0 / len(groups))
    yield way.to(way.parts, "count_differs", min(2.0, abs(math.log((len(way.parts) or 0.5) / query.count))))


def _single(inventory: Inventory, query: PartQuery, way: _Way, _: int) -> Iterator[_Way]:
    """Of 'the hole' where there are several: all, the largest, those of the most numerous size, the central one."""
    if not way.parts:
        yield way.to((), "empty")
        return
    if query.plural:
        yield way.to(way.parts, "one_for_plural", float(len(way.parts) == 1))
        return
    if len(way.parts) == 1:
        yield way.to(way.parts, "one_for_one")
        return
    groups = by_size(way.parts)
    if len(groups) == 1:
        yield way.to(way.parts, "alike_for_one")
        return
    yield way.to(way.parts, "several_for_one")
    if query.sample or len(groups) > MOST_GROUPS:
        groups = [max(groups, key=lambda group: measured(group[0], "size"))] if not query.sample else []
    sizes = [measured(group[0], "size") for group in groups]
    for group, size in zip(groups, sizes, strict=True):
        features = {
            "group_for_one": 1.0,
            "group_one": float(len(group) == 1),
            "group_largest": float(size == max(sizes)),
            "group_smallest": float(size == min(sizes)),
            "group_most": float(len(group) == max(map(len, groups)) > 1),
            "group_central": float(any("central" in part.tags for part in group)),
        }
        yield _Way(
            tuple(group), {**way.features, **{name: value for name, value in features.items() if value}}, way.unchecked
        )


def _has_color(color: str | None, name: str, hues: dict[str, tuple[float, float]]) -> bool:
    """Does a hexadecimal colour go by this name? Greys by saturation below 15 %, black and white by brightness."""
    if color is None:
        return False
    r, g, b = (int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))
    hue, saturation, value = colorsys.rgb_to_hsv(r, g, b)
    if name == "black":
        return value < 0.2
    if name == "white":
        return saturation < 0.15 and value > 0.9
    if name in ("gray", "silver"):
        return saturation < 0.15 and 0.2 <= value <= 0.9
    low, high = hues[name]
    degrees = math.degrees(hue * math.tau)
    inside = low <= degrees < high if low < high else degrees >= low or degrees < high
    return saturation >= 0.15 and value >= 0.2 and inside
