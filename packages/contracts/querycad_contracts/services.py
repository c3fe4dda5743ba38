"""What travels between the services: tasks on the queues, runs in the sandbox, resources of the HTTP interface."""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum
from typing import Annotated, Generic, TypeVar

from pydantic import Field

from .answers import AnswerRecord, AnswerType, Failure, LengthUnit
from .geometry import Frozen, Part, Shape, Side
from .runs import RunLimits

T = TypeVar("T")

ModelId = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$", description="SHA-256 of the file's bytes, hexadecimal.")]
JobId = Annotated[str, Field(pattern=r"^[0-9a-f]{32}$", description="Id of one asked question, and of its answer.")]


class Queue(StrEnum):
    """The queues, by what they need: a CAD kernel for minutes, a known model for milliseconds, the sandbox."""

    INGEST = "ingest"
    SEGCAD = "segcad"
    QUESTIONS = "questions"


class TaskName(StrEnum):
    """Tasks are sent by these names, so that no service imports another. Each takes the payload beside it."""

    INGEST = "querycad.ingest"  # IngestTask -> TaskOutcome[ModelSummary]
    SHAPE = "querycad.shape"  # ModelTask -> TaskOutcome[Shape]
    FIND_PARTS = "querycad.find_parts"  # FindPartsTask -> TaskOutcome[Grounding]
    FACES = "querycad.faces"  # FacesTask -> TaskOutcome[tuple[Face, ...]]
    DISTANCE = "querycad.distance"  # DistanceTask -> TaskOutcome[float]
    EDGE_DISTANCE = "querycad.edge_distance"  # EdgeDistanceTask -> TaskOutcome[float]
    PARTS = "querycad.parts"  # PartsTask -> TaskOutcome[PartsPage]
    PICTURE = "querycad.picture"  # PictureTask -> TaskOutcome[str]: file name in the folder for pictures
    QUESTION = "querycad.question"  # QuestionTask -> nothing: the answer is kept under the job
    MODEL_READ = "querycad.model_read"  # TaskOutcome[ModelSummary], model -> nothing: follows a finished ingest
    MODEL_LOST = "querycad.model_lost"  # task id, model -> nothing: follows an ingest that was stopped


def alive_key(queue: Queue) -> str:
    """Under which Redis key does a worker on this queue say that it lives? The key expires when none says so."""
    return f"querycad:alive:{queue.value}"


def reply_key(task: str) -> str:
    """Under which Redis key does a called segworker leave its TaskOutcome? A list of one, which the caller takes."""
    return f"querycad:reply:{task}"


class ModelTask(Frozen):
    """What is asked of one known model."""

    model: ModelId


class IngestTask(ModelTask):
    """Read an uploaded file."""

    file_name: str


class FindPartsTask(ModelTask):
    """Which parts does the description mean?"""

    description: str
    sides: tuple[Side, ...] | None = None


class FacesTask(ModelTask):
    """What are these faces?"""

    ids: tuple[int, ...]


class DistanceTask(ModelTask):
    """How far apart are the surfaces of two parts?"""

    part_a: str
    part_b: str


class EdgeDistanceTask(ModelTask):
    """How far is a part from the outer edge of its face?"""

    part: str


class PartsTask(ModelTask):
    """Which parts does the model have?"""

    kind: str | None = None
    offset: int = Field(0, ge=0)
    limit: int = Field(100, ge=1, le=1000)


class PictureTask(ModelTask):
    """Draw the parts that an answer rests on."""

    record: AnswerRecord
    name: str = Field(pattern=r"^[0-9a-f]{32}\.png$", description="Name of the file to write.")


class QuestionTask(ModelTask):
    """Answer a question; the job says which."""

    job: JobId
    question: str
    unit: LengthUnit = LengthUnit.MM


class TaskFailureKind(StrEnum):
    """Whose fault was it?"""

    FILE = "file"
    UNKNOWN_ID = "unknown_id"
    INTERNAL = "internal"


class TaskFailure(Frozen):
    """Why a task has no value."""

    kind: TaskFailureKind
    message: str = Field(description="One sentence for the user.")
    retryable: bool = False


class TaskOutcome(Frozen, Generic[T]):
    """What came of a task: exactly one of `value` and `failure`."""

    value: T | None = None
    failure: TaskFailure | None = None


class ModelSummary(Frozen):
    """What a model holds, in short."""

    shape: Shape = Field(description="The whole model; of many bodies only the first hundred are listed.")
    body_count: int
    part_counts: dict[str, int] = Field(description="How many parts of each kind were recognised.")
    warnings: tuple[str, ...]
    timings_ms: dict[str, float] = Field(description="What each stage of reading the file took.")


class RunRequest(Frozen):
    """A program to run in the sandbox: the body of `POST /runs`, answered with a RunOutcome."""

    code: str
    model: ModelId
    limits: RunLimits = RunLimits()
    expects: AnswerType | None = None


class Problem(Frozen):
    """What went wrong with a request: `application/problem+json`, RFC 9457."""

    type: str = Field("about:blank", description="URI that identifies the kind of problem.")
    title: str
    status: int = Field(description="The HTTP status code.")
    detail: str = ""
    retryable: bool = Field(False, description="Whether the same request may succeed later.")
    errors: tuple[str, ...] = Field((), description="Where the request is not as documented, one line each.")


class ModelStatus(StrEnum):
    """How far is a model?"""

    READING = "reading"
    READY = "ready"
    FAILED = "failed"


class ModelResource(Frozen):
    """An uploaded model."""

    id: ModelId
    file_name: str
    size_bytes: int
    created: datetime
    status: ModelStatus
    summary: ModelSummary | None = Field(None, description="Of a model that is ready.")
    failure: Failure | None = Field(None, description="Why the file cannot be answered about.")


class PartsPage(Frozen):
    """Some of a model's parts, by id."""

    items: tuple[Part, ...]
    total: int = Field(description="How many there are on all pages.")


class QuestionRequest(Frozen):
    """A question about a model."""

    question: str = Field(min_length=1, max_length=2000, description="In English; one question.")
    unit: LengthUnit = Field(LengthUnit.MM, description="Unit of lengths in the answer's text; values stay SI.")


class JobStatus(StrEnum):
    """How far is a question?"""

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"


class Job(Frozen):
    """One asked question."""

    id: JobId
    model: ModelId
    question: str
    unit: LengthUnit
    status: JobStatus
    created: datetime
    finished: datetime | None = None
    record: AnswerRecord | None = Field(None, description="The outcome, once the job is done.")


class Health(Frozen):
    """Whether a service is ready, and which of the things that it needs are."""

    ready: bool
    checks: dict[str, bool] = Field(default_factory=dict)
