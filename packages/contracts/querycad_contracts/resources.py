"""Resources of the HTTP interface: what it sends and takes as JSON, and what a run tells while it goes on.

The last classes are the `data` of the server-sent events of `POST /runs`, named by their `kind`.
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from enum import StrEnum
from typing import Annotated, Literal
from urllib.parse import quote

from pydantic import Field

from .answers import Answer, AnswerRecord, Failure, LengthUnit
from .geometry import Frozen, GroundedBy, Part, Side
from .runs import RunId, RunOutcome, RunStatus
from .services import JobId, ModelId, ModelSummary, QuestionRequest, ReadingStage

DESCRIPTION_CHARS = 500
"""Of the longest phrase for parts."""


class ProblemError(Frozen):
    """One place where a request is not as documented."""

    detail: str
    pointer: str = Field("", description="JSON pointer into the body, as a URI fragment: '#/questions/0/unit'.")
    parameter: str = Field("", description="Name of the parameter of path, query or header, where it is one of these.")

    @classmethod
    def in_body(cls, steps: Sequence[str | int], detail: str) -> ProblemError:
        """What is wrong at a place in the body, which `steps` lead to; the pointer is one of RFC 6901."""
        escaped = (quote(str(step).replace("~", "~0").replace("/", "~1")) for step in steps)
        return cls(detail=detail, pointer="#" + "".join(f"/{step}" for step in escaped))


class Problem(Frozen):
    """What went wrong with a request: `application/problem+json`, RFC 9457."""

    type: str = Field("about:blank", description="URI that identifies the kind of problem.")
    title: str
    status: int = Field(description="The HTTP status code.")
    detail: str = ""
    retryable: bool = Field(False, description="Whether the same request may succeed later.")
    errors: tuple[ProblemError, ...] = Field((), description="Where the request is not as documented.")


class ModelStatus(StrEnum):
    """How far is a model?"""

    READING = "reading"
    READY = "ready"
    FAILED = "failed"


Links = dict[str, str]
"""Paths on the same service, by what they lead to."""


class ModelResource(Frozen):
    """An uploaded model."""

    id: ModelId
    file_name: str
    size_bytes: int
    created: datetime
    status: ModelStatus
    stage: ReadingStage | None = Field(None, description="Of a file that is being read; null: it waits.")
    ahead: int | None = Field(None, description="Of a file that waits to be read: how many are read before it.")
    summary: ModelSummary | None = Field(None, description="Of a model that is ready.")
    failure: Failure | None = Field(None, description="Why the file cannot be answered about.")
    links: Links = Field({}, description="Where to go on: `self`, `questions`, `parts`, `description`, `view`, `glb` …")


class PartsPage(Frozen):
    """Some of a model's parts, by id."""

    items: tuple[Part, ...]
    total: int = Field(description="How many there are on all pages.")


class QuestionsRequest(Frozen):
    """Several questions about a model; each becomes a job of its own."""

    questions: tuple[QuestionRequest, ...] = Field(min_length=1, max_length=100)


class SegmentRequest(Frozen):
    """Which parts of a model does a phrase mean?"""

    description: str = Field(min_length=1, max_length=DESCRIPTION_CHARS, description="Such as 'counterbored hole'.")
    sides: tuple[Side, ...] | None = Field(
        None, min_length=1, max_length=6, description="Only parts that are visible from one of these; null: all."
    )
    grounding: GroundedBy = Field(GroundedBy.GEOMETRY, description="By which evidence words are turned into parts.")


class JobStatus(StrEnum):
    """How far is a question?"""

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"


class Job(Frozen):
    """One asked question, and what came of it once it is done: the same shape, whether one waits for it or not."""

    id: JobId
    model: ModelId
    question: str
    unit: LengthUnit
    status: JobStatus
    created: datetime
    finished: datetime | None = None
    ahead: int | None = Field(None, description="Of a queued question: how many tasks are done before it.")
    answer: Answer | None = Field(None, description="As in `record`.")
    confidence: float | None = Field(None, description="As in `record`.")
    part_ids: tuple[str, ...] = Field((), description="Ids of the parts that the answer rests on, however many.")
    links: Links = Field({}, description="Where to go on: `self`, `model`, `events`; once answered `picture`, `parts`.")
    record: AnswerRecord | None = Field(
        None, description="The whole outcome, once the job is done, as `querycad ask --json` prints it."
    )


class JobsPage(Frozen):
    """Some of the questions that were asked about a model, the newest first."""

    items: tuple[Job, ...]
    total: int = Field(description="How many there are on all pages.")


class ModelsPage(Frozen):
    """Some of the uploaded models, the newest first."""

    items: tuple[ModelResource, ...]
    total: int = Field(description="How many there are on all pages.")


class JobEventKind(StrEnum):
    """The steps of a question. The last event of every job is `done`; those between may come more than once."""

    QUEUED = "queued"
    STARTED = "started"
    PROGRAM = "program"
    RAN = "ran"
    WAITING = "waiting"
    DONE = "done"


class JobEvent(Frozen):
    """One step of a question: the `data` of a server-sent event, whose name is `kind`."""

    kind: JobEventKind
    at: datetime
    code: str | None = Field(None, description="Of `program`: what was written.")
    codegen: str | None = Field(None, description="Of `program`: who wrote it.")
    outcome: RunStatus | None = Field(None, description="Of `ran`: how the program ended.")
    message: str = Field("", description="Of `ran` and `waiting`: what there is to say.")
    record: AnswerRecord | None = Field(None, description="Of `done`: what came of the question.")


class Health(Frozen):
    """Whether a service is ready, and which of the things that it needs are."""

    ready: bool
    checks: dict[str, bool] = Field(default_factory=dict)
    walls_missing: dict[str, tuple[str, ...]] = Field(
        default_factory=dict, description="Walls that it does without, as a setting says, by where they are not up."
    )


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
