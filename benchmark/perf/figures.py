"""What a measurement of speed is made of."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from pydantic import BaseModel, ConfigDict, computed_field

QUESTIONS = (
    "How many holes does the object have?",
    "What is the height of the object?",
    "What is the diameter of the holes?",
    "Where is the center of the largest hole?",
)
"""What a client asks while speed is measured."""


class Measurement(BaseModel):
    """One figure and what it is measured against. `ratio` is value by baseline; `limit` says what is to be held."""

    model_config = ConfigDict(frozen=True)

    name: str
    value: float
    unit: str
    baseline_name: str
    baseline: float
    limit: str = ""
    holds: bool | None = None

    @computed_field  # type: ignore[prop-decorator]
    @property
    def ratio(self) -> float:
        """How many times the baseline is it?"""
        return self.value / self.baseline if self.baseline else float("inf")


class Series(BaseModel):
    """How one figure grows with another, beside how it is to grow."""

    model_config = ConfigDict(frozen=True)

    name: str
    x_name: str
    y_name: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    expected_name: str
    expected: tuple[float, ...]
    is_logarithmic: bool = False


class NotMeasured(Exception):
    """A part cannot be measured on this machine; `str()` says what it lacks."""


def times_ms(call: Callable[[int], object], count: int) -> list[float]:
    """How long does each of `count` calls take, in milliseconds?"""
    taken = []
    for i in range(count):
        start = time.perf_counter()
        call(i)
        taken.append((time.perf_counter() - start) * 1e3)
    return taken


def percentile(values: Sequence[float], share: int) -> float:
    """The value that `share` per cent of the values do not exceed (nearest rank)."""
    ordered = sorted(values)
    return ordered[max(-(-share * len(ordered) // 100) - 1, 0)]
