"""`/v1/models/{id}/questions`: ask, one or several at once; `/v1/models/{id}/answers`: what was asked before."""

from __future__ import annotations

import asyncio
from typing import Annotated, Final

from fastapi import APIRouter, Header, Request, Response
from redis.exceptions import RedisError

from querycad_api.dependencies import (
    LimitDep,
    OffsetDep,
    PartsShown,
    PartsShownDep,
    Services,
    ServicesDep,
    WaitDep,
    shown,
)
from querycad_api.links import link_next
from querycad_api.problems import (
    KeyReused,
    Malformed,
    ModelNotFound,
    NotAsDocumented,
    ServiceUnavailable,
    TooLarge,
    TooManyQuestions,
    TooManyRequests,
    WrongMediaType,
    responses,
)
from querycad_contracts import Job, JobsPage, JobStatus, ModelId, QuestionRequest, QuestionsRequest

from .service import accept, done

IdempotencyKeyDep = Annotated[
    str | None,
    Header(
        alias="Idempotency-Key",
        min_length=1,
        max_length=255,
        description="Any text of the client's. A request that comes again with it, within a day, is not done again: "
        "the answer is that of the first.",
    ),
]

PROBLEMS: Final = (
    *(Malformed, TooLarge, WrongMediaType, ModelNotFound, NotAsDocumented, KeyReused),
    *(TooManyRequests, ServiceUnavailable),
)

router = APIRouter(prefix="/v1/models/{model_id}", tags=["questions"])


@router.post(
    "/questions",
    response_model=None,
    status_code=202,
    responses={
        **responses(*PROBLEMS),
        200: {"description": "The job is done: its `record` has the answer, or why there is none.", "model": Job},
        202: {"description": "The question was accepted; the job at `Location` will hold the answer.", "model": Job},
    },
)
async def ask(
    model_id: ModelId,
    asked: QuestionRequest,
    services: ServicesDep,
    wait_s: WaitDep,
    once: IdempotencyKeyDep = None,
    parts: PartsShownDep = PartsShown.FULL,
) -> Response:
    """Asks a question about a model. With `Prefer: wait=N` the answer comes at once if it is there within N seconds."""
    jobs = await _waited(services, await accept(services, model_id, (asked,), once), wait_s)
    response = _accepted(jobs, wait_s, shown(jobs[0], parts))
    response.headers["Location"] = f"/v1/jobs/{jobs[0].id}"
    return response


@router.post(
    "/questions/batch",
    response_model=None,
    status_code=202,
    responses={
        **responses(*PROBLEMS, TooManyQuestions),
        200: {"description": "All are done; their jobs hold the answers, in the order asked.", "model": JobsPage},
        202: {"description": "The questions were accepted; a job each, in the order asked.", "model": JobsPage},
    },
)
async def ask_many(
    model_id: ModelId,
    asked: QuestionsRequest,
    services: ServicesDep,
    wait_s: WaitDep,
    once: IdempotencyKeyDep = None,
    parts: PartsShownDep = PartsShown.FULL,
) -> Response:
    """Asks several questions about a model at once: all are accepted, or none. With `Prefer: wait=N` as for one."""
    jobs = await _waited(services, await accept(services, model_id, asked.questions, once), wait_s)
    return _accepted(jobs, wait_s, JobsPage(items=tuple(shown(job, parts) for job in jobs), total=len(jobs)))


@router.get("/answers", response_model=JobsPage, responses=responses(ModelNotFound, ServiceUnavailable))
async def list_answers(
    model_id: ModelId,
    services: ServicesDep,
    request: Request,
    response: Response,
    offset: OffsetDep = 0,
    limit: LimitDep = 100,
    parts: PartsShownDep = PartsShown.FULL,
) -> JobsPage:
    """What was asked about the model, and what came of it? The newest first; `Link` tells the next page."""
    await services.must_know(model_id)
    page = await services.state.jobs(services.caller.tenant, model_id, offset, limit)
    link_next(request, response, offset, limit, page.total)
    return JobsPage(items=tuple(shown(job, parts) for job in page.items), total=page.total)


async def _waited(services: Services, jobs: tuple[Job, ...], wait_s: int) -> tuple[Job, ...]:
    """The jobs as they are once all are done, or after so many seconds."""
    if not wait_s:
        return jobs
    deadline = asyncio.get_running_loop().time() + wait_s
    for job in jobs:
        await done(services, job, max(0.0, deadline - asyncio.get_running_loop().time()))
    return tuple([await _now(services, job) for job in jobs])


def _accepted(jobs: tuple[Job, ...], wait_s: int, body: Job | JobsPage) -> Response:
    """200 where all are done, else 202."""
    all_done = all(job.status is JobStatus.DONE for job in jobs)
    headers = {"Preference-Applied": f"wait={wait_s}"} if wait_s and all_done else {}
    return Response(body.model_dump_json(), 200 if all_done else 202, headers, media_type="application/json")


async def _now(services: Services, job: Job) -> Job:
    """The job as it is by now, if it can be found out."""
    try:
        return await services.state.job(services.caller.tenant, job.id) or job
    except RedisError:
        return job
