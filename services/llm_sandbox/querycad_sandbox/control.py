"""What whoever starts a run can do with it from outside: hear what it does, cancel it, bound how long it waits.

It is also how a call to the segworker says that it will take long, so that the run gives its interpreter to another.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock
from time import monotonic

from querycad_contracts import GuestAnswer, GuestCall, Printed, RunLimits, RunStatus

Heard = GuestCall | GuestAnswer | Printed
CANCELLED = "the run was cancelled"


class RunEndedError(Exception):
    """The run is over, whatever the program would do next."""

    def __init__(self, status: RunStatus, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.message = message


class RunControl:
    """Of one run. `cancel` may be called from any thread, at any time; all else is the run's own thread's."""

    def __init__(self, hear: Callable[[Heard], None] | None = None) -> None:
        self._hear = hear
        self._lock = Lock()
        self._stops: list[Callable[[], None]] = []
        self._cancelled = False
        self._ends = float("inf")
        self._segworker_s = float("inf")
        self._asked: float | None = None
        self.release: Callable[[], None] = _nothing
        """What gives the interpreter back while the segworker is waited for; set by the run."""

    def begin(self, limits: RunLimits) -> None:
        """Starts the clock of the run."""
        self._ends = monotonic() + limits.wall_s
        self._segworker_s = limits.segcad_s

    @property
    def is_heard(self) -> bool:
        """Does anybody listen?"""
        return self._hear is not None

    @property
    def cancelled(self) -> bool:
        """Was the run cancelled?"""
        return self._cancelled

    def cancel(self) -> None:
        """Ends the run wherever it is; of no effect on one that has ended."""
        with self._lock:
            self._cancelled = True
            stops = list(self._stops)
        for stop in stops:
            stop()

    @contextmanager
    def stopped_by(self, stop: Callable[[], None]) -> Iterator[None]:
        """While the context lasts, a cancellation calls `stop`, in the thread that cancels.

        Raises RunEndedError when the run is cancelled already.
        """
        with self._lock:
            self.check()
            self._stops.append(stop)
        try:
            yield
        finally:
            with self._lock:
                self._stops.remove(stop)

    @contextmanager
    def in_segworker(self) -> Iterator[None]:
        """While the context lasts, the time counts as the segworker's."""
        self._asked = monotonic()
        try:
            yield
        finally:
            self._segworker_s -= monotonic() - self._asked
            self._asked = None

    def left_s(self) -> float:
        """How long may be waited now, in seconds? 0 or less when the time is up."""
        now = monotonic()
        return min(self._ends - now, self._segworker_s - (now - self._asked) if self._asked else float("inf"))

    def check(self) -> None:
        """Raises RunEndedError when the run is cancelled or has no time left."""
        if self._cancelled:
            raise RunEndedError(RunStatus.CANCELLED, CANCELLED)
        if monotonic() >= self._ends:
            raise RunEndedError(RunStatus.TIMED_OUT, "the run took longer than it may in all")
        if self._segworker_s <= 0 or (self._asked and self.left_s() <= 0):
            raise RunEndedError(RunStatus.TIMED_OUT, "the segworker took longer than it may for one run")

    def tell(self, event: Heard) -> None:
        """Tells whoever listens."""
        if self._hear is not None:
            self._hear(event)


def _nothing() -> None:
    """A run that holds no interpreter has none to give back."""
