"""What does a model of the benchmark consist of, and how is a question with its true answer written down?

Lengths go in as millimetres, as on the drawing, and come out as metres.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

from _example import Item as Asked
from _example import Value
from _example import count as asked_count
from _example import length as asked_length
from _example import lengths as asked_lengths
from _example import point as asked_point
from _example import points as asked_points
from _example import size as asked_size

INCH = 25.4  # millimetres, exactly (ISO 31-1)
Triple = tuple[float, float, float]


class Form(StrEnum):
    """How is the geometry stored in the file?"""

    SOLID = "solid"
    BSPLINE = "b-spline"
    SURFACES = "loose surfaces"


@dataclass(frozen=True, slots=True)
class Model:
    """What is to be known of a model beside its geometry."""

    title: str
    split: Literal["dev", "held_out"]
    form: Form = Form.SOLID
    unit: Literal["mm", "in"] = "mm"  # of the file
    bodies: int = 1


@dataclass(frozen=True, slots=True)
class Tags:
    """What a question is about: the part as the question calls it in general terms, and its property."""

    part: str
    property: str


@dataclass(frozen=True, slots=True)
class Item:
    """A question, its true answer in SI units, the answer's type (`contracts.AnswerType`) and its tags."""

    question: str
    value: Value | list[str]
    type: str
    tags: Tags


def count(part: str, question: str, value: int) -> Item:
    """How many are there?"""
    return _tagged(asked_count(question, value), part, "count")


def length(part: str, measure: str, question: str, value_mm: float) -> Item:
    """How long is it?"""
    return _tagged(asked_length(question, value_mm), part, measure)


def lengths(part: str, measure: str, question: str, values_mm: Sequence[float]) -> Item:
    """How long is each? Smallest first."""
    return _tagged(asked_lengths(question, list(values_mm)), part, measure)


def point(part: str, question: str, value_mm: Triple) -> Item:
    """Where is its centre?"""
    return _tagged(asked_point(question, value_mm), part, "center")


def points(part: str, question: str, values_mm: Sequence[Triple]) -> Item:
    """Where is the centre of each? In ascending order."""
    return _tagged(asked_points(question, list(values_mm)), part, "center")


def size(part: str, question: str, value_mm: Triple, measure: str = "size") -> Item:
    """How large is it along x, y and z?"""
    return _tagged(asked_size(question, value_mm), part, measure)


def volume(part: str, question: str, value_mm3: float) -> Item:
    """Which volume has it? Cubic millimetres become cubic metres."""
    return Item(question, value_mm3 * 1e-9, "volume", Tags(part, "volume"))


def area(part: str, question: str, value_mm2: float) -> Item:
    """Which area has it? Square millimetres become square metres."""
    return Item(question, value_mm2 * 1e-6, "area", Tags(part, "area"))


def angle(part: str, question: str, value_deg: float) -> Item:
    """How wide is the angle? Degrees become radians."""
    return Item(question, math.radians(value_deg), "angle", Tags(part, "angle"))


def exists(part: str, question: str, value: bool) -> Item:
    """Is there one?"""
    return Item(question, value, "boolean", Tags(part, "existence"))


def text(part: str, question: str, value: str) -> Item:
    """What is it called in the file?"""
    return Item(question, value, "text", Tags(part, "name"))


def texts(part: str, question: str, values: Sequence[str]) -> Item:
    """What are they called in the file? In alphabetical order."""
    return Item(question, sorted(values), "texts", Tags(part, "name"))


def _tagged(item: Asked, part: str, measure: str) -> Item:
    return Item(item.question, item.value, item.type, Tags(part, measure))
