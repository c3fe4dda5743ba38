"""The port over the queue: calls become payloads, outcomes become values or the errors that the port promises."""

from __future__ import annotations

import json
from typing import Any

import pytest
from redis import Redis
from tests.llm_sandbox.conftest import make_part

from querycad_contracts import (
    FindPartsTask,
    GroundedBy,
    ModelTask,
    NoSuchMeasure,
    PartsTask,
    Side,
    TaskFailure,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
)
from querycad_sandbox.control import RunControl
from querycad_sandbox.remote import TRIES, QueueCaller, RemotePartFinder, SegworkerFailed, SegworkerUnavailable
from querycad_sandbox.settings import SandboxSettings

MODEL = "0123456789abcdef" * 4
SETTINGS = SandboxSettings(call_s=3.0, measure_s=70.0)


class Recorder:
    """Answers every call with the same, and keeps the calls."""

    def __init__(self, answer: dict[str, Any]) -> None:
        self.answer = answer
        self.calls: list[tuple[TaskName, dict[str, Any], float]] = []

    def __call__(self, name: TaskName, task: ModelTask, timeout_s: float, control: RunControl) -> str:
        self.calls.append((name, task.model_dump(mode="json"), timeout_s))
        return json.dumps(self.answer)


def value(of: Any) -> dict[str, Any]:
    return {"value": of, "failure": None}


def failing(kind: TaskFailureKind) -> dict[str, Any]:
    return TaskOutcome[None](failure=TaskFailure(kind=kind, message="because")).model_dump(mode="json")


def test_a_call_is_a_task_with_the_model_in_its_payload() -> None:
    grounding = {"description": "hole", "sides": ["top"], "parts": [], "understood": True}
    call = Recorder(value(grounding))
    found = RemotePartFinder(MODEL, call, SETTINGS).find_parts("hole", [Side.TOP])
    assert found.sides == (Side.TOP,)
    ((name, payload, timeout_s),) = call.calls
    assert (name, timeout_s) == (TaskName.FIND_PARTS, 3.0)
    assert payload.items() >= {"model": MODEL, "description": "hole"}.items()
    assert payload["sides"] == ["top"]


def test_words_are_grounded_by_the_evidence_that_was_asked_for_and_looking_is_waited_for() -> None:
    call = Recorder(value({"description": "logo", "sides": None, "parts": [], "understood": True}))
    RemotePartFinder(MODEL, call, SETTINGS, grounding=GroundedBy.FUSED).find_parts("logo")
    ((_, payload, timeout_s),) = call.calls
    assert payload["grounding"] == "fused"
    assert timeout_s == SETTINGS.measure_s


def test_a_measurement_is_waited_for_longer() -> None:
    call = Recorder(value(0.25))
    finder = RemotePartFinder(MODEL, call, SETTINGS)
    assert (finder.distance("a", "b"), finder.edge_distance("a")) == (0.25, 0.25)
    assert [timeout for _, _, timeout in call.calls] == [70.0, 70.0]


def test_a_distance_of_zero_is_a_value() -> None:
    assert RemotePartFinder(MODEL, Recorder(value(0.0)), SETTINGS).distance("a", "b") == 0.0


def test_an_unknown_id_is_the_key_error_of_the_port() -> None:
    with pytest.raises(KeyError, match="because"):
        RemotePartFinder(MODEL, Recorder(failing(TaskFailureKind.UNKNOWN_ID)), SETTINGS).faces([1])


def test_a_measure_that_parts_have_not_is_the_error_of_the_port() -> None:
    with pytest.raises(NoSuchMeasure, match="because"):
        RemotePartFinder(MODEL, Recorder(failing(TaskFailureKind.NO_MEASURE)), SETTINGS).edge_distance("a")


def test_any_other_failure_tells_why() -> None:
    with pytest.raises(SegworkerFailed, match="because"):
        RemotePartFinder(MODEL, Recorder(failing(TaskFailureKind.FILE)), SETTINGS).shape()


def test_an_answer_with_neither_value_nor_reason_is_a_failure() -> None:
    with pytest.raises(SegworkerFailed, match="neither"):
        RemotePartFinder(MODEL, Recorder(value(None)), SETTINGS).shape()


def test_without_a_segworker_a_call_is_given_up(redis_url: str) -> None:
    call = QueueCaller(redis_url)
    with pytest.raises(SegworkerUnavailable):
        call(TaskName.SHAPE, ModelTask(model=MODEL), 0.1, RunControl())
    call.close()


@pytest.mark.parametrize(
    ("grounding", "queue"),
    [(GroundedBy.GEOMETRY, "segcad"), (GroundedBy.VISION, "pictures"), (GroundedBy.FUSED, "pictures")],
)
def test_looking_keeps_no_quick_call_waiting(redis_url: str, grounding: GroundedBy, queue: str) -> None:
    call = QueueCaller(redis_url)
    task = FindPartsTask(model=MODEL, description="logo", grounding=grounding)
    with pytest.raises(SegworkerUnavailable):
        call(TaskName.FIND_PARTS, task, 0.1, RunControl())
    call.close()
    with Redis.from_url(redis_url, decode_responses=True) as redis:
        assert {name: redis.llen(name) for name in ("segcad", "pictures")} == {"segcad": 0, "pictures": 0, queue: TRIES}


def test_without_a_broker_a_call_is_given_up() -> None:
    call = QueueCaller("redis://127.0.0.1:1/0")
    with pytest.raises(SegworkerUnavailable):
        call(TaskName.SHAPE, ModelTask(model=MODEL), 0.1, RunControl())
    call.close()


def test_all_parts_come_with_one_call() -> None:
    parts = [make_part(f"hole-{i}").model_dump(mode="json") for i in range(2500)]

    def call(name: TaskName, task: ModelTask, timeout_s: float, control: RunControl) -> str:
        calls.append((name, task))
        return json.dumps(value({"items": parts, "total": len(parts)}))

    calls: list[tuple[TaskName, ModelTask]] = []
    found = RemotePartFinder(MODEL, call, SETTINGS).parts()
    assert [part.id for part in found] == [f"hole-{i}" for i in range(2500)]
    assert calls == [(TaskName.PARTS, PartsTask(model=MODEL))]
