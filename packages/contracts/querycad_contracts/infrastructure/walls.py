"""How does a process shut itself in, for good? Limits, another user, no capabilities, Landlock, seccomp.

The interpreters of the sandbox and the processes of the CAD kernel are behind the same walls. Nothing but the standard
library is imported when this is: this text, with a call of `launch` after it, is also what starts an interpreter.
"""

from __future__ import annotations

import ctypes
import os
import resource
import sys

PR_SET_NO_NEW_PRIVS, PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 38, 22, 2
PR_SET_PDEATHSIG, PR_GET_PDEATHSIG = 1, 2
LANDLOCK_RESTRICT_SELF = 446
BPF_INSTRUCTION_BYTES = 8
CAPABILITIES_VERSION = 0x20080522
CLONE_THREAD = 0x10000

COMPUTING = (
    # memory
    "brk", "mmap", "munmap", "mprotect", "mremap", "madvise",
    # its pipes, and its own libraries, which Landlock limits
    "read", "write", "readv", "writev", "close", "poll", "ppoll", "dup", "dup2", "fcntl", "lseek", "fstat",
    "newfstatat", "statx", "openat", "pread64", "access", "faccessat2", "readlink", "getcwd", "ioctl",
    # threads and their waiting
    "futex", "set_robust_list", "set_tid_address", "rseq", "gettid", "getpid", "sched_yield", "sched_getaffinity",
    "clock_nanosleep", "nanosleep", "restart_syscall", "sigaltstack", "rt_sigaction", "rt_sigprocmask", "rt_sigreturn",
    "tgkill", "arch_prctl", "prlimit64", "prctl", "exit", "exit_group",
    # time and chance
    "clock_gettime", "clock_getres", "gettimeofday", "getrandom",
)  # fmt: skip
"""System calls of a process that computes; those that not every processor's Linux has are in `OF_OTHER_MACHINES`."""
OF_OTHER_MACHINES = frozenset(("arch_prctl", "access", "dup2", "poll", "readlink", "mkdir", "rename", "unlink"))
SYSTEM_FOLDERS = ("/lib", "/lib64", "/usr/lib", "/usr/lib64", "/usr/local/lib", "/usr/share/zoneinfo")
"""What the libraries of a process are read from, beside its installation."""


class _Program(ctypes.Structure):
    """`struct sock_fprog`."""

    _fields_ = (("length", ctypes.c_ushort), ("filter", ctypes.c_char_p))


def launch(binary: str, limits: dict[str, int], user: int | None, landlock: int | None, seccomp: bytes | None) -> None:
    """Becomes `binary`, shut in: see `shut_in`. A wall that cannot be raised ends the process."""
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
        become(user)
    for name, most in limits.items():
        resource.setrlimit(getattr(resource, name), (most, most))
    _must(libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))
    header, none = (ctypes.c_uint32 * 2)(CAPABILITIES_VERSION, 0), (ctypes.c_uint32 * 6)()
    _must(libc.capset(header, none))  # root without them is one user among others
    if landlock is not None:
        _must(libc.syscall(LANDLOCK_RESTRICT_SELF, landlock, 0))
        os.close(landlock)
    if seccomp is not None:
        program = _Program(len(seccomp) // BPF_INSTRUCTION_BYTES, seccomp)
        _must(libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(program), 0, 0))


def become(user: int) -> None:
    """Changes to the user and group of this id, and to no other group. Raises OSError."""
    libc, ends_with_parent = ctypes.CDLL(None, use_errno=True), ctypes.c_int()
    _must(libc.prctl(PR_GET_PDEATHSIG, ctypes.byref(ends_with_parent)))
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)
    _must(libc.prctl(PR_SET_PDEATHSIG, ends_with_parent.value, 0, 0, 0))  # a change of user forgets it


def _must(result: int) -> None:
    if result != 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))


def landlock_ruleset(reads: list[str], starts: list[str], writes: list[str], devices: list[str] | None = None) -> int:
    """A Landlock ruleset, as a file descriptor: these files and folders, no TCP, no signal to others.

    `reads` are read, `starts` read and mapped as code; in the folders `writes` files are made and removed; `devices`
    are read and written. Raises OSError where there is no Landlock, or a path is not there.
    """
    from pathlib import Path

    from landlockpy import AccessFS, AccessNet, Ruleset, Scope

    net = AccessNet.CONNECT_TCP | AccessNet.BIND_TCP
    file = AccessFS.READ_FILE
    made = AccessFS.WRITE_FILE | AccessFS.TRUNCATE | AccessFS.MAKE_REG | AccessFS.MAKE_DIR
    made |= AccessFS.REMOVE_FILE | AccessFS.REMOVE_DIR | AccessFS.READ_DIR | file
    ruleset = Ruleset(handled_net=net, scoped=Scope.ABSTRACT_UNIX_SOCKET | Scope.SIGNAL)
    with ruleset:
        for paths, rights in ((reads, file), (starts, file | AccessFS.EXECUTE)):
            for path in paths:
                ruleset.allow_path(path, rights | AccessFS.READ_DIR if Path(path).is_dir() else rights)
        for path in writes:
            ruleset.allow_path(path, made)
        for path in devices or ():
            ruleset.allow_path(path, file | AccessFS.WRITE_FILE)
        return os.dup(ruleset.fileno())


def seccomp_program(calls: tuple[str, ...]) -> bytes:
    """A seccomp program that lets through these calls, and threads. Raises OSError where there is no seccomp."""
    from errno import ENOSYS, EPERM

    from seccompy import Action, ArgCmp, CmpOp, Filter, supported

    if not supported():
        raise OSError("the kernel has no seccomp")
    allowed = Filter(default=int(Action.ERRNO) | EPERM)
    for name in calls:
        try:
            allowed.allow(name)
        except (KeyError, ValueError):
            if name not in OF_OTHER_MACHINES:
                raise
    # A thread is let through and a process is not; clone3 hides which, so the C library is told to use clone.
    allowed.allow("clone", args=[ArgCmp(0, CmpOp.MASKED_EQ, CLONE_THREAD, CLONE_THREAD)])
    allowed.errno("clone3", ENOSYS)
    return allowed.program
