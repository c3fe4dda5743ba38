"""Is an answer right? By the published rule of CAD-Q&A (strict), and within an engineer's tolerance (tolerant).

Strict: the answer is a Python literal; floats are rounded to 4 decimals (0.1 mm, as lengths are metres), a list of one
element is unwrapped, both lists are sorted where the label is in no particular order, and the texts must be equal. A
label that is a set is compared with the different values of the answer. A label that starts with `re` is a regular
expression that the whole printed answer must match. Two things the published rule leaves open: a negative zero is
written as zero, and areas and volumes, which 4 decimals of a square metre would make all alike, are rounded to 4
significant digits where the benchmark says that they are such.

Tolerant: counts exact; lengths and coordinates within 1 % or 0.1 mm, whichever is more; other measures within 1 %;
directions within 1 degree, whatever their sign, since an axis has none; lists in any order but of the same length
(the three numbers of a point or size keep theirs); where the label is one value, a list of values that all agree with
it is right; text apart from case.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from querycad_contracts import AnswerType

from .items import Item, literal

DECIMALS = 4
"""The published rule's: 0.1 mm."""
SIGNIFICANT_DIGITS = 4
"""Of areas and volumes: the same relative accuracy that 4 decimals give a length of one metre."""
RELATIVE = 0.01
ABSOLUTE_M = 1e-4
MAX_ANGLE_RAD = math.radians(1.0)

_NOT_LENGTHS = frozenset(
    {
        AnswerType.AREA,
        AnswerType.AREAS,
        AnswerType.VOLUME,
        AnswerType.VOLUMES,
        AnswerType.ANGLE,
        AnswerType.ANGLES,
        AnswerType.NUMBER,
        AnswerType.NUMBERS,
    }
)
_SMALL_UNITS = frozenset({AnswerType.AREA, AnswerType.AREAS, AnswerType.VOLUME, AnswerType.VOLUMES})
_DIRECTIONS = frozenset({AnswerType.DIRECTION, AnswerType.DIRECTIONS})
_TRIPLES = frozenset({AnswerType.POINT, AnswerType.DIRECTION, AnswerType.SIZE})
_EXPRESSION = re.compile(r"^re(?=\W)")


@dataclass(frozen=True, slots=True)
class Score:
    """Whether an answer is right, by both rules."""

    strict: bool
    tolerant: bool


WRONG = Score(strict=False, tolerant=False)


def score(item: Item, answer: str | None, answer_type: AnswerType | None = None) -> Score:
    """Is `answer`, a Python literal in SI units, right? None is no answer, and wrong.

    `answer_type` is what the answer says it is; what the benchmark says comes first.
    """
    pattern = expression(item.label)
    label = None if pattern is not None else meant(item.label)
    if answer is None:
        return WRONG
    try:
        value = literal(answer)
    except ValueError:
        return WRONG
    kind = item.type or answer_type
    if pattern is not None:
        strict = re.fullmatch(pattern, _printed(value, item)) is not None
        tolerant = any(within_tolerance(value, other, item, kind) for other in _alternatives(pattern))
        return Score(strict, strict or tolerant)
    strict = _strict(value, label, item)
    return Score(strict, strict or within_tolerance(value, label, item, kind))


def expression(label: str) -> str | None:
    """Which regular expression is the label? None when it is a literal, or no expression that there can be."""
    found = _EXPRESSION.match(label.strip())
    pattern = label.strip()[found.end() :].strip() if found else None
    try:
        re.compile(pattern or "")
    except re.error:
        return None
    return pattern


def meant(label: str) -> Any:
    """Which value does the label stand for? One that is no literal is text: no label of others stops a run."""
    try:
        return literal(label)
    except ValueError:
        return label.strip()


def _alternatives(pattern: str) -> list[Any]:
    """The values of an expression that only lists literals, such as `(0.34|0.3405)`."""
    inner = pattern.removeprefix("(").removesuffix(")")
    try:
        return [literal(part) for part in inner.split("|")]
    except ValueError:
        return []


def _strict(value: Any, label: Any, item: Item) -> bool:
    if isinstance(label, set | frozenset):
        label = list(label)
        answer = value if isinstance(value, list) else list(value) if isinstance(value, set) else [value]
        return _distinct(answer, item) == _distinct(label, item)
    return _printed(value, item) == _printed(label, item)


def _printed(value: Any, item: Item) -> str:
    """The value as the published rule compares it."""
    rounded = _rounded(sorted(value) if isinstance(value, set) else value, item)
    if isinstance(rounded, list) and len(rounded) == 1:
        rounded = rounded[0]
    if item.is_sorted and isinstance(rounded, list):
        rounded = _sorted(rounded)
    return str(rounded)


def _distinct(values: Sequence[Any], item: Item) -> list[str]:
    return sorted({str(_rounded(value, item)) for value in values})


def _rounded(value: Any, item: Item) -> Any:
    if isinstance(value, list):
        return [_rounded(entry, item) for entry in value]
    if isinstance(value, float):
        if item.type in _SMALL_UNITS:
            return float(f"{value:.{SIGNIFICANT_DIGITS}g}") + 0.0
        return round(value, DECIMALS) + 0.0
    return value


def _sorted(values: list[Any]) -> list[Any]:
    try:
        return sorted(values)
    except TypeError:  # numbers beside lists or text
        return sorted(values, key=str)


def within_tolerance(value: Any, label: Any, item: Item, kind: AnswerType | None = None) -> bool:
    """Does a value agree with the label's value, by the tolerant rule? `kind` is the type the answer says it is of."""
    is_exact = item.type is AnswerType.COUNT if item.type else _all_integers(label)

    def close(a: Any, b: Any) -> bool:
        return bool(a == b and type(a) is type(b)) if is_exact and not isinstance(b, list) else _close(a, b, kind)

    if isinstance(label, set | frozenset):
        values = list(value) if isinstance(value, list | set) else [value]
        return all(any(close(v, want) for want in label) for v in values) and all(
            any(close(v, want) for v in values) for want in label
        )
    if _is_one(label, value, kind, item):
        several = isinstance(value, list) and (not isinstance(label, list) or _is_nested(value))
        values = value if several else [value]
        return bool(values) and all(close(v, label) for v in values)
    single = not isinstance(value, list) or (_is_nested(label) and not _is_nested(value))
    return _pairs_up([value] if single else value, label, close)


def _is_one(label: Any, value: Any, kind: AnswerType | None, item: Item) -> bool:
    """Is the label one value: no list, or the three numbers of one point or size?"""
    if not isinstance(label, list):
        return True
    flat = len(label) == 3 and not _is_nested(label) and not item.is_sorted
    return flat and (kind in _TRIPLES or _is_nested(value))


def _is_nested(value: Any) -> bool:
    return isinstance(value, list) and any(isinstance(entry, list) for entry in value)


def _all_integers(label: Any) -> bool:
    """Is the label a count, or counts? Lengths in metres are written with a decimal point."""
    if isinstance(label, list | set | frozenset):
        return bool(label) and all(_all_integers(entry) for entry in label)
    return isinstance(label, int) and not isinstance(label, bool)


def _close(value: Any, label: Any, kind: AnswerType | None) -> bool:
    """Do two single values, or two points, agree?"""
    if isinstance(label, list):
        if not isinstance(value, list) or len(value) != len(label):
            return False
        if kind in _DIRECTIONS:
            return _parallel(value, label)
        return all(_close(a, b, kind) for a, b in zip(value, label, strict=True))
    if isinstance(value, bool) or isinstance(label, bool):
        return value is label
    if isinstance(value, str) and isinstance(label, str):
        return value.strip().casefold() == label.strip().casefold()
    if not isinstance(value, int | float) or not isinstance(label, int | float):
        return False
    allowed = RELATIVE * abs(label)
    return abs(value - label) <= (allowed if kind in _NOT_LENGTHS else max(allowed, ABSOLUTE_M)) * (1 + 1e-9)


def _parallel(a: Sequence[Any], b: Sequence[Any]) -> bool:
    if not all(isinstance(v, int | float) for v in (*a, *b)) or not math.hypot(*a) or not math.hypot(*b):
        return False
    cosine = abs(sum(x * y for x, y in zip(a, b, strict=True))) / math.hypot(*a) / math.hypot(*b)
    return bool(cosine >= math.cos(MAX_ANGLE_RAD))


def _pairs_up(values: Sequence[Any], labels: Sequence[Any], close: Callable[[Any, Any], bool]) -> bool:
    """Is there a value of its own for every label? Bipartite matching by augmenting paths (Kuhn)."""
    if len(values) != len(labels):
        return False
    fits = [[close(value, label) for label in labels] for value in values]
    owner: list[int | None] = [None] * len(labels)

    def place(i: int, tried: set[int]) -> bool:
        for j, good in enumerate(fits[i]):
            if good and j not in tried:
                tried.add(j)
                holder = owner[j]
                if holder is None or place(holder, tried):
                    owner[j] = i
                    return True
        return False

    return all(place(i, set()) for i in range(len(values)))
