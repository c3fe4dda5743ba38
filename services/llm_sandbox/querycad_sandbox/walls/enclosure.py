"""The walls around the service itself, which its interpreters inherit.

A service needs its own code, a connection to the broker, and its clients. What else it had is given up at its start:
the rest of the environment, root, files, other ports.
"""

from __future__ import annotations

import ctypes
import logging
import os
import resource
import stat
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Final
from urllib.parse import urlsplit

import querycad_contracts
from querycad_contracts.infrastructure.walls import SYSTEM_FOLDERS, become
from querycad_sandbox.settings import SandboxSettings

from .confinement import NOBODY, interpreter

KEPT: Final = frozenset(
    ("PATH", "LANG", "LC_ALL", "LC_CTYPE", "TZ", "VIRTUAL_ENV", "MONTY_BIN", "HOME", "HOSTNAME", "PWD", "OLDPWD")
) | frozenset(("SHLVL", "SHELL", "TERM", "USER", "LOGNAME", "_"))
"""Variables that a Python process reads, and those of every shell, which are no secrets."""
KEPT_STARTS: Final = ("PYTHON",)
TRACING_START: Final = "OTEL_"
"""Of traces' own settings, which are kept where traces are wanted; their address may be any host's."""
TRACING_PORTS: Final = (4317, 4318)
SYSTEM_FILES: Final = ("hosts", "resolv.conf", "nsswitch.conf", "host.conf", "gai.conf", "localtime", "ld.so.cache")
CONTRACTS: Final = Path(querycad_contracts.__file__).parent
DEVICES: Final = ("/dev/null", "/dev/urandom")
PR_SET_DUMPABLE: Final = 4

log = logging.getLogger(__name__)


def enclose(settings: SandboxSettings) -> dict[str, bool]:
    """Gives up what the service does not need. Which walls hold, by name?

    Call it before the first thread, after `clean_environment`.
    """
    unprivileged = _leave_root()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return {"clean_environment": True, "unprivileged_user": unprivileged, "landlock": _landlock(settings)}


def clean_environment(settings: SandboxSettings) -> None:
    """Starts this process anew without the variables that it does not read: another service's secrets may be there."""
    known = KEPT | {settings.variable(field) for field in type(settings).model_fields}
    starts = (*KEPT_STARTS, TRACING_START) if settings.traces else KEPT_STARTS
    kept = {name: value for name, value in os.environ.items() if name in known or name.startswith(starts)}
    if kept != dict(os.environ):
        os.execve(sys.executable, sys.orig_argv, kept)  # noqa: S606 - itself, as it was started


def _leave_root() -> bool:
    """Is this process without root's powers, now at the latest?

    Root becomes nobody where nobody could read the installation. Else the interpreters alone become nobody.
    """
    if os.geteuid() != 0:
        return True
    needed = (
        sys.executable,
        sys.prefix,
        sys.base_prefix,
        os.__file__,
        __file__,
        querycad_contracts.__file__,
        interpreter(),
    )
    if not all(_open_to_all(Path(path)) for path in needed):
        log.warning("this runs as root: another user could not read %s", sys.prefix)
        return False
    become(NOBODY)
    ctypes.CDLL(None).prctl(PR_SET_DUMPABLE, 1)  # else its interpreters could not be started from its own memory
    return True


def _open_to_all(path: Path) -> bool:
    """May any user read the file or folder, and reach it?"""
    path = path.resolve()
    mode = path.stat().st_mode
    readable = mode & stat.S_IROTH and (mode & stat.S_IXOTH or not path.is_dir())
    return bool(readable) and all(parent.stat().st_mode & stat.S_IXOTH for parent in path.parents)


def _landlock(settings: SandboxSettings) -> bool:
    """Leaves the files of the installation to read and the broker to connect to; False where there is no Landlock."""
    try:
        from landlockpy import AccessFS, AccessNet, LandlockError, Ruleset, Scope
        from seccompy import supported
    except ImportError:
        return False
    supported()  # it looks for the C library once, with programs that are out of reach afterwards
    read = AccessFS.READ_FILE | AccessFS.READ_DIR | AccessFS.EXECUTE
    net = AccessNet.CONNECT_TCP | AccessNet.BIND_TCP
    try:
        with Ruleset(handled_net=net, scoped=Scope.ABSTRACT_UNIX_SOCKET | Scope.SIGNAL) as ruleset:
            for path in _readable():
                ruleset.allow_path(path, read if path.is_dir() else read & ~AccessFS.READ_DIR)
            for device in DEVICES:
                ruleset.allow_path(device, AccessFS.READ_FILE | AccessFS.WRITE_FILE)
            for port in _ports(settings):
                ruleset.allow_port(port, AccessNet.CONNECT_TCP)
            ruleset.restrict()
    except (LandlockError, OSError) as error:
        log.warning("no Landlock around the service: %s", error)
        return False
    return True


def _readable() -> Iterable[Path]:
    """The installation, and what the system's libraries read."""
    own: tuple[str | Path, ...] = (sys.prefix, sys.base_prefix, Path(__file__).parents[1], CONTRACTS, interpreter())
    listed = (path for path in sys.path if Path(path).name in ("site-packages", "dist-packages"))
    found = (
        Path(path) for path in (*own, *listed, *SYSTEM_FOLDERS, "/proc", *(f"/etc/{name}" for name in SYSTEM_FILES))
    )
    return [path for path in found if path.exists()]


def _ports(settings: SandboxSettings) -> tuple[int, ...]:
    """The TCP ports that the service connects to."""
    broker = urlsplit(settings.redis_url).port or 6379
    return (broker, *TRACING_PORTS) if settings.traces else (broker,)
