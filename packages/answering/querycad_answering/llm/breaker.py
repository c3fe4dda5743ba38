"""What spares a server: a breaker leaves one alone that does not answer, a gate lets only so many requests through.

Both are of one process. While a breaker is open the parser answers at once; a request at a gate waits for its turn.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from .messages import LlmBusy, LlmError, LlmTooSlow, TimeLimit

MINUTE_S = 60.0


class Breaker:
    """Of one language model, in one process. After `failures` in a row it is open for `pause_s`; then one try decides.

    What counts is that it cannot be reached, is overloaded, or takes too long; a request that it refuses does not.
    """

    def __init__(self, failures: int, pause_s: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._most = failures
        self._pause_s = pause_s
        self._clock = clock
        self._failed = 0
        self._until = 0.0

    def check(self) -> None:
        """Raises LlmBusy while the language model is left alone."""
        left_s = self._until - self._clock()
        if left_s > 0:
            raise LlmBusy(f"the language model failed {self._failed} times in a row and is left alone", left_s)

    def heard(self, error: LlmError | None) -> None:
        """Notes how a conversation ended: with an error, or well."""
        if error is None:
            self._failed = 0
        elif isinstance(error, LlmBusy | LlmTooSlow):
            self._failed += 1
            if self._failed >= self._most:
                self._until = self._clock() + self._pause_s


class Gate:
    """Lets so many requests at once through to one address, and so many in any minute; 0: any number. Thread safe."""

    def __init__(
        self,
        parallel: int,
        per_minute: int,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._free = threading.BoundedSemaphore(parallel)
        self._per_minute = per_minute
        self._clock = clock
        self._sleep = sleep
        self._begun: deque[float] = deque()
        self._lock = threading.Lock()

    @contextmanager
    def passed(self, deadline: TimeLimit) -> Iterator[None]:
        """While the context lasts, one of the places is taken. Raises LlmTooSlow where none is free in time."""
        if not self._free.acquire(timeout=deadline.left_s()):
            deadline.left_s()
            raise LlmTooSlow("too many other requests to the language model are under way")
        try:
            self._wait(deadline)
            yield
        finally:
            self._free.release()

    def _wait(self, deadline: TimeLimit) -> None:
        """Waits until fewer than so many requests were begun in the minute before; this one counts from then on."""
        while self._per_minute:
            with self._lock:
                now = self._clock()
                while self._begun and self._begun[0] <= now - MINUTE_S:
                    self._begun.popleft()
                if len(self._begun) < self._per_minute:
                    self._begun.append(now)
                    return
                left_s = self._begun[0] + MINUTE_S - now
            if left_s >= deadline.left_s():
                raise LlmTooSlow(f"the language model is asked {self._per_minute} times a minute at most")
            self._sleep(left_s)


_GATES: dict[str, Gate] = {}
_GATES_LOCK = threading.Lock()


def gate_of(address: str, parallel: int, per_minute: int) -> Gate:
    """The gate of an address, one for all who ask there from this process."""
    key = f"{address} {parallel} {per_minute}"
    with _GATES_LOCK:
        return _GATES.setdefault(key, Gate(parallel, per_minute))
