"""Values as they are asked for: in the unit and the frame of the parameter."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from querycad_contracts import Answer, AnswerType, LengthUnit, Unit
from querycad_contracts.parameters import AngleUnit, ParameterType

from .frames import Rigid, told

DIGITS = 6
"""Shown to people, as in answers."""
_PLACES = (AnswerType.POINT, AnswerType.POINTS)
_WAYS = (AnswerType.DIRECTION, AnswerType.DIRECTIONS)
_SIZES = (AnswerType.SIZE, AnswerType.SIZES)
_LENGTHS = (ParameterType.LENGTH, ParameterType.LENGTHS, ParameterType.SIZE, ParameterType.MATES)
_PLACED = (
    *(ParameterType.POINT, ParameterType.POINTS, ParameterType.POSE),
    *(ParameterType.APPROACH, ParameterType.INSERTION, ParameterType.GRASPS),
)
_POWER_OF = {ParameterType.AREA: 2, ParameterType.VOLUME: 3, **dict.fromkeys((*_LENGTHS, *_PLACED), 1)}
"""Which power of the length unit are values in? None where they have no such unit."""


class NotInFrame(ValueError):
    """A value that cannot be told in the frame that is asked for; `str()` says why."""


@dataclass(frozen=True, slots=True)
class Telling:
    """In which unit and frame are values told? `is_models`: the frame is the file's own."""

    unit: LengthUnit
    angle: AngleUnit
    frame: Rigid
    is_models: bool

    @property
    def metres(self) -> float:
        """How many metres is one of the unit?"""
        return self.unit.metres

    def has_place(self, kind: ParameterType) -> bool:
        """Do values of this type depend on the frame?"""
        return kind in (*_PLACED, ParameterType.DIRECTION)

    def unit_name(self, kind: ParameterType) -> str:
        """'mm', 'mm2' …: what values of this type are in."""
        if kind is ParameterType.ANGLE:
            return self.angle.value
        power = _POWER_OF.get(kind, 0)
        return f"{self.unit.value}{power if power > 1 else ''}" if power else ""

    def answer(self, answer: Answer) -> tuple[Any, str]:
        """An answer's value in unit and frame, and as a person reads it. Raises NotInFrame."""
        if answer.type in _SIZES and not self.is_models:
            raise NotInFrame("a size is along the file's axes: ask for it in the frame of the model")
        if answer.type in (*_PLACES, *_WAYS) and not self.is_models:
            value = self._seen(answer.value, answer.type)
            return value, _text(value, self.unit.value if answer.type in _PLACES else "")
        if answer.unit is Unit.RADIAN:
            factor = 1.0 if self.angle is AngleUnit.RAD else math.pi / 180
        else:
            factor = self.metres**answer.unit.power
        return (answer.value if factor == 1.0 else _scaled(answer.value, factor)), answer.text

    def _seen(self, value: Any, kind: AnswerType) -> Any:
        if isinstance(value[0], list):
            return [self._seen(each, kind) for each in value]
        place = (float(value[0]), float(value[1]), float(value[2]))
        seen = told(self.frame.point(place), self.metres) if kind in _PLACES else told(self.frame.direction(place), 1.0)
        return list(seen)


def triple_text(value: Sequence[float], unit: str = "") -> str:
    """(1, 2, 3) mm"""
    return _text(list(value), unit)


def number_text(value: float) -> str:
    """To six digits."""
    return f"{value:.{DIGITS}g}"


def _text(value: Any, unit: str) -> str:
    if value and isinstance(value[0], list):
        return ", ".join(_text(each, unit) for each in value)
    return f"({', '.join(number_text(each) for each in value)}){' ' if unit else ''}{unit}"


def _scaled(value: Any, factor: float) -> Any:
    return [_scaled(each, factor) for each in value] if isinstance(value, list) else round(value / factor, 12) + 0.0
