"""Rows and columns of like parts: how many there are, how many parts are in each, and how far apart they lie."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from querycad_contracts import DRAWING_M, Part, PartQuery, Vector
from querycad_contracts.vectors import coordinate_axis, cross, dot, norm, sub

from .builder import Builder, Read, Unwritable

ROWS = frozenset(("row", "row of hole", "hole row"))
"""Nouns that mean the rows, not what stands in them."""
_SQUARE = 1e-3
"""Cosine of directions that are square to each other: 0.06 degrees."""


def count_rows(build: Builder, target: PartQuery) -> str | None:
    """The program's number of rows or columns of parts, or of the parts in one of them; None where neither is asked.

    'The row of holes' is its holes. Raises Unwritable where there are not as many in each.
    """
    if (word := row_word(target)) is not None:
        found = _lines(build.of(target), word) if not target.definite else None
        if found is None:
            return None
        return "1" if len(found[1]) == 1 else _different(build, target, found[0])
    within = (row_word(place.what) for place in target.places if place.what is not None and _any_one(place.what))
    word = next(filter(None, within), None)
    return in_each(build, target, word) if word is not None else None


def in_each(build: Builder, target: PartQuery, word: str) -> str | None:
    """The program's number of parts in each 'row' or 'column'; None where all are one. Raises Unwritable."""
    found = _lines(build.of(target), word)
    if found is None or len(found[1]) == 1:
        return None
    if len(set(found[1].values())) > 1:
        raise Unwritable
    return f"len({build.parts(target)}) // {_different(build, target, found[0])}"


def row_word(query: PartQuery) -> str | None:
    """Which of 'row' and 'column' the noun says."""
    return next((word for word in ("row", "column") if word in query.noun.split()), None)


def _different(build: Builder, target: PartQuery, axis: int) -> str:
    return f"len(different([p.center[{axis}] for p in {build.parts(target)}], {DRAWING_M:g}))"


def _any_one(query: PartQuery) -> bool:
    """'In one row': not in a certain one, nor in all of them."""
    return not (query.plural or query.ranks or query.ends or query.sides)


def _lines(parts: Sequence[Part], word: str) -> tuple[int, Counter[int]] | None:
    """Along which axis rows (or columns) follow each other, and how many parts are in each; None of what has none.

    As one looks at the parts, from above with x to the right, from the front or a side with z up, rows run to the
    right and columns up, as in a matrix. Parts on one line are one row, and one column.
    """
    normal = parts[0].normal if parts else None
    if normal is None or len(parts) < 3 or not all(part.kind.cuts_in for part in parts):
        return None  # pillars are columns themselves
    steepest = max(range(3), key=lambda i: abs(normal[i]))
    right, up = ((1, 2), (0, 2), (0, 1))[steepest]
    axis = up if word == "row" else right
    first, last = parts[0].center, max((p.center for p in parts), key=lambda c: norm(sub(c, parts[0].center)))
    along = sub(last, first)
    if all(norm(cross(sub(p.center, first), along)) <= DRAWING_M * norm(along) for p in parts):
        return axis, Counter({0: len(parts)})
    found, at, reached = Counter[int](), -1, float("-inf")
    for place in sorted(p.center[axis] for p in parts):
        at += place - reached > DRAWING_M
        reached = place
        found[at] += 1
    return (axis, found) if 2 * len(found) <= len(parts) else None


def rows_apart(build: Builder, first: PartQuery, second: PartQuery | None, axis: int | None) -> str | None:
    """From one row to the next, square to both, as an expression; None where the parts do not lie in rows.

    As many rows as are said; else level ones. `axis`: x, y or z, where it is said.
    """
    queries = [query for query in (first, second) if query is not None]
    if any(query.noun not in ROWS or not build.of(query) for query in queries) or (second is None and not first.plural):
        return None
    ways = [way for way in _across(build.all_of(*queries)) if axis is None or coordinate_axis(way) == axis]
    if second is not None:
        ways = [way for way in ways if all(len(_levels(build.of(query), way)) == 1 for query in queries)]
    else:
        parts, said = build.of(first), first.count or 0
        rows = {way: len(_levels(parts, way)) for way in ways}
        ways = [way for way in ways if 2 <= rows[way] < len(parts) and rows[way] in (said or rows[way],)]
    if not ways or (len(ways) > 1 and (first.count is not None or second is not None)):
        return None
    way = ways[0 if "vertical" in first.adjectives else -1]
    at = f"sum(x * y for x, y in zip(p.center, {tuple(round(x, 9) for x in way)}))"
    names = [build.parts(query) for query in queries]
    build.lines.append(f"levels = different([{at} for p in {' + '.join(f'list({n})' for n in names)}], {DRAWING_M})")
    build.reads.append(Read("distance", str(build.of(first)[0].kind), "center", "own"))
    return "min(b - a for a, b in zip(levels, levels[1:]))"


def _across(parts: Sequence[Part]) -> list[Vector]:
    """The directions along which parts lie in rows and columns, the level one first: square to what they look along."""
    looks = next((way for part in parts[:1] for way in (part.axis, part.normal) if way is not None), None)
    ways = list(_coordinates())
    if looks is None:
        return ways
    level = [way for way in ways if abs(dot(way, looks)) < _SQUARE]
    return level if len(level) != 1 else [level[0], cross(looks, level[0])]


def _coordinates() -> Iterator[Vector]:
    yield from ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def _levels(parts: Sequence[Part], way: Vector) -> list[float]:
    """How far along a direction the middles of parts lie, each distance once."""
    found: list[float] = []
    for at in sorted(dot(part.center, way) for part in parts):
        if not found or at - found[-1] > DRAWING_M:
            found.append(at)
    return found
