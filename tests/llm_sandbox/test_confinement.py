"""The walls around an interpreter: what a process behind them cannot do, whatever it was made to run."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import landlockpy
import pytest
import seccompy

from querycad_contracts.infrastructure import walls
from querycad_sandbox.walls.confinement import LIMITS, Confinement, landlock_ruleset, seccomp_program

LAUNCHER = Path(walls.__file__).read_text(encoding="utf-8")
TRIES = """
import errno, json, os, signal, socket, sys
def attempt(name, call):
    if name not in WANTED:
        return
    try:
        call()
        found[name] = "done"
    except OSError as error:
        found[name] = errno.errorcode.get(error.errno, str(error))
    except BaseException as error:
        found[name] = type(error).__name__
found = {}
attempt("read a file", lambda: open("/etc/passwd").read())
attempt("read its own environment", lambda: open("/proc/self/environ").read())
attempt("read its parent's memory", lambda: open(f"/proc/{os.getppid()}/mem", "rb"))
attempt("list a folder", lambda: os.listdir("/"))
attempt("write a file", lambda: open(WRITABLE + "/written", "w"))
attempt("make a folder", lambda: os.mkdir(WRITABLE + "/made"))
attempt("remove a file", lambda: os.unlink(WRITABLE + "/there"))
attempt("open a TCP socket", lambda: socket.create_connection(("127.0.0.1", 9)))
attempt("open a UDP socket", lambda: socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
attempt("open a local socket", lambda: socket.socket(socket.AF_UNIX))
attempt("start a process", lambda: os.fork())
attempt("become another program", lambda: os.execv("/bin/true", ["true"]))
attempt("signal its parent", lambda: os.kill(os.getppid(), 0))
attempt("signal everyone", lambda: os.kill(-1, 0))
attempt("change its user", lambda: os.setuid(0))
attempt("change the root", lambda: os.chroot("/"))
attempt("raise its limits", lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (10**5, 10**5)))
attempt("take the memory", lambda: bytearray(2 * 2**30))
attempt("make a file in memory", lambda: os.memfd_create("x"))
print(json.dumps(found))
"""

ON_FILES = {"read a file", "list a folder", "write a file", "make a folder"}
ON_SOCKETS = {"open a TCP socket", "open a UDP socket", "open a local socket"}

needs_linux = pytest.mark.skipif(sys.platform != "linux", reason="these are walls of Linux")


def tried(wanted: set[str], writable: Path, *, landlock: bool, seccomp: bool) -> dict[str, str]:
    """What came of each attempt, in a process behind these walls."""
    (writable / "there").write_text("still")
    ruleset = landlock_ruleset(str(Path(sys.executable).resolve())) if landlock else None
    program = seccomp_program() if seccomp else None
    script = f"{LAUNCHER}\nWRITABLE, WANTED = {str(writable)!r}, {wanted!r}\nimport errno, json, signal, socket\n"
    script += f"shut_in({LIMITS!r}, None, {ruleset!r}, {program!r})\n{TRIES}"
    kept: Any = () if ruleset is None else (ruleset,)
    command = [sys.executable, "-IS", "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, timeout=30, pass_fds=kept, check=False)
    assert done.returncode == 0, done.stderr
    found: dict[str, str] = json.loads(done.stdout)
    return found


@needs_linux
@pytest.mark.skipif(not (landlockpy.supported() and seccompy.supported()), reason="the kernel has not both")
def test_behind_all_walls_nothing_can_be_reached(tmp_path: Path) -> None:
    every = set(re.findall(r'^attempt\("([^"]+)"', TRIES, re.MULTILINE))
    found = tried(every, tmp_path, landlock=True, seccomp=True)
    assert found.keys() == every
    assert len(every) == 19
    assert {name: how for name, how in found.items() if how == "done"} == {}
    assert (tmp_path / "there").read_text() == "still"
    assert [each.name for each in tmp_path.iterdir()] == ["there"]


@needs_linux
@pytest.mark.skipif(not landlockpy.supported(), reason="the kernel has no Landlock")
def test_behind_landlock_alone_no_file_can_be_reached(tmp_path: Path) -> None:
    wanted = {*ON_FILES, "remove a file", "become another program", "read its own environment"}
    found = tried(wanted, tmp_path, landlock=True, seccomp=False)
    assert set(found.values()) == {"EACCES"}


@needs_linux
@pytest.mark.skipif(not seccompy.supported(), reason="the kernel has no seccomp")
def test_behind_seccomp_alone_no_socket_or_process_can_be_made(tmp_path: Path) -> None:
    wanted = {*ON_SOCKETS, "start a process", "signal its parent", "signal everyone", "change the root"}
    found = tried(wanted, tmp_path, landlock=False, seccomp=True)
    assert set(found.values()) == {"EPERM"}


@needs_linux
def test_without_walls_the_same_attempts_succeed(tmp_path: Path) -> None:
    found = tried({*ON_FILES, "open a UDP socket", "open a local socket"}, tmp_path, landlock=False, seccomp=False)
    assert set(found.values()) == {"done"}


@needs_linux
def test_the_interpreter_starts_behind_the_strongest_walls_that_there_are() -> None:
    confinement = Confinement.strongest()
    try:
        assert confinement.layers["landlock"] == landlockpy.supported()
        assert confinement.layers["seccomp"] == seccompy.supported()
        assert confinement.binary is not None
        answer = subprocess.run(
            [confinement.binary, "-c", "print(6 * 7)"], capture_output=True, check=True, close_fds=False
        )
        assert answer.stdout == b"42\n"
    finally:
        confinement.close()
