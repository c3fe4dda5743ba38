"""How is a size written on a drawing? With as many decimals as a model supports, and no zeros behind them."""

from __future__ import annotations

import math
from collections.abc import Iterable

from querycad_contracts import LengthUnit, Vector

SIGNIFICANT_DIGITS = 6
"""Digits shown to people: 0.1 mm in a model of a hundred metres. The value itself is not rounded."""
_DECIMALS = {LengthUnit.MM: 3, LengthUnit.CM: 4, LengthUnit.IN: 4, LengthUnit.M: 6}
"""A micrometre, or a ten-thousandth of an inch: finer than parts are made, and than files are exact."""
OVER_NOISE = 1.0 + 1e-9
"""What inches leave is often half a micrometre, 7.9375 mm: the kernel's noise of some 1e-12 would part equal sizes."""
ALIGNED = 1.0 - 1e-6
"""A direction is along an axis of the file where its component there is at least this."""


def number(value: float, decimals: int = 3) -> str:
    """The number without needless zeros: '8.5'."""
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text


def length(metres: float, unit: LengthUnit) -> str:
    """The length in that unit, which is not named; a half of the last decimal is rounded up, also over noise."""
    return number(metres * OVER_NOISE / unit.metres, _DECIMALS[unit])


def sizes(metres: Iterable[float], unit: LengthUnit) -> str:
    """The lengths in that unit, which is not named: '170 x 170 x 53'."""
    return " x ".join(length(each, unit) for each in metres)


def unit_name(unit: LengthUnit) -> str:
    """What is said for 'in …': 'mm', 'inches'."""
    return "inches" if unit is LengthUnit.IN else unit.value


def significant(value: float) -> str:
    """The number with `SIGNIFICANT_DIGITS`, and no exponent: for areas and volumes."""
    if value == 0.0:
        return "0"
    return number(value, max(0, SIGNIFICANT_DIGITS - 1 - math.floor(math.log10(abs(value)))))


def degrees(radians: float) -> str:
    """The angle: '45°'."""
    return f"{number(math.degrees(radians), 2)}°"


def direction(vector: Vector) -> str:
    """The direction: '+z' where it is along an axis of the file, else its three components."""
    for axis, component in zip("xyz", vector, strict=True):
        if abs(component) >= ALIGNED:
            return f"{'+' if component > 0 else '-'}{axis}"
    return "(" + ", ".join(number(component) for component in vector) + ")"
