"""`/v1/jobs/{id}`: how far a question is, step by step; its answer's picture."""

from __future__ import annotations

from collections import Counter
from collections.abc import AsyncIterator
from typing import Annotated

from fastapi import APIRouter, Depends, Header, Request
from fastapi.responses import Response
from fastapi.sse import EventSourceResponse, ServerSentEvent
from redis.exceptions import RedisError

from querycad_api.dependencies import (
    LimitDep,
    OffsetDep,
    PartsShown,
    PartsShownDep,
    ServicesDep,
    WaitDep,
    shown,
)
from querycad_api.links import link_next
from querycad_api.models.drawings import PNG, drawn
from querycad_api.problems import (
    JobIsDone,
    JobNotFound,
    ModelNotFound,
    ModelUnreadable,
    NothingMore,
    PictureNotFound,
    ServiceUnavailable,
    TooManyRequests,
    responses,
)
from querycad_contracts import Job, JobId, JobStatus, ModelId, PartsPage, PictureTask, Queue, TaskName
from querycad_contracts.infrastructure import picture_name

from .service import answered, cancel

RECONNECT_MS = 1000
JOB_STREAMS, KEY_STREAMS = 8, 128
"""Streams open at the same time, of one process of the api: a page holds one for each question that it waits for."""

router = APIRouter(prefix="/v1", tags=["jobs"])


@router.get("/jobs/{job_id}", response_model=Job, responses=responses(JobNotFound, ServiceUnavailable))
async def get_job(job_id: JobId, services: ServicesDep, wait_s: WaitDep, parts: PartsShownDep = PartsShown.FULL) -> Job:
    """How far is the question? With `Prefer: wait=N`, once it is done or after N seconds."""
    found = await services.job(job_id)
    if found.record is None and wait_s and await services.state.job_done(job_id, wait_s):
        found = await services.job(job_id)
    if found.status is JobStatus.QUEUED:
        found = found.model_copy(update={"ahead": await services.state.ahead(Queue.QUESTIONS, job_id)})
    return shown(found, parts)


LastEventDep = Annotated[
    str,
    Header(alias="Last-Event-ID", pattern=r"^(\d{1,19}-\d{1,19})?$", description="Only what came after this event."),
]


async def _followed(
    job_id: JobId, services: ServicesDep, request: Request, last_event_id: LastEventDep = ""
) -> AsyncIterator[Job]:
    """The job, looked up before the response begins, while its stream lasts.

    Raises JobNotFound, NothingMore to who was told all, and TooManyRequests where too many streams are open.
    """
    job = await services.job(job_id)
    if last_event_id and await services.state.told(job_id, last_event_id):
        raise NothingMore
    open_streams: Counter[str] = request.app.state.streams
    names = {f"job {job_id}": JOB_STREAMS, f"key {services.caller.key}": KEY_STREAMS}
    if any(open_streams[name] >= most for name, most in names.items()):
        raise TooManyRequests(f"at most {JOB_STREAMS} streams of one job, and {KEY_STREAMS} of one API key")
    open_streams.update(names.keys())
    try:
        yield job
    finally:
        open_streams.subtract(names.keys())
        for name in names:
            if not open_streams[name]:
                del open_streams[name]


@router.get(
    "/jobs/{job_id}/events",
    response_class=EventSourceResponse,
    responses={
        **responses(JobNotFound, ServiceUnavailable),
        200: {"description": "Server-sent events; `data` is a JobEvent, `event` its kind. `done` is the last."},
        204: {"description": "The job is done; no further events."},
    },
)
async def get_events(
    job: Annotated[Job, Depends(_followed)], services: ServicesDep, last_event_id: LastEventDep = ""
) -> AsyncIterator[ServerSentEvent]:
    """What happens to the question, as it happens, from its start. Whoever comes later is told all of it, too."""
    try:
        async for number, event in services.state.events(job.id, last_event_id or "0"):
            data = event.model_dump_json()
            yield ServerSentEvent(raw_data=data, event=event.kind.value, id=number, retry=RECONNECT_MS)
    except RedisError:
        return  # the client connects again and goes on where it was


@router.post(
    "/jobs/{job_id}/cancel",
    response_model=Job,
    responses=responses(JobNotFound, JobIsDone, ServiceUnavailable),
)
async def cancel_job(job_id: JobId, services: ServicesDep) -> Job:
    """Calls the question off: its job is done, with the failure `cancelled`, and what runs for it is stopped."""
    return await cancel(services, job_id)


@router.get(
    "/models/{model_id}/answers/{job_id}/picture",
    response_class=Response,
    responses={
        **responses(ModelNotFound, JobNotFound, PictureNotFound, ModelUnreadable, ServiceUnavailable),
        **PNG,
    },
)
async def get_picture(model_id: ModelId, job_id: JobId, services: ServicesDep, request: Request) -> Response:
    """The parts that an answer rests on, marked and numbered in a picture of the model."""
    await services.must_know(model_id)
    record = await answered(services, model_id, job_id)
    task = PictureTask(model=model_id, record=record, name=picture_name(job_id))
    return await drawn(services, TaskName.PICTURE, task, "image/png", request.headers)


@router.get(
    "/models/{model_id}/answers/{job_id}/parts",
    response_model=PartsPage,
    responses=responses(ModelNotFound, JobNotFound, PictureNotFound, ServiceUnavailable),
)
async def list_answer_parts(
    model_id: ModelId,
    job_id: JobId,
    services: ServicesDep,
    request: Request,
    response: Response,
    offset: OffsetDep = 0,
    limit: LimitDep = 100,
) -> PartsPage:
    """The parts that an answer rests on, page by page; `Link` tells the next."""
    await services.must_know(model_id)
    found = (await answered(services, model_id, job_id)).parts
    link_next(request, response, offset, limit, len(found))
    return PartsPage(items=found[offset : offset + limit], total=len(found))
