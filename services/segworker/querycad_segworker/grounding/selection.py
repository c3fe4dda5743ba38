"""Which of them: exceptions, ranks, numbers, and one where the words say one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from querycad_contracts import Measure, Part, PartQuery, Rank
from querycad_language.lexicon import lexicon
from querycad_segworker.relations.nearby import to_nearest
from querycad_segworker.relations.orders import by_size, compared, extreme, size
from querycad_segworker.vectors import dot

from .candidates import Candidate, Request, kept, through, true_of

LARGER = 1.2  # what is so much larger than all others stands out by its size
MOST_GROUPS = 8  # of more sizes only the largest is a reading of 'the hole': nobody means the fourth of nine


def excepted(request: Request, way: Candidate) -> Iterator[Candidate]:
    """Without those that the words leave out: 'except the one in the middle'."""
    query = request.query
    for other in query.excluded:
        if other.noun in ("", "one", "ones"):
            other = other.model_copy(update={"noun": query.noun, "known": query.known})
        ids = {part.id for part in request.best(other)}
        left = [part for part in way.parts if part.id not in ids]
        way = way.to(left, "excluded" if len(left) < len(way.parts) else "excluded_nothing")
    yield way


def joined(request: Request, way: Candidate) -> Iterator[Candidate]:
    """With those of further kinds: 'holes and slots'."""
    parts = list(way.parts)
    for other in request.query.also:
        shared = other.model_copy(update={"sides": other.sides or request.query.sides})
        known = {part.id for part in parts}
        parts += [part for part in request.best(shared) if part.id not in known]
    yield way if not request.query.also else way.to(parts, "joined")


def ranked(request: Request, way: Candidate) -> Sequence[Candidate]:
    """'the largest', 'the second deepest', 'the one nearest to the edge'; there must be two for 'the second bore'."""
    return through([way], request.query.ranks, lambda way, rank: _in_order(request, way, rank))


def _in_order(request: Request, way: Candidate, rank: Rank) -> Sequence[Candidate]:
    if rank.is_unordered:
        unchecked = f"which is number {rank.nth}"
        if len(way.parts) >= rank.nth:
            return [way.to(way.parts, "nth_unchecked", unchecked=unchecked)]
        return kept(way, (), "nth", unchecked)
    if len(way.parts) > 1:
        first = _first_of(request, way.parts, rank)
        return [way.to(first or way.parts, "ranked" if first else "rank_dropped")]
    return [way.to(way.parts, "rank_of_one")] if way.parts else [way]


def _first_of(request: Request, parts: Sequence[Part], rank: Rank) -> list[Part]:
    most = rank.most
    if rank.side is not None:
        outward, most = rank.side.outward, True
        values = [round(dot(p.center, outward), 7) for p in parts]
    elif rank.near is not None:
        others = [other for other in request.best(rank.near) if other.kind != "model"]
        ids = {other.id for other in others}
        parts = [p for p in parts if others and p.id not in ids]
        values = list(map(to_nearest(others), parts))
    elif rank.edge:
        parts = [p for p in parts if p.edge_distance is not None]
        values = [p.edge_distance or 0.0 for p in parts]
    else:
        values = _values(parts, rank)
    return extreme(parts, values, most, rank.nth, rank.count)


def _values(parts: Sequence[Part], rank: Rank) -> list[float]:
    """What a superlative compares: of stepped holes the diameter that is told of them."""
    if rank.measure is Measure.HEIGHT and all(p.kind.cuts_in for p in parts):
        return [p.center[2] for p in parts]  # 'the highest hole', 'the lowest groove': where they are
    sized = rank.measure in (None, Measure.MAGNITUDE, Measure.DIAMETER, Measure.RADIUS)
    if sized and all(p.kind == "face" for p in parts):
        return [p.area or 0.0 for p in parts]
    return compared(parts, "size" if sized else str(rank.measure))


def counted(request: Request, way: Candidate) -> Sequence[Candidate]:
    """As many as are said, or a group of that many alike."""
    count = request.query.count
    if not count or request.query.ranks:
        return [way]
    if len(way.parts) == count:
        return [way.to(way.parts, "count_agrees")]
    groups = [group for group in by_size(way.parts) if len(group) == count]
    ordered = sorted(way.parts, key=size, reverse=True)
    stand_out = not groups and count < len(ordered) and size(ordered[count - 1]) > LARGER * size(ordered[count])
    largest = [way.to(ordered[:count], "count_largest")] if stand_out else []  # 'the two bores' among screw holes
    differs = min(2.0, abs(math.log((len(way.parts) or 0.5) / count)))
    return [
        *largest,
        *(way.to(group, "count_group", 1.0 / len(groups)) for group in groups[:3]),
        way.to(way.parts, "count_differs", differs),
    ]


def single(request: Request, way: Candidate) -> Sequence[Candidate]:
    """Of 'the hole' where there are several, all or those of one size; of 'the holes' too, which need not be all."""
    query, groups = request.query, by_size(way.parts)
    if not way.parts:
        return [way.to((), "empty")]
    if query.plural:
        if query.sample:
            return [way]  # all that are so, however many
        every = way.to(way.parts, "one_for_plural", float(len(way.parts) == 1))
        if not _is_loose(query, way) or query.count or query.ranks or not 1 < len(groups) <= MOST_GROUPS:
            return [every]  # 'the holes' are all of them, 'the grip studs' may be those of one size
        return [every, *_of_groups(query, way, [group for group in groups if len(group) > 1])]
    if len(groups) == 1:
        alone = len(way.parts) == 1 or any(rank.measure for rank in query.ranks)  # of several largest ones any is it
        return [way.to(way.parts, "one_for_one" if alone else "alike_for_one")]
    if query.sample:
        groups = []
    elif len(groups) > MOST_GROUPS:
        groups = [max(groups, key=lambda group: size(group[0]))]
    return [way.to(way.parts, "several_for_one"), *_of_groups(query, way, groups)]


def _is_loose(query: PartQuery, way: Candidate) -> bool:
    """Is some word of it not checked? Nothing checks the 'vent' of a vent slot; a tag checks a blind hole's 'blind'."""
    if way.unchecked or query.unknown or any(not place.relation for place in query.places):
        return True
    if way.features.get("sense_stretch") == 1:  # holes, where no screw is there
        return True
    noun = lexicon().nouns.get(query.noun)
    if noun is None or " " not in query.noun:
        return False
    first = noun.senses[0]
    return not (first.kind == ("face",) or any((*first.tags, *first.any)))  # planes are what 'flat face' says


def _of_groups(query: PartQuery, way: Candidate, groups: Sequence[Sequence[Part]]) -> Iterator[Candidate]:
    """Those of one kind and size."""
    sizes = [size(group[0]) for group in groups]
    for group, own in zip(groups, sizes, strict=True):
        told = true_of(
            group_for_plural=query.plural,
            group_for_one=not query.plural,
            group_one=len(group) == 1,
            group_largest=own == max(sizes),
            group_most=len(group) == max(map(len, groups)) > 1,
        )
        yield Candidate(tuple(group), way.features | told, way.unchecked)
