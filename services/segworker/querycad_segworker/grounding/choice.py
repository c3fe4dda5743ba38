"""Which of them: exceptions, ranks, numbers, and one where the words say one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from querycad_contracts import Measure, Part, Rank
from querycad_language.lexicon import lexicon
from querycad_segworker.relations.nearby import to_nearest
from querycad_segworker.vectors import dot

from .inventory import by_size, extreme, measured
from .ways import Request, Way

MOST_GROUPS = 8
"""Of more sizes only the largest is a reading of 'the hole': nobody means the fourth of nine."""


def excepted(request: Request, way: Way) -> Iterator[Way]:
    """Without those that the words leave out: 'except the one in the middle'."""
    query = request.query
    for other in query.excluded:
        if other.noun in ("", "one", "ones"):
            other = other.model_copy(update={"noun": query.noun, "known": query.known})
        ids = {part.id for part in request.best(other)}
        left = [part for part in way.parts if part.id not in ids]
        way = way.to(left, "excluded" if len(left) < len(way.parts) else "excluded_nothing")
    yield way


def joined(request: Request, way: Way) -> Iterator[Way]:
    """With those of further kinds: 'holes and slots'."""
    parts = list(way.parts)
    for other in request.query.also:
        shared = other.model_copy(update={"sides": other.sides or request.query.sides})
        known = {part.id for part in parts}
        parts += [part for part in request.best(shared) if part.id not in known]
    yield way if not request.query.also else way.to(parts, "joined")


def ranked(request: Request, way: Way) -> Iterator[Way]:
    """'the largest', 'the second deepest', 'the one nearest to the edge'."""
    for rank in request.query.ranks:
        if len(way.parts) > 1:
            kept = _first_of(request, way.parts, rank)
            way = way.to(kept or way.parts, "ranked" if kept else "rank_dropped")
        elif way.parts:
            way = way.to(way.parts, "rank_of_one")
    yield way


def _first_of(request: Request, parts: Sequence[Part], rank: Rank) -> list[Part]:
    if rank.side is not None:
        outward = rank.side.outward
        return extreme(parts, [round(dot(p.center, outward), 7) for p in parts], True, rank.nth, rank.count)
    if rank.near is not None:
        others = [other for other in request.best(rank.near) if other.kind != "model"]
        parts = [p for p in parts if p.id not in {other.id for other in others}]
        if not others or not parts:
            return []
        values = list(map(to_nearest(others), parts))
    elif rank.edge:
        parts = [p for p in parts if p.edge_distance is not None]
        values = [p.edge_distance for p in parts if p.edge_distance is not None]
        if not parts:
            return []
    else:
        values = _values(parts, rank)
    return extreme(parts, values, rank.most, rank.nth, rank.count)


def _values(parts: Sequence[Part], rank: Rank) -> list[float]:
    """What a superlative compares; of stepped parts the widest or the narrowest step."""
    sized = rank.measure in (None, Measure.MAGNITUDE, Measure.DIAMETER, Measure.RADIUS)
    if rank.measure is Measure.HEIGHT and all(p.kind == "hole" for p in parts):
        return [p.center[2] for p in parts]  # 'the highest hole' by where it is
    step = max if rank.most else min
    order = "size" if sized else str(rank.measure)
    if sized and all(p.kind == "face" for p in parts):
        return [p.area or 0.0 for p in parts]
    return [step(p.radii) if sized and p.radii else measured(p, order) for p in parts]


def counted(request: Request, way: Way) -> Iterator[Way]:
    """As many as are said, or a group of that many alike."""
    if not request.query.count or request.query.ranks:
        yield way
        return
    if len(way.parts) == request.query.count:
        yield way.to(way.parts, "count_agrees")
        return
    groups = [group for group in by_size(way.parts) if len(group) == request.query.count]
    for group in groups[:3]:
        yield way.to(group, "count_group", 1.0 / len(groups))
    yield way.to(way.parts, "count_differs", min(2.0, abs(math.log((len(way.parts) or 0.5) / request.query.count))))


def single(request: Request, way: Way) -> Iterator[Way]:
    """Of 'the hole' where there are several, all or those of one size; of 'the holes' too, which need not be all."""
    if not way.parts:
        yield way.to((), "empty")
        return
    groups = by_size(way.parts)
    if request.query.plural:
        yield way.to(way.parts, "one_for_plural", float(len(way.parts) == 1))
        query = request.query
        # Nothing checks the 'vent' of a vent slot; a tag checks the 'blind' of a blind hole.
        noun = lexicon().nouns.get(query.noun)
        flat = noun is not None and noun.senses[0].kind == ("face",)  # planes, which 'flat face' says
        loose = (
            noun is not None and " " in query.noun and not (flat or any((*noun.senses[0].tags, *noun.senses[0].any)))
        )
        told = way.unchecked or query.unknown or loose or any(not place.relation for place in query.places)
        if not told or query.count or query.ranks or not 1 < len(groups) <= MOST_GROUPS:
            return  # 'the holes' are all of them, 'the grip studs' may be those of one size
        groups = [group for group in groups if len(group) > 1]
    elif len(way.parts) == 1:
        yield way.to(way.parts, "one_for_one")
        return
    elif len(groups) == 1:
        yield way.to(way.parts, "alike_for_one")
        return
    else:
        yield way.to(way.parts, "several_for_one")
        if request.query.sample or len(groups) > MOST_GROUPS:
            groups = [max(groups, key=lambda group: measured(group[0], "size"))] if not request.query.sample else []
    sizes = [measured(group[0], "size") for group in groups]
    for group, size in zip(groups, sizes, strict=True):
        features = {
            "group_for_plural" if request.query.plural else "group_for_one": 1.0,
            "group_unchecked": float(bool(way.unchecked and request.query.plural)),
            "group_one": float(len(group) == 1),
            "group_largest": float(size == max(sizes)),
            "group_smallest": float(size == min(sizes)),
            "group_most": float(len(group) == max(map(len, groups)) > 1),
            "group_central": float(any("central" in part.tags for part in group)),
        }
        yield Way(
            tuple(group), {**way.features, **{name: value for name, value in features.items() if value}}, way.unchecked
        )
