"""Where what is known of models and jobs is kept in Redis, and how it is read back.

querycad:model:<tenant>:<id>   hash: resource (ModelResource as uploaded), ingest (id of the task that reads its
                               file), outcome (TaskOutcome[ModelSummary])
querycad:models:<tenant>       sorted set: ids of the tenant's models by the time of their upload
querycad:sizes:<tenant>        hash: bytes of each uploaded file of the tenant and of what was read of it, by model
querycad:answers:<tenant>      sorted set: ids of the tenant's jobs by the time of the question
querycad:bytes:<tenant>        hash: bytes of each answer of the tenant, by job, and their `sum`
querycad:owners:<id>           set: tenants that have a model with this content; its files go with the last one
querycad:job:<id>              hash: task (QuestionTask), created, attempts, started, waits, record, finished
querycad:asked:<tenant>:<id>   sorted set: ids of the jobs about a model by the time of the question
querycad:events:<id>           stream: what happened to a job, or to <tenant>:<model>, so far
querycad:done:<id>             stream: one entry once a job is done, for who waits for that alone
querycad:said:<id>             list: what a language model was asked for a job, and said; a job that is begun again
                               goes on there
querycad:open:<key>            sorted set: ids of the API key's unanswered jobs by the time of the question
querycad:once:<tenant>:<key>   what was done for a request with this idempotency key
querycad:pending               sorted set: ids of unanswered jobs by the time at which they are looked at again
querycad:reading               sorted set: <tenant>:<model> of files that are being read, likewise
querycad:totals                hash: counters of all workers, for /metrics
"""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Literal

from querycad_api.links import job_links, model_links
from querycad_contracts import (
    AnswerRecord,
    Failure,
    FailureCategory,
    Job,
    JobEvent,
    JobEventKind,
    JobStatus,
    ModelResource,
    ModelStatus,
    ModelSummary,
    QuestionTask,
    TaskFailureKind,
    TaskOutcome,
)

DAY_S = 24 * 3600
TOTALS = "querycad:totals"
PENDING = "querycad:pending"
READING = "querycad:reading"
UNREAD = 4
"""A file that is not read yet counts as so many: what is read of a file has three times its bytes, in the median."""
RECORD_BYTES = 2**21
"""An answer about 24 parts takes 20,000, their faces included; one about 1,360 holes 950,000."""
LONGEST_QUESTION = 2000
TOLD_S = 3600
"""How long it is told that a job is done; nobody waits for longer, and who comes later reads it from the job."""


class ModelStale(Exception):
    """What is known of a model is an older version's: its file has to be read anew first."""


Kind = Literal[
    "model", "models", "sizes", "answers", "bytes", "owners", "job", "asked", "events", "done", "said", "open", "once"
]


def key_of(kind: Kind, *whose: str) -> str:
    """Under which key is this kept of a tenant, a model, a job …? The table above says what follows each kind."""
    return ":".join(("querycad", kind, *whose))


def model_of(fields: dict[str, str]) -> ModelResource | None:
    """The model that a hash tells of; None when there is none."""
    if "resource" not in fields:
        return None
    resource = ModelResource.model_validate_json(fields["resource"])
    if "outcome" not in fields:
        return resource.model_copy(update={"links": model_links(resource.id, ready=False)})
    outcome = TaskOutcome[ModelSummary].model_validate_json(fields["outcome"])
    if outcome.failure is None:
        links = model_links(resource.id, ready=True)
        return resource.model_copy(update={"status": ModelStatus.READY, "summary": outcome.value, "links": links})
    category = FailureCategory.BAD_INPUT if outcome.failure.kind is TaskFailureKind.FILE else FailureCategory.INTERNAL
    failure = Failure(category=category, message=outcome.failure.message, retryable=outcome.failure.retryable)
    links = model_links(resource.id, ready=False)
    return resource.model_copy(update={"status": ModelStatus.FAILED, "failure": failure, "links": links})


def uploaded(resource: ModelResource) -> str:
    """When was the file uploaded? As it is written in the model's hash."""
    return str(resource.model_dump(mode="json")["created"])


def task_of(fields: dict[str, str]) -> QuestionTask | None:
    """What a job's hash says that was asked; None when there is none."""
    return QuestionTask.model_validate_json(fields["task"]) if "task" in fields else None


def job_of(fields: dict[str, str]) -> Job | None:
    """The job that a hash tells of; None when there is none."""
    task = task_of(fields)
    if task is None:
        return None
    record = AnswerRecord.model_validate_json(fields["record"]) if "record" in fields else None
    waits = JobStatus.RUNNING if "started" in fields else JobStatus.QUEUED
    return Job(
        id=task.job,
        model=task.model,
        question=task.question,
        unit=task.unit,
        status=JobStatus.DONE if record is not None else waits,
        created=datetime.fromisoformat(fields["created"]),
        finished=datetime.fromisoformat(fields["finished"]) if "finished" in fields else None,
        answer=record.answer if record is not None else None,
        confidence=record.confidence if record is not None else None,
        part_ids=tuple(part.id for part in record.parts) if record is not None else (),
        links=job_links(task.model, task.job, record),
        record=record,
    )


def finished(
    task: QuestionTask, record: AnswerRecord, kept_s: int, times: Mapping[str, float] | None = None
) -> tuple[list[str], list[str | float]]:
    """Keys and arguments of FINISH_JOB: what is kept and told of a finished job, and what is added to the counters.

    The question is counted by how it ended; `times` are counted beside that.
    """
    keys = [key_of("job", task.job), key_of("events", task.job), key_of("open", task.key), TOTALS, PENDING]
    keys += key_of("done", task.job), key_of("bytes", task.tenant)
    told = entry(JobEvent(kind=JobEventKind.DONE, at=now()))["event"]
    kept: list[str | float] = [bounded(record), now().isoformat(), kept_s, told, task.job, TOLD_S]
    category = record.failure.category if record.failure else ""
    totals = {f"questions:{record.status.value}:{category}": 1.0, **(times or {})}
    return keys, [*kept, *(each for pair in totals.items() for each in pair)]


def bounded(record: AnswerRecord) -> str:
    """The record as JSON of at most `RECORD_BYTES`: without what is large and no answer, at last without an answer."""
    text = record.model_dump_json(exclude_defaults=True)
    if len(text) <= RECORD_BYTES:
        return text
    warnings = (*record.warnings, "the record was too large: parts are without faces, other programs were left out")
    bare = tuple(part.model_copy(update={"faces": (), "children": ()}) for part in record.parts)
    fewer = record.model_copy(update={"parts": bare, "attempts": (), "alternatives": (), "warnings": warnings})
    for each in (fewer, fewer.model_copy(update={"parts": ()})):
        text = each.model_dump_json(exclude_defaults=True)
        if len(text) <= RECORD_BYTES:
            return text
    failure = Failure(
        category=FailureCategory.INTERNAL, message=f"the answer has more than the {RECORD_BYTES:,} bytes that are kept"
    )
    return AnswerRecord.failed(record.question[:LONGEST_QUESTION], failure).model_dump_json(exclude_defaults=True)


def entry(event: JobEvent) -> dict[str, str]:
    """The event as it is put on a job's stream; the record is in the job's hash alone."""
    data = event.model_dump_json(exclude={"record"}, exclude_defaults=True)
    return {"kind": event.kind.value, "event": data}


def now() -> datetime:
    """The time in UTC."""
    return datetime.now(UTC)
