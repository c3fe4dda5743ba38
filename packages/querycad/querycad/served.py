"""A model that a service holds: `Model` through a `Client`, and `AsyncModel`, whose methods are awaited."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from functools import wraps
from typing import Concatenate, ParamSpec, Protocol, TypeVar

from querycad_contracts import (
    AnswerOptions,
    AnswerRecord,
    AnswerType,
    Description,
    GroundedBy,
    Grounding,
    LengthUnit,
    ModelResource,
    ModelSummary,
    ParameterSet,
    ParametersRequest,
    Part,
    ProgramRequest,
    RunOutcome,
    Shape,
    Side,
    Table,
    TableKind,
    ViewName,
)

from . import flows
from .flows import Flow
from .model import Model, Parts

T = TypeVar("T")
P = ParamSpec("P")

ANSWER_S = 300.0
PAGE = 1000
"""Parts asked for in one request."""


class Does(Protocol):
    """Does what a flow says, and waits for what comes of it."""

    def __call__(self, flow: Flow[T], /) -> T:
        """What comes of it."""
        ...


class Served:
    """What a service tells of one of its models: a `Source`."""

    def __init__(self, found: ModelResource, do: Does) -> None:
        self.name = found.file_name
        self.id = found.id
        self._summary = found.summary
        self._do = do

    def ask(self, question: str, unit: LengthUnit, options: AnswerOptions) -> tuple[AnswerRecord, Callable[[], bytes]]:
        """The answer, and what fetches its picture."""
        job = self._do(flows.submit(self.id, question, unit, options)).id
        return self._do(flows.wait(job, ANSWER_S)), lambda: self._do(flows.picture(self.id, job))

    def summary(self) -> ModelSummary:
        """As it was when the model was opened."""
        if self._summary is None:
            raise flows.ServerUnreachable("no description of the model came: this is no QueryCAD service")
        return self._summary

    def parts(self) -> tuple[Part, ...]:
        """Page by page."""
        found: list[Part] = []
        while True:
            page = self._do(flows.parts(self.id, None, len(found), PAGE))
            found += page.items
            if not page.items or len(found) >= page.total:
                return tuple(found)

    def find_parts(self, description: str, sides: Sequence[Side] | None, grounding: GroundedBy) -> Grounding:
        """Which parts are meant?"""
        return self._do(flows.find_parts(self.id, description, sides, grounding))

    def describe(self, unit: LengthUnit) -> Description:
        """What is it?"""
        return self._do(flows.describe(self.id, unit))

    def table(self, kind: TableKind, grouped: bool | None, unit: LengthUnit) -> Table:
        """A row each."""
        return self._do(flows.table(self.id, kind, grouped, unit))

    def parameters(self, asked: ParametersRequest, other: Callable[[], Sequence[Part]] | None) -> ParameterSet:  # noqa: ARG002
        """What are they? The service has the parts of the other model."""
        return self._do(flows.parameters(self.id, asked))

    def run(self, code: str, expects: AnswerType | None) -> RunOutcome:
        """What comes of the program?"""
        return self._do(flows.run(self.id, ProgramRequest(code=code, expects=expects)))

    def view(self, view: ViewName, width: int, height: int) -> bytes:
        """A PNG file, sizes in pixels."""
        return self._do(flows.view(self.id, view, width, height))


def _awaited(
    method: Callable[Concatenate[Model, P], T],
) -> Callable[Concatenate[AsyncModel, P], Awaitable[T]]:
    """The method, done in a thread while the event loop goes on; its requests are the loop's."""

    @wraps(method)
    async def awaited(self: AsyncModel, /, *arguments: P.args, **named: P.kwargs) -> T:
        return await asyncio.to_thread(method, self._model, *arguments, **named)

    return awaited


class AsyncModel:
    """`Model` for asynchronous programs: the same methods, to be awaited. `AsyncClient.open` gives one."""

    def __init__(self, model: Model) -> None:
        self._model = model
        self.id = model.id
        self.name = model.name
        self.unit = model.unit

    @property
    def summary(self) -> ModelSummary:
        """What it holds, in short: the shape, how many parts of each kind, warnings."""
        return self._model.summary

    @property
    def shape(self) -> Shape:
        """The whole: centre (m), extents (m), volume (m3), area (m2), bodies."""
        return self._model.shape

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is odd about the file, such as repaired faces."""
        return self._model.warnings

    async def parts(self) -> Parts:
        """All parts that were recognised, sorted by id."""
        return await asyncio.to_thread(lambda: self._model.parts)

    part = _awaited(Model.part)
    ask = _awaited(Model.ask)
    find_parts = _awaited(Model.find_parts)
    measure = _awaited(Model.measure)
    distance = _awaited(Model.distance)
    angle = _awaited(Model.angle)
    describe = _awaited(Model.describe)
    table = _awaited(Model.table)
    compare = _awaited(Model.compare)
    parameters = _awaited(Model.parameters)
    run = _awaited(Model.run)
    picture = _awaited(Model.picture)
