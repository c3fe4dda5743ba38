"""What is said beside a value: the other length of a screw, the other way in, the height along another axis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist
from typing import NamedTuple

from querycad_contracts import LengthUnit, Measure, ModelSummary, Part, PartKind, Side
from querycad_contracts.vectors import dot
from querycad_language.forms import Distance, Get, Reduce
from querycad_language.text import Text

from .candidates import Candidate
from .drawing.describing import stands_along
from .drawing.numbers import length

PROFILE = 2.0
"""A profile lies along the axis that it is this many times as long along as along any other."""
_SAME = 1e-6
_ROUNDED = 1e-5
"""Metres within which two distances between centres, or two diameters, are one."""
_MOST = 200
"""Parts whose next one is looked for."""
_TOLD = 4
"""Distances that a note names."""
_FROM = 1.0 - 1e-6
_AXES = "xyz"


class Standing(NamedTuple):
    """Another axis that a height may be meant along, and why."""

    axis: int
    why: str


def beside(candidate: Candidate, unit: LengthUnit) -> Iterator[str]:
    """Notes on the parts whose measure was read."""
    form = candidate.reading.form
    if apart := uneven(candidate):
        told = ", ".join(length(each, unit) for each in apart)
        yield f"not all are equally far from the next of their size: {told} {unit.value}; the least is told"
    parts = [part for grounded in candidate.grounds.values() for part in grounded.parts]
    read = {read.expression for read in candidate.written.reads}
    if "{0}.nominal_length" in read:
        over = [part.length for part in parts if part.length and part.length > (part.nominal_length or 0.0) + _SAME]
        texts = dict.fromkeys(length(each, unit) for each in over)
        if texts:
            yield f"under the head, as standards name screws; overall {', '.join(texts)} {unit.value}"
    if isinstance(form, Get) and Measure.APPROACH in form.measures:
        sides = dict.fromkeys(_side(part) for part in parts if part.approach)
        if len(sides) == 1 and (side := next(iter(sides))) is not None:
            yield f"that is from the {side.value}"
        if any(len(part.approach) > 1 for part in parts):
            yield "what goes through has a second way in, from the other side"


def uneven(candidate: Candidate) -> list[float]:
    """How far parts lie from the next one of their diameter, where 'the spacing' is asked and they have several.

    Ascending, in metres, a few; none where all are equally far apart.
    """
    form = candidate.reading.form
    one = isinstance(form, Distance) and (form.second, form.axis, form.reduce) == ("each other", None, Reduce.ONE)
    if not one or not any(read.expression == "center" for read in candidate.written.reads):
        return []
    parts = [part for grounded in candidate.grounds.values() for part in grounded.parts]
    found: list[float] = []
    for part in parts[:_MOST]:
        others = [p for p in parts if p is not part and abs((p.diameter or 0) - (part.diameter or 0)) < _ROUNDED]
        near = min((dist(part.center, other.center) for other in others), default=None)
        if near is not None and all(abs(near - known) > _ROUNDED for known in found):
            found.append(near)
    return sorted(found)[:_TOLD] if len(found) > 1 else []


def _side(part: Part) -> Side | None:
    """From which side does one come who goes along the first way in?"""
    into = part.approach[0]
    return next((side for side in Side if dot(side.outward, into) < -_FROM), None)


def reads_height(candidate: Candidate) -> bool:
    """Is a height along z read, and nothing else?"""
    reads = [(read.measure, read.expression) for read in candidate.written.reads]
    of_z = ("{0}.extents[2]", "{0}.height")
    return isinstance(candidate.reading.form, Get) and reads in [[(Measure.HEIGHT.value, one)] for one in of_z]


def is_of_whole(candidate: Candidate, alone: bool) -> bool:
    """Is it read of all of the model? `alone`: its only body is all of it."""
    grounded = [part for ground in candidate.grounds.values() for part in ground.parts]
    return all(part.kind is PartKind.MODEL or alone for part in grounded)


def standing(text: Text, summary: ModelSummary, parts: Sequence[Part]) -> Standing | None:
    """Along which other axis may a height be meant: where the model stands on one, or is a profile that lies along z?

    It stands on another axis where that is its axis of rotation, or square to its largest flat face, and where it would
    hardly stand on its bottom. The words say that it is a profile; then its section has the height.
    """
    shape = summary.shape
    x, y, z = shape.extents
    if text.at_phrases("profile") and z >= PROFILE * max(x, y) and abs(y - z) > _SAME:
        return Standing(1, "the profile lies along z, and its section")
    axis = next((i for i in range(3) if shape.up is not None and shape.up.outward[i]), 2)
    if axis == 2 or stands_along(parts) != _AXES[axis] or abs(shape.extents[axis] - z) <= _SAME:
        return None
    return Standing(axis, f"the model likely stands along {_AXES[axis]}, and then")


def of_height(found: Standing, text: str) -> str:
    """The note on a height along z, with the other value."""
    return f"the height is along z, the file's axis; {found.why} is {text} high along {_AXES[found.axis]}"
