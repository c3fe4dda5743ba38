"""Which measures does a question name: 'the maximum depth', 'different radii', 'width, depth and height'?"""

from __future__ import annotations

from dataclasses import dataclass, replace

from .lexicon import LEXICON
from .meaning import ENDS, Measure, Reduce
from .text import Text

EXTENTS = {Measure.WIDTH, Measure.DEPTH, Measure.HEIGHT, Measure.LENGTH}
SCALARS = frozenset(Measure) - {
    Measure.SIZE, Measure.HALF_SIZE, Measure.POSITION, Measure.OPENING, Measure.TIP, Measure.AXIS, Measure.NORMAL,
    Measure.DIRECTION, Measure.NAME, Measure.KIND, Measure.COLOR, Measure.SIDES, Measure.BOTTOM, *ENDS,
}  # fmt: skip
BORES = {
    ("inner", Measure.OUTER_DIAMETER): Measure.INNER_DIAMETER,
    ("inner", Measure.OUTER_RADIUS): Measure.INNER_RADIUS,
    ("outer", Measure.INNER_DIAMETER): Measure.OUTER_DIAMETER,
    ("outer", Measure.INNER_RADIUS): Measure.OUTER_RADIUS,
}
BORE_WORDS = {
    "inner": "inner",
    "inside": "inner",
    "internal": "inner",
    "outer": "outer",
    "outside": "outer",
    "external": "outer",
}


@dataclass(frozen=True, slots=True)
class Asked:
    """Measures as they are named, with what is to become of their values."""

    measures: tuple[Measure, ...]
    reduce: Reduce = Reduce.EACH
    nth: int = 1
    plural: bool = False


def asked_measures(text: Text, start: int, end: int) -> tuple[Asked, int] | None:
    """Which measures are named here: 'the maximum depth', 'different radii', 'width, depth and height'?"""
    wanted, at = _reduction(text, start, end)
    if coordinates := _coordinates(text, at, end):
        return replace(wanted, measures=coordinates[0]), coordinates[1]
    measures: list[Measure] = []
    plural = False
    while True:
        both = _inner_and_outer(text, at, end) if not measures else None
        if both:
            measures.extend(both[0])
            at = both[1]
        elif (named := text.match("property", at, end)) and not is_part(text, at, named[1], end):
            measures.append(Measure(named[0]))
            several = LEXICON.is_plural(text.words[named[1] - 1]) and text.words[named[1] - 1] != "flats"
            plural = plural or (measures[-1] in SCALARS | {Measure.NAME} and several)
            at = named[1]
        else:
            break
        rest = text.skip(at, end, "conjunction", "article", "noise")
        rest = text.skip(rest, end, "whole_adjective") if rest > at else rest
        if not (text.match("property", rest, end) and (rest > at or measures[-1] is Measure.SIZE)):
            break
        at = rest
    if not measures:
        return None
    return replace(wanted, measures=_as_size(tuple(dict.fromkeys(measures))), plural=plural), at


def _reduction(text: Text, start: int, end: int) -> tuple[Asked, int]:
    """What is said before a measure's name: 'the maximum', 'different', 'second largest', 'overall'."""
    wanted, at = Asked(()), start
    while True:
        at = text.skip(at, end, "article", "noise", "quantifier")
        if text.match("property", at, end) or _inner_and_outer(text, at, end):
            return wanted, at
        if found := text.match("reduce", at, end) or text.match("extreme", at, end):
            wanted, at = replace(wanted, reduce=Reduce(found[0])), found[1]
        elif ordinal := text.match("ordinal", at, end):
            wanted, at = replace(wanted, nth=int(ordinal[0])), ordinal[1]
        elif (after := text.after("whole_adjective", at, end)) and not text.match("whole", at, end):
            at = after
        else:
            return wanted, at


def _coordinates(text: Text, start: int, end: int) -> tuple[tuple[Measure, ...], int] | None:
    """'x and y coordinates', 'x, y and z coordinates'."""
    axes: list[Measure] = []
    at = start
    while text.word_at(at, end, "x", "y", "z"):
        axes.append(Measure(text.words[at]))
        at = text.skip(at + 1, end, "conjunction", "article")
    named = text.match("property", at, end) if len(axes) > 1 else None
    if named is None or named[0] != Measure.POSITION:
        last = text.match("property", at - 1, end) if len(axes) > 1 else None
        named = last if last and last[0] in "xyz" else None
    if named is None:
        return None
    return ((Measure.POSITION,) if len(set(axes)) == 3 else tuple(dict.fromkeys(axes))), named[1]


def _inner_and_outer(text: Text, start: int, end: int) -> tuple[list[Measure], int] | None:
    """'inner and outer diameter'."""
    kind = BORE_WORDS.get(text.words[start]) if start < end else None
    joined = text.after("conjunction", start + 1, end) if kind else None
    second = text.match("property", text.skip(joined, end), end) if joined else None
    if kind is None or second is None or (kind, Measure(second[0])) not in BORES:
        return None
    measure = Measure(second[0])
    return [BORES[kind, measure], measure], second[1]


def is_part(text: Text, start: int, after: int, end: int) -> bool:
    """Is 'opening' a part here ('the width of the opening') and no point of one ('the opening of the hole')?"""
    return text.word_at(start, end, "opening", "openings") and not text.word_at(after, end, "of", "point", "center")


def _as_size(measures: tuple[Measure, ...]) -> tuple[Measure, ...]:
    """The three extents together, or dimensions named one by one, are the size."""
    named = set(measures) - {Measure.SIZE, Measure.MAGNITUDE}
    if len(named) < len(measures) and len(named) == 3 and named <= EXTENTS:
        return (Measure.SIZE,)
    if measures in ((Measure.WIDTH, Measure.DEPTH, Measure.HEIGHT),):
        return (Measure.SIZE,)
    return measures
