"""Who asks? What endpoints that are for callers, or for operators, depend on."""

from __future__ import annotations

from typing import Annotated, cast

from fastapi import Depends, Request
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer

from .gate import admitted
from .schemas import Caller, Scope
from .service import Access

_bearer = HTTPBearer(
    auto_error=False, scheme_name="ApiKey", description="An API key. Not asked for where the service is on loopback."
)

Credentials = Annotated[HTTPAuthorizationCredentials | None, Depends(_bearer)]


async def caller(request: Request, _: Credentials) -> Caller:
    """Who asks about models? `Gate` has found out."""
    return cast("Caller", request.state.caller)


async def operator(request: Request, _: Credentials) -> Caller:
    """Who reads the metrics?"""
    return await admitted(cast("Access", request.app.state.access), request.headers, Scope.METRICS)


CallerDep = Annotated[Caller, Depends(caller)]
OperatorDep = Annotated[Caller, Depends(operator)]
