"""`/v1/models/{id}/parameters`: named, typed values of a model for a program, all at once."""

from __future__ import annotations

from fastapi import APIRouter

from querycad_api.dependencies import ServicesDep
from querycad_api.problems import BODY_PROBLEMS
from querycad_contracts import ModelId, ParameterSet, ParametersRequest, ParametersTask, TaskName, TaskOutcome

from .service import called

FILL_S = 120.0
"""64 parameters of several questions each, some ten milliseconds a question; language models take longer."""
_SET = TaskOutcome[ParameterSet]

router = APIRouter(prefix="/v1/models/{model_id}", tags=["parameters"])


@router.post("/parameters", response_model=ParameterSet, responses=BODY_PROBLEMS)
async def fill(model_id: ModelId, asked: ParametersRequest, services: ServicesDep) -> ParameterSet:
    """Fills parameters, each with its confidence and what it rests on. What is not sure has a reason in its place."""
    model = await services.ready_model(model_id)
    if asked.other is not None:
        await services.ready_model(asked.other)
    assert model.summary is not None
    task = ParametersTask(model=model_id, asked=asked, summary=model.summary)
    return await called(services, TaskName.PARAMETERS, task, _SET, FILL_S)
