"""From a program's plain result to a typed answer: right type, right shape, written for people."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

from querycad_contracts import Answer, AnswerType, LengthUnit, Unit


class WrongAnswerType(ValueError):
    """A program's result is not of the type that the question asks for; `str()` says what is and what should be."""


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
_POWER = {Unit.METRE: 1, Unit.SQUARE_METRE: 2, Unit.CUBIC_METRE: 3}
_EXPONENT = {1: "", 2: "²", 3: "³"}
_TRIPLES = (AnswerType.POINT, AnswerType.DIRECTION, AnswerType.SIZE)
_NUMBERS = (AnswerType.LENGTH, AnswerType.AREA, AnswerType.VOLUME, AnswerType.ANGLE, AnswerType.NUMBER)
SIGNIFICANT_DIGITS = 6
"""Digits shown to people: 0.1 mm in a model of a hundred metres. The value itself is not rounded."""


def typed_answer(value: Any, expects: AnswerType | None, unit: LengthUnit = LengthUnit.MM) -> Answer:
    """Which typed answer is this result? `value` is plain data as in `RunOutcome.value`.

    A scalar type accepts a list of such scalars: "the hole" may turn out to be four. Where all agree, their one value
    is the answer; else the answer becomes plural. Raises WrongAnswerType.
    """
    wanted = expects or _guess(value)
    checked, actual = _checked(value, wanted)
    scalar = _SCALAR_OF.get(actual, actual)
    return Answer(value=checked, type=actual, unit=_UNITS.get(scalar, Unit.NONE), text=_text(checked, actual, unit))


def _guess(value: Any) -> AnswerType:
    """The type of a result whose program did not say: numbers are lengths, as nearly all measures are."""
    if isinstance(value, bool):
        return AnswerType.BOOLEAN
    if isinstance(value, int):
        return AnswerType.COUNT
    if isinstance(value, float):
        return AnswerType.LENGTH
    if isinstance(value, str):
        return AnswerType.TEXT
    if isinstance(value, dict):
        return AnswerType.PARTS
    if isinstance(value, list) and value:
        inner = _guess(value[0])
        if inner is AnswerType.LENGTHS and len(value[0]) == 3:
            return AnswerType.POINTS
        return {AnswerType.COUNT: AnswerType.NUMBERS, AnswerType.PARTS: AnswerType.PARTS}.get(
            inner, _LIST_OF.get(inner, AnswerType.LENGTHS)
        )
    return AnswerType.LENGTHS


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


def _same(a: Any, b: Any) -> bool:
    """Equal to nine digits, as values are that differ only by how they were computed."""
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-12)
    if isinstance(a, list) and isinstance(b, list):
        return all(_same(x, y) for x, y in zip(a, b, strict=True))
    return bool(a == b)


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
    """The answer as a person reads it; equal values of a list are written once: '4 x 1.25 mm'."""
    if kind in _SCALAR_OF or (kind is AnswerType.PARTS and isinstance(value, list)):
        texts = [_scalar_text(item, _SCALAR_OF.get(kind, kind), unit) for item in value]
        return _joined(texts) if texts else "none"
    return _scalar_text(value, kind, unit)


def _joined(texts: Sequence[str]) -> str:
    return ", ".join(text if count == 1 else f"{count} x {text}" for text, count in Counter(texts).items())


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
    power = _POWER.get(si, 0)
    factor = unit.metres**power
    suffix = f" {unit.value}{_EXPONENT[power]}" if power else ""
    if kind in _TRIPLES:
        separator = " x " if kind is AnswerType.SIZE else ", "
        body = separator.join(_number(v / factor) for v in value)
        return f"{body}{suffix}" if kind is AnswerType.SIZE else f"({body}){suffix}"
    return f"{_number(value / factor)}{suffix}"


def _number(value: float) -> str:
    rounded = 0.0 if abs(value) < 1e-9 else value
    return f"{rounded:.{SIGNIFICANT_DIGITS}g}"
