"""Accepting questions: each becomes a job that ends with a record, once, however often the request is repeated."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from uuid import uuid4

from redis.exceptions import RedisError

from querycad_api.dependencies import Services, no_model
from querycad_api.problems import KeyReused, TooManyQuestions, TooManyRequests
from querycad_api.store.keyspace import now
from querycad_api.store.state import Once
from querycad_contracts import Job, JobStatus, QuestionRequest, QuestionTask

LOST_S = 5.0
"""A job that is queued for longer may have been kept by a process that died before it put it on the queue. Should it be
on the queue all the same, it is answered once: the second to take it finds the record."""


async def accept(services: Services, model: str, asked: Sequence[QuestionRequest], key: str | None) -> tuple[Job, ...]:
    """The jobs of the questions.

    Raises ModelNotFound, KeyReused, TooManyQuestions, TooManyRequests and ServiceUnavailable.
    """
    caller, most = services.caller, services.settings.key_questions
    if caller.key and len(asked) > most:
        raise TooManyQuestions(f"at most {most} open questions for one API key: ask so many at once, not {len(asked)}")
    tasks = [
        QuestionTask(
            model=model, job=uuid4().hex, tenant=caller.tenant, key=caller.key, **each.model_dump(exclude_unset=True)
        )
        for each in asked
    ]
    if key is not None:
        tasks, known = await _claimed(services, tasks, key)
        if known:
            return known
    if caller.key and not await services.state.reserve(tasks, most):
        raise TooManyRequests(f"at most {most} open questions for one API key")
    jobs = await services.state.add_jobs(tasks)
    if not jobs:
        await services.state.forget_jobs(tasks)
        raise no_model()
    return jobs


async def done(services: Services, job: Job, wait_s: float) -> bool:
    """Is the job done in time? A store that goes away meanwhile makes no accepted question a refused one."""
    try:
        return job.status is JobStatus.DONE or await services.state.job_done(job.id, wait_s)
    except RedisError:
        return False


async def _claimed(
    services: Services, tasks: list[QuestionTask], key: str
) -> tuple[list[QuestionTask], tuple[Job, ...]]:
    """The tasks with the ids that they have under this idempotency key, and their jobs where all are there already.

    A key stays with the request that it came with first, though that was refused: another of the same may be accepted
    at this moment, under the same ids.
    """
    tenant = services.caller.tenant
    wanted = Once(_fingerprint(tasks), tuple(task.job for task in tasks))
    claim = await services.state.once(tenant, key, wanted)
    if claim is wanted:
        return tasks, ()
    if claim.fingerprint != wanted.fingerprint:
        raise KeyReused("this idempotency key came with another request before")
    tasks = [task.model_copy(update={"job": job}) for task, job in zip(tasks, claim.jobs, strict=True)]
    found = [await services.state.job(tenant, task.job) for task in tasks]
    jobs = tuple(job for job in found if job is not None)
    if len(jobs) < len(tasks):
        return tasks, ()
    lost = {job.id for job in jobs if job.status is JobStatus.QUEUED and (now() - job.created).total_seconds() > LOST_S}
    await services.broker.questions([task for task in tasks if task.job in lost])
    return tasks, jobs


def _fingerprint(tasks: Sequence[QuestionTask]) -> str:
    """What tells one request from another? SHA-256 of model and questions."""
    own = set(QuestionTask.model_fields) - set(QuestionRequest.model_fields) - {"model"}
    text = "\n".join(task.model_dump_json(exclude=own) for task in tasks)
    return hashlib.sha256(text.encode()).hexdigest()
