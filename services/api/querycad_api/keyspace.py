"""Where what is known of models and jobs is kept in Redis, and how it is read back.

querycad:model:<tenant>:<id>   hash: resource (ModelResource as uploaded), outcome (TaskOutcome[ModelSummary])
querycad:models:<tenant>       sorted set: ids of the tenant's models by the time of their upload
querycad:owners:<id>           set: tenants that have a model with this content; its files go with the last one
querycad:job:<id>              hash: task (QuestionTask), created, attempts, started, waits, record, finished
querycad:asked:<tenant>:<id>   sorted set: ids of the jobs about a model by the time of the question
querycad:events:<id>           stream: what happened to a job, or to <tenant>:<model>, so far
querycad:done:<id>             stream: one entry once a job is done, for who waits for that alone
querycad:open:<key>            sorted set: ids of the API key's unanswered jobs by the time of the question
querycad:once:<tenant>:<key>   what was done for a request with this idempotency key
querycad:pending               sorted set: ids of unanswered jobs by the time at which they are looked at again
querycad:reading               sorted set: <tenant>:<model> of files that are being read, likewise
querycad:totals                hash: counters of all workers, for /metrics
"""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime

from querycad_contracts import (
    AnswerRecord,
    Failure,
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
TOLD_S = 3600
"""How long it is told that a job is done; nobody waits for longer, and who comes later reads it from the job."""

ADD_JOBS = """
if redis.call('HEXISTS', KEYS[1], 'resource') == 0 then
  return 0
end
for i = 1, (#KEYS - 4) / 2 do
  local job, events = KEYS[2 * i + 3], KEYS[2 * i + 4]
  local id, task, message = ARGV[3 * i + 4], ARGV[3 * i + 5], ARGV[3 * i + 6]
  redis.call('HSET', job, 'task', task, 'created', ARGV[1])
  redis.call('EXPIRE', job, ARGV[4])
  redis.call('XADD', events, '*', 'kind', 'queued', 'event', ARGV[6])
  redis.call('EXPIRE', events, ARGV[4])
  redis.call('ZADD', KEYS[2], ARGV[2], id)
  redis.call('ZADD', KEYS[3], ARGV[3], id)
  redis.call('LPUSH', KEYS[4], message)
end
redis.call('ZREMRANGEBYSCORE', KEYS[2], 0, ARGV[5])
redis.call('EXPIRE', KEYS[2], ARGV[4])
return 1
"""
"""Keys: model, what was asked about it, pending, queue, then of each job: itself, its events. Arguments: time as text
and as a number, when jobs are looked at again, seconds kept, before when jobs are forgotten, event, then of each job:
id, task, message for the queue. 0, and nothing is done, when there is no such model."""
FINISH_JOB = """
if redis.call('HEXISTS', KEYS[1], 'task') == 0 or redis.call('HSETNX', KEYS[1], 'record', ARGV[1]) == 0 then
  return 0
end
redis.call('HSET', KEYS[1], 'finished', ARGV[2])
redis.call('EXPIRE', KEYS[1], ARGV[3])
redis.call('XADD', KEYS[2], '*', 'kind', 'done', 'event', ARGV[4])
redis.call('EXPIRE', KEYS[2], ARGV[3])
redis.call('XADD', KEYS[6], '*', 'kind', 'done')
redis.call('EXPIRE', KEYS[6], ARGV[6])
redis.call('ZREM', KEYS[3], ARGV[5])
redis.call('ZREM', KEYS[5], ARGV[5])
for i = 7, #ARGV, 2 do
  redis.call('HINCRBYFLOAT', KEYS[4], ARGV[i], ARGV[i + 1])
end
return 1
"""
"""Keys and arguments: `finished`. A job that is done, or was deleted, stays as it is."""
BEGIN_JOB = """
if redis.call('HEXISTS', KEYS[1], 'task') == 0 or redis.call('HEXISTS', KEYS[1], 'record') == 1 then
  return 0
end
redis.call('HSET', KEYS[1], 'started', ARGV[1], 'touched', ARGV[3])
if redis.call('HEXISTS', KEYS[1], 'waits') == 0 then
  redis.call('XADD', KEYS[2], '*', 'kind', 'started', 'event', ARGV[2])
end
local attempt = redis.call('HINCRBY', KEYS[1], 'attempts', 1)
local model = redis.call('HMGET', KEYS[3], 'resource', 'outcome')
return {attempt, redis.call('HGET', KEYS[1], 'created'), model[1], model[2]}
"""
"""Keys: job, its events, its model. 0 for a job that is done, or was deleted; else the attempt's number, the time at
which it was asked, and what is known of the model, all in one: each way to the store costs more than what is read."""
WAIT_JOB = """
if redis.call('HEXISTS', KEYS[1], 'task') == 1 then
  redis.call('HINCRBY', KEYS[1], 'attempts', -1)
  redis.call('HDEL', KEYS[1], 'started')
  redis.call('HSET', KEYS[1], 'touched', ARGV[2])
  if redis.call('HGET', KEYS[1], 'waits') ~= ARGV[3] then
    redis.call('HSET', KEYS[1], 'waits', ARGV[3])
    redis.call('XADD', KEYS[2], '*', 'kind', 'waiting', 'event', ARGV[1])
  end
end
return 0
"""
"""Keys: job, its events. Arguments: event, time, what is waited for: told once, however often it is looked for."""
FINISH_MODEL = """
local resource = redis.call('HGET', KEYS[1], 'resource')
if not resource or not string.find(resource, ARGV[3], 1, true) then
  return 0
end
if redis.call('HSETNX', KEYS[1], 'outcome', ARGV[1]) == 0 then
  return 0
end
redis.call('XADD', KEYS[2], '*', 'kind', 'done')
redis.call('ZREM', KEYS[3], ARGV[2])
return 1
"""
"""Keys: model, its events, models that are read. Arguments: outcome, member of the last, time of the upload. What came
of a file that was deleted while it was read is none of the same file's that was uploaded anew."""


def model_key(tenant: str, model: str) -> str:
    """Where is the model's hash?"""
    return f"querycad:model:{tenant}:{model}"


def models_key(tenant: str) -> str:
    """Where are the ids of the tenant's models?"""
    return f"querycad:models:{tenant}"


def owners_key(model: str) -> str:
    """Where are the tenants that have a model with this content?"""
    return f"querycad:owners:{model}"


def job_key(job: str) -> str:
    """Where is the job's hash?"""
    return f"querycad:job:{job}"


def asked_key(tenant: str, model: str) -> str:
    """Where are the ids of the jobs about a model?"""
    return f"querycad:asked:{tenant}:{model}"


def model_events_key(tenant: str, model: str) -> str:
    """Where is the stream of what happens to a model?"""
    return f"querycad:events:{tenant}:{model}"


def job_events_key(job: str) -> str:
    """Where is the stream of what happens to a job?"""
    return f"querycad:events:{job}"


def job_done_key(job: str) -> str:
    """Where is it told that a job is done?"""
    return f"querycad:done:{job}"


def open_key(key: str) -> str:
    """Where are the unanswered jobs of an API key?"""
    return f"querycad:open:{key}"


def once_key(tenant: str, key: str) -> str:
    """Where is it noted what was done for an idempotency key?"""
    return f"querycad:once:{tenant}:{key}"


def model_of(fields: dict[str, str]) -> ModelResource | None:
    """The model that a hash tells of; None when there is none."""
    if "resource" not in fields:
        return None
    resource = ModelResource.model_validate_json(fields["resource"])
    if "outcome" not in fields:
        return resource
    outcome = TaskOutcome[ModelSummary].model_validate_json(fields["outcome"])
    if outcome.failure is None:
        return resource.model_copy(update={"status": ModelStatus.READY, "summary": outcome.value})
    category = "bad_input" if outcome.failure.kind is TaskFailureKind.FILE else "internal"
    failure = Failure(category=category, message=outcome.failure.message, retryable=outcome.failure.retryable)
    return resource.model_copy(update={"status": ModelStatus.FAILED, "failure": failure})


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
    record = fields.get("record")
    waits = JobStatus.RUNNING if "started" in fields else JobStatus.QUEUED
    return Job(
        id=task.job,
        model=task.model,
        question=task.question,
        unit=task.unit,
        status=JobStatus.DONE if record else waits,
        created=datetime.fromisoformat(fields["created"]),
        finished=datetime.fromisoformat(fields["finished"]) if "finished" in fields else None,
        record=AnswerRecord.model_validate_json(record) if record else None,
    )


def finished(
    task: QuestionTask, record: AnswerRecord, kept_s: int, totals: Mapping[str, float]
) -> tuple[list[str], list[str | float]]:
    """Keys and arguments of FINISH_JOB: what is kept and told of a finished job, and what is added to the counters."""
    keys = [job_key(task.job), job_events_key(task.job), open_key(task.key), TOTALS, PENDING, job_done_key(task.job)]
    told = entry(JobEvent(kind=JobEventKind.DONE, at=now()))["event"]
    kept: list[str | float] = [record.model_dump_json(), now().isoformat(), kept_s, told, task.job, TOLD_S]
    return keys, [*kept, *(each for pair in totals.items() for each in pair)]


def entry(event: JobEvent) -> dict[str, str]:
    """The event as it is put on a job's stream; the record is in the job's hash alone."""
    data = event.model_dump_json(exclude={"record"}, exclude_defaults=True)
    return {"kind": event.kind.value, "event": data}


def now() -> datetime:
    """The time in UTC."""
    return datetime.now(UTC)
