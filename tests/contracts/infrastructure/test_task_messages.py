"""A task's message is the one that Celery itself would send."""

from __future__ import annotations

import base64
import json
from contextvars import copy_context
from datetime import datetime
from typing import Any
from uuid import uuid4

import pytest
from celery import Celery
from redis import Redis

from querycad_contracts import FindPartsTask, TaskName
from querycad_contracts.infrastructure import carry_trace, task_message

TASK = FindPartsTask(model="0123456789abcdef" * 4, description="größte Bohrung ⌀ 5", request="r")
OWN = ("origin", "reply_to", "delivery_tag", "kwargsrepr")
"""What tells one message, or one sender, from another, or is for logs that are not kept."""


def read(message: str) -> dict[str, Any]:
    """The message with its body decoded, without what is its own."""
    data = json.loads(message)
    data["body"] = json.loads(base64.b64decode(data["body"]))
    for place in (data["headers"], data["properties"]):
        for own in OWN:
            place.pop(own, None)
    return dict(data)


def sent_by_celery(redis_url: str, task_id: str, expires_s: float | None) -> dict[str, Any]:
    app = Celery("test", broker=redis_url, set_as_current=False)
    app.send_task(
        TaskName.FIND_PARTS.value,
        args=[TASK.model_dump(mode="json")],
        queue=TaskName.FIND_PARTS.queue.value,
        task_id=task_id,
        expires=expires_s,
        ignore_result=True,
        argsrepr="",
    )
    app.close()
    with Redis.from_url(redis_url, decode_responses=True) as redis:
        return read(redis.rpop(TaskName.FIND_PARTS.queue.value))


def test_it_is_what_celery_sends(redis_url: str) -> None:
    task_id = str(uuid4())
    assert read(task_message(TaskName.FIND_PARTS, TASK, task_id)) == sent_by_celery(redis_url, task_id, None)


def test_one_that_expires_is_too(redis_url: str) -> None:
    task_id = str(uuid4())
    ours = read(task_message(TaskName.FIND_PARTS, TASK, task_id, 20.5))
    celerys = sent_by_celery(redis_url, task_id, 20.5)
    times = [datetime.fromisoformat(each["headers"].pop("expires")).timestamp() for each in (ours, celerys)]
    assert times[0] == pytest.approx(times[1], abs=60)
    assert ours == celerys


def test_no_two_are_the_same_to_the_store() -> None:
    assert task_message(TaskName.FIND_PARTS, TASK, "a") != task_message(TaskName.FIND_PARTS, TASK, "a")


def test_the_trace_goes_along() -> None:
    trace = f"00-{'a' * 32}-{'b' * 16}-01"

    def sent() -> str:
        carry_trace({"traceparent": trace})
        return task_message(TaskName.FIND_PARTS, TASK, "a")

    assert json.loads(copy_context().run(sent))["headers"]["traceparent"] == trace
