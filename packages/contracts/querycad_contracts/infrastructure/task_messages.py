"""What is put on a queue, so that Celery's workers take it for a task: one text, pushed to the Redis list of that name.

Celery's own sender does what is done here for fifteen servers, formats and routings; it costs what running a program
does, and cannot send along with anything else (docs/adr/0018-task-messages.md).
"""

from __future__ import annotations

import json
from base64 import b64encode
from datetime import UTC, datetime, timedelta
from typing import Any
from uuid import uuid4

from querycad_contracts import ModelTask, TaskName, queue_of

from .tracing import carried_trace

_FOLLOWS = '{}, {"callbacks": null, "errbacks": null, "chain": null, "chord": null}'


def task_message(name: TaskName, task: ModelTask, task_id: str, expires_s: float | None = None) -> str:
    """The task as it is pushed (LPUSH) to `queue_of(name, task)`: JSON.

    Celery's message protocol, version 2 (docs.celeryq.dev, Internals), in the envelope of kombu's Redis transport. Not
    begun any more `expires_s` after now. The trace that is being worked for goes along.
    """
    body = f"[[{task.model_dump_json()}], {_FOLLOWS}]"
    headers: dict[str, Any] = {
        "lang": "py",
        "task": name.value,
        "id": task_id,
        "shadow": None,
        "eta": None,
        "expires": None,
        "group": None,
        "group_index": None,
        "retries": 0,
        "timelimit": [None, None],
        "root_id": task_id,
        "parent_id": None,
        "argsrepr": "",
        "kwargsrepr": "",
        "origin": "querycad",
        "ignore_result": True,
        "replaced_task_nesting": 0,
        "stamped_headers": None,
        "stamps": {},
        **carried_trace(),
    }
    properties: dict[str, Any] = {
        "correlation_id": task_id,
        "reply_to": "",
        "argsrepr": "",
        "delivery_mode": 2,
        "delivery_info": {"exchange": "", "routing_key": queue_of(name, task).value},
        "priority": 0,
        "body_encoding": "base64",
        "delivery_tag": str(uuid4()),
    }
    if expires_s is not None:
        headers["expires"] = (datetime.now(UTC) + timedelta(seconds=expires_s)).isoformat()
        properties["expiration"] = str(int(expires_s * 1000))
    return json.dumps(
        {
            "body": b64encode(body.encode()).decode(),
            "content-encoding": "utf-8",
            "content-type": "application/json",
            "headers": headers,
            "properties": properties,
        }
    )
