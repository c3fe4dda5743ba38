"""From a program's plain result to a typed answer: right type, right shape, written for people."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

from querycad_contracts import Answer, AnswerType, Expectation, LengthUnit, Unit

from .drawing.numbers import SIGNIFICANT_DIGITS
from .quantities import frame, scalar_type, triple_type


class WrongAnswerType(ValueError):
    """A program's result is not of the type that the question asks for; `str()` says what is and what should be."""


class Unexpected(ValueError):
    """An answer is not what the caller expects; `str()` says what it is and what was expected."""


_SCALAR_OF = {
    AnswerType.LENGTHS: AnswerType.LENGTH,
    AnswerType.POINTS: AnswerType.POINT,
    AnswerType.DIRECTIONS: AnswerType.DIRECTION,
    AnswerType.SIZES: AnswerType.SIZE,
    AnswerType.TEXTS: AnswerType.TEXT,
    AnswerType.AREAS: AnswerType.AREA,
    AnswerType.VOLUMES: AnswerType.VOLUME,
    AnswerType.ANGLES: AnswerType.ANGLE,
    AnswerType.NUMBERS: AnswerType.NUMBER,
}
_LIST_OF = {scalar: plural for plural, scalar in _SCALAR_OF.items()}
_UNITS = {
    AnswerType.LENGTH: Unit.METRE,
    AnswerType.POINT: Unit.METRE,
    AnswerType.SIZE: Unit.METRE,
    AnswerType.AREA: Unit.SQUARE_METRE,
    AnswerType.VOLUME: Unit.CUBIC_METRE,
    AnswerType.ANGLE: Unit.RADIAN,
}
_EXPONENT = {1: "", 2: "²", 3: "³"}
_TRIPLES = (AnswerType.POINT, AnswerType.DIRECTION, AnswerType.SIZE)
_NUMBERS = (AnswerType.LENGTH, AnswerType.AREA, AnswerType.VOLUME, AnswerType.ANGLE, AnswerType.NUMBER)
SAME = 1e-6
"""Relative difference up to which two programs' values are the same: far below what is shown."""


def typed_answer(
    value: Any, expects: AnswerType | None, unit: LengthUnit = LengthUnit.MM, code: str | None = None
) -> Answer:
    """Which typed answer is this result? `value` is plain data as in `RunOutcome.value`.

    A scalar type accepts a list of such scalars: "the hole" may turn out to be four. Where all agree, their one value
    is the answer; else the answer becomes plural. Without `expects` the type follows the value and what `code`, its
    program, measures. Raises WrongAnswerType.
    """
    wanted = expects or guessed_type(value, code)
    checked, actual = _checked(value, wanted)
    text = _text(checked, actual, unit)
    return Answer(value=checked, type=actual, unit=unit_of(actual), text=text, frame=frame(code, actual))


def as_expected(answer: Answer, expect: Expectation, unit: LengthUnit = LengthUnit.MM) -> Answer:
    """The answer as the caller expects it: one value is a list of one where a list is expected. Raises Unexpected."""
    wanted = expect.type
    if wanted is not None and _LIST_OF.get(answer.type) is wanted:
        value = [answer.value]
        answer = answer.model_copy(update={"value": value, "type": wanted, "text": _text(value, wanted, unit)})
    if wanted is AnswerType.NUMBER and answer.type is AnswerType.COUNT:
        answer = answer.model_copy(update={"value": float(answer.value), "type": wanted})
    for what, found, hoped in (
        ("of type", answer.type, wanted),
        ("in unit", answer.unit, expect.unit),
        ("in frame", answer.frame, expect.frame),
    ):
        if hoped is not None and found != hoped:
            is_so = f"'{found.value}'" if found is not None and found.value else "none"
            raise Unexpected(f"an answer {what} '{hoped.value}' is expected, but it is {is_so}: {answer.text}")
    return answer


def is_like(kind: AnswerType, other: AnswerType) -> bool:
    """Do the types differ at most in how many values there are, or as a count and a number do?"""
    a, b = _SCALAR_OF.get(kind, kind), _SCALAR_OF.get(other, other)
    return a is b or {a, b} == {AnswerType.COUNT, AnswerType.NUMBER}


def unit_of(kind: AnswerType) -> Unit:
    """Which SI unit do values of this type have?"""
    return _UNITS.get(_SCALAR_OF.get(kind, kind), Unit.NONE)


def same_value(a: Answer, b: Answer, each_once: bool = False) -> bool:
    """Do two answers say the same, in whatever order their lists are? A list of one says what its one value says.

    `each_once`: so does a list of equal ones.
    """
    if unit_of(a.type) is not unit_of(b.type):
        return False
    values, others = (_distinct(_as_list(one)) if each_once else _as_list(one) for one in (a, b))
    return _same_lists(values, others)


def are_several(answer: Answer, wanted: AnswerType | None) -> int:
    """How many different values has the answer, where one is asked for? 0 where there is one, or any number may be."""
    if wanted is None or answer.type is not _LIST_OF.get(wanted):
        return 0
    count = len(_distinct(_as_list(answer)))
    return count if count > 1 else 0


def _distinct(values: list[Any]) -> list[Any]:
    kept: list[Any] = []
    for value in values:
        if not any(_same(value, other, SAME) for other in kept):
            kept.append(value)
    return kept


def _as_list(answer: Answer) -> list[Any]:
    is_list = answer.type in _SCALAR_OF or answer.type is AnswerType.PARTS
    return list(answer.value) if is_list and isinstance(answer.value, list) else [answer.value]


def _same_lists(values: list[Any], others: list[Any]) -> bool:
    left = list(others)
    for value in values:
        match = next((i for i, other in enumerate(left) if _same(value, other, SAME)), None)
        if match is None:
            return False
        left.pop(match)
    return not left


def guessed_type(value: Any, code: str | None = None) -> AnswerType:
    """The type of a result whose program did not say, from what the program measures; else numbers are lengths."""
    if isinstance(value, bool):
        return AnswerType.BOOLEAN
    if isinstance(value, int):
        return AnswerType.COUNT
    if isinstance(value, float):
        return scalar_type(code) if code is not None else AnswerType.LENGTH
    if isinstance(value, str):
        return AnswerType.TEXT
    if isinstance(value, dict):
        return AnswerType.PARTS
    if isinstance(value, list) and value:
        return _guessed_list(value, code)
    return AnswerType.LENGTHS


def _guessed_list(value: list[Any], code: str | None) -> AnswerType:
    triple = triple_type(code) if code is not None else None
    if triple is not None and _is(value, triple):
        return triple
    if isinstance(value[0], list) and len(value[0]) == 3:
        return _LIST_OF[triple or AnswerType.POINT]
    inner = guessed_type(value[0], code)
    if inner is AnswerType.COUNT:
        return AnswerType.NUMBERS
    return inner if inner is AnswerType.PARTS else _LIST_OF.get(inner, AnswerType.LENGTHS)


def _checked(value: Any, wanted: AnswerType) -> tuple[Any, AnswerType]:
    if wanted in _SCALAR_OF:
        scalar = _SCALAR_OF[wanted]
        items = value if isinstance(value, list) and not _is(value, scalar) else [value]
        return [_one(item, scalar) for item in items], wanted
    if wanted in _LIST_OF and isinstance(value, list) and not _is(value, wanted):
        items = [_one(item, wanted) for item in value]
        if items and all(_same(item, items[0]) for item in items):
            return items[0], wanted
        return items, _LIST_OF[wanted]
    if wanted is AnswerType.PARTS:
        items = value if isinstance(value, list) else [value]
        return [_one(item, wanted) for item in items], wanted
    return _one(value, wanted), wanted


def _same(a: Any, b: Any, relative: float = 1e-9) -> bool:
    """Equal to nine digits, as values are that differ only by how they were computed."""
    if _is_number(a) and _is_number(b):
        return math.isclose(a, b, rel_tol=relative, abs_tol=1e-12)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(_same(x, y, relative) for x, y in zip(a, b, strict=True))
    return type(a) is type(b) and bool(a == b)


def _is(value: Any, scalar: AnswerType) -> bool:
    try:
        _one(value, scalar)
    except WrongAnswerType:
        return False
    return True


def _one(value: Any, scalar: AnswerType) -> Any:
    """One value of a scalar type, in its plain form."""
    if scalar is AnswerType.BOOLEAN and isinstance(value, bool):
        return value
    if scalar is AnswerType.COUNT and _is_number(value) and float(value).is_integer() and value >= 0:
        return int(value)
    if scalar in _NUMBERS and _is_number(value):
        return float(value)
    if scalar in _TRIPLES and isinstance(value, list) and len(value) == 3 and all(map(_is_number, value)):
        return [float(v) for v in value]
    if scalar is AnswerType.TEXT and isinstance(value, str):
        return value
    if scalar is AnswerType.PARTS and isinstance(value, dict) and set(value) <= {"part", "face"} and len(value) == 1:
        return value
    raise WrongAnswerType(f"the program's result {_shown(value)} is not of type {scalar.value}")


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _text(value: Any, kind: AnswerType, unit: LengthUnit) -> str:
    """The answer as a person reads it; equal values of a list are written once: '1.25 mm (each of 4)'."""
    if kind in _SCALAR_OF or (kind is AnswerType.PARTS and isinstance(value, list)):
        texts = [_scalar_text(item, _SCALAR_OF.get(kind, kind), unit) for item in value]
        return _joined(texts) if texts else "none"
    return _scalar_text(value, kind, unit)


def _joined(texts: Sequence[str]) -> str:
    return ", ".join(text if count == 1 else f"{text} (each of {count})" for text, count in Counter(texts).items())


def _scalar_text(value: Any, kind: AnswerType, unit: LengthUnit) -> str:
    if kind is AnswerType.BOOLEAN:
        return "yes" if value else "no"
    if kind is AnswerType.PARTS:
        return str(next(iter(value.values())))
    if kind in (AnswerType.TEXT, AnswerType.COUNT):
        return str(value)
    si = _UNITS.get(kind, Unit.NONE)
    if kind is AnswerType.ANGLE:
        return f"{_number(math.degrees(value))}°"
    power = si.power
    factor = unit.metres**power
    suffix = f" {unit.value}{_EXPONENT[power]}" if power else ""
    if kind in _TRIPLES:
        separator = " x " if kind is AnswerType.SIZE else ", "
        body = separator.join(_number(v / factor) for v in value)
        return f"{body}{suffix}" if kind is AnswerType.SIZE else f"({body}){suffix}"
    return f"{_number(value / factor)}{suffix}"


def _number(value: float) -> str:
    rounded = 0.0 if abs(value) < 1e-9 else value
    return f"{rounded:.{SIGNIFICANT_DIGITS}g}" if abs(value) < 10**SIGNIFICANT_DIGITS else f"{rounded:.0f}"
