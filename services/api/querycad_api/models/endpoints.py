"""`/v1/models`: upload files, see what they hold, delete them."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from datetime import UTC, datetime
from typing import Annotated

from fastapi import APIRouter, File, Request, Response, UploadFile

from querycad_api.answered import cancelled
from querycad_api.dependencies import LimitDep, OffsetDep, Services, ServicesDep, WaitDep
from querycad_api.problems import (
    FileTooLarge,
    Malformed,
    ModelNotFound,
    NotStepFile,
    ServiceUnavailable,
    responses,
)
from querycad_contracts import (
    ModelId,
    ModelResource,
    ModelsPage,
    ModelStatus,
    models_name,
    picture_name,
    upload_name,
)

from .files import Received, received, shown_name

router = APIRouter(prefix="/v1/models", tags=["models"])


@router.post(
    "",
    status_code=202,
    response_model=ModelResource,
    responses={
        **responses(Malformed, ModelNotFound, FileTooLarge, NotStepFile, ServiceUnavailable),
        200: {"description": "The file was there already; it has been read.", "model": ModelResource},
        201: {"description": "The file has been read within the wait that was preferred.", "model": ModelResource},
        202: {"description": "The file was accepted and is being read.", "model": ModelResource},
    },
)
async def upload_model(
    file: Annotated[UploadFile, File(description="A STEP file (ISO 10303-21).")],
    services: ServicesDep,
    wait_s: WaitDep,
    request: Request,
    response: Response,
) -> ModelResource:
    """Uploads a model. The same file twice is one model, so that the request may be repeated."""
    if len((await request.form()).getlist("file")) > 1:
        raise Malformed("send one file a request: of several, all but one would be lost")
    tenant = services.caller.tenant
    async with _on_disk(file, services) as upload:
        resource = ModelResource(
            id=upload.sha256,
            file_name=shown_name(file.filename),
            size_bytes=upload.size_bytes,
            created=datetime.now(UTC),
            status=ModelStatus.READING,
        )
        async with services.state.files_of(upload.sha256):
            await asyncio.to_thread(services.files.keep, upload_name(upload.sha256), upload.path)
            new = await services.state.add_model(tenant, resource)
    known = resource if new else await services.model(resource.id)
    if new or known.status is ModelStatus.FAILED:  # what failed may have been the machine
        await _read(services, known, new)
    if wait_s and await services.state.model_done(tenant, resource.id, wait_s):
        response.headers["Preference-Applied"] = f"wait={wait_s}"
    found = await services.model(resource.id)
    read = found.status is not ModelStatus.READING
    response.status_code = 202 if not read else 201 if new else 200
    response.headers["Location"] = f"/v1/models/{resource.id}"
    return found


@router.get("", response_model=ModelsPage, responses=responses(ServiceUnavailable))
async def list_models(services: ServicesDep, offset: OffsetDep = 0, limit: LimitDep = 100) -> ModelsPage:
    """Which models are there? The newest first."""
    return await services.state.models(services.caller.tenant, offset, limit)


@router.get("/{model_id}", response_model=ModelResource, responses=responses(ModelNotFound, ServiceUnavailable))
async def get_model(model_id: ModelId, services: ServicesDep, wait_s: WaitDep) -> ModelResource:
    """What is known of the model? With `Prefer: wait=N`, after its file has been read."""
    found = await services.model(model_id)
    reading = found.status is ModelStatus.READING
    if wait_s and reading and await services.state.model_done(services.caller.tenant, model_id, wait_s):
        found = await services.model(model_id)
    return found


@router.delete(
    "/{model_id}", status_code=204, response_model=None, responses=responses(ModelNotFound, ServiceUnavailable)
)
async def delete_model(model_id: ModelId, services: ServicesDep) -> None:
    """Deletes the model with its file, questions and answers; questions that are under way end as cancelled."""
    await services.must_know(model_id)
    state, tenant = services.state, services.caller.tenant
    tasks = await state.tasks_about(tenant, model_id)
    stopped = [task.job for task in tasks if await state.end_job(task, cancelled(task.question))]
    async with state.files_of(model_id):
        nobodys = await state.forget_model(tenant, model_id)
        await state.forget_jobs(tasks)
        names = [upload_name(model_id), models_name(model_id)] if nobodys else []  # see the segworker's drop_if_deleted
        names += [picture_name(task.job) for task in tasks]
        await asyncio.to_thread(_remove, services, names)
    await services.broker.stop(stopped)


@asynccontextmanager
async def _on_disk(file: UploadFile, services: Services) -> AsyncIterator[Received]:
    """The upload as a file, its hash known; disk work is done in a thread."""
    context = received(file.file, services.files.home, services.settings.upload_mib * 2**20)
    upload = await asyncio.to_thread(context.__enter__)
    try:
        yield upload
    finally:
        await asyncio.to_thread(context.__exit__, None, None, None)


async def _read(services: Services, resource: ModelResource, new: bool) -> None:
    tenant = services.caller.tenant
    if not new:
        await services.state.forget_outcome(tenant, resource.id)
    await services.state.reading(tenant, resource.id)
    try:
        await services.broker.ingest(resource, tenant)
    except ServiceUnavailable:
        await services.state.forget_model(tenant, resource.id)
        raise


def _remove(services: Services, names: list[str]) -> None:
    for name in names:
        services.files.remove(name)
