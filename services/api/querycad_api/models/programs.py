"""`/v1/models/{id}/programs`: a caller's own program of the guest API, run in the sandbox as every other program is."""

from __future__ import annotations

from http import HTTPStatus

import httpx
from fastapi import APIRouter, Request
from pydantic import ValidationError

from querycad_api.dependencies import ServicesDep
from querycad_api.problems import BODY_PROBLEMS, ModelNotReady, ModelUnreadable, ServiceUnavailable
from querycad_contracts import ModelId, Problem, ProgramRequest, RunLimits, RunOutcome, RunRequest
from querycad_contracts.infrastructure import carried_trace

from .service import read_again

LIMITS = RunLimits(segcad_s=60.0, wall_s=90.0)
"""As of every program; in all less than of a question's, since the caller waits for it."""
SPARE_S = 5.0
"""For the sandbox to say that the time was up."""

router = APIRouter(prefix="/v1/models/{model_id}", tags=["programs"])


@router.post("/programs", response_model=RunOutcome, responses=BODY_PROBLEMS)
async def run_program(
    model_id: ModelId, program: ProgramRequest, services: ServicesDep, request: Request
) -> RunOutcome:
    """Runs a program against the model. However it ended, that is the outcome: an error says it could not be run."""
    await services.ready_model(model_id)
    asked = RunRequest(
        code=program.code, model=model_id, limits=LIMITS, expects=program.expects, grounding=program.grounding
    )
    sandbox: httpx.AsyncClient = request.app.state.sandbox
    headers = {"Content-Type": "application/json", **carried_trace()}
    try:
        answer = await sandbox.post(
            "/runs", content=asked.model_dump_json(), headers=headers, timeout=LIMITS.wall_s + SPARE_S
        )
        if answer.status_code == HTTPStatus.OK:
            return RunOutcome.model_validate_json(answer.content)
        problem = Problem.model_validate_json(answer.content)
    except (httpx.HTTPError, ValidationError) as error:
        raise ServiceUnavailable("the sandbox does not answer; try again in a moment") from error
    if problem.status == HTTPStatus.CONFLICT:
        await read_again(services, model_id)
        raise ModelNotReady("the file is being read anew; try again in a moment")
    if problem.status == HTTPStatus.UNPROCESSABLE_ENTITY:
        raise ModelUnreadable(problem.detail)
    raise ServiceUnavailable(problem.detail or problem.title)
