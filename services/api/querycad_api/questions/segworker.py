"""What the segworkers say of a model before a program runs: how the queries of a question can be grounded on it."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from typing import TypeVar, cast
from uuid import uuid4

from redis import Redis
from redis.exceptions import RedisError

from querycad_answering.understanding import ModelView
from querycad_api.store.keyspace import ModelStale
from querycad_contracts import (
    Failure,
    FailureCategory,
    FindPartsTask,
    Grounded,
    GroundedBy,
    GroundedParts,
    Grounding,
    GroundTask,
    MarkedPicture,
    MarkTask,
    ModelTask,
    Part,
    PartQuery,
    PartsPage,
    PartsTask,
    PictureRequest,
    Side,
    Sight,
    SightTask,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    queue_of,
    reply_key,
)
from querycad_contracts.infrastructure import FileStore, task_message

from .sandbox import RunRefused, SandboxUnavailable

CALL_S, LOOK_S = 20.0, 120.0
VIEWS_KEPT = 256
"""Models whose names and whole are remembered: a few kilobytes each."""
_OUTCOME = TaskOutcome[GroundedParts]
_PARTS = TaskOutcome[PartsPage]
_GROUNDING = TaskOutcome[Grounding]
_PICTURES = TaskOutcome[tuple[MarkedPicture, ...]]
_KEPT = TaskOutcome[bool]
T = TypeVar("T")


class SegworkerClient:
    """Asks segworkers over the queue; for one process, one question at a time."""

    def __init__(self, redis: Redis) -> None:
        self._redis = redis
        self._known: OrderedDict[str, GroundedParts] = OrderedDict()

    def view(self, model: str, grounding: GroundedBy = GroundedBy.GEOMETRY) -> ModelView:
        """What readings are ranked on. Raises SandboxUnavailable, RunRefused and ModelStale, as its `ground` does."""
        known = self._known.get(model)
        if known is None:
            known = self._known[model] = self._ask(GroundTask(model=model, queries=()))
        self._known.move_to_end(model)
        while len(self._known) > VIEWS_KEPT:
            self._known.popitem(last=False)

        def ground(queries: Sequence[PartQuery]) -> Sequence[Sequence[Grounded]]:
            return self._ask(GroundTask(model=model, queries=tuple(queries), grounding=grounding)).grounded

        return ModelView(ground, known.whole, frozenset(known.names), known.kinds)

    def parts(self, model: str) -> tuple[Part, ...]:
        """All parts of the model. Raises as `view` does."""
        return self.call(TaskName.PARTS, PartsTask(model=model), _PARTS, CALL_S).items

    def place(self, model: str, files: FileStore) -> ModelPlace:
        """The model as eyes need it."""
        return ModelPlace(self, model, files)

    def _ask(self, task: GroundTask) -> GroundedParts:
        wait_s = LOOK_S if task.grounding in (GroundedBy.VISION, GroundedBy.FUSED) else CALL_S
        return self.call(TaskName.GROUND, task, _OUTCOME, wait_s)

    def call(self, name: TaskName, task: ModelTask, value: type[TaskOutcome[T]], wait_s: float = LOOK_S) -> T:
        """What comes of a task, which may draw. Raises as `view` does."""
        sent = uuid4().hex
        queue = queue_of(name, task)
        try:
            with self._redis.pipeline(transaction=False) as pipe:  # sent and waited for in one
                pipe.lpush(queue.value, task_message(name, task, sent, wait_s))
                pipe.blpop([reply_key(sent)], wait_s)
                reply = cast("tuple[str, str] | None", pipe.execute()[1])
        except RedisError as error:
            raise SandboxUnavailable(str(error)) from error
        if reply is None:
            raise SandboxUnavailable("no segworker answered")
        outcome = value.model_validate_json(reply[1])
        if outcome.value is not None:
            return outcome.value
        failure = outcome.failure
        if failure is not None and failure.kind is TaskFailureKind.NOT_READ:
            self._known.pop(task.model, None)
            raise ModelStale(failure.message)
        if failure is None or failure.kind is not TaskFailureKind.FILE:
            raise RunRefused(
                Failure(category=FailureCategory.INTERNAL, message="the segworker could not do this; its log says why")
            )
        raise RunRefused(
            Failure(category=FailureCategory.BAD_INPUT, message=failure.message, retryable=failure.retryable)
        )


class ModelPlace:
    """A model whose pictures segworkers draw, and by whom what was seen is kept: the port of eyes, over the queue."""

    def __init__(self, client: SegworkerClient, model: str, files: FileStore) -> None:
        self._client = client
        self._model = model
        self._files = files

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        """Which parts are meant, by geometry and by what was seen so far?"""
        seen_from = None if sides is None else tuple(sides)
        task = FindPartsTask(model=self._model, description=description, sides=seen_from, grounding=GroundedBy.EYES)
        return self._client.call(TaskName.FIND_PARTS, task, _GROUNDING)

    def marked(self, asked: PictureRequest | None = None) -> tuple[MarkedPicture, ...]:
        """The pictures with marks on all that could be meant; or the one that a program asks for."""
        return self._client.call(TaskName.MARK, MarkTask(model=self._model, asked=asked), _PICTURES)

    def png(self, name: str) -> bytes:
        """A picture's file. Raises OSError."""
        path = self._files.fetch(name)
        if path is None:
            raise FileNotFoundError(f"the picture {name} is not in the store")
        return path.read_bytes()

    def keep_sight(self, sight: Sight) -> None:
        """Keeps what was seen."""
        self._client.call(TaskName.SIGHT, SightTask(model=self._model, sight=sight), _KEPT)
