"""What endpoints are given: state, queues, files, settings, who asks, and the wait that the client prefers.

All are async, though they wait for nothing: FastAPI would hand anything else to a thread.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, cast

from fastapi import Depends, Header, Query, Request

from querycad_contracts import Job, ModelResource, ModelStatus
from querycad_contracts.infrastructure import FileStore

from .accounts.dependencies import CallerDep
from .accounts.schemas import Caller
from .problems import JobNotFound, Malformed, ModelNotFound, ModelNotReady, ModelUnreadable
from .settings import ApiSettings
from .store.broker import Broker
from .store.state import State

_WAIT = re.compile(r"(?:^|[,;\s])wait(?:\s*=\s*(?:\"(\d+)\"|(\d+)(?=[,;\s]|$)))?", re.IGNORECASE)
"""The preference `wait`; without its seconds it is malformed."""


@dataclass(frozen=True, slots=True)
class Application:
    """What all requests share."""

    settings: ApiSettings
    state: State
    broker: Broker
    files: FileStore


@dataclass(frozen=True, slots=True)
class Services(Application):
    """What every endpoint may need, for the one who asks: nothing of another tenant can be reached through it."""

    caller: Caller

    async def model(self, model: str) -> ModelResource:
        """The uploaded model. Raises ModelNotFound."""
        found = await self.state.model(self.caller.tenant, model)
        if found is None:
            raise no_model()
        return found

    async def must_know(self, model: str) -> None:
        """Raises ModelNotFound unless the model was uploaded."""
        if not await self.state.knows_model(self.caller.tenant, model):
            raise no_model()

    async def ready_model(self, model: str) -> ModelResource:
        """The model, whose file has been read. Raises ModelNotFound, ModelNotReady and ModelUnreadable."""
        found = await self.model(model)
        if found.status is ModelStatus.READING:
            raise ModelNotReady("the file is still being read")
        if found.failure is not None:
            raise ModelUnreadable(found.failure.message)
        return found

    async def job(self, job: str) -> Job:
        """The job. Raises JobNotFound."""
        found = await self.state.job(self.caller.tenant, job)
        if found is None:
            raise JobNotFound("there is no job with this id, or it is no longer kept")
        return found


async def services(request: Request, caller: CallerDep) -> Services:
    """The application's services, for the caller."""
    shared = _shared(request)
    return Services(shared.settings, shared.state, shared.broker, shared.files, caller)


def _shared(request: Request) -> Application:
    return cast("Application", request.app.state.application)


def no_model() -> ModelNotFound:
    """What to raise where the model is not known."""
    return ModelNotFound("there is no model with this id; upload its file first")


ServicesDep = Annotated[Services, Depends(services)]


async def preferred_wait_s(
    request: Request,
    prefer: Annotated[
        str | None,
        Header(description="`wait=N`: answer within N seconds (RFC 7240).", examples=["wait=10"]),
    ] = None,
) -> int:
    """How long does the client want to wait, as far as it is granted? 0 when it did not say. Raises Malformed."""
    wanted = _WAIT.search(prefer or "")
    if wanted is None:
        return 0
    seconds = wanted[1] or wanted[2]
    if seconds is None:
        raise Malformed("`Prefer: wait=N` takes whole seconds, such as wait=10")
    return min(int(seconds[:9]), _shared(request).settings.wait_s)


WaitDep = Annotated[int, Depends(preferred_wait_s)]
OffsetDep = Annotated[int, Query(ge=0, le=2**31 - 1, description="How many to pass over.")]
LimitDep = Annotated[int, Query(ge=1, le=1000, description="How many at most.")]


class PartsShown(StrEnum):
    """How the parts that answers rest on are told."""

    IDS = "ids"
    FULL = "full"


PartsShownDep = Annotated[
    PartsShown,
    Query(alias="parts", description="`ids`: only `part_ids` are returned, and `record.parts` is empty."),
]


def shown(job: Job, parts: PartsShown) -> Job:
    """The job with its parts told so."""
    if parts is PartsShown.FULL or job.record is None:
        return job
    return job.model_copy(update={"record": job.record.model_copy(update={"parts": ()})})
