"""Questions in, typed answers with their evidence out."""

from __future__ import annotations

from enum import StrEnum
from typing import Any

from pydantic import Field

from .geometry import Frozen, Part


class AnswerType(StrEnum):
    """What kind of value answers a question."""

    COUNT = "count"
    NUMBER = "number"
    LENGTH = "length"
    LENGTHS = "lengths"
    AREA = "area"
    VOLUME = "volume"
    ANGLE = "angle"
    POINT = "point"
    POINTS = "points"
    DIRECTION = "direction"
    DIRECTIONS = "directions"
    SIZE = "size"
    SIZES = "sizes"
    TEXT = "text"
    TEXTS = "texts"
    BOOLEAN = "boolean"
    PARTS = "parts"
    AREAS = "areas"
    VOLUMES = "volumes"
    ANGLES = "angles"
    NUMBERS = "numbers"


class Unit(StrEnum):
    """SI unit of an answer's value."""

    METRE = "m"
    SQUARE_METRE = "m2"
    CUBIC_METRE = "m3"
    RADIAN = "rad"
    NONE = ""


class LengthUnit(StrEnum):
    """Unit that lengths are written in for people; values stay SI."""

    MM = "mm"
    M = "m"
    IN = "in"

    @property
    def metres(self) -> float:
        """How many metres is one of this unit? (Inch: 25.4 mm exactly, ISO 31-1.)"""
        return {"mm": 1e-3, "m": 1.0, "in": 0.0254}[self.value]


class Answer(Frozen):
    """A typed value."""

    value: Any = Field(description="SI: metres, m2, m3, radians; counts are integers; points are three floats.")
    type: AnswerType
    unit: Unit
    text: str = Field(description="The value as a person reads it, in the unit the caller asked for.")


class Program(Frozen):
    """A Python program that answers a question, and who wrote it."""

    code: str
    codegen: str = Field(description="Who wrote it: 'parser', or 'llm:<model>'.")
    expects: AnswerType | None = Field(
        None, description="The type the answer must have; None when the writer did not say."
    )
    confidence: float = Field(1.0, ge=0.0, le=1.0)
    unused_words: tuple[str, ...] = Field((), description="Words of the question that the program does not reflect.")
    notes: tuple[str, ...] = Field(
        (), description="Readings chosen where the question was ambiguous, said to the user."
    )


class Status(StrEnum):
    """How a question ended."""

    ANSWERED = "answered"
    NOT_GROUNDED = "not_grounded"
    FAILED = "failed"


class Failure(Frozen):
    """Why there is no answer."""

    category: str = Field(
        description="'not_grounded', 'not_understood', 'bad_input', 'program', 'limit' or 'internal'."
    )
    message: str = Field(description="One sentence for the user.")
    nearest: tuple[str, ...] = Field((), description="The nearest terms that would be understood.")
    retryable: bool = False


class AnswerRecord(Frozen):
    """The whole outcome of one question: what `querycad ask --json` prints and the API returns."""

    question: str
    status: Status
    answer: Answer | None
    code: str | None
    codegen: str | None
    parts: tuple[Part, ...]
    timings_ms: dict[str, float]
    warnings: tuple[str, ...]
    failure: Failure | None = None
