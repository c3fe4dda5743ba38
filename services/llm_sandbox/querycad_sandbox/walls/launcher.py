"""Shuts this process in and becomes the interpreter. `confinement` starts it in the interpreter's place.

Run by Python with nothing but the standard library, so that it takes milliseconds; its last line, the call of
`launch`, is added when it is started. A wall that cannot be raised ends the process: no program runs without it.
"""

from __future__ import annotations

import ctypes
import os
import resource
import sys

PR_SET_NO_NEW_PRIVS, PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 38, 22, 2
LANDLOCK_RESTRICT_SELF = 446
BPF_INSTRUCTION_BYTES = 8


class _Program(ctypes.Structure):
    """`struct sock_fprog`."""

    _fields_ = (("length", ctypes.c_ushort), ("filter", ctypes.c_char_p))


def launch(binary: str, limits: dict[str, int], user: int | None, landlock: int | None, seccomp: bytes | None) -> None:
    """Becomes `binary`, shut in: see `shut_in`."""
    interpreter = os.open(binary, os.O_RDONLY | os.O_CLOEXEC)
    os.chdir("/")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # what it would write to the service's log is the program's to choose
    shut_in(limits, user, landlock, seccomp)
    os.execve(interpreter, [binary, *sys.argv[1:]], {})  # noqa: S606 - the interpreter, by what was opened


def shut_in(limits: dict[str, int], user: int | None, landlock: int | None, seccomp: bytes | None) -> None:
    """Raises the walls around this process, for good.

    `limits` are resource limits by name, `user` the id to change to, `landlock` a ruleset's file descriptor, and
    `seccomp` a BPF program. Raises OSError when one cannot be raised.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    if user is not None:
        os.setgroups([])
        os.setresgid(user, user, user)
        os.setresuid(user, user, user)
    for name, most in limits.items():
        resource.setrlimit(getattr(resource, name), (most, most))
    _must(libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))
    if landlock is not None:
        _must(libc.syscall(LANDLOCK_RESTRICT_SELF, landlock, 0))
        os.close(landlock)
    if seccomp is not None:
        program = _Program(len(seccomp) // BPF_INSTRUCTION_BYTES, seccomp)
        _must(libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(program), 0, 0))


def _must(result: int) -> None:
    if result != 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
