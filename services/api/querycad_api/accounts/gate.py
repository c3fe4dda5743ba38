"""Lets requests in before their bodies are read: who is not known costs neither memory nor disk."""

from __future__ import annotations

import logging
from typing import cast

from redis.exceptions import RedisError
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Send
from starlette.types import Scope as Request

from querycad_api.problems import ApiProblem, ServiceUnavailable, problem_response

from .schemas import Caller, Scope
from .service import Access

GUARDED = "/v1/"
"""Where the paths begin that callers use."""

log = logging.getLogger(__name__)


class Gate:
    """ASGI middleware: the caller of a guarded path is known, or the request is refused by its head."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Request, receive: Receive, send: Send) -> None:
        """Keeps the caller in the request's state, where `dependencies.caller` finds it."""
        if scope["type"] == "http" and scope["path"].startswith(GUARDED):
            access = cast("Access", scope["app"].state.access)
            headers = Headers(scope=scope)
            try:
                scope.setdefault("state", {})["caller"] = await admitted(access, headers, Scope.ASK)
            except ApiProblem as error:
                await problem_response(error.problem(), error.headers)(scope, receive, send)
                return
            except (RedisError, OSError) as error:
                log.warning("cannot identify the caller: %s", error)
                problem = ServiceUnavailable("the store cannot be reached; try again in a moment").problem()
                await problem_response(problem)(scope, receive, send)
                return
        await self._app(scope, receive, send)


async def admitted(access: Access, headers: Headers, scope: Scope) -> Caller:
    """Who asks, by the headers? Raises NotAuthenticated, NotAllowed or TooManyRequests."""
    kind, _, presented = headers.get("authorization", "").partition(" ")
    return await access.caller(presented.strip() if kind.lower() == "bearer" else None, headers, scope)
