"""Processes that work with the CAD kernel: their crash is an exit code. They are forked by `kernel_host`.

One host serves this process; it is started when the first is needed, and ends with this process. A file that takes the
kernel over is behind the walls of `querycad_contracts.infrastructure.walls`, as a program that takes its interpreter
over is. Where this process is root, or may do as much, they have a user of their own, who reads what was opened for
him before.
"""

from __future__ import annotations

import atexit
import contextlib
import itertools
import json
import logging
import os
import signal
import site
import socket
import stat
import subprocess
import sys
import tempfile
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import TracebackType
from typing import Final, Self

import querycad_contracts
from querycad_contracts.infrastructure import Walls, WallSettings, WallsMissing, walls

ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""NumPy's linear algebra starts threads when it is imported. They do not come along in a fork; and waiting for one
another over arrays as small as ours, two of them use 1.4 times the processor time of one."""

KEPT = frozenset(("PATH", "HOME", "LANG", "TZ", "VIRTUAL_ENV", "TMPDIR", "USER", "LOGNAME", "XDG_CACHE_HOME"))
KEPT_STARTS = ("PYTHON", "LC_", "LD_", "CSF_", "COVERAGE_")
"""Variables of Python, of the system and of the kernel (CSF_: Open CASCADE's resources)."""

LINE_BYTES: Final = 1024
MEMORY_BYTES: Final = 4 * 2**30
"""Address space of a process: the kernel's libraries alone map about 1 GiB."""
LIMITS: Final = {"RLIMIT_CORE": 0, "RLIMIT_FSIZE": 2**30, "RLIMIT_NOFILE": 128}
"""The largest of what is kept of 201 ugly files has 60 MB."""
CALLS: Final = (
    *walls.COMPUTING, "pwrite64", "ftruncate", "fsync", "getdents64", "mkdir", "mkdirat", "rename",
    "renameat", "renameat2",
    "unlink", "unlinkat", "umask", "sysinfo", "uname", "getrusage", "getuid", "geteuid", "getgid", "getegid",
    "sched_setaffinity", "sched_getparam", "sched_getscheduler", "membarrier", "fadvise64", "readlinkat", "select",
    "pselect6", "times", "getcpu",
)  # fmt: skip
"""What computes and keeps files; no socket, no process, no other user, no signal."""
DEVICES: Final = ("/dev/null", "/dev/full", "/dev/zero")
USER: Final = 65533
"""Not the number of nobody, which the sandbox's interpreters have: they could signal one another."""
LACKING: Final = ("unprivileged_user", "landlock", "seccomp")
"""Walls that some machines have not."""
CHANGING_USER: Final = {"CAP_CHOWN": 0, "CAP_KILL": 5, "CAP_SETGID": 6, "CAP_SETUID": 7}
"""What it takes to give a folder to another user, to become him, to end what he runs, and to take the folder back."""

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Reach:
    """What a piece of the kernel's work needs beside its own code."""

    reads: str | None = None
    """A file."""
    writes: str | None = None
    """A folder, which becomes the current one: a user who may not enter those above it works in it all the same."""
    memory_bytes: int = MEMORY_BYTES


def shut_in(reach: Reach, missing: Sequence[str] = ()) -> None:
    """Raises the walls around this process, for good, but for those that are `missing`. Raises OSError, ImportError.

    Where it changes its user, the folder that it writes is given to him: `take_back` undoes that.
    """
    landlock = None if "landlock" in missing else _ruleset(reach)
    seccomp = None if "seccomp" in missing else _seccomp()
    user = None if "unprivileged_user" in missing else user_of_work()
    if reach.writes is not None:
        os.chdir(reach.writes)
        if user is not None:
            os.chown(".", user, user)
    walls.shut_in(LIMITS | {"RLIMIT_AS": reach.memory_bytes}, user, landlock, seccomp)


def user_of_work() -> int | None:
    """As whom is the kernel's work done here? None: as who does all else, where that is not root and may not change.

    Raises PermissionError where it is root, and may not become another.
    """
    status = Path("/proc/self/status").read_text(encoding="utf-8", errors="replace")
    effective = next((int(line.split()[1], 16) for line in status.splitlines() if line.startswith("CapEff:")), 0)
    lacking = [name for name, bit in CHANGING_USER.items() if not effective >> bit & 1]
    if not lacking:
        return USER
    if os.geteuid() == 0:
        raise PermissionError(f"root without {', '.join(lacking)} cannot become another user")
    return None


def take_back(folder: Path) -> None:
    """Makes a folder that `shut_in` gave away, and what was made in it, this user's own again, and nobody else's.

    Call it when the process that was shut in has ended. What is neither a file nor a folder is removed.
    """
    if folder.stat().st_uid == os.geteuid():
        return
    os.chown(folder, os.geteuid(), os.getegid())
    for _, folders, files, at in os.fwalk(folder):
        for name in (*folders, *files):
            mode = os.stat(name, dir_fd=at, follow_symlinks=False).st_mode
            if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
                os.unlink(name, dir_fd=at)
                continue
            os.chown(name, os.geteuid(), os.getegid(), dir_fd=at, follow_symlinks=False)
            os.chmod(name, 0o700 if stat.S_ISDIR(mode) else 0o600, dir_fd=at)


def missing_walls() -> tuple[str, ...]:
    """Which walls can not be raised here? Tried in a fork; call it where there is one thread."""
    if sys.platform != "linux":
        return (*LACKING, "no_new_privileges")
    with tempfile.TemporaryDirectory() as folder:
        for missing in (some for n in range(len(LACKING) + 1) for some in itertools.combinations(LACKING, n)):
            child = os.fork()
            if not child:
                code = 1
                with contextlib.suppress(OSError, ImportError, ValueError):
                    shut_in(Reach(writes=folder), missing)
                    code = 0
                os._exit(code)
            ended = os.waitpid(child, 0)[1]
            take_back(Path(folder))
            if ended == 0:
                return missing
    return (*LACKING, "resource_limits", "no_new_privileges")


def must_be_up(missing: Sequence[str]) -> None:
    """Raises WallsMissing where walls are missing that are required; says in the log which, where they are not."""
    if missing and WallSettings.read().walls is Walls.REQUIRED:
        raise WallsMissing("no file is read", "the CAD kernel", missing)
    for name in missing:
        log.warning("wall %s is not up around the CAD kernel", name)


def _ruleset(reach: Reach) -> int:
    reads = [reach.reads] if reach.reads and Path(reach.reads).exists() else []  # the work says of one that is missing
    return walls.landlock_ruleset(reads, _installation(), [reach.writes] if reach.writes else [], [*DEVICES])


@cache
def _seccomp() -> bytes:
    return walls.seccomp_program(CALLS)


@cache
def _installation() -> list[str]:
    """What Python, the kernel and this package are read from."""
    own = (sys.prefix, sys.base_prefix, str(Path(__file__).parent), str(Path(querycad_contracts.__file__).parent))
    found = {str(Path(path).resolve()) for path in (*own, *site.getsitepackages(), *walls.SYSTEM_FOLDERS)}
    return sorted(path for path in found if Path(path).exists())


class KernelProcess:
    """One piece of work in a process of its own. Use it as a context manager: it does not outlive the block."""

    def __init__(self, work: str, *arguments: str | int, errors: int = subprocess.DEVNULL) -> None:
        """`work`: a name in `kernel_host.WORK`. `errors`: descriptor that its standard error goes to."""
        self._code: int | None = None
        with contextlib.ExitStack() as theirs, contextlib.ExitStack() as ours:
            stdin, into = os.pipe()
            theirs.callback(os.close, stdin)
            self.stdin = ours.enter_context(os.fdopen(into, "w", encoding="utf-8"))
            out_of, stdout = os.pipe()
            theirs.callback(os.close, stdout)
            self.stdout = ours.enter_context(os.fdopen(out_of, encoding="utf-8", errors="replace"))
            if errors == subprocess.DEVNULL:
                errors = os.open(os.devnull, os.O_WRONLY)
                theirs.callback(os.close, errors)
            self._line, line = socket.socketpair()
            theirs.enter_context(line)
            ours.enter_context(self._line)
            _host.fork([line.fileno(), stdin, stdout, errors])
            ours.pop_all()
        self.say(json.dumps([work, *arguments]))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def say(self, line: str) -> None:
        """Writes a line to its standard input; nothing happens where it has ended."""
        with contextlib.suppress(OSError):
            self.stdin.write(line + "\n")
            self.stdin.flush()

    def kill(self) -> None:
        """Ends it at once; from any thread."""
        with contextlib.suppress(OSError):
            self._line.shutdown(socket.SHUT_WR)

    def wait(self) -> int:
        """How did it end? The exit code, or the negative number of the signal that ended it."""
        if self._code is None:
            told = self._line.recv(16)
            self._code = int(told) if told else -signal.SIGKILL  # the host is gone, and took it along
        return self._code

    def close(self) -> None:
        """Ends it and lets go of its pipes."""
        self.kill()
        self.wait()
        for pipe in (self.stdin, self.stdout):
            with contextlib.suppress(OSError):  # what was not written yet has nobody to read it
                pipe.close()
        self._line.close()


def _environment() -> dict[str, str]:
    """Variables for a process that a file may take over: no password or key of the services."""
    kept = {name: value for name, value in os.environ.items() if name in KEPT or name.startswith(KEPT_STARTS)}
    return {**kept, **ONE_THREAD}


class _Host:
    """The host of this process. Thread safe; a forked process has a host of its own."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process: subprocess.Popen[bytes] | None = None
        self._control: socket.socket | None = None
        self.missing: tuple[str, ...] = ()
        """Walls that are not up around what it forks."""

    def fork(self, descriptors: list[int]) -> None:
        """Has a process forked that gets these descriptors: a line, standard input, output and error."""
        with self._lock:
            try:
                socket.send_fds(self._running(), [b"f"], descriptors)
            except OSError:  # it was killed since
                self._stop()
                socket.send_fds(self._running(), [b"f"], descriptors)

    def start(self) -> None:
        """Starts the host if it does not run, and waits until it is ready. Raises WallsMissing."""
        with self._lock:
            self._running()

    def stop(self) -> None:
        """Ends the host, and all that it has forked."""
        with self._lock:
            self._stop()

    def forget(self) -> None:
        """In a forked process: the host belongs to the parent."""
        if self._control is not None:
            self._control.close()
        if self._process is not None:
            self._process.returncode = 0  # nothing to wait for
        self._lock, self._process, self._control = threading.Lock(), None, None

    def _running(self) -> socket.socket:
        if self._control is None:
            self._control, theirs = socket.socketpair()
            with theirs:
                self._process = subprocess.Popen(
                    [sys.executable, "-m", "querycad_segworker.kernel_host", str(theirs.fileno())],
                    env=_environment(),
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    pass_fds=[theirs.fileno()],
                )
            told = self._control.recv(LINE_BYTES)
            if not told:
                self._stop()
                raise OSError("the CAD kernel cannot be loaded; standard error says why")
            self.missing = tuple(json.loads(told))
            try:
                must_be_up(self.missing)
            except WallsMissing:
                self._stop()
                raise
        return self._control

    def _stop(self) -> None:
        if self._control is not None:
            self._control.close()
        if self._process is not None:
            self._process.wait()
        self._control = self._process = None


_host = _Host()
start_host = _host.start


def host_missing() -> tuple[str, ...]:
    """Which walls are not up around the processes of the host that runs?"""
    return _host.missing


os.register_at_fork(after_in_child=_host.forget)
atexit.register(_host.stop)
