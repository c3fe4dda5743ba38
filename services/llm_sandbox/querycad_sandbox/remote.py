"""The `PartFinder` port over the queue: every call is a task that some segworker does, by name.

SegworkerUnavailable    no segworker answered
SegworkerFailed         a segworker answered that it cannot: `failure` says why
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import Final, Protocol, TypeVar, cast
from uuid import uuid4

from redis import Redis
from redis.exceptions import RedisError

from querycad_contracts import (
    DistanceTask,
    EdgeDistanceTask,
    ExtentTask,
    Face,
    FaceQuery,
    FacesTask,
    FindFacesTask,
    FindPartsTask,
    FoundFaces,
    Grounded,
    GroundedBy,
    GroundedParts,
    Grounding,
    GroundTask,
    ModelTask,
    NoSuchMeasure,
    Part,
    PartQuery,
    PartsPage,
    PartsTask,
    Queue,
    Shape,
    Side,
    TaskFailure,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
    Vector,
    queue_of,
    reply_key,
)
from querycad_contracts.infrastructure import task_message

from .control import RunControl
from .settings import SandboxSettings

PATIENCE_S: Final = 0.05
"""Most answers come sooner. A run that waits longer gives its interpreter to another, which costs it some 2 ms."""
KEPT_S: Final = 60
"""How long what is left of an abandoned call stays in the store."""
TRIES: Final = 2
"""A call is lost with the worker that died at it; asking again does no harm, as no call changes anything."""
CONNECT_S: Final = 2.0

T = TypeVar("T")
log = logging.getLogger(__name__)

_SHAPE = TaskOutcome[Shape]
_GROUNDING = TaskOutcome[Grounding]
_GROUNDED = TaskOutcome[GroundedParts]
_FACES = TaskOutcome[tuple[Face, ...]]
_FOUND_FACES = TaskOutcome[FoundFaces]
_PARTS = TaskOutcome[PartsPage]
_FLOAT = TaskOutcome[float]


class SegworkerUnavailable(Exception):
    """No segworker answered in time."""


class SegworkerFailed(Exception):
    """A segworker cannot do what was asked."""

    def __init__(self, failure: TaskFailure) -> None:
        super().__init__(failure.message)
        self.failure = failure


class Caller(Protocol):
    """Sends a task and waits for what comes of it."""

    def __call__(self, name: TaskName, task: ModelTask, timeout_s: float, control: RunControl) -> str | bytes:
        """The task's TaskOutcome as JSON. Raises SegworkerUnavailable, RunEndedError when `control` ends the run."""
        ...


class QueueCaller:
    """Sends tasks to the segworkers and takes their replies; what is abandoned, they do not begin. Thread safe."""

    def __init__(self, redis_url: str) -> None:
        self._redis = Redis.from_url(redis_url, socket_connect_timeout=CONNECT_S, socket_timeout=None)

    def __call__(self, name: TaskName, task: ModelTask, timeout_s: float, control: RunControl) -> bytes:
        """The task's TaskOutcome as JSON.

        Raises SegworkerUnavailable when no worker answered, twice, and RunEndedError when `control` ends the run.
        """
        for attempt in range(1, TRIES + 1):
            control.check()
            try:
                sent = uuid4().hex
                message = task_message(name, task, sent, timeout_s)
                with control.stopped_by(lambda sent=sent: self._abandon(sent)):  # type: ignore[misc]
                    reply = self._reply(queue_of(name, task), message, sent, min(timeout_s, control.left_s()), control)
            except RedisError as error:
                log.warning("%s: %s (attempt %d)", name.value, error, attempt)
                continue
            control.check()
            if reply is not None:
                return reply[1]
            log.warning("%s: no answer within %g s (attempt %d)", name.value, timeout_s, attempt)
        raise SegworkerUnavailable("no segworker answered; try again in a moment")

    def _reply(
        self, queue: Queue, message: str, task: str, timeout_s: float, control: RunControl
    ) -> tuple[bytes, bytes] | None:
        """Sends the task; what came back within the time? Zero seconds would mean for ever to the store."""
        keys = [reply_key(task)]
        soon = max(min(PATIENCE_S, timeout_s), 0.01)
        with self._redis.pipeline(transaction=False) as pipe:  # sent and waited for in one
            pipe.lpush(queue.value, message)
            pipe.blpop(keys, soon)
            reply = cast("tuple[bytes, bytes] | None", pipe.execute()[1])
        if reply is not None or timeout_s <= soon:
            return reply
        control.release()
        return cast("tuple[bytes, bytes] | None", self._redis.blpop(keys, timeout_s - soon))

    def _abandon(self, task: str) -> None:
        """Wakes whoever waits for the task's reply; what stays in its place tells the segworkers not to begin it."""
        key = reply_key(task)
        try:
            with self._redis.pipeline(transaction=False) as pipe:
                pipe.rpush(key, b"null", b"null")
                pipe.expire(key, KEPT_S)
                pipe.execute()
        except RedisError as error:
            log.warning("task %s could not be abandoned: %s", task, error)

    def close(self) -> None:
        """Closes the connections."""
        self._redis.close()


class RemotePartFinder:
    """Finds and measures one model's parts by asking a segworker. Raises SegworkerUnavailable, SegworkerFailed."""

    def __init__(
        self,
        model: str,
        call: Caller,
        settings: SandboxSettings,
        control: RunControl | None = None,
        grounding: GroundedBy = GroundedBy.GEOMETRY,
    ) -> None:
        self._model = model
        self._grounding = grounding
        self._call = call
        self._settings = settings
        self._control = control or RunControl()

    def shape(self) -> Shape:
        """What is the whole model?"""
        return self._ask(TaskName.SHAPE, ModelTask(model=self._model), _SHAPE)

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        """Which parts does `description` mean, of those visible from any of `sides`?"""
        asked = None if sides is None else tuple(sides)
        task = FindPartsTask(model=self._model, description=description, sides=asked, grounding=self._grounding)
        long_s = self._settings.measure_s if self._grounding in (GroundedBy.VISION, GroundedBy.FUSED) else None
        return self._ask(TaskName.FIND_PARTS, task, _GROUNDING, long_s)

    def look(self, phrase: str) -> Grounding:
        """Which parts look like this to whoever was shown pictures of them? Geometry has no say."""
        task = FindPartsTask(model=self._model, description=phrase, grounding=GroundedBy.EYES, sight_alone=True)
        return self._ask(TaskName.FIND_PARTS, task, _GROUNDING)

    def ground(self, queries: Sequence[PartQuery]) -> tuple[tuple[Grounded, ...], ...]:
        """In which ways can each query be grounded on the model, the best first?"""
        task = GroundTask(model=self._model, queries=tuple(queries))
        return self._ask(TaskName.GROUND, task, _GROUNDED).grounded

    def parts(self) -> tuple[Part, ...]:
        """Which parts were recognised in the model?"""
        return self._ask(TaskName.PARTS, PartsTask(model=self._model), _PARTS).items

    def find_faces(self, query: FaceQuery) -> FoundFaces:
        """Which faces are so?"""
        return self._ask(TaskName.FIND_FACES, FindFacesTask(model=self._model, query=query), _FOUND_FACES)

    def extent(self, part: str, direction: Vector) -> float:
        """How far does a part extend along a unit vector, in metres? Raises KeyError for an unknown part id."""
        return self._measure(TaskName.EXTENT, ExtentTask(model=self._model, part=part, direction=direction))

    def faces(self, ids: Sequence[int]) -> tuple[Face, ...]:
        """What are the faces with these ids? Raises KeyError for an id the model does not have."""
        return self._ask(TaskName.FACES, FacesTask(model=self._model, ids=tuple(ids)), _FACES)

    def distance(self, part_a: str, part_b: str) -> float:
        """How far apart are the surfaces of two parts, in metres? Raises KeyError for an unknown part id."""
        return self._measure(TaskName.DISTANCE, DistanceTask(model=self._model, part_a=part_a, part_b=part_b))

    def overlap(self, part_a: str, part_b: str) -> float:
        """Which volume do two bodies share, in m3? Raises KeyError as above."""
        return self._measure(TaskName.OVERLAP, DistanceTask(model=self._model, part_a=part_a, part_b=part_b))

    def edge_distance(self, part: str) -> float:
        """How far is a part from the outer edge of the face it lies in, in metres? Raises KeyError as above."""
        return self._measure(TaskName.EDGE_DISTANCE, EdgeDistanceTask(model=self._model, part=part))

    def _measure(self, name: TaskName, task: ModelTask) -> float:
        return self._ask(name, task, _FLOAT, self._settings.measure_s)

    def _ask(self, name: TaskName, task: ModelTask, outcome: type[TaskOutcome[T]], timeout_s: float | None = None) -> T:
        answer = self._call(name, task, timeout_s or self._settings.call_s, self._control)
        done = outcome.model_validate_json(answer)
        if done.failure is not None and done.failure.kind is TaskFailureKind.UNKNOWN_ID:
            raise KeyError(done.failure.message)
        if done.failure is not None and done.failure.kind is TaskFailureKind.NO_MEASURE:
            raise NoSuchMeasure(done.failure.message)
        if done.failure is not None or done.value is None:
            unknown = TaskFailure(kind=TaskFailureKind.INTERNAL, message="the segworker gave neither value nor reason")
            raise SegworkerFailed(done.failure or unknown)
        return done.value
