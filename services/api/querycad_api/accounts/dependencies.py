"""Who asks? What endpoints that are for callers, or for operators, depend on."""

from __future__ import annotations

from typing import Annotated, cast

from fastapi import Depends, Request
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer

from .schemas import Caller, Scope
from .service import Access

_bearer = HTTPBearer(
    auto_error=False, scheme_name="ApiKey", description="An API key. Not asked for where the service is on loopback."
)

Credentials = Annotated[HTTPAuthorizationCredentials | None, Depends(_bearer)]


async def caller(request: Request, credentials: Credentials) -> Caller:
    """Who asks about models?"""
    return await _admit(request, credentials, Scope.ASK)


async def operator(request: Request, credentials: Credentials) -> Caller:
    """Who reads the metrics?"""
    return await _admit(request, credentials, Scope.METRICS)


async def _admit(request: Request, credentials: HTTPAuthorizationCredentials | None, scope: Scope) -> Caller:
    access = cast("Access", request.app.state.access)
    presented = credentials.credentials if credentials is not None else None
    return await access.caller(presented, request.headers, scope)


CallerDep = Annotated[Caller, Depends(caller)]
OperatorDep = Annotated[Caller, Depends(operator)]
