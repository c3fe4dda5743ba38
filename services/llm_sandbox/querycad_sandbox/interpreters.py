"""The interpreter's processes: how many there are, what shuts them in, and who has one now."""

from __future__ import annotations

import os
import signal
from contextlib import suppress
from threading import BoundedSemaphore, Lock
from typing import Final, Self

from pydantic_monty import Monty, MontySession, OSPolicy, ResourceLimits

from .control import RunControl

GRACE_S: Final = 1.0
"""How much longer than its time limit a program may take before its process is killed: the interpreter looks at the
clock only between operations, and not at all while it compiles."""
RUNS_PER_PROCESS: Final = 1000
"""A fresh process bounds what could pile up in one; starting it takes some 30 ms."""
LOOK_S: Final = 0.1
"""Between two looks at whether a run that waits for an interpreter is still wanted."""


class Interpreters:
    """A pool of `processes` interpreters, started when first needed; thread safe."""

    def __init__(self, processes: int, binary: str | None) -> None:
        self._pool = Monty(
            binary_path=binary,
            min_processes=1,
            max_processes=processes,
            max_checkouts_per_worker=RUNS_PER_PROCESS,
            feed_duration_limit_grace=GRACE_S,
        )
        self._free = BoundedSemaphore(processes)

    def start(self) -> None:
        """Starts the first process."""
        self._pool.__enter__()

    def close(self) -> None:
        """Ends the processes."""
        self._pool.__exit__(None, None, None)

    def lease(self, script: str, limits: ResourceLimits, policy: OSPolicy, control: RunControl) -> Lease:
        """A fresh session for one program, in a process that no other program has meanwhile."""
        return Lease(self._pool, self._free, (script, limits, policy), control)


class Lease:
    """A session for one program, as a context manager. It may be given back in between and taken again, empty.

    A cancelled run's process is killed. Raises RunEndedError when the run is over before a process is free.
    """

    def __init__(
        self,
        pool: Monty,
        free: BoundedSemaphore,
        options: tuple[str, ResourceLimits, OSPolicy],
        control: RunControl,
    ) -> None:
        self._pool = pool
        self._free = free
        self._options = options
        self._control = control
        self._session: MontySession | None = None
        self._pid: int | None = None
        self._lock = Lock()
        """Held while `_pid` is used or changed: a process given back is another run's."""

    def __enter__(self) -> Self:
        self.take()
        return self

    def __exit__(self, *_: object) -> None:
        self.give_back()

    @property
    def session(self) -> MontySession:
        """The session that the program runs in."""
        assert self._session is not None
        return self._session

    def take(self) -> None:
        """Waits for a free process and opens a session there."""
        while not self._free.acquire(timeout=LOOK_S):
            self._control.check()
        script, limits, policy = self._options
        try:
            self._control.check()
            session = self._pool.checkout(script_name=script, limits=limits, os_policy=policy)
            session.__enter__()
        except BaseException:
            self._free.release()
            raise
        with self._lock:
            self._session, self._pid = session, session.worker_pid
        try:
            self._control.check()  # a run cancelled meanwhile had no process to kill
        except BaseException:
            self.give_back()
            raise

    def give_back(self) -> None:
        """Closes the session; its process is free for another program."""
        with self._lock:
            session, self._session, self._pid = self._session, None, None
        if session is not None:
            try:
                session.__exit__(None, None, None)
            finally:
                self._free.release()

    def kill(self) -> None:
        """Kills the process, if there is one now."""
        with self._lock, suppress(ProcessLookupError):
            if self._pid is not None:
                os.kill(self._pid, signal.SIGKILL)
