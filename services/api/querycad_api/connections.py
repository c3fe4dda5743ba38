"""Connections before anyone is known: how many, how long their heads may be, and how long they may take."""

from __future__ import annotations

import asyncio
import resource
from typing import Any, ClassVar

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle

HEAD_BYTES = 32 * 1024
"""Request line and headers; browsers send some 2 KiB."""
HEAD_S = 10.0
"""In which the head of a request must have come."""
LINGER_S = 5.0
"""In which the rest of a body must come that was answered before its end; then the connection goes on."""
KEEP_S = 20
"""How long a connection may be idle: longer than clients keep one (httpx 5 s, aiohttp 15 s), so that none sends a
request just as it is closed."""
SPARE_FILES = 256
"""Open files that are left to the store, uploads and libraries."""

_BUSY = (
    b"HTTP/1.1 503 Service Unavailable\r\ncontent-type: text/plain\r\nretry-after: 2\r\nconnection: close\r\n"
    b"content-length: 21\r\n\r\ntoo many connections\n"
)


class Bounded(H11Protocol):
    """HTTP/1.1 for a bounded number of connections; more are asked to retry."""

    most: ClassVar[int]
    most_of_one: ClassVar[int]
    head_s: ClassVar[float] = HEAD_S
    _head_timer: asyncio.TimerHandle | None = None
    _refused = False

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """A connection is taken, or told at once that there are too many."""
        super().connection_made(transport)
        others = [other.client for other in self.connections if isinstance(other, Bounded) and other.client]
        of_one = [client for client in others if self.client is not None and client[0] == self.client[0]]
        if len(self.connections) > self.most or len(of_one) > self.most_of_one:
            self._refused = True
            transport.write(_BUSY)
            transport.close()
            return
        self._await_head()

    def data_received(self, data: bytes) -> None:
        """A head that has begun has its time; a body has that of `BodyLimit`."""
        if self._refused:
            return
        super().data_received(data)
        if self.conn.their_state is h11.IDLE:
            self._await_head()
        else:
            self._has_head()

    def connection_lost(self, exc: Exception | None) -> None:
        """Nothing is waited for any more."""
        self._has_head()
        super().connection_lost(exc)

    def on_response_complete(self) -> None:
        """What was answered before its body had come is passed over, for a while."""
        super().on_response_complete()
        if self.conn.their_state is h11.SEND_BODY and not self.transport.is_closing():
            self._unset_keepalive_if_required()
            self.loop.call_later(LINGER_S, self._end_unread, self.cycle)

    def _end_unread(self, cycle: RequestResponseCycle) -> None:
        """Closes the connection whose body still comes; another request on it has nothing to do with that."""
        if self.cycle is cycle and self.conn.their_state is h11.SEND_BODY:
            self.transport.close()

    def _await_head(self) -> None:
        if self._head_timer is None:
            self._head_timer = self.loop.call_later(self.head_s, self.transport.close)

    def _has_head(self) -> None:
        if self._head_timer is not None:
            self._head_timer.cancel()
            self._head_timer = None


def more_files() -> int:
    """Raises the limit on open files as far as it goes; returns how many connections it leaves room for."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = max(soft, 65536 if hard == resource.RLIM_INFINITY else min(hard, 65536))
    resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
    return max(wanted - SPARE_FILES, 16)


def limits(connections: int, of_one: int, head_s: float = HEAD_S) -> dict[str, Any]:
    """Options of uvicorn that limit what connections cost before anybody is known."""
    most = min(connections, more_files())
    protocol = type("Protocol", (Bounded,), {"most": most, "most_of_one": min(of_one, most), "head_s": head_s})
    return {
        "http": protocol,
        "ws": "none",
        "h11_max_incomplete_event_size": HEAD_BYTES,
        "timeout_keep_alive": KEEP_S,
    }
