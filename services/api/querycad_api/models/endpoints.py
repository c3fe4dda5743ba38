"""`/v1/models`: upload a file, see what it holds."""

from __future__ import annotations

import asyncio
from datetime import UTC, datetime
from typing import Annotated

from fastapi import APIRouter, File, Query, Response, UploadFile
from pydantic import TypeAdapter

from querycad_api.dependencies import Services, ServicesDep, WaitDep
from querycad_api.problems import (
    FileTooLarge,
    ModelNotFound,
    ModelNotReady,
    ModelUnreadable,
    NotStepFile,
    ServiceUnavailable,
    responses,
)
from querycad_contracts import (
    IngestTask,
    ModelId,
    ModelResource,
    ModelStatus,
    PartsPage,
    PartsTask,
    TaskFailureKind,
    TaskName,
    TaskOutcome,
)

from .files import keep_upload, shown_name

PARTS_S = 20.0
_PARTS = TypeAdapter(TaskOutcome[PartsPage])

router = APIRouter(prefix="/v1/models", tags=["models"])


@router.post(
    "",
    status_code=202,
    response_model=ModelResource,
    responses={
        **responses(FileTooLarge, NotStepFile, ServiceUnavailable),
        200: {"description": "The file was there already; it has been read.", "model": ModelResource},
        201: {"description": "The file has been read within the wait that was preferred.", "model": ModelResource},
        202: {"description": "The file was accepted and is being read.", "model": ModelResource},
    },
)
async def upload_model(
    file: Annotated[UploadFile, File(description="A STEP file (ISO 10303-21).")],
    services: ServicesDep,
    wait_s: WaitDep,
    response: Response,
) -> ModelResource:
    """Uploads a model. The same file twice is one model."""
    max_bytes = services.settings.upload_mib * 2**20
    sha256, size = await asyncio.to_thread(keep_upload, file.file, services.settings, max_bytes)
    resource = ModelResource(
        id=sha256,
        file_name=shown_name(file.filename),
        size_bytes=size,
        created=datetime.now(UTC),
        status=ModelStatus.READING,
    )
    new = await services.state.add_model(resource)
    known = resource if new else await services.model(sha256)
    if new or known.status is ModelStatus.FAILED:  # what failed may have been the machine
        await _read(services, known, new)
    if wait_s and await services.state.done(sha256, wait_s):
        response.headers["Preference-Applied"] = f"wait={wait_s}"
    found = await services.model(sha256)
    read = found.status is not ModelStatus.READING
    response.status_code = 202 if not read else 201 if new else 200
    response.headers["Location"] = f"/v1/models/{sha256}"
    return found


@router.get("/{model_id}", response_model=ModelResource, responses=responses(ModelNotFound, ServiceUnavailable))
async def get_model(model_id: ModelId, services: ServicesDep, wait_s: WaitDep) -> ModelResource:
    """What is known of the model? With `Prefer: wait=N`, after its file has been read."""
    found = await services.model(model_id)
    if wait_s and found.status is ModelStatus.READING and await services.state.done(model_id, wait_s):
        found = await services.model(model_id)
    return found


@router.get(
    "/{model_id}/parts",
    response_model=PartsPage,
    responses=responses(ModelNotFound, ModelNotReady, ModelUnreadable, ServiceUnavailable),
)
async def list_parts(
    model_id: ModelId,
    services: ServicesDep,
    kind: Annotated[str | None, Query(description="Only this kind: 'hole', 'boss' …", max_length=100)] = None,
    offset: Annotated[int, Query(ge=0, le=2**31 - 1)] = 0,
    limit: Annotated[int, Query(ge=1, le=1000)] = 100,
) -> PartsPage:
    """Which parts were recognised in the model?"""
    found = await services.model(model_id)
    if found.status is ModelStatus.READING:
        raise ModelNotReady("the file is still being read")
    if found.failure is not None:
        raise ModelUnreadable(found.failure.message)
    task = PartsTask(model=model_id, kind=kind, offset=offset, limit=limit)
    outcome = _PARTS.validate_python(await services.broker.call(TaskName.PARTS, task, PARTS_S))
    if outcome.failure is not None and outcome.failure.kind is TaskFailureKind.FILE:
        raise ModelUnreadable(outcome.failure.message)
    if outcome.value is None:
        raise ServiceUnavailable("the segworker could not list the parts")
    return outcome.value


async def _read(services: Services, resource: ModelResource, new: bool) -> None:
    if not new:
        await services.state.forget_outcome(resource.id)
    try:
        await services.broker.ingest(IngestTask(model=resource.id, file_name=resource.file_name))
    except ServiceUnavailable:
        await services.state.forget_model(resource.id)
        raise
