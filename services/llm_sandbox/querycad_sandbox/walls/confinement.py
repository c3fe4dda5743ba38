"""The walls around the interpreter's processes: what is left to a program that finds a flaw in the interpreter.

A process of the interpreter needs memory, its standard input and output, and nothing else. Before it starts, by
`querycad_contracts.infrastructure.walls`: another user (where this one is root), resource limits, no new privileges,
Landlock (it may open the files that it consists of, and no other; no TCP; no signals to others), seccomp (it may make
the calls of `CALLS`), and an empty environment. Which of these the kernel has is found out by trying: `layers`.
"""

from __future__ import annotations

import logging
import os
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Self

from pydantic_monty._binary import find_monty_binary

from querycad_contracts.infrastructure import walls

PROBE_S: Final = 10.0
NOBODY: Final = 65534
MEMORY_BYTES: Final = 1536 * 2**20
"""Address space of a process: three times the largest heap that a run may have, for what the heap does not count."""
LIMITS: Final = {"RLIMIT_AS": MEMORY_BYTES, "RLIMIT_CORE": 0, "RLIMIT_FSIZE": 0, "RLIMIT_NOFILE": 64}
"""No limit on CPU time: a process does many runs, each of which is timed, and is killed by the pool."""
CALLS: Final = (*walls.COMPUTING, "execve", "execveat")
"""What the interpreter was seen to call, what the C library does in their stead on other machines, and its own start:
what a process becomes stays as shut in as it is. There is no list to take over: those of container engines keep general
programs running, sockets and processes included."""
MFD_EXEC: Final = 0x10

log = logging.getLogger(__name__)


@dataclass(slots=True)
class Confinement:
    """How processes are shut in. `binary` is what the pool starts: a file in memory that shuts itself in first."""

    layers: dict[str, bool]
    """Which walls hold, by name; one that is down is in `missing`."""
    binary: str | None
    _files: tuple[int, ...]

    @classmethod
    def strongest(cls) -> Self:
        """All walls that this machine has: of Landlock and seccomp, those under which the interpreter still starts."""
        if sys.platform != "linux":
            return cls(_layers(), None, ())
        for landlock, seccomp in ((True, True), (True, False), (False, True), (False, False)):
            try:
                made = cls._made(landlock=landlock, seccomp=seccomp)
            except (OSError, ImportError, ValueError) as error:
                log.warning("the interpreter cannot be shut in (landlock %s, seccomp %s): %s", landlock, seccomp, error)
                continue
            if made._starts():
                return made
            made.close()
            log.warning("the interpreter does not start with landlock %s, seccomp %s", landlock, seccomp)
        return cls(_layers(), None, ())

    @classmethod
    def _made(cls, *, landlock: bool, seccomp: bool) -> Self:
        monty = interpreter()
        python = os.open(sys.executable, os.O_RDONLY | os.O_CLOEXEC)
        user = NOBODY if os.geteuid() == 0 else None
        ruleset: int | None = None
        try:
            ruleset = landlock_ruleset(monty) if landlock else None
            program = seccomp_program() if seccomp else None
            call = f"launch({monty!r}, {LIMITS!r}, {user!r}, {ruleset!r}, {program!r})"
            source = Path(walls.__file__).read_text(encoding="utf-8")
            # the kernel takes no path with a space, and none over some 250 letters, from a script's first line
            script = _executable(f"#!/proc/{os.getpid()}/fd/{python} -IS\n{source}\n{call}\n")
        except BaseException:
            _close(ruleset)
            _close(python)
            raise
        raised = {"landlock": landlock, "seccomp": seccomp, "unprivileged_user": user is not None or os.getuid() != 0}
        opened = tuple(each for each in (script, ruleset, python) if each is not None)
        return cls(_layers(resource_limits=True, **raised), f"/proc/{os.getpid()}/fd/{script}", opened)

    @property
    def missing(self) -> tuple[str, ...]:
        """The walls that are not up."""
        return tuple(name for name, holds in self.layers.items() if not holds)

    def close(self) -> None:
        """Closes what the processes were started from; no more can be started."""
        for each in self._files:
            _close(each)
        self._files = ()

    def _starts(self) -> bool:
        """Does the interpreter start, and run a program?"""
        assert self.binary is not None
        try:
            done = subprocess.run(
                [self.binary, "-c", "print(sum(range(10)))"],
                capture_output=True,
                timeout=PROBE_S,
                check=False,
                close_fds=False,
            )
        except (OSError, subprocess.TimeoutExpired):
            return False
        return done.returncode == 0 and done.stdout.strip() == b"45"


def interpreter() -> str:
    """Where is the interpreter's executable file?"""
    return str(Path(find_monty_binary()).resolve())


def _layers(
    *, resource_limits: bool = False, landlock: bool = False, seccomp: bool = False, unprivileged_user: bool = False
) -> dict[str, bool]:
    """Which walls hold, by name."""
    return {
        "own_process": True,
        "empty_environment": resource_limits,
        "resource_limits": resource_limits,
        "no_new_privileges": resource_limits,
        "unprivileged_user": unprivileged_user,
        "landlock": landlock,
        "seccomp": seccomp,
    }


def landlock_ruleset(monty: str) -> int:
    """A Landlock ruleset, as a file descriptor that processes inherit. Raises OSError where there is none."""
    inherited = walls.landlock_ruleset([], [monty, *_libraries(monty)], [])
    os.set_inheritable(inherited, True)
    return inherited


def _libraries(monty: str) -> Iterable[str]:
    """The files that the interpreter consists of, as its loader tells them, and the loader's own index."""
    listed = subprocess.run(
        [monty],
        env={"LD_TRACE_LOADED_OBJECTS": "1"},
        capture_output=True,
        text=True,
        timeout=PROBE_S,
        check=True,
        stdin=subprocess.DEVNULL,
    )
    words = (word for line in listed.stdout.splitlines() for word in line.split())
    found = [word for word in words if word.startswith("/") and Path(word).is_file()]
    if not found:
        raise OSError("the interpreter's libraries are not known")
    index = Path("/etc/ld.so.cache")
    return [*found, str(index)] if index.exists() else found


def seccomp_program() -> bytes:
    """A seccomp program that lets through `CALLS`. Raises OSError where there is no seccomp."""
    return walls.seccomp_program(CALLS)


def _executable(text: str) -> int:
    """A file in memory that can be started, as a file descriptor."""
    try:
        made = os.memfd_create("querycad-launcher", os.MFD_CLOEXEC | MFD_EXEC)
    except OSError:  # a kernel that does not know MFD_EXEC
        made = os.memfd_create("querycad-launcher", os.MFD_CLOEXEC)
    with os.fdopen(os.dup(made), "w", encoding="utf-8") as file:
        file.write(text)
    os.fchmod(made, 0o500)
    return made


def _close(descriptor: int | None) -> None:
    if descriptor is not None:
        os.close(descriptor)
