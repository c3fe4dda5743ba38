"""What travels between the services: tasks on the queues, runs in the sandbox."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from enum import StrEnum
from typing import Annotated, Generic, TypeVar
from uuid import uuid4

from pydantic import Field

from .answers import AnswerOptions, AnswerRecord, AnswerType, LengthUnit
from .geometry import Frozen, GroundedBy, Part, PartKind, Shape, Side, Vector
from .queries import FaceQuery, Grounded, PartQuery
from .runs import RunId, RunLimits

T = TypeVar("T")
_REQUEST: ContextVar[str] = ContextVar("querycad_request", default="")

ModelId = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$", description="SHA-256 of the file's bytes, hexadecimal.")]
JobId = Annotated[str, Field(pattern=r"^[0-9a-f]{32}$", description="Id of one asked question, and of its answer.")]
Tenant = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9-]{0,39}$", description="Whose models and answers these are.")]
NO_ACCOUNTS = "local"
"""The one tenant of a service without API keys."""


class Queue(StrEnum):
    """The queues, by what they need: a kernel for minutes, a model for milliseconds, pictures for seconds, the sandbox.

    Pictures are drawn, or looked at. On `segcad` parts are found and measured, whatever finds them: deployments and the
    store's access lists have the name.
    """

    INGEST = "ingest"
    SEGCAD = "segcad"
    PICTURES = "pictures"
    QUESTIONS = "questions"


class TaskName(StrEnum):
    """Tasks are sent by these names, so that no service imports another. Each takes the payload beside it."""

    INGEST = "querycad.ingest"  # IngestTask -> TaskOutcome[ModelSummary]
    SHAPE = "querycad.shape"  # ModelTask -> TaskOutcome[Shape]
    FIND_PARTS = "querycad.find_parts"  # FindPartsTask -> TaskOutcome[Grounding]
    GROUND = "querycad.ground"  # GroundTask -> TaskOutcome[GroundedParts]
    FACES = "querycad.faces"  # FacesTask -> TaskOutcome[tuple[Face, ...]]
    FIND_FACES = "querycad.find_faces"  # FindFacesTask -> TaskOutcome[FoundFaces]
    EXTENT = "querycad.extent"  # ExtentTask -> TaskOutcome[float]
    DISTANCE = "querycad.distance"  # DistanceTask -> TaskOutcome[float]
    OVERLAP = "querycad.overlap"  # DistanceTask -> TaskOutcome[float]
    EDGE_DISTANCE = "querycad.edge_distance"  # EdgeDistanceTask -> TaskOutcome[float]
    PARTS = "querycad.parts"  # PartsTask -> TaskOutcome[PartsPage]
    PICTURE = "querycad.picture"  # PictureTask -> TaskOutcome[str]: name of the file in the store
    VIEW = "querycad.view"  # ViewTask -> TaskOutcome[str]: as above
    GLB = "querycad.glb"  # ModelTask -> TaskOutcome[str]: as above
    MARK = "querycad.mark"  # MarkTask -> TaskOutcome[tuple[MarkedPicture, ...]]
    SIGHT = "querycad.sight"  # SightTask -> TaskOutcome[bool]: it is kept
    DESCRIPTION = "querycad.description"  # DescribeTask -> TaskOutcome[Description], by the question workers
    PARAMETERS = "querycad.parameters"  # ParametersTask -> TaskOutcome[ParameterSet], by the question workers
    QUESTION = "querycad.question"  # QuestionTask -> nothing: the answer is kept under the job
    MODEL_READ = "querycad.model_read"  # TaskOutcome[ModelSummary], model, tenant, uploaded -> nothing; after an ingest
    MODEL_LOST = "querycad.model_lost"  # task id, model, tenant, uploaded -> nothing; after one that was stopped

    @property
    def queue(self) -> Queue:
        """On which queue is it sent, as a rule? See `queue_of`."""
        return _QUEUES.get(self, Queue.SEGCAD)


_QUEUES = {
    TaskName.INGEST: Queue.INGEST,
    TaskName.PICTURE: Queue.PICTURES,
    TaskName.VIEW: Queue.PICTURES,
    TaskName.GLB: Queue.PICTURES,
    TaskName.MARK: Queue.PICTURES,
    TaskName.DESCRIPTION: Queue.QUESTIONS,
    TaskName.PARAMETERS: Queue.QUESTIONS,
    TaskName.QUESTION: Queue.QUESTIONS,
    TaskName.MODEL_READ: Queue.QUESTIONS,
    TaskName.MODEL_LOST: Queue.QUESTIONS,
}


def alive_key(queue: Queue) -> str:
    """Under which Redis key does a worker on this queue say that it lives? The key expires when none says so."""
    return f"querycad:alive:{queue.value}"


def reply_key(task: str) -> str:
    """Under which Redis key does a called segworker leave its TaskOutcome? A list of one, which the caller takes."""
    return f"querycad:reply:{task}"


def stage_key(model: str) -> str:
    """Under which Redis key does a segworker say which `ReadingStage` of the file it is at?"""
    return f"querycad:stage:{model}"


class ReadingStage(StrEnum):
    """What is being done while a file is read, in this order."""

    READ = "read"
    MEASURE = "measure"
    TESSELLATE = "tessellate"
    LOOK = "look"
    RECOGNISE = "recognise"


def current_request() -> str:
    """Which HTTP request is being worked for? Empty when none is."""
    return _REQUEST.get()


@contextmanager
def working_for(request: str) -> Iterator[None]:
    """Notes in this context that all that is done now is for the HTTP request of that id."""
    token = _REQUEST.set(request)
    try:
        yield
    finally:
        _REQUEST.reset(token)


class ModelTask(Frozen):
    """What is asked of one known model."""

    model: ModelId
    request: str = Field(default_factory=current_request, description="Id of the HTTP request that this is done for.")


class IngestTask(ModelTask):
    """Read an uploaded file."""

    file_name: str
    anew: bool = Field(
        False, description="Read it though it is known: who uploads what another has cannot tell by the time it takes."
    )


class GroundTask(ModelTask):
    """In which ways can each of the queries of a question be grounded on the model?"""

    queries: tuple[PartQuery, ...]
    grounding: GroundedBy = GroundedBy.GEOMETRY


class GroundedIds(Frozen):
    """`Grounded`, with the ids of its parts in place of the parts."""

    parts: tuple[str, ...]
    features: dict[str, float]
    unchecked: tuple[str, ...] = ()
    reason: str = ""


class GroundedParts(Frozen):
    """What a question's readings are ranked on: all groundings, and every part in them once."""

    whole: Part = Field(description="The part that stands for the whole model.")
    names: tuple[str, ...] = Field(description="Words of the product names in the file.")
    kinds: tuple[str, ...] = Field(description="Kinds of part that the model has, the most frequent first.")
    parts: tuple[Part, ...] = Field(description="Without their faces, which nothing here reads.")
    ways: tuple[tuple[GroundedIds, ...], ...] = Field(description="Of each query, the best first.")

    @property
    def grounded(self) -> tuple[tuple[Grounded, ...], ...]:
        """The groundings of each query, with their parts."""
        known = {part.id: part for part in self.parts}
        return tuple(
            tuple(
                Grounded(
                    parts=tuple(known[part] for part in way.parts),
                    features=way.features,
                    unchecked=way.unchecked,
                    reason=way.reason,
                )
                for way in ways
            )
            for ways in self.ways
        )


class FindPartsTask(ModelTask):
    """Which parts does the description mean, or the query?"""

    description: str | PartQuery
    sides: tuple[Side, ...] | None = None
    grounding: GroundedBy = GroundedBy.GEOMETRY
    sight_alone: bool = Field(False, description="What eyes saw of the description, and nothing else.")


class FacesTask(ModelTask):
    """What are these faces?"""

    ids: tuple[int, ...]


class FindFacesTask(ModelTask):
    """Which faces are so?"""

    query: FaceQuery


class ExtentTask(ModelTask):
    """How far does a part extend along a direction?"""

    part: str
    direction: Vector


class DistanceTask(ModelTask):
    """How far apart are the surfaces of two parts?"""

    part_a: str
    part_b: str


class EdgeDistanceTask(ModelTask):
    """How far is a part from the outer edge of its face?"""

    part: str


def queue_of(name: TaskName, task: ModelTask) -> Queue:
    """On which queue is this very task sent? Looking takes seconds: what takes milliseconds does not wait for it."""
    networks = (GroundedBy.VISION, GroundedBy.FUSED)
    looks = isinstance(task, FindPartsTask | GroundTask) and task.grounding in networks
    return Queue.PICTURES if looks else name.queue


class PartsTask(ModelTask):
    """Which parts does the model have?"""

    kind: str | None = None
    ids: tuple[str, ...] = Field((), description="Only these; empty: all.")
    offset: int = Field(0, ge=0)
    limit: int | None = Field(None, ge=1, description="Null: all.")


class PictureTask(ModelTask):
    """Draw the parts that an answer rests on."""

    record: AnswerRecord
    name: str = Field(pattern=r"^pictures/[0-9a-f]{32}\.png$", description="Name of the file in the store.")


class ViewName(StrEnum):
    """Where a model may be looked at from."""

    ISOMETRIC = "isometric"
    TOP = "top"
    BOTTOM = "bottom"
    LEFT = "left"
    RIGHT = "right"
    FRONT = "front"
    BACK = "back"


PIXELS = (64, 2048)
"""Of the smallest and the largest picture, each way."""


class ViewTask(ModelTask):
    """Draw the model as it is seen from there, without marks."""

    view: ViewName
    width: int = Field(ge=PIXELS[0], le=PIXELS[1])
    height: int = Field(ge=PIXELS[0], le=PIXELS[1])


class QuestionRequest(AnswerOptions):
    """A question about a model."""

    question: str = Field(min_length=1, max_length=2000, description="In English; one question.")
    unit: LengthUnit = Field(LengthUnit.MM, description="Unit of lengths in the answer's text; values stay SI.")


class QuestionTask(ModelTask, QuestionRequest):
    """Answer a question; the job says which."""

    job: JobId
    tenant: Tenant = NO_ACCOUNTS
    key: str = Field("", description="Id of the API key that asked; its open questions are counted.")


class TaskFailureKind(StrEnum):
    """Whose fault was it?"""

    FILE = "file"
    NOT_READ = "not_read"
    """Nobody's: nothing is kept of the file that this version can use, and an ingest has to read it first."""
    UNKNOWN_ID = "unknown_id"
    NO_MEASURE = "no_measure"
    """The program's: it measures what has no such measure."""
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


class PartGroup(Frozen):
    """Parts that are alike in kind and size."""

    count: int
    kind: PartKind
    label: str = Field(description="What a drawing would call each: 'blind hole, diameter 5 mm, depth 12 mm'.")
    tags: tuple[str, ...] = Field((), description="Those that all of them have.")
    sides: tuple[Side, ...] = Field((), description="Those that all of them are visible from.")
    hidden: bool = Field(False, description="Whether none of them is visible from any side.")
    layout: str = Field("", description="The pattern that they lie in, where all of one lie in it: 'bolt circle of 6'.")
    name: str = Field("", description="Product name in the file, of bodies.")
    color: str = Field("", description="Of bodies, hexadecimal sRGB.")
    extents: Vector = Field(description="Full size along x, y, z of the first of them.")


class ModelSummary(Frozen):
    """What a model holds, in short."""

    shape: Shape = Field(description="The whole model; of many bodies only the first hundred are listed.")
    body_count: int
    part_counts: dict[str, int] = Field(description="How many parts of each kind were recognised.")
    terms: dict[str, int] = Field(
        default_factory=dict,
        description="How many parts go by each name, such as 'blind hole'; the most frequent first.",
    )
    groups: tuple[PartGroup, ...] = Field(
        (), description="The parts by kind and size, those first that say most of the model; bodies where several are."
    )
    units: tuple[str, ...] = Field(
        (), description="Length units that the file declares, such as 'millimetre'; all values here are SI."
    )
    warnings: tuple[str, ...]
    timings_ms: dict[str, float] = Field(description="What each stage of reading the file took.")
    kept_bytes: int = Field(
        0, ge=0, description="What is kept of what was read, beside the file: it counts towards a tenant's share, too."
    )


class RunRequest(Frozen):
    """A program to run in the sandbox: the body of `POST /runs`, answered with a RunOutcome."""

    code: str
    model: ModelId
    limits: RunLimits = RunLimits()
    expects: AnswerType | None = None
    check: bool = Field(True, description="Whether a program that names what does not exist is refused, and not begun.")
    grounding: GroundedBy = Field(GroundedBy.GEOMETRY, description="By which evidence its words are turned into parts.")
    run: RunId = Field(default_factory=lambda: uuid4().hex)
    request: str = Field(default_factory=current_request, description="Id of the HTTP request that this is done for.")


class ProgramRequest(Frozen):
    """A caller's own program of the guest API, to be run against a model."""

    code: str = Field(
        description="Python, as docs/guest-api.md has it; assigns `solution`. More than 65,536 bytes are refused."
    )
    expects: AnswerType | None = Field(None, description="Then an absent measure in the result is the run's failure.")
    grounding: GroundedBy = Field(GroundedBy.GEOMETRY, description="By which evidence words are turned into parts.")


class DescribeTask(ModelTask):
    """What is the model, and what can be asked about it?"""

    summary: ModelSummary
    unit: LengthUnit = LengthUnit.MM
