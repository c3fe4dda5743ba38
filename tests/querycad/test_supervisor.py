"""Children run until they are told to stop, and none is left."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from querycad.supervisor import Command, Supervisor

WITHIN_S = 20.0
SLEEP = "import time; time.sleep(600)"


def script(name: str, code: str) -> Command:
    return Command(name, (sys.executable, "-c", code), dict(os.environ))


def until(done: Callable[[], bool]) -> None:
    deadline = time.monotonic() + WITHIN_S
    while not done():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def gone(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    stat = Path(f"/proc/{pid}/stat")
    return stat.exists() and stat.read_text().rpartition(")")[2].split()[0] == "Z"


@pytest.fixture
def said() -> list[str]:
    return []


@pytest.fixture
def supervisor(tmp_path: Path, said: list[str]) -> Supervisor:
    return Supervisor(tmp_path / "logs", said.append)


def test_what_a_child_says_is_in_its_log(supervisor: Supervisor, tmp_path: Path) -> None:
    with supervisor:
        supervisor.start(script("talker", "print('hello', flush=True); import time; time.sleep(600)"))
        until(lambda: (tmp_path / "logs/talker.log").read_text() == "hello\n")


def test_a_child_that_was_killed_is_started_again(supervisor: Supervisor, said: list[str]) -> None:
    with supervisor:
        supervisor.start(script("sleeper", SLEEP))
        first = supervisor.pids()["sleeper"]
        os.kill(first, signal.SIGKILL)

        def again() -> bool:
            supervisor.watch()
            return supervisor.pids().get("sleeper", first) != first

        until(again)
    assert "sleeper was killed (SIGKILL)" in said[0]


def test_a_child_that_cannot_live_is_not_started_over_and_over(supervisor: Supervisor, said: list[str]) -> None:
    with supervisor:
        supervisor.start(script("failing", "raise SystemExit(3)"))
        end = time.monotonic() + 1.2
        while time.monotonic() < end:
            supervisor.watch()
            time.sleep(0.01)
    assert 1 <= len(said) <= 2
    assert "exit code 3" in said[0]


def test_stopping_ends_children_and_theirs(supervisor: Supervisor, tmp_path: Path) -> None:
    note = tmp_path / "grandchild"
    spawn = f"""
import pathlib, subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "{SLEEP}"])
pathlib.Path({str(note)!r}).write_text(str(child.pid) + ".")
time.sleep(600)
"""
    with supervisor:
        supervisor.start(script("first", SLEEP))
        supervisor.start(script("parent", spawn))
        until(lambda: note.exists() and note.read_text().endswith("."))
        pids = [*supervisor.pids().values(), int(note.read_text()[:-1])]
    assert len(pids) == 3
    until(lambda: all(gone(pid) for pid in pids))


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells children of their parent's death")
def test_children_end_when_their_parent_is_killed(tmp_path: Path) -> None:
    note = tmp_path / "child"
    code = f"""
import os, pathlib, sys, time
from querycad.supervisor import Command, Supervisor
supervisor = Supervisor(pathlib.Path({str(tmp_path)!r}), print)
supervisor.start(Command("child", (sys.executable, "-c", {SLEEP!r}), dict(os.environ)))
pathlib.Path({str(note)!r}).write_text(str(supervisor.pids()["child"]) + ".")
time.sleep(600)
"""
    with subprocess.Popen([sys.executable, "-c", code]) as parent:
        until(lambda: note.exists() and note.read_text().endswith("."))
        parent.kill()
    until(lambda: gone(int(note.read_text()[:-1])))
