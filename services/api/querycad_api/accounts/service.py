"""Who asks? The API key that comes with a request, the tenant it stands for, and how much it may do.

Without API keys, on loopback, everybody on this machine is the one tenant `local`. Pages of other sites, which a
browser on this machine may show, are no such body: their requests are refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from urllib.parse import SplitResult, urlsplit

from limits import RateLimitItem, parse
from limits.aio.storage import RedisStorage
from limits.aio.strategies import SlidingWindowCounterRateLimiter
from redis.asyncio import Redis

from querycad_api.problems import NotAllowed, NotAuthenticated, TooManyRequests
from querycad_api.settings import ApiSettings
from querycad_contracts import NO_ACCOUNTS

from .keys import KeyRing
from .schemas import Caller, Scope

LOOPBACK_NAMES = ("127.0.0.1", "localhost", "::1")


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
