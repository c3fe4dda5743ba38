"""`/livez` and `/readyz`: does the process answer; is everything there that questions need?"""

from __future__ import annotations

import asyncio

import httpx
from fastapi import APIRouter, Request, Response
from redis.exceptions import RedisError

from querycad_api.dependencies import Application
from querycad_contracts import Health, Queue, alive_key

SANDBOX_S = 2.0
STORE_S = 2.0
"""A store that hangs is not there: it may have a connection open and say nothing."""

router = APIRouter(tags=["health"])


@router.get("/livez", response_model=Health)
async def livez() -> Health:
    """Does the process answer?"""
    return Health(ready=True)


@router.get(
    "/readyz",
    response_model=Health,
    responses={503: {"description": "Something is missing; `checks` says what.", "model": Health}},
)
async def readyz(request: Request, response: Response) -> Health:
    """Can questions be answered now? Store, sandbox, and a worker on each queue."""
    application: Application = request.app.state.application
    store, sandbox = await asyncio.gather(_store(application), _sandbox(request.app.state.sandbox))
    checks = {name: said is not None for name, said in (store | sandbox).items()}
    missing = {name: tuple(said.split()) for name, said in (store | sandbox).items() if said}
    health = Health(ready=all(checks.values()), checks=checks, walls_missing=missing)
    response.status_code = 200 if health.ready else 503
    return health


async def _store(application: Application) -> dict[str, str | None]:
    """Is the store there, and a worker on each queue? None where not, else which walls it does without."""
    try:
        async with asyncio.timeout(STORE_S):
            alive = await application.state.alive(*(alive_key(queue) for queue in Queue))
    except (RedisError, OSError):
        return dict.fromkeys(("store", *(queue.value for queue in Queue)))
    return {"store": ""} | {queue.value: there for queue, there in zip(Queue, alive, strict=True)}


async def _sandbox(client: httpx.AsyncClient) -> dict[str, str | None]:
    try:
        told = await client.get("/readyz", timeout=SANDBOX_S)
        return {"sandbox": " ".join(told.json().get("missing", ())) if told.is_success else None}
    except (httpx.HTTPError, ValueError, AttributeError):
        return {"sandbox": None}
