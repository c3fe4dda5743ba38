"""What is done with models: a file is taken in and read, a model is deleted with all that was made of it."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from datetime import UTC, datetime
from typing import BinaryIO, TypeVar
from uuid import uuid4

from querycad_api.dependencies import Application, Services
from querycad_api.problems import ModelNotReady, QuotaReached, ServiceUnavailable
from querycad_api.store.keyspace import ModelStale
from querycad_api.store.state import TooMuchStored
from querycad_contracts import AnswerRecord, ModelResource, ModelStatus, ModelTask, TaskName, TaskOutcome
from querycad_contracts.infrastructure import FileStore, models_name, picture_name, upload_name

from .uploads import Received, received, shown_name

T = TypeVar("T")


async def add(services: Services, file: BinaryIO, file_name: str | None) -> tuple[str, bool]:
    """The id of the file's model, and whether it is new; what is new is put on the queue to be read.

    Raises FileTooLarge, NotStepFile, QuotaReached, ModelNotFound and ServiceUnavailable.
    """
    tenant = services.caller.tenant
    async with _on_disk(file, services) as upload:
        resource = ModelResource(
            id=upload.sha256,
            file_name=shown_name(file_name),
            size_bytes=upload.size_bytes,
            created=datetime.now(UTC),
            status=ModelStatus.READING,
        )
        async with services.state.files_of(upload.sha256):
            await asyncio.to_thread(services.files.keep, upload_name(upload.sha256), upload.path)
            try:
                new = await services.state.add_model(tenant, resource)
            except TooMuchStored:
                if not await services.state.owned(upload.sha256):
                    await asyncio.to_thread(services.files.remove, upload_name(upload.sha256))
                most = services.settings.tenant_mib
                raise QuotaReached(
                    f"with this file, yours and what is read of them would be more than {most} MiB: delete models first"
                ) from None
    known = resource if new else await services.model(resource.id)
    if new or known.status is ModelStatus.FAILED:  # what failed may have been the machine
        await _read(services, known, new)
    return resource.id, new


async def delete(application: Application, tenant: str, model: str) -> None:
    """Deletes the model with its file, questions and answers.

    Questions that are under way end as cancelled; where the file is being read, that is stopped.
    """
    state = application.state
    tasks = await state.tasks_about(tenant, model)
    stopped = [reader] if (reader := await state.ingest_of(tenant, model)) is not None else []
    stopped += [task.job for task in tasks if await state.end_job(task, AnswerRecord.cancelled(task.question))]
    async with state.files_of(model):
        nobodys = await state.forget_model(tenant, model)
        await state.forget_jobs(tasks)
        names = [upload_name(model), models_name(model)] if nobodys else []  # see the segworker's drop_if_deleted
        names += [picture_name(task.job) for task in tasks]
        await asyncio.to_thread(_remove, application.files, names)
    await application.broker.stop(stopped)


async def called(
    services: Services, name: TaskName, task: ModelTask, value: type[TaskOutcome[T]], timeout_s: float
) -> T:
    """What does a worker say of the model? Raises ModelUnreadable, ServiceUnavailable, and ModelNotReady.

    The last where its file was read by an older version: it is read anew then, by an ingest, while nobody waits.
    """
    try:
        return await services.broker.call(name, task, value, timeout_s)
    except ModelStale:
        await read_again(services, task.model)
        raise ModelNotReady("the file is being read anew; try again in a moment") from None


async def read_again(services: Services, model: str) -> None:
    """Has the file of a model read anew that was read before. Raises ModelNotFound and ServiceUnavailable."""
    known = await services.model(model)
    if known.status is ModelStatus.READY:
        await _read(services, known, new=False)


@asynccontextmanager
async def _on_disk(file: BinaryIO, services: Services) -> AsyncIterator[Received]:
    """The upload as a file, its hash known; disk work is done in a thread."""
    context = received(file, services.files.home, services.settings.upload_mib * 2**20)
    upload = await asyncio.to_thread(context.__enter__)
    try:
        yield upload
    finally:
        await asyncio.to_thread(context.__exit__, None, None, None)


async def _read(services: Services, resource: ModelResource, new: bool) -> None:
    tenant = services.caller.tenant
    if not new:
        await services.state.forget_outcome(tenant, resource.id)
    task = uuid4().hex
    await services.state.reading(tenant, resource.id, task)
    try:
        await services.broker.ingest(resource, tenant, task, anew=new)
    except ServiceUnavailable:
        await services.state.forget_model(tenant, resource.id)
        raise


def _remove(files: FileStore, names: list[str]) -> None:
    for name in names:
        files.remove(name)
