"""Rows and columns of like parts: how many there are, and how many parts are in each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from querycad_contracts import DRAWING_M, Part, PartQuery
from querycad_contracts.vectors import cross, norm, sub

from .builder import Builder, Unwritable


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
