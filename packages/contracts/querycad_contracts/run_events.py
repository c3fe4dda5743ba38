"""What a run tells while it goes on: the `data` of the server-sent events of `POST /runs`, named by their `kind`."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from .geometry import Frozen
from .runs import RunId, RunOutcome
from .services import Problem


class RunStarted(Frozen):
    """The first event: the run may be cancelled by this id."""

    kind: Literal["started"] = "started"
    run: RunId


class GuestCall(Frozen):
    """The program calls the guest API, and waits."""

    kind: Literal["call"] = "call"
    call: int = Field(description="Number of the call in its run, from 1.")
    name: str = Field(description="Such as 'find_parts', 'shape', 'faces', 'distance_to'.")
    on: str = Field("", description="Id of the part whose method or attribute it is.")
    arguments: tuple[str, ...] = Field((), description="As text; a part is its id.")


class GuestAnswer(Frozen):
    """The call came back."""

    kind: Literal["answer"] = "answer"
    call: int
    duration_ms: float
    found: int | None = Field(None, description="How many parts or faces it gave.")
    parts: tuple[str, ...] = Field((), description="Ids of the first parts it gave.")
    value: float | None = Field(None, description="The measure it gave.")
    error: str = Field("", description="Why it gave nothing.")


class Printed(Frozen):
    """The program printed."""

    kind: Literal["printed"] = "printed"
    text: str


class RunEnded(Frozen):
    """The last event of a run that could be made."""

    kind: Literal["ended"] = "ended"
    outcome: RunOutcome


class RunFailed(Frozen):
    """The last event of a run that could not: what an HTTP error would have said."""

    kind: Literal["failed"] = "failed"
    problem: Problem


RunEvent = Annotated[RunStarted | GuestCall | GuestAnswer | Printed | RunEnded | RunFailed, Field(discriminator="kind")]
