"""Keeps child processes running: starts them, starts them again when they die, and leaves none behind."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from querycad_contracts.infrastructure import end_with_parent

LOG_BYTES = 10 * 2**20
"""A log longer than this is begun anew, and the old one kept beside it, when its process starts."""
STEADY_S = 10.0
"""A child that lived this long is started again at once; one that did not, after a pause that doubles."""
PAUSE_S = 0.5
LONGEST_PAUSE_S = 30.0
GRACE_S = 15.0
"""What a child has to end by itself: a worker finishes the question that it is at."""
POLL_S = 0.05


@dataclass(frozen=True, slots=True)
class Command:
    """One child: how it is started."""

    name: str
    arguments: tuple[str, ...]
    environment: Mapping[str, str]


@dataclass(slots=True)
class _Child:
    command: Command
    log: Path
    process: subprocess.Popen[bytes] | None = None
    started: float = 0.0
    start_at: float = 0.0
    pause_s: float = PAUSE_S


class Supervisor:
    """Runs commands as children, each in a process group of its own. Use it from the main thread, as a context manager.

    A child's output goes to a file of its name in `logs`. `tell` is told, one line each, what happens to the children.
    """

    def __init__(self, logs: Path, tell: Callable[[str], None]) -> None:
        self._logs = logs
        self._tell = tell
        self._children: list[_Child] = []

    def __enter__(self) -> Supervisor:
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    def start(self, command: Command) -> None:
        """Starts one more child."""
        self._logs.mkdir(parents=True, exist_ok=True)
        child = _Child(command, self._logs / f"{command.name}.log")
        self._children.append(child)
        self._spawn(child)

    def pids(self) -> dict[str, int]:
        """The processes that run now, by name."""
        return {each.command.name: each.process.pid for each in self._children if each.process is not None}

    def watch(self) -> None:
        """Starts again what died since the last call; to be called again and again."""
        for child in self._children:
            if child.process is not None and child.process.poll() is not None:
                self._died(child, child.process)
            if child.process is None and time.monotonic() >= child.start_at:
                self._spawn(child)

    def stop(self) -> None:
        """Ends all children: all but the first together, then the first, which the others need to end well."""
        for group in (self._children[1:], self._children[:1]):
            for child in group:
                if child.process is not None:
                    with contextlib.suppress(ProcessLookupError):
                        child.process.terminate()
            deadline = time.monotonic() + GRACE_S
            for child in group:
                self._await_end(child, deadline)
        self._children.clear()

    def _spawn(self, child: _Child) -> None:
        if child.log.exists() and child.log.stat().st_size > LOG_BYTES:
            child.log.replace(child.log.with_suffix(".old.log"))
        with child.log.open("ab") as log:
            child.process = subprocess.Popen(
                child.command.arguments,
                env=dict(child.command.environment),
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,  # Ctrl-C is for the parent alone, which ends the others in order
                preexec_fn=end_with_parent,  # noqa: PLW1509 - there are no threads here
            )
        child.started = time.monotonic()

    def _died(self, child: _Child, process: subprocess.Popen[bytes]) -> None:
        _kill_group(process.pid)
        if time.monotonic() - child.started >= STEADY_S:
            child.pause_s = PAUSE_S
        child.process, child.start_at = None, time.monotonic() + child.pause_s
        self._tell(f"{child.command.name} {_end(process.returncode)}; starting it again (log: {child.log})")
        child.pause_s = min(2 * child.pause_s, LONGEST_PAUSE_S)

    def _await_end(self, child: _Child, deadline: float) -> None:
        process = child.process
        if process is None:
            return
        try:
            process.wait(max(0.0, deadline - time.monotonic()))
        except subprocess.TimeoutExpired:
            self._tell(f"{child.command.name} did not stop within {GRACE_S:.0f} s and was killed")
        _kill_group(process.pid)
        process.wait()
        child.process = None


def python(name: str, module: str, environment: Mapping[str, str]) -> Command:
    """The command that runs a module of this installation."""
    return Command(name, (sys.executable, "-m", module), environment)


def _end(code: int) -> str:
    return f"was killed ({signal.Signals(-code).name})" if code < 0 else f"ended (exit code {code})"


def _kill_group(group: int) -> None:
    """Kills what is left of a child's process group: its own children."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(group, signal.SIGKILL)
