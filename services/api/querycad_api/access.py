"""Who asks? The API key that comes with a request, the tenant it stands for, and how much it may do.

Without API keys, on loopback, everybody on this machine is the one tenant `local`. Pages of other sites, which a
browser on this machine may show, are no such body: their requests are refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, cast
from urllib.parse import SplitResult, urlsplit

from fastapi import Depends, Request
from fastapi.security import HTTPAuthorizationCredentials, HTTPBearer
from limits import RateLimitItem, parse
from limits.aio.storage import RedisStorage
from limits.aio.strategies import SlidingWindowCounterRateLimiter
from redis.asyncio import Redis

from querycad_contracts import NO_ACCOUNTS

from .keys import KeyRing, Scope
from .problems import NotAllowed, NotAuthenticated, TooManyRequests
from .settings import ApiSettings

LOOPBACK_NAMES = ("127.0.0.1", "localhost", "::1")

_bearer = HTTPBearer(
    auto_error=False, scheme_name="ApiKey", description="An API key. Not asked for where the service is on loopback."
)


@dataclass(frozen=True, slots=True)
class Caller:
    """Whose models are meant, and by which key; its id is empty where there are none."""

    tenant: str
    key: str = ""


class Access:
    """Lets requests in, or raises NotAuthenticated, NotAllowed or TooManyRequests."""

    def __init__(self, settings: ApiSettings, redis: Redis) -> None:
        self._ring = KeyRing(settings.keys) if settings.asks_for_keys else None
        self._origins = settings.origins
        self._rate: RateLimitItem = parse(settings.key_rate)
        storage = RedisStorage(
            f"async+{settings.redis_url}",
            implementation="redispy",
            key_prefix="querycad:rate",
            connection_pool=redis.connection_pool,  # type: ignore[arg-type]  # its annotation leaves out what it takes
        )
        self._limiter = SlidingWindowCounterRateLimiter(storage)

    async def caller(self, presented: str | None, headers: Mapping[str, str], scope: Scope) -> Caller:
        """Who asks?"""
        if self._ring is None:
            self._same_site(headers)
            return Caller(NO_ACCOUNTS)
        key = self._ring.find(presented or "")
        if key is None:
            raise NotAuthenticated("send a valid API key: `Authorization: Bearer qc_…`")
        if key.scope is not scope:
            raise NotAllowed(f"this API key is for {key.scope.value}, not for {scope.value}")
        if not await self._limiter.hit(self._rate, key.id):
            raise TooManyRequests(f"at most {self._rate} for one API key")
        return Caller(key.tenant, key.id)

    def _same_site(self, headers: Mapping[str, str]) -> None:
        """Without keys, what a browser sends for another site's page must not pass for its user's wish.

        The `Host` is checked too: another site's name may be made to lead to this machine (DNS rebinding).
        """
        host = headers.get("host", "")
        origin = headers.get("origin")
        if _address(f"//{host}").hostname not in LOOPBACK_NAMES:
            raise NotAllowed("without API keys, the service is only reached by the name of this machine's loopback")
        if origin is not None and origin not in self._origins and _address(origin).netloc != host:
            raise NotAllowed(f"pages of {origin} may not use this service")


def _address(text: str) -> SplitResult:
    """The parts of a URL; all are empty where it is none."""
    try:
        return urlsplit(text)
    except ValueError:
        return urlsplit("")


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
