"""A model that is open: ask it, find and measure its parts, look at it. The same on this machine and in a service.

Values are SI: metres, square and cubic metres, radians. Points and directions are in the frame of the file, z up.
`unit` is that of lengths in texts alone: 54 mm are `0.054` as a value and "54 mm" as text.
"""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, Literal, Protocol, Self, TypeAlias

from pydantic import PrivateAttr

from querycad_answering.answering import NO_OPTIONS, no_question
from querycad_answering.drawing.callouts import callouts
from querycad_answering.drawing.comparing import compare
from querycad_answering.typed import WrongAnswerType, typed_answer
from querycad_contracts import (
    Answer,
    AnswerOptions,
    AnswerRecord,
    AnswerType,
    Comparison,
    Description,
    Expectation,
    GroundedBy,
    Grounding,
    LengthUnit,
    Measure,
    ModelSummary,
    ParameterSet,
    ParametersRequest,
    Part,
    PartKind,
    RunOutcome,
    Selection,
    Shape,
    Side,
    Status,
    Table,
    TableKind,
    Unit,
    ViewName,
)
from querycad_contracts.resources import DESCRIPTION_CHARS
from querycad_contracts.services import PIXELS
from querycad_language.forms import Get

from .inputs import Parameters, listed, named, request_fields
from .measuring import UNITS, NoValue, measuring, value_of

SIZE = (800, 600)
"""Width and height of a picture of the model, pixels."""
PARTS_SHOWN = 30
"""Rows of parts in a notebook; the rest is counted."""

OnePart: TypeAlias = Part | str
"""A part, or its id such as 'hole-4'."""
UnitName: TypeAlias = LengthUnit | Literal["mm", "cm", "m", "in"]
SideName: TypeAlias = Side | Literal["top", "bottom", "left", "right", "front", "back"]


class Picture(bytes):
    """A PNG file. A notebook shows it."""

    def save(self, path: Path | str) -> Path:
        """Writes the file, and its folder where there is none. Raises OSError."""
        target = Path(path)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(self)
        return target

    def _repr_png_(self) -> bytes:
        return bytes(self)


class Parts(tuple[Part, ...]):
    """Parts of a model, sorted by id. Where words found none, `message` says why and `nearest` what would be found."""

    message: str = ""
    nearest: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    """What the words say and nothing could be checked by."""

    @classmethod
    def of(cls, grounding: Grounding) -> Self:
        """What words were grounded on."""
        found = cls(grounding.parts)
        found.message, found.nearest, found.warnings = grounding.message, grounding.nearest, grounding.warnings
        return found

    @property
    def ids(self) -> tuple[str, ...]:
        """Such as ('hole-4', 'hole-6')."""
        return tuple(part.id for part in self)

    def _repr_html_(self) -> str:
        return _parts_html(self) if self else f"<p>{html.escape(self.message or 'no parts')}</p>"


class Reply(AnswerRecord):
    """The answer to one question, with all that it rests on: `print` it, take its `value`, look at its `picture()`.

    `status` is 'answered', 'unsure' (`alternatives` has other readings), 'not_grounded' or 'failed' (`failure` says
    why). `confidence` is the probability that the value is right.
    """

    _draw: Callable[[], bytes] | None = PrivateAttr(None)

    @classmethod
    def of(cls, record: AnswerRecord, draw: Callable[[], bytes]) -> Reply:
        """The record, and what draws its picture."""
        reply = cls.model_construct(**dict(record))
        reply._draw = draw
        return reply

    @property
    def value(self) -> Any:
        """In SI: a number, a text, a point or size of three floats, or a list of such; None where there is none."""
        return None if self.answer is None else self.answer.value

    @property
    def type(self) -> AnswerType | None:
        """What kind of value it is; None where there is none."""
        return None if self.answer is None else self.answer.type

    @property
    def unit(self) -> Unit | None:
        """The value's SI unit, '' for none; None where there is no value."""
        return None if self.answer is None else self.answer.unit

    @property
    def text(self) -> str:
        """The answer as a person reads it, or why there is none."""
        if self.answer is not None:
            return self.answer.text
        assert self.failure is not None
        nearest = f" (known here: {', '.join(self.failure.nearest)})" if self.failure.nearest else ""
        return f"no answer: {self.failure.message}{nearest}"

    def __bool__(self) -> bool:
        """Is there an answer that is sure enough?"""
        return self.status is Status.ANSWERED

    def __str__(self) -> str:
        return self.text

    def picture(self) -> Picture:
        """The model with the parts that the answer rests on marked and numbered. Raises NoValue where there is none."""
        if self._draw is None or self.answer is None:
            raise NoValue(f"there is no picture: {self.text}")
        return Picture(self._draw())

    def _repr_html_(self) -> str:
        if self.answer is None:
            return f"<p><b>{html.escape(self.question)}</b><br>{html.escape(self.text)}</p>"
        sure = "" if self.confidence is None else f" ({self.status}, confidence {self.confidence:.2f})"
        notes = "".join(f"<br>note: {html.escape(each)}" for each in self.warnings)
        return (
            f"<p><b>{html.escape(self.question)}</b><br><span style='font-size:150%'>{html.escape(self.text)}</span>"
            f"<br>understood as: {html.escape(self.understood_as)}{sure}{notes}</p>"
            f"{_image(self.picture())}{_parts_html(self.parts) if self.parts else ''}"
        )


class Source(Protocol):
    """What a model is read through: the runtime on this machine, or a service."""

    id: str
    """SHA-256 of the file."""
    name: str
    """Of the file."""

    def ask(self, question: str, unit: LengthUnit, options: AnswerOptions) -> tuple[AnswerRecord, Callable[[], bytes]]:
        """The answer, and what draws it."""
        ...

    def summary(self) -> ModelSummary:
        """What does the file hold, in short?"""
        ...

    def parts(self) -> tuple[Part, ...]:
        """All of them."""
        ...

    def find_parts(self, description: str, sides: Sequence[Side] | None, grounding: GroundedBy) -> Grounding:
        """Which parts are meant?"""
        ...

    def describe(self, unit: LengthUnit) -> Description:
        """What is it?"""
        ...

    def table(self, kind: TableKind, grouped: bool | None, unit: LengthUnit) -> Table:
        """A row each."""
        ...

    def parameters(self, asked: ParametersRequest, other: Callable[[], Sequence[Part]] | None) -> ParameterSet:
        """What are they? `other` gives the parts of the other model."""
        ...

    def run(self, code: str, expects: AnswerType | None) -> RunOutcome:
        """What comes of the program?"""
        ...

    def view(self, view: ViewName, width: int, height: int) -> bytes:
        """A PNG file, sizes in pixels."""
        ...


class Model:
    """A CAD model. `querycad.open("part.step")` gives one, `Client.open` one that a service holds."""

    def __init__(self, source: Source, unit: UnitName = LengthUnit.MM) -> None:
        self._source = source
        self.unit = named(LengthUnit, unit, "unit")

    def __repr__(self) -> str:
        x, y, z = (each / self.unit.metres for each in self.shape.extents)
        return f"<querycad.Model {self.name!r}: {x:.6g} x {y:.6g} x {z:.6g} {self.unit}, {len(self.parts)} parts>"

    def _unit(self, unit: UnitName | None) -> LengthUnit:
        return named(LengthUnit, unit or self.unit, "unit")

    @property
    def id(self) -> str:
        """SHA-256 of its file, hexadecimal."""
        return self._source.id

    @property
    def name(self) -> str:
        """Of its file."""
        return self._source.name

    @cached_property
    def summary(self) -> ModelSummary:
        """What it holds, in short: the shape, how many parts of each kind, warnings."""
        return self._source.summary()

    @property
    def shape(self) -> Shape:
        """The whole: centre (m), extents (m), volume (m3), area (m2), bodies."""
        return self.summary.shape

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is odd about the file."""
        return self.summary.warnings

    @cached_property
    def parts(self) -> Parts:
        """All parts that were recognised: features, surfaces, bodies, and the model itself."""
        return Parts(self._source.parts())

    @cached_property
    def _by_id(self) -> dict[str, Part]:
        return {part.id: part for part in self.parts}

    def part(self, part: OnePart) -> Part:
        """The part with this id, such as 'hole-4'. Raises KeyError."""
        if isinstance(part, Part):
            return part
        if part not in self._by_id:
            raise KeyError(f"the model has no part {part!r}; `parts.ids` lists them")
        return self._by_id[part]

    def ask(
        self,
        question: str,
        *,
        unit: UnitName | None = None,
        expect: Expectation | AnswerType | str | None = None,
        least_confidence: float | None = None,
        context: Sequence[str] = (),
        select: OnePart | int | Sequence[OnePart | int] = (),
        grounding: GroundedBy | Literal["geometry", "vision", "fused", "eyes"] | None = None,
        options: AnswerOptions = NO_OPTIONS,
    ) -> Reply:
        """What is the answer to a question in English?

        `unit`: of lengths in the text. `expect`: the type of the value; another one is a failure. `least_confidence`:
        an answer less probable than this is unsure (0.45). `context`: questions asked before, the oldest first.
        `select`: parts, their ids, or numbers of faces: what 'it' and 'this' are. `grounding`: what finds parts.
        `options`: the rest, such as who writes the program; what is given beside it goes first.

        Never raises for what is wrong with the question: the reply's `failure` says it. Raises ValueError for an
        option that is none, such as a unit that does not exist.
        """
        if (none := no_question(question)) is not None:
            return Reply.of(none, bytes)
        given_parts = (select,) if isinstance(select, Part | str | int) else select
        chosen = [each.id if isinstance(each, Part) else each for each in given_parts]
        given = {
            "expect": expect
            if isinstance(expect, Expectation | None)
            else Expectation(type=named(AnswerType, expect, "type of answer")),
            "least_confidence": least_confidence,
            "context": listed(context) or None,
            "grounding": None if grounding is None else named(GroundedBy, grounding, "grounding"),
            "selection": Selection(
                parts=tuple(each for each in chosen if isinstance(each, str)),
                faces=tuple(each for each in chosen if isinstance(each, int)),
            )
            if chosen
            else None,
        }
        said = options.model_dump(exclude_unset=True) | {name: each for name, each in given.items() if each is not None}
        options = AnswerOptions.model_validate(said)
        return Reply.of(*self._source.ask(question, self._unit(unit), options))

    def find_parts(
        self,
        description: str,
        sides: SideName | Sequence[SideName] | None = None,
        grounding: GroundedBy | Literal["geometry", "vision", "fused", "eyes"] = GroundedBy.GEOMETRY,
    ) -> Parts:
        """Which parts does a phrase mean, such as 'blind holes', of those visible from any of `sides`?

        Raises ValueError for an empty phrase, and for one of more than 500 characters.
        """
        if not 0 < len(description.strip()) <= len(description) <= DESCRIPTION_CHARS:
            raise ValueError(f"a phrase for parts has 1 to {DESCRIPTION_CHARS} characters")
        seen_from = None if sides is None else tuple(named(Side, side, "side") for side in listed(sides))
        return Parts.of(self._source.find_parts(description, seen_from, named(GroundedBy, grounding, "grounding")))

    def measure(
        self,
        measure: Measure | str,
        of: OnePart | Sequence[OnePart] | None = None,
        *,
        unit: UnitName | None = None,
        density: float | None = None,
    ) -> Answer:
        """What is a measure, such as 'diameter', of a part, of each of several, or of the whole model (None)?

        The measures are those of docs/measures.md: what is meant of a part of that kind is said there. The value is SI,
        in a list where several parts are given. Masses and moments of inertia take a `density`, kg/m3. Raises NoValue
        where a part has no such measure, KeyError and ValueError for an id or a measure that does not exist, ValueError
        for a density that is not above 0.
        """
        wanted = named(Measure, measure, "measure")
        one = of is None or isinstance(of, Part | str)
        parts = () if of is None else (self.part(of),) if isinstance(of, Part | str) else tuple(map(self.part, of))
        code, kind = measuring(Get((wanted,), None, density=density), parts, self._whole, several=not one)
        value = value_of(self.run(code), self.name)
        if value in ([], None) or (isinstance(value, list) and all(each is None for each in value)):
            raise NoValue(f"the file gives no {wanted.value.replace('_', ' ')} of it")
        try:
            found = typed_answer(value, kind, self._unit(unit), code)
        except WrongAnswerType as error:
            raise NoValue(str(error)) from error
        return found.model_copy(update={"text": f"{found.text} {UNITS[wanted]}"}) if wanted in UNITS else found

    def distance(
        self,
        a: OnePart,
        b: OnePart,
        between: Literal["surfaces", "centers"] = "surfaces",
    ) -> float:
        """How far apart are two parts, in metres?

        Between their surfaces, exactly, and 0 where they touch; or between their centres, of holes between their axes.
        """
        methods = {"surfaces": "distance_to", "centers": "center_distance"}
        if between not in methods:
            raise ValueError(f"a distance is between surfaces or centers, not {between!r}")
        return float(self._of_two(methods[between], a, b))

    def angle(self, a: OnePart, b: OnePart) -> float:
        """Which angle do the axes or normals of two parts make? Radians, 0 to pi/2."""
        return float(self._of_two("angle_to", a, b))

    def _of_two(self, method: str, a: OnePart, b: OnePart) -> Any:
        first, second = ({"ids": [self.part(each).id]} for each in (a, b))
        return value_of(self.run(f"solution = find_parts({first})[0].{method}(find_parts({second})[0])"), self.name)

    @property
    def _whole(self) -> Part:
        return next((part for part in self.parts if part.kind is PartKind.MODEL), self.parts[0])

    def describe(self, unit: UnitName | None = None) -> Description:
        """What is the model, and what can be asked about it? `text` has all of it for a person."""
        return self._source.describe(self._unit(unit))

    def table(self, kind: TableKind | str, grouped: bool | None = None, unit: UnitName | None = None) -> Table:
        """The holes, slots, bosses, edges, bends, patterns, fasteners or bodies, a row each; numbers are SI.

        `grouped`: a row for all that are alike; None: so for fasteners and bodies. `unit`: of lengths in texts.
        """
        return self._source.table(named(TableKind, kind, "table"), grouped, self._unit(unit))

    def parameters(self, asked: Parameters, /, other: Model | None = None, **options: Any) -> ParameterSet:
        """What are these named, typed parameters (docs/parameters.md)? What is not sure has a reason, and no value.

        `asked`: a request, its fields, or its parameters alone. `other`: a model whose holes and shafts are mated with
        this one's. `options`: what else a request has, such as `frame` or `least_confidence`; lengths are in `unit`,
        else in the model's. Raises pydantic.ValidationError.
        """
        said = {"unit": self.unit, **request_fields(asked), **({} if other is None else {"other": other.id}), **options}
        others = None if other is None else lambda: other.parts
        return self._source.parameters(ParametersRequest.model_validate(said), others)

    def compare(self, after: Model, unit: UnitName | None = None) -> Comparison:
        """What is different in another model, part by part? `text` has all of it for a person."""
        sides = (self.summary, self.parts), (after.summary, after.parts)
        return compare(*sides, self._unit(unit))

    def run(self, code: str, expects: AnswerType | str | None = None) -> RunOutcome:
        """What comes of a program of the guest API (docs/guest-api.md)? It runs in the sandbox; all it sees is SI.

        However it ended, that is the outcome: `status`, `value`, `message`.
        """
        return self._source.run(code, None if expects is None else named(AnswerType, expects, "type of answer"))

    def picture(
        self, view: ViewName | str = ViewName.ISOMETRIC, width: int = SIZE[0], height: int = SIZE[1]
    ) -> Picture:
        """How does it look from 'isometric', 'top', 'bottom', 'left', 'right', 'front' or 'back'?

        `width` and `height`: 64 to 2048 pixels. Raises ValueError.
        """
        least, most = PIXELS
        if not (least <= width <= most and least <= height <= most):
            raise ValueError(f"a picture has {least} to {most} pixels each way, not {width} x {height}")
        return Picture(self._source.view(named(ViewName, view, "view"), width, height))

    def _repr_html_(self) -> str:
        return f"{_image(self.picture())}<pre>{html.escape(self.describe().text)}</pre>"


def _image(picture: Picture) -> str:
    from base64 import b64encode

    return f"<img style='max-width:100%' src='data:image/png;base64,{b64encode(picture).decode()}'>"


def _parts_html(parts: Sequence[Part]) -> str:
    """A table of like parts, as a drawing would call them out."""
    groups = callouts(parts, known={part.id: part for part in parts})
    rows = "".join(
        f"<tr><td style='text-align:left'>{html.escape(group.text)}</td>"
        f"<td style='text-align:left'>{html.escape(', '.join(group.ids[:8]))}"
        f"{f' and {len(group.ids) - 8} more' if len(group.ids) > 8 else ''}</td></tr>"
        for group in groups[:PARTS_SHOWN]
    )
    more = f"<tr><td>… and {len(groups) - PARTS_SHOWN} more</td></tr>" if len(groups) > PARTS_SHOWN else ""
    return f"<table><tr><th>part, in mm</th><th>ids</th></tr>{rows}{more}</table>"
