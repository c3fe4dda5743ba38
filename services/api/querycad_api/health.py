"""`/livez` and `/readyz`: does the process answer; is everything there that questions need?"""

from __future__ import annotations

import httpx
from fastapi import APIRouter, Request, Response
from redis.exceptions import RedisError

from querycad_contracts import Health, Queue, alive_key

from .dependencies import Application

SANDBOX_S = 2.0

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
    try:
        alive = await application.state.alive(*(alive_key(queue) for queue in Queue))
        checks = {"store": True} | {queue.value: there for queue, there in zip(Queue, alive, strict=True)}
    except (RedisError, OSError):
        checks = {"store": False} | {queue.value: False for queue in Queue}
    client: httpx.AsyncClient = request.app.state.sandbox
    try:
        checks["sandbox"] = (await client.get("/readyz", timeout=SANDBOX_S)).is_success
    except httpx.HTTPError:
        checks["sandbox"] = False
    health = Health(ready=all(checks.values()), checks=checks)
    response.status_code = 200 if health.ready else 503
    return health
