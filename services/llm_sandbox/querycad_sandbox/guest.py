"""The host side of one run's guest API: what a program's calls do, and what they leave behind.

A call that the program got wrong raises TypeError, ValueError or AttributeError into the program. A call that ends the
run (`RunEndedError`), or a failure of SegCAD itself, is kept in `Guest.ended`: whatever the program does with the
exception that it sees, the run is over.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, NoReturn, TypeVar
from uuid import UUID

from pydantic_monty import ClassInstance, ClassType, MontyClassProxy

from querycad_contracts import (
    Body,
    Face,
    Grounding,
    MissingAttribute,
    Part,
    PartQuery,
    RunStatus,
    SegCad,
    Shape,
    Side,
    Vector,
)

from .control import RunControl, RunEndedError
from .measures import Measures, body_measures, face_measures, part_measures, shape_measures

T = TypeVar("T")

PART_METHODS: Final = frozenset({"distance_to", "center_distance", "angle_to", "edge_distance", "is_in"})
BOX_SLACK_M: Final = 1e-6
"""A centre on the border of a box counts as in it: above kernel noise, below drawing accuracy."""
DESCRIPTION_CHARS: Final = 300
"""Longest description of a part; a phrase of a question has a few dozen characters."""
ATTRIBUTE_CHARS: Final = 100
"""Of the name of a measure that is not there, which is the program's to choose."""
OBJECT_BYTES, ID_BYTES = 6000, 40
"""Of a part or face with what a program sees of it, and of each of its faces' numbers: measured with tracemalloc."""
DESCRIPTIONS: Final = 100
"""Most different find_parts calls of a run; each may render and segment, and its time is not the program's."""

_PARALLEL: Final = 1e-3
"""Radians; axes nearer to one direction are parallel."""
_SIDES: Final = {side.value: side for side in Side}
_CLASSES: Final = {kind: ClassType(kind) for kind in (Part, Face, Body, Shape)}
"""How a program sees the classes of the guest API: it can ask isinstance(), and make no objects of them."""


@dataclass(frozen=True, slots=True)
class Absence:
    """A measure that an object of the model does not have, and what the program is told of that."""

    text: str
    missing: MissingAttribute


class View(ClassInstance):
    """An object of the model as a program sees it: its measures, and an AttributeError for any other name."""

    def __init__(self, guest: Guest, value: Part | Face | Body | Shape, measures: Measures) -> None:
        super().__init__(value, class_type=_CLASSES[type(value)])
        self.guest = guest
        self.measures = measures
        guest.views[self.id] = self

    def get_eager_attrs(self) -> dict[str, Any]:
        """The measures that go into the sandbox with the object."""
        return self.measures

    def lookup_lazy_attrs(self, name: str) -> Any:
        """A name that is no measure of the object: the interpreter asks the host before it gives up."""
        self.guest.absence = self.lacks(name)
        raise AttributeError(self.guest.absence.text)

    def lacks(self, name: str) -> Absence:
        """What to say of a measure that the object does not have?"""
        text = f"{_noun(self.value)} has no {name}; it has {', '.join(sorted(self.measures))}"
        return _absence(self.value, name, text)


class PartView(View):
    """A part: fetches its faces, and measures to other parts, when asked."""

    def lookup_lazy_attrs(self, name: str) -> Any:
        """`faces`, the one attribute that costs a call to SegCAD."""
        return self.guest.faces(self.value) if name == "faces" else super().lookup_lazy_attrs(name)

    def call_method(self, name: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
        """Calls one of the part's methods."""
        if name not in PART_METHODS:
            return super().call_method(name, args, kwargs)
        if kwargs.keys() - {"other"}:
            raise TypeError(f"{name}() takes no argument {sorted(kwargs)[0][:40]!r}")
        others = (*args, *kwargs.values())
        wanted = 0 if name == "edge_distance" else 1
        if len(others) != wanted:
            raise TypeError(f"{name}() takes {'one other part' if wanted else 'no arguments'}")
        if not all(isinstance(other, Part) for other in others):
            raise TypeError(f"{name}() takes a part that find_parts returned")
        return getattr(self.guest, name)(self.value, *others)


class Guest:
    """Answers one program's calls from one model, and keeps the groundings."""

    def __init__(self, segcad: SegCad, control: RunControl, memory_bytes: int) -> None:
        """`memory_bytes`: what the model's objects may take here, outside the interpreter's heap."""
        self._segcad = segcad
        self._control = control
        self._memory_bytes = memory_bytes
        self.views: dict[UUID, View] = {}
        """Every object that the program was given, by the id that the interpreter knows it by."""
        self._found: dict[tuple[str | PartQuery, tuple[Side, ...] | None], list[PartView]] = {}
        self._faces: dict[str, list[View]] = {}
        self.groundings: list[Grounding] = []
        self.ended: BaseException | None = None
        self.absence: Absence | None = None
        """The last measure that was asked for in vain."""

    def names(self) -> dict[str, Any]:
        """What a program's undefined names stand for, but for `shape`, which is asked for when it is read."""
        return {"find_parts": self.find_parts} | {kind.__name__: wrapper for kind, wrapper in _CLASSES.items()}

    def original(self, value: Any) -> Any:
        """The model's own object, where `value` is what a restored session says in place of it; else `value`."""
        view = self.views.get(value.id) if isinstance(value, MontyClassProxy) else None
        return value if view is None else view.value

    def originals(self, values: tuple[Any, ...]) -> tuple[Any, ...]:
        """The same of each of `values`."""
        return tuple(map(self.original, values))

    def shape(self) -> View:
        """The variable `shape`."""
        shape = self._ask(self._segcad.shape)
        bodies = [View(self, body, body_measures(body)) for body in shape.bodies]
        return View(self, shape, {**shape_measures(shape), "bodies": bodies})

    def find_parts(self, description: str | dict[str, Any], sides: Sequence[str] | str | None = None) -> list[PartView]:
        """The function `find_parts`. A call made before is answered from the first."""
        key = (_description(description), _sides(sides))
        if key not in self._found:
            self._found[key] = [PartView(self, part, part_measures(part)) for part in self._ground(*key).parts]
        return self._found[key]

    def faces(self, part: Part) -> list[View]:
        """A part's attribute `faces`."""
        if part.id not in self._faces:
            self._takes(len(part.faces), 0)
            faces = self._ask(lambda: self._segcad.faces(part.faces))
            self._faces[part.id] = [View(self, face, face_measures(face)) for face in faces]
        return self._faces[part.id]

    def distance_to(self, part: Part, other: Part) -> float:
        """How far apart are the surfaces of two parts, in metres?"""
        return self._ask(lambda: self._segcad.distance(part.id, other.id))

    def edge_distance(self, part: Part) -> float:
        """How far is a part from the outer edge of the face that it lies in, in metres?"""
        return self._ask(lambda: self._segcad.edge_distance(part.id))

    def center_distance(self, part: Part, other: Part) -> float:
        """How far apart are the centres of two parts, in metres?

        Of holes, and of gears, on parallel axes, how far apart the axes are: what drawings say, whatever the depths.
        """
        if part.kind == other.kind and part.kind in ("hole", "gear") and part.axis and other.axis:
            apart = [b - a for a, b in zip(part.center, other.center, strict=True)]
            along = sum(a * b for a, b in zip(apart, part.axis, strict=True))
            aside = math.sqrt(max(0.0, sum(a * a for a in apart) - along**2))
            if self.angle_to(part, other) < _PARALLEL and aside > BOX_SLACK_M:
                return aside
        return math.dist(part.center, other.center)

    def angle_to(self, part: Part, other: Part) -> float:
        """Which angle, 0 to pi/2, do the axes (or normals) of two parts enclose?

        From the cross and the dot product, which loses no digits near 0 and pi/2 as acos and asin do.
        """
        (ax, ay, az), (bx, by, bz) = self._direction(part), self._direction(other)
        cross = math.hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)
        return math.atan2(cross, abs(ax * bx + ay * by + az * bz))

    def is_in(self, part: Part, other: Part) -> bool:
        """Does one part lie in or on another: is it carried by it, or its centre or opening in the other's box?

        In a pattern of such parts, and in a gear of teeth, is what belongs to it.
        """
        if other.kind in ("pattern", "gear") and any(child.startswith(f"{part.kind}-") for child in other.children):
            return part.id in other.children
        points = [part.center] if part.opening is None else [part.center, part.opening]
        return part.id in other.children or any(
            all(abs(c - m) <= e / 2 + BOX_SLACK_M for c, m, e in zip(point, other.center, other.extents, strict=True))
            for point in points
        )

    def explain(self, type_name: str, attribute: str) -> Absence | None:
        """What is it that had no such attribute? None when no object of the guest API is known to lack it.

        Inside some callbacks the interpreter does not ask the host for an attribute; the parts found tell then.
        """
        if self.absence is not None and self.absence.missing.attribute == attribute[:ATTRIBUTE_CHARS]:
            return self.absence
        views = (view for found in self._found.values() for view in found)
        lacking = (view for view in views if type_name == "Part" and attribute not in view.measures)
        return next((view.lacks(attribute) for view in lacking), None)

    def _direction(self, part: Part) -> Vector:
        direction = part.axis or part.normal
        if direction is None:
            self.absence = _absence(part, "axis", f"{_noun(part)} has neither axis nor normal")
            raise AttributeError(self.absence.text)
        return direction

    def _ground(self, description: str | PartQuery, sides: tuple[Side, ...] | None) -> Grounding:
        if len(self.groundings) >= DESCRIPTIONS:
            self._end(RunEndedError(RunStatus.REFUSED, f"the program asked for more than {DESCRIPTIONS} descriptions"))
        grounding = self._ask(lambda: self._segcad.find_parts(description, sides))
        self._takes(len(grounding.parts), sum(len(part.faces) for part in grounding.parts))
        self.groundings.append(grounding)
        if not grounding.understood:
            nearest = f"; the nearest known terms are: {', '.join(grounding.nearest)}" if grounding.nearest else ""
            reason = f": {grounding.message.rstrip('.')}" if grounding.message else ""
            self._end(RunEndedError(RunStatus.RAISED, f"not grounded: {grounding.description!r}{reason}{nearest}"))
        return grounding

    def _takes(self, objects: int, ids: int) -> None:
        """Counts what a reply keeps in this process towards the run's memory."""
        self._memory_bytes -= objects * OBJECT_BYTES + ids * ID_BYTES
        if self._memory_bytes < 0:
            self._end(RunEndedError(RunStatus.OUT_OF_MEMORY, "the program asked for more parts than its memory holds"))

    def _ask(self, call: Callable[[], T]) -> T:
        try:
            with self._control.in_segcad():
                found = call()
            self._control.check()
        except BaseException as error:  # SegCAD's own failure is no exception of the program's
            self._end(error)
        return found

    def _end(self, reason: BaseException) -> NoReturn:
        self.ended = reason
        raise RuntimeError("the run has ended")


def _noun(value: Part | Face | Body | Shape) -> str:
    match value:
        case Part():
            return f"part {value.id!r}"
        case Face():
            return f"face {value.id} ({value.kind.value})"
        case Body():
            return f"body {value.id}"
        case Shape():
            return "the model"


def _absence(value: Part | Face | Body | Shape, attribute: str, text: str) -> Absence:
    part = value.id if isinstance(value, Part) else ""
    return Absence(text, MissingAttribute(part=part, attribute=attribute[:ATTRIBUTE_CHARS]))


def _description(description: object) -> str | PartQuery:
    if isinstance(description, dict):
        try:
            return PartQuery.model_validate_json(json.dumps(description))
        except (TypeError, ValueError) as problem:
            raise ValueError(f"find_parts() takes no such query: {str(problem)[:200]}") from None
    if not isinstance(description, str):
        raise TypeError("find_parts() takes a description as text, such as 'through hole', or a query as a dict")
    if not description.strip() or len(description) > DESCRIPTION_CHARS:
        raise ValueError(f"a description has 1 to {DESCRIPTION_CHARS} characters")
    return description.strip()


def _sides(sides: object) -> tuple[Side, ...] | None:
    """The sides asked for, in the order of `Side`; None for every side."""
    if sides is None:
        return None
    words = [sides] if isinstance(sides, str) else sides
    if not isinstance(words, (list, tuple, set, frozenset)) or not all(isinstance(word, str) for word in words):
        raise TypeError("find_parts() takes its sides as a list such as ['top', 'left'], or None for every side")
    unknown = sorted(set(words) - _SIDES.keys())
    if unknown or not words:
        problem = f"no side is called {unknown[0][:40]!r}" if unknown else "no side given"
        raise ValueError(f"{problem}: use {', '.join(_SIDES)}")
    return tuple(side for word, side in _SIDES.items() if word in words)
