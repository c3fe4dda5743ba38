"""What travels between services survives the journey, and what should not travel is refused."""

from __future__ import annotations

import pytest
from pydantic import TypeAdapter, ValidationError

from querycad_contracts import (
    FindPartsTask,
    ModelTask,
    PictureTask,
    Queue,
    Side,
    TaskFailure,
    TaskFailureKind,
    TaskOutcome,
    alive_key,
)

MODEL = "0123456789abcdef" * 4


def test_a_payload_survives_json() -> None:
    task = FindPartsTask(model=MODEL, description="hole", sides=(Side.TOP,))
    assert FindPartsTask.model_validate(task.model_dump(mode="json")) == task


@pytest.mark.parametrize("model", ["", "../../etc/passwd", MODEL[:-1], MODEL.upper(), MODEL + "\n"])
def test_a_model_s_id_is_a_hash_and_nothing_else(model: str) -> None:
    with pytest.raises(ValidationError):
        ModelTask(model=model)


@pytest.mark.parametrize("name", ["../x.png", "a.png", "0" * 32 + ".exe"])
def test_a_picture_s_name_leads_nowhere_else(name: str) -> None:
    with pytest.raises(ValidationError, match="name"):
        PictureTask.model_validate({"model": MODEL, "record": None, "name": name})


def test_an_outcome_keeps_value_or_failure() -> None:
    outcome = TypeAdapter(TaskOutcome[float])
    assert outcome.validate_python(TaskOutcome[float](value=0.5).model_dump(mode="json")).value == 0.5
    failure = TaskFailure(kind=TaskFailureKind.FILE, message="no")
    assert outcome.validate_python(TaskOutcome[float](failure=failure).model_dump(mode="json")).failure == failure


def test_every_queue_has_a_sign_of_life_of_its_own() -> None:
    assert len({alive_key(queue) for queue in Queue}) == len(Queue)
