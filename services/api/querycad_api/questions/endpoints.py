"""`/v1/models/{id}/questions`: ask, one or several at once; `/v1/models/{id}/answers`: what was asked before."""

from __future__ import annotations

import asyncio
from typing import Annotated

from fastapi import APIRouter, Header, Response

from querycad_api.dependencies import LimitDep, OffsetDep, ServicesDep, WaitDep
from querycad_api.problems import (
    KeyReused,
    Malformed,
    ModelNotFound,
    ServiceUnavailable,
    TooLarge,
    TooManyRequests,
    responses,
)
from querycad_contracts import AnswerRecord, Job, JobsPage, JobStatus, ModelId, QuestionRequest, QuestionsRequest

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

PROBLEMS = responses(Malformed, TooLarge, ModelNotFound, KeyReused, TooManyRequests, ServiceUnavailable)

router = APIRouter(prefix="/v1/models/{model_id}", tags=["questions"])


@router.post(
    "/questions",
    response_model=None,
    status_code=202,
    responses={
        **PROBLEMS,
        200: {
            "description": "The answer, or why there is none; the same as `querycad ask --json` prints.",
            "model": AnswerRecord,
        },
        202: {"description": "The question was accepted; the job at `Location` will hold the answer.", "model": Job},
    },
)
async def ask(
    model_id: ModelId, asked: QuestionRequest, services: ServicesDep, wait_s: WaitDep, once: IdempotencyKeyDep = None
) -> Response:
    """Asks a question about a model. With `Prefer: wait=N` the answer comes at once if it is there within N seconds."""
    (job,) = await accept(services, model_id, (asked,), once)
    headers = {"Location": f"/v1/jobs/{job.id}"}
    if wait_s and await done(services, job, wait_s):
        record = await services.state.record(job.id)
        headers["Preference-Applied"] = f"wait={wait_s}"
        return Response(record, 200, headers, media_type="application/json")
    return Response(job.model_dump_json(), 202, headers, media_type="application/json")


@router.post(
    "/questions/batch",
    response_model=None,
    status_code=202,
    responses={
        **PROBLEMS,
        200: {"description": "All are done; their jobs hold the answers, in the order asked.", "model": JobsPage},
        202: {"description": "The questions were accepted; a job each, in the order asked.", "model": JobsPage},
    },
)
async def ask_many(
    model_id: ModelId, asked: QuestionsRequest, services: ServicesDep, wait_s: WaitDep, once: IdempotencyKeyDep = None
) -> Response:
    """Asks several questions about a model at once: all are accepted, or none. With `Prefer: wait=N` as for one."""
    jobs = await accept(services, model_id, asked.questions, once)
    headers = {}
    if wait_s:
        deadline = asyncio.get_running_loop().time() + wait_s
        for job in jobs:
            await done(services, job, max(0.0, deadline - asyncio.get_running_loop().time()))
        found = [await services.state.job(services.caller.tenant, job.id) for job in jobs]
        jobs = tuple(now or before for now, before in zip(found, jobs, strict=True))
    all_done = all(job.status is JobStatus.DONE for job in jobs)
    if wait_s and all_done:
        headers["Preference-Applied"] = f"wait={wait_s}"
    page = JobsPage(items=jobs, total=len(jobs))
    return Response(page.model_dump_json(), 200 if all_done else 202, headers, media_type="application/json")


@router.get("/answers", response_model=JobsPage, responses=responses(ModelNotFound, ServiceUnavailable))
async def list_answers(
    model_id: ModelId, services: ServicesDep, offset: OffsetDep = 0, limit: LimitDep = 100
) -> JobsPage:
    """What was asked about the model, and what came of it? The newest first."""
    await services.must_know(model_id)
    return await services.state.jobs(services.caller.tenant, model_id, offset, limit)
