"""`/v1/models`: upload files, see what they hold, delete them."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, File, Request, Response, UploadFile

from querycad_api.dependencies import LimitDep, OffsetDep, ServicesDep, WaitDep
from querycad_api.links import link_next
from querycad_api.problems import (
    DiskFull,
    FileTooLarge,
    Malformed,
    ModelNotFound,
    NotStepFile,
    QuotaReached,
    ServiceUnavailable,
    TooSlow,
    WrongMediaType,
    responses,
)
from querycad_contracts import ModelId, ModelResource, ModelsPage, ModelStatus

from .service import add, delete

router = APIRouter(prefix="/v1/models", tags=["models"])
FORM: Any = {"max_files": 2, "max_fields": 2, "max_part_size": 1024}
"""Of an upload: one file. The second of each lets a client be told what is wrong."""


@router.post(
    "",
    status_code=202,
    response_model=ModelResource,
    form_limits=FORM,
    responses={
        **responses(Malformed, ModelNotFound, TooSlow, FileTooLarge, NotStepFile, WrongMediaType),
        **responses(QuotaReached, DiskFull, ServiceUnavailable),
        200: {"description": "The file was there already; it has been read.", "model": ModelResource},
        201: {"description": "The file has been read within the wait that was preferred.", "model": ModelResource},
        202: {"description": "The file was accepted and is being read.", "model": ModelResource},
    },
)
async def upload_model(
    file: Annotated[
        UploadFile,
        File(description="STEP (ISO 10303-21), IGES, BREP, STL, OBJ or 3MF, or one of them zipped."),
    ],
    services: ServicesDep,
    wait_s: WaitDep,
    request: Request,
    response: Response,
) -> ModelResource:
    """Uploads a model. The same file twice is one model, so that the request may be repeated."""
    if len((await request.form()).getlist("file")) > 1:
        raise Malformed("send one file a request: of several, all but one would be lost")
    model_id, new = await add(services, file.file, file.filename)
    if wait_s and await services.state.model_done(services.caller.tenant, model_id, wait_s):
        response.headers["Preference-Applied"] = f"wait={wait_s}"
    found = await services.model(model_id)
    read = found.status is not ModelStatus.READING
    response.status_code = 202 if not read else 201 if new else 200
    response.headers["Location"] = f"/v1/models/{model_id}"
    return found


@router.get("", response_model=ModelsPage, responses=responses(ServiceUnavailable))
async def list_models(
    services: ServicesDep, request: Request, response: Response, offset: OffsetDep = 0, limit: LimitDep = 100
) -> ModelsPage:
    """Which models are there? The newest first; `Link` tells the next page."""
    page = await services.state.models(services.caller.tenant, offset, limit)
    link_next(request, response, offset, limit, page.total)
    return page


@router.get("/{model_id}", response_model=ModelResource, responses=responses(ModelNotFound, ServiceUnavailable))
async def get_model(model_id: ModelId, services: ServicesDep, wait_s: WaitDep) -> ModelResource:
    """What is known of the model? With `Prefer: wait=N`, after its file has been read."""
    found = await services.model(model_id)
    reading = found.status is ModelStatus.READING
    if wait_s and reading and await services.state.model_done(services.caller.tenant, model_id, wait_s):
        found = await services.model(model_id)
    if found.status is ModelStatus.READING:
        stage, ahead = await services.state.progress(model_id)
        found = found.model_copy(update={"stage": stage, "ahead": ahead})
    return found


@router.delete(
    "/{model_id}", status_code=204, response_model=None, responses=responses(ModelNotFound, ServiceUnavailable)
)
async def delete_model(model_id: ModelId, services: ServicesDep) -> None:
    """Deletes the model with its file, questions and answers; questions that are under way end as cancelled."""
    await services.must_know(model_id)
    await delete(services, services.caller.tenant, model_id)
