"""A circuit breaker: a language model that does not answer is left alone for a while; the parser answers at once."""

from __future__ import annotations

import time
from collections.abc import Callable

from .messages import LlmBusy, LlmError, LlmTooSlow


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
