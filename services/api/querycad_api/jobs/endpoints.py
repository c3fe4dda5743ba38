"""`/v1/jobs/{id}`: how far a question is; its answer's picture."""

from __future__ import annotations

from fastapi import APIRouter
from fastapi.responses import FileResponse
from pydantic import TypeAdapter

from querycad_api.dependencies import ServicesDep, WaitDep
from querycad_api.problems import JobNotFound, ModelNotFound, PictureNotFound, ServiceUnavailable, responses
from querycad_contracts import Job, JobId, ModelId, PictureTask, Status, TaskName, TaskOutcome

PICTURE_S = 60.0
_NAME = TypeAdapter(TaskOutcome[str])

router = APIRouter(prefix="/v1", tags=["jobs"])


@router.get("/jobs/{job_id}", response_model=Job, responses=responses(JobNotFound, ServiceUnavailable))
async def get_job(job_id: JobId, services: ServicesDep, wait_s: WaitDep) -> Job:
    """How far is the question? With `Prefer: wait=N`, once it is done or after N seconds."""
    found = await services.state.job(job_id)
    if found is not None and found.record is None and wait_s and await services.state.done(job_id, wait_s):
        found = await services.state.job(job_id)
    if found is None:
        raise JobNotFound("there is no job with this id, or it is no longer kept")
    return found


@router.get(
    "/models/{model_id}/answers/{job_id}/picture",
    response_class=FileResponse,
    responses={
        **responses(ModelNotFound, JobNotFound, PictureNotFound, ServiceUnavailable),
        200: {"description": "The picture.", "content": {"image/png": {"schema": {"type": "string"}}}},
    },
)
async def get_picture(model_id: ModelId, job_id: JobId, services: ServicesDep) -> FileResponse:
    """The parts that an answer rests on, marked and numbered in a picture of the model."""
    await services.model(model_id)
    job = await services.state.job(job_id)
    if job is None or job.model != model_id:
        raise JobNotFound("the model has no answer with this id, or it is no longer kept")
    if job.record is None or job.record.status is not Status.ANSWERED:
        raise PictureNotFound("the question has no answer to draw")
    path = services.settings.pictures / f"{job_id}.png"
    if not path.exists():
        task = PictureTask(model=model_id, record=job.record, name=path.name)
        outcome = _NAME.validate_python(await services.broker.call(TaskName.PICTURE, task, PICTURE_S))
        if outcome.failure is not None or not path.exists():
            raise PictureNotFound(outcome.failure.message if outcome.failure else "the picture could not be drawn")
    return FileResponse(path, media_type="image/png")
