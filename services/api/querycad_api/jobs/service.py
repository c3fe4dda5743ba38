"""What is done with jobs: they are called off, and their answers looked up."""

from __future__ import annotations

from querycad_api.dependencies import Services
from querycad_api.problems import JobIsDone, JobNotFound, PictureNotFound
from querycad_contracts import AnswerRecord, Job


async def cancel(services: Services, job: str) -> Job:
    """Ends the job with the failure `cancelled` and stops what runs for it. Raises JobNotFound and JobIsDone."""
    found = await services.job(job)
    task = await services.state.task(job)
    if task is None or not await services.state.end_job(task, AnswerRecord.cancelled(found.question)):
        raise JobIsDone("the question has its answer already")
    await services.broker.stop([job])
    return await services.job(job)


async def answered(services: Services, model: str, job: str) -> AnswerRecord:
    """The record of an answer about the model. Raises JobNotFound, and PictureNotFound where there is no answer."""
    found = await services.job(job)
    if found.model != model:
        raise JobNotFound("the model has no answer with this id")
    if found.record is None or found.record.answer is None:
        raise PictureNotFound("the question has no answer to draw")
    return found.record
