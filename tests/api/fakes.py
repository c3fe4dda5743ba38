"""A small model that was never read, and a sandbox that runs nothing."""

from __future__ import annotations

import hashlib
import json
import threading
from base64 import b64decode
from collections.abc import Callable

from redis import Redis
from tests.made import view, whole

from querycad_answering.understanding import ModelView
from querycad_contracts import (
    GroundedIds,
    GroundedParts,
    Grounding,
    GroundTask,
    ModelSummary,
    Part,
    Program,
    Queue,
    RunOutcome,
    RunStatus,
    Shape,
    TaskOutcome,
    reply_key,
)

STEP = b"ISO-10303-21;\n"
MODEL = hashlib.sha256(STEP).hexdigest()
BOX = Shape(name="box", center=(0, 0, 0), extents=(0.1, 0.2, 0.3), volume=0.006, area=0.22, bodies=(), face_count=6)
SUMMARY = ModelSummary(shape=BOX, body_count=1, part_counts={}, warnings=("it was tilted",), timings_ms={})
NO_HOLE = Grounding(description="hole", sides=None, parts=(), understood=True, message="there is no hole")


class FakeSandbox:
    """Runs nothing: says that there are no holes, or raises what it is told to."""

    def __init__(self, error: Exception | None = None) -> None:
        self.error = error
        self.runs = 0
        self.before: Callable[[], object] = lambda: None

    def run(self, program: Program, model: str, *_: object) -> RunOutcome:
        self.runs += 1
        self.before()
        if self.error is not None:
            raise self.error
        return RunOutcome(status=RunStatus.OK, value=0, groundings=(NO_HOLE,))


class FakeSegcad:
    """Knows a plate without a hole."""

    def view(self, model: str, *_: object) -> ModelView:
        return view()

    def parts(self, model: str) -> tuple[Part, ...]:
        return (whole(),)

    def place(self, model: str, *_: object) -> None:
        """Nobody looks at pictures here."""


class FakeSegworker(threading.Thread):
    """Takes what is sent to the segworkers, and knows a plate without a hole."""

    def __init__(self, redis_url: str) -> None:
        super().__init__(daemon=True)
        self._redis = Redis.from_url(redis_url)
        self._ended = threading.Event()
        self.asked: list[GroundTask] = []

    def run(self) -> None:
        plate = view()
        while not self._ended.is_set():
            taken = self._redis.brpop([Queue.SEGCAD.value], 0.1)
            if taken is None:
                continue
            message = json.loads(taken[1])
            (payload,), *_ = json.loads(b64decode(message["body"]))
            task = GroundTask.model_validate(payload)
            self.asked.append(task)
            ways = tuple(
                tuple(GroundedIds(parts=(), features=way.features) for way in each)
                for each in plate.ground(task.queries)
            )
            value = GroundedParts(whole=plate.whole, names=(), kinds=plate.kinds, parts=(), ways=ways)
            outcome = TaskOutcome[GroundedParts](value=value).model_dump_json()
            self._redis.rpush(reply_key(message["headers"]["id"]), outcome)
        self._redis.close()

    def stop(self) -> None:
        self._ended.set()
        self.join()
