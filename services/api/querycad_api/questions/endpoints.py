"""`/v1/models/{id}/questions`: ask."""

from __future__ import annotations

from uuid import uuid4

from fastapi import APIRouter, Response
from redis.exceptions import RedisError

from querycad_api.dependencies import Services, ServicesDep, WaitDep
from querycad_api.problems import ModelNotFound, ServiceUnavailable, responses
from querycad_contracts import AnswerRecord, Job, ModelId, QuestionRequest, QuestionTask

router = APIRouter(prefix="/v1/models/{model_id}/questions", tags=["questions"])


@router.post(
    "",
    response_model=None,
    status_code=202,
    responses={
        **responses(ModelNotFound, ServiceUnavailable),
        200: {
            "description": "The answer, or why there is none; the same as `querycad ask --json` prints.",
            "model": AnswerRecord,
        },
        202: {"description": "The question was accepted; the job at `Location` will hold the answer.", "model": Job},
    },
)
async def ask(model_id: ModelId, asked: QuestionRequest, services: ServicesDep, wait_s: WaitDep) -> Response:
    """Asks a question about a model. With `Prefer: wait=N` the answer comes at once if it is there within N seconds."""
    await services.model(model_id)
    task = QuestionTask(model=model_id, job=uuid4().hex, question=asked.question, unit=asked.unit)
    accepted = await services.state.add_job(task)
    try:
        await services.broker.question(task)
    except ServiceUnavailable:
        await services.state.forget_job(task)
        raise
    headers = {"Location": f"/v1/jobs/{task.job}"}
    if wait_s and await _done(services, task.job, wait_s):
        record = await services.state.record(task.job)
        headers["Preference-Applied"] = f"wait={wait_s}"
        return Response(record, 200, headers, media_type="application/json")
    return Response(accepted.model_dump_json(), 202, headers, media_type="application/json")


async def _done(services: Services, job: str, wait_s: int) -> bool:
    """Is the job done in time? A store that goes away meanwhile makes no accepted question a refused one."""
    try:
        return await services.state.done(job, wait_s)
    except RedisError:
        return False
