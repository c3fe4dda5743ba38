"""The host side of one run's guest API: what a program's calls do, and what they leave behind.

A call that the program got wrong raises TypeError, ValueError or AttributeError into the program. A call that ends the
run (`RunEndedError`), or a failure of the segworker, is kept in `Guest.ended`: whatever the program does with the
exception that it sees, the run is over.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Final, NoReturn, TypeVar
from uuid import UUID

from pydantic_monty import ClassInstance, ClassType, MontyClassProxy

from querycad_contracts import (
    MOST_SHOWN,
    Body,
    Face,
    Grounding,
    MissingAttribute,
    NoSuchMeasure,
    Part,
    PartFinder,
    PartKind,
    PartQuery,
    PictureRequest,
    RunStatus,
    Shape,
    Side,
    Vector,
)
from querycad_contracts.guest_reference import guest_api
from querycad_contracts.places import is_inside
from querycad_contracts.vectors import cross, dot, sub

from .control import RunControl, RunEndedError
from .measures import (
    LocalFrame,
    Measures,
    Opening,
    body_measures,
    face_frame,
    face_measures,
    frame_measures,
    opening_measures,
    openings_of,
    part_frame,
    part_measures,
    shape_measures,
)
from .rewriting import WORDS_LEFT
from .selection import (
    by_distance,
    call_text,
    center_of,
    chosen_parts,
    description_of,
    face_query,
    sides_of,
)

T = TypeVar("T")

WITH_PART: Final = frozenset({"distance_to", "center_distance", "angle_to", "is_in", "overlap_with"})
PART_METHODS: Final = WITH_PART | {"edge_distance", "size_in", "measures"}
ON_DEMAND: Final[dict[type, tuple[str, ...]]] = {
    Part: ("faces", "frame", "openings"),
    Face: ("neighbours", "part", "frame"),
}
"""Attributes that are made, or asked for, when a program reads them."""
FUNCTIONS: Final = ("find_parts", "parts", "faces", "adjacent", "look", "picture")
"""What of the guest API asks the host; the rest is Python inside the sandbox."""
BOX_SLACK_M: Final = 1e-6
"""A centre on the border of a box counts as in it: above kernel noise, below drawing accuracy."""
FACES: Final = 5000
"""Most faces of one faces() call; a program that wants more has not said which."""
SAID_CHARS: Final = 300
"""Of a call of parts or faces, where it stands for what was asked."""
ATTRIBUTE_CHARS: Final = 100
"""Of the name of a measure that is not there, which is the program's to choose."""
OBJECT_BYTES, ID_BYTES = 6000, 40
"""Of a part or face with what a program sees of it, and of each of its faces' numbers: measured with tracemalloc."""
PICTURES: Final = 3
"""Most pictures of one run: each is a thousand tokens to whoever is shown it."""
DESCRIPTIONS: Final = 100
"""Most different calls of a run that find parts or faces; each may take long, and its time is not the program's."""

_PARALLEL: Final = 1e-3
"""Radians; axes nearer to one direction are parallel."""
Seen = Part | Face | Body | Shape | LocalFrame | Opening
_NAMES: Final = {
    Part: "Part", Face: "Face", Body: "Body", Shape: "Shape", LocalFrame: "Frame", Opening: "Opening",
}  # fmt: skip
_CLASSES: Final = {kind: ClassType(kind) for kind in _NAMES}
"""How a program sees the classes of the guest API: it can ask isinstance(), and make no objects of them."""
_KNOWN: Final = {each.name: frozenset(one.name for one in each.attributes) for each in guest_api().classes}
"""The attributes of each class: of these an object that lacks one has None."""


@dataclass(frozen=True, slots=True)
class Absence:
    """A measure that an object of the model does not have, and what the program is told of that."""

    text: str
    missing: MissingAttribute


class View(ClassInstance):
    """An object of the model as a program sees it: its measures, and an AttributeError for any other name."""

    def __init__(self, guest: Guest, value: Seen, measures: Measures) -> None:
        super().__init__(value, class_type=_CLASSES[type(value)])
        self.guest = guest
        self.measures = measures
        guest.views[self.id] = self

    def get_eager_attrs(self) -> dict[str, Any]:
        """The measures that go into the sandbox with the object."""
        return self.measures

    def lookup_lazy_attrs(self, name: str) -> Any:
        """A measure that the object does not have is None; a name that is none of the guest API is an error."""
        if name in ON_DEMAND.get(type(self.value), ()) and (made := self.guest.made(self.value, name)) is not None:
            return made
        self.guest.absence = self.lacks(name)
        if name in _KNOWN[_NAMES[type(self.value)]] and not self.guest.is_strict:
            return None
        raise AttributeError(self.guest.absence.text)

    def lacks(self, name: str) -> Absence:
        """What to say of a measure that the object does not have?"""
        has = ", ".join(sorted(self.measures))
        is_method = isinstance(self.value, Part) and name in PART_METHODS
        text = f"{name} is called: {name}(…)" if is_method else f"{_noun(self.value)} has no {name}; it has {has}"
        return _absence(self.value, name, text)


class PartView(View):
    """A part: measures to other parts when asked."""

    def call_method(self, name: str, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
        """Calls one of the part's methods."""
        if name not in PART_METHODS:
            return super().call_method(name, args, kwargs)
        parameter, kind = ("frame", LocalFrame) if name == "size_in" else ("other", Part)
        if kwargs.keys() - {parameter}:
            raise TypeError(f"{name}() takes no argument {sorted(kwargs)[0][:40]!r}")
        others = (*args, *kwargs.values())
        wanted = 1 if name in WITH_PART or name == "size_in" else 0
        if len(others) != wanted:
            told = "one frame" if kind is LocalFrame else "one other part" if wanted else "no arguments"
            raise TypeError(f"{name}() takes {told}")
        if not all(isinstance(other, kind) for other in others):
            told = "a frame, such as part.frame" if kind is LocalFrame else "a part; offset(a, b) takes faces too"
            raise TypeError(f"{name}() takes {told}")
        if name == "measures":
            return sorted(self.measures)
        return getattr(self.guest, name)(self.value, *others)


class Guest:
    """Answers one program's calls from one model, and keeps the groundings."""

    def __init__(self, finder: PartFinder, control: RunControl, memory_bytes: int, is_strict: bool = False) -> None:
        """`memory_bytes`: what the model's objects may take here, outside the interpreter's heap.

        `is_strict`: a measure that is not there is an AttributeError, as programs expect that catch it.
        """
        self.is_strict = is_strict
        self._finder = finder
        self._control = control
        self._memory_bytes = memory_bytes
        self.views: dict[UUID, View] = {}
        """Every object that the program was given, by the id that the interpreter knows it by."""
        self._found: dict[tuple[str | PartQuery, tuple[Side, ...] | None], list[PartView]] = {}
        self._said: dict[tuple[str | PartQuery, tuple[Side, ...] | None], Grounding] = {}
        self._last: Grounding | None = None
        """Of the find_parts call before."""
        self._chosen: dict[str, list[PartView] | list[View]] = {}
        """What parts and faces gave, by the call."""
        self._made: dict[tuple[type, str | int, str], Any] = {}
        self._face_views: dict[int, View] = {}
        self._part_views: dict[str, PartView] = {}
        self._parts: tuple[Part, ...] | None = None
        self._by_id: dict[str, Part] = {}
        self.groundings: list[Grounding] = []
        self.pictures: list[PictureRequest] = []
        self.ended: BaseException | None = None
        self.absence: Absence | None = None
        """The last measure that was asked for in vain."""

    def names(self) -> dict[str, Any]:
        """What a program's undefined names stand for, but for `shape`, which is asked for when it is read."""
        functions = {name: getattr(self, name) for name in FUNCTIONS}
        functions[WORDS_LEFT] = self.words_left
        return functions | {_NAMES[kind]: wrapper for kind, wrapper in _CLASSES.items()}

    def original(self, value: Any) -> Any:
        """The model's own object, where `value` is what a restored session says in place of it; else `value`."""
        view = self.views.get(value.id) if isinstance(value, MontyClassProxy) else None
        return value if view is None else view.value

    def originals(self, values: tuple[Any, ...]) -> tuple[Any, ...]:
        """The same of each of `values`."""
        return tuple(map(self.original, values))

    def shape(self) -> View:
        """The variable `shape`."""
        shape = self._ask(self._finder.shape)
        bodies = [View(self, body, body_measures(body)) for body in shape.bodies]
        return View(self, shape, {**shape_measures(shape), "bodies": bodies})

    def find_parts(self, description: str | dict[str, Any], sides: Sequence[str] | str | None = None) -> list[PartView]:
        """The function `find_parts`. A call made before is answered from the first."""
        key = (description_of(description), sides_of(sides))
        if key not in self._found:
            self._said[key] = self._ground(*key)
            self._found[key] = [self._part_view(part) for part in self._said[key].parts]
        self._last = self._said[key]
        return self._found[key]

    def words_left(self) -> list[list[str]]:
        """Of the find_parts call before: the words that were passed over, and what could not be checked."""
        said = self._last
        return [[], []] if said is None else [list(said.ignored), list(said.unchecked)]

    def parts(
        self,
        kind: object = None,
        tags: object = None,
        side: object = None,
        diameter: object = None,
        near: object = None,
    ) -> list[PartView]:
        """The function `parts`."""
        point = None if near is None else center_of(near)
        said = call_text("parts", kind=kind, tags=tags, side=side, diameter=diameter)
        if said not in self._chosen:
            found = chosen_parts(self._inventory(), kind, tags, side, diameter)
            message = "" if found else f"no part of the model matches: {said[:SAID_CHARS]}"
            self._count()
            self.groundings.append(_grounding(said, found, message))
            self._chosen[said] = [self._part_view(part) for part in found]
        views = {view.value.id: view for view in self._chosen[said] if isinstance(view, PartView)}
        if point is None:
            return list(views.values())
        return [views[part.id] for part in by_distance([view.value for view in views.values()], point)]

    def faces(
        self,
        kind: object = None,
        convexity: object = None,
        facing: object = None,
        radius: object = None,
        coaxial_with: object = None,
        body: object = None,
    ) -> list[View]:
        """The function `faces`. What an answer rests on is the part that they make together."""
        query = face_query(kind, convexity, facing, radius, coaxial_with, body)
        said = call_text(
            "faces", kind=kind, convexity=convexity, facing=facing, radius=radius, coaxial_with=coaxial_with, body=body
        )
        if said not in self._chosen:
            self._count()
            found = self._ask(lambda: self._finder.find_faces(query))
            self._takes(found.faces)
            if len(found.faces) > FACES:
                raise ValueError(f"more than {FACES:,} faces match: narrow the query")
            if found.part is not None:
                self.groundings.append(_grounding(said, (found.part,)))
            self._chosen[said] = [self._face_view(face) for face in found.faces]
        return [*self._chosen[said]]

    def look(self, phrase: object) -> list[PartView]:
        """The function `look`: what was seen in pictures, where whoever looks has done so."""
        said = call_text("look", phrase=phrase)
        if not isinstance(phrase, str) or not phrase.strip():
            raise TypeError("look() takes a few words, such as 'logo'")
        if said not in self._chosen:
            self._count()
            grounding = self._ask(lambda: self._finder.look(phrase[:SAID_CHARS]))
            self._takes(grounding.parts)
            self.groundings.append(grounding)
            self._chosen[said] = [self._part_view(part) for part in grounding.parts]
        return [view for view in self._chosen[said] if isinstance(view, PartView)]

    def picture(self, side: object = None, parts: object = None) -> None:
        """The function `picture`: notes what is to be drawn once the program has ended."""
        sides = sides_of(side, "picture")
        if sides is not None and len(sides) != 1:
            raise ValueError("picture() takes one side")
        shown = [parts] if isinstance(parts, Part) else list(parts) if isinstance(parts, list | tuple) else []
        if not all(isinstance(each, Part) for each in shown) or (parts is not None and not shown):
            raise TypeError("picture() takes a list of parts")
        if len(shown) > MOST_SHOWN:
            raise ValueError(f"picture() numbers {MOST_SHOWN} parts at most: say which")
        asked = PictureRequest(side=sides[0] if sides else None, parts=tuple(dict.fromkeys(one.id for one in shown)))
        if asked not in self.pictures:
            if len(self.pictures) >= PICTURES:
                raise ValueError(f"a program may ask for {PICTURES} pictures")
            self.pictures.append(asked)

    def adjacent(self, a: object, b: object) -> bool:
        """The function `adjacent`: do they share a face, or an edge?"""
        first, second = self._faces_of(a), self._faces_of(b)
        ids = {face.id for face in second}
        return any(face.id in ids or not ids.isdisjoint(face.neighbours) for face in first)

    def made(self, value: Seen, name: str) -> Any:
        """An attribute of `ON_DEMAND`, made once; None where the object has none."""
        if isinstance(value, Part | Face):
            key = (type(value), value.id, name)
            if key not in self._made:
                self._made[key] = self._of_part(value, name) if isinstance(value, Part) else self._of_face(value, name)
            return self._made[key]
        return None

    def _of_part(self, part: Part, name: str) -> Any:
        if name == "openings":
            return [self._plain_view(one) for one in openings_of(part)] or None
        faces = self._faces_of(part)
        self._takes(faces)
        if name == "faces":
            return [self._face_view(face) for face in faces]
        frame = part_frame(part, faces)
        return None if frame is None else self._plain_view(frame)

    def _of_face(self, face: Face, name: str) -> Any:
        if name == "neighbours":
            return [self._face_view(each) for each in self._ask(lambda: self._finder.faces(face.neighbours))]
        if name == "part":
            self._inventory()
            return self._part_view(self._by_id[face.part]) if face.part in self._by_id else None
        frame = face_frame(face)
        return None if frame is None else self._plain_view(frame)

    def size_in(self, part: Part, frame: LocalFrame) -> Vector:
        """How large is a part along the axes of a frame, in metres?"""
        x, y, z = (self._ask(partial(self._finder.extent, part.id, way)) for way in (frame.x, frame.y, frame.z))
        return (x, y, z)

    def distance_to(self, part: Part, other: Part) -> float:
        """How far apart are the surfaces of two parts, in metres?"""
        return self._ask(lambda: self._finder.distance(part.id, other.id))

    def overlap_with(self, part: Part, other: Part) -> float:
        """Which volume do two bodies share, in m3?"""
        for one in (part, other):
            if one.kind is not PartKind.BODY:
                raise ValueError(f"overlap_with() takes bodies; {_noun(one)} is none")
            if one.volume is None:
                raise ValueError(f"{_noun(one)} is not closed, so nothing can be inside it")
        return self._ask(lambda: self._finder.overlap(part.id, other.id))

    def edge_distance(self, part: Part) -> float:
        """How far is a part from the outer edge of the face that it lies in, in metres?"""
        return self._ask(lambda: self._finder.edge_distance(part.id))

    def center_distance(self, part: Part, other: Part) -> float:
        """How far apart are the centres of two parts, in metres; of two round ones on parallel axes, those axes?"""
        if (part.radius or part.kind is PartKind.GEAR) and part.kind == other.kind and part.axis and other.axis:
            apart = sub(other.center, part.center)
            aside = math.sqrt(max(0.0, dot(apart, apart) - dot(apart, part.axis) ** 2))
            if self.angle_to(part, other) < _PARALLEL and aside > BOX_SLACK_M:
                return aside
        return math.dist(part.center, other.center)

    def angle_to(self, part: Part, other: Part) -> float:
        """Which angle, 0 to pi/2, do the axes (or normals) of two parts enclose? Of arms, which point outwards, to pi.

        From the cross and the dot product, which loses no digits near 0 and pi/2 as acos and asin do.
        """
        a, b = self._direction(part), self._direction(other)
        cosine = dot(a, b) if "arm" in part.tags and "arm" in other.tags else abs(dot(a, b))
        return math.atan2(math.hypot(*cross(a, b)), cosine)

    def is_in(self, part: Part, other: Part) -> bool:
        """Does one part lie in or on another? As `is_inside` has it."""
        return is_inside(part, other)

    def explain(self, type_name: str, attribute: str) -> Absence | None:
        """What is it that had no such attribute? None when no object of the guest API is known to lack it.

        Inside some callbacks the interpreter does not ask the host for an attribute; the parts found tell then.
        """
        if self.absence is not None and self.absence.missing.attribute == attribute[:ATTRIBUTE_CHARS]:
            return self.absence
        views = (view for found in self._found.values() for view in found)
        kept = (view for view in self._part_views.values())
        lacking = (view for view in (*views, *kept) if type_name == "Part" and attribute not in view.measures)
        return next((view.lacks(attribute) for view in lacking), None)

    def _direction(self, part: Part) -> Vector:
        direction = part.axis or part.normal
        if direction is None:
            self.absence = _absence(part, "axis", f"{_noun(part)} has neither axis nor normal")
            raise AttributeError(self.absence.text)
        return direction

    def _ground(self, description: str | PartQuery, sides: tuple[Side, ...] | None) -> Grounding:
        self._count()
        grounding = self._ask(lambda: self._finder.find_parts(description, sides))
        self._takes(grounding.parts)
        self.groundings.append(grounding)
        if not grounding.understood:
            nearest = f"; the nearest known terms are: {', '.join(grounding.nearest)}" if grounding.nearest else ""
            reason = f": {grounding.message.rstrip('.')}" if grounding.message else ""
            self._end(RunEndedError(RunStatus.RAISED, f"not grounded: {grounding.description!r}{reason}{nearest}"))
        return grounding

    def _count(self) -> None:
        if len(self.groundings) >= DESCRIPTIONS:
            self._end(RunEndedError(RunStatus.REFUSED, f"the program asked for more than {DESCRIPTIONS} descriptions"))

    def _inventory(self) -> tuple[Part, ...]:
        """All parts of the model, fetched once."""
        if self._parts is None:
            self._parts = self._ask(self._finder.parts)
            self._takes(self._parts)
            self._by_id = {part.id: part for part in self._parts}
        return self._parts

    def _part_view(self, part: Part) -> PartView:
        """The part as the program sees it: one object however often it is found."""
        known = self._part_views.get(part.id)
        if known is None or (known.value is not part and known.value != part):
            known = self._part_views[part.id] = PartView(self, part, part_measures(part))
        return known

    def _face_view(self, face: Face) -> View:
        if face.id not in self._face_views:
            self._face_views[face.id] = View(self, face, face_measures(face))
        return self._face_views[face.id]

    def _plain_view(self, value: LocalFrame | Opening) -> View:
        return View(self, value, frame_measures(value) if isinstance(value, LocalFrame) else opening_measures(value))

    def _faces_of(self, value: object) -> tuple[Face, ...]:
        if isinstance(value, Face):
            return (value,)
        if isinstance(value, Part):
            return self._ask(lambda: self._finder.faces(value.faces)) if value.faces else ()
        raise TypeError("adjacent() takes two parts or faces")

    def _takes(self, kept: Sequence[Part | Face]) -> None:
        """Counts what a reply keeps in this process towards the run's memory."""
        ids = sum(len(one.faces if isinstance(one, Part) else one.neighbours) for one in kept)
        self._memory_bytes -= len(kept) * OBJECT_BYTES + ids * ID_BYTES
        if self._memory_bytes < 0:
            self._end(RunEndedError(RunStatus.OUT_OF_MEMORY, "the program asked for more parts than its memory holds"))

    def _ask(self, call: Callable[[], T]) -> T:
        try:
            with self._control.in_segworker():
                found = call()
            self._control.check()
        except NoSuchMeasure as error:  # the program may do without it
            raise ValueError(str(error)) from None
        except BaseException as error:  # the segworker's own failure is no exception of the program's
            self._end(error)
        return found

    def _end(self, reason: BaseException) -> NoReturn:
        self.ended = reason
        raise RuntimeError("the run has ended")


def _grounding(said: str, parts: Sequence[Part], message: str = "") -> Grounding:
    """What a typed call gave, as an answer's evidence."""
    return Grounding(description=said[:SAID_CHARS], sides=None, parts=tuple(parts), understood=True, message=message)


def _noun(value: Seen) -> str:
    match value:
        case Part():
            return f"part {value.id!r}"
        case Face():
            return f"face {value.id} ({value.kind.value})"
        case Body():
            return f"body {value.id}"
        case Shape():
            return "the model"
    return "a frame" if isinstance(value, LocalFrame) else "an opening"


def _absence(value: Seen, attribute: str, text: str) -> Absence:
    part = value.id if isinstance(value, Part) else ""
    return Absence(text, MissingAttribute(part=part, attribute=attribute[:ATTRIBUTE_CHARS]))
