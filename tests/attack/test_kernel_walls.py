"""The walls around the CAD kernel: what a file that takes it over cannot do, and what happens where one is missing."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import landlockpy
import pytest
import seccompy

from querycad_contracts.infrastructure import Walls, WallsMissing
from querycad_segworker import kernel_process
from querycad_segworker.ingest import ingest
from querycad_segworker.kernel_process import _host, host_missing, missing_walls, start_host
from querycad_segworker.model import ModelStore
from querycad_segworker.settings import SegworkerSettings
from querycad_segworker.tasks import make_tasks

EXAMPLE = Path("examples/flange.step")
TRIES = """
import errno, json, os, resource, socket, sys
from querycad_segworker.kernel_process import Reach, shut_in
folder, others = sys.argv[1:]
opened = open(folder + "/file.step")
if "walls" in os.environ:
    shut_in(Reach(folder + "/file.step", folder + "/scratch", 2 * 2**30))
else:
    os.chdir(folder + "/scratch")
found = {}
def attempt(name, call):
    try:
        call()
        found[name] = "done"
    except OSError as error:
        found[name] = errno.errorcode.get(error.errno, str(error))
    except (MemoryError, ValueError) as error:
        found[name] = type(error).__name__
attempt("own: read its file", opened.read)
attempt("own: keep what it found", lambda: open("new", "w").write("x"))
attempt("own: remove what it kept", lambda: os.remove("new"))
attempt("own: use 1 GiB", lambda: bytearray(2**30))
attempt("own: compute", lambda: sum(range(1000)))
attempt("read another's file", lambda: open(others).read())
attempt("change its own file", lambda: open(folder + "/file.step", "r+"))
attempt("write beside it", lambda: open(folder + "/beside", "w"))
attempt("list the home", lambda: os.listdir(folder))
attempt("read the passwords", lambda: open("/etc/passwd").read())
attempt("read its parent's environment", lambda: open(f"/proc/{os.getppid()}/environ").read())
attempt("read its parent's memory", lambda: open(f"/proc/{os.getppid()}/mem", "rb"))
attempt("write the installation", lambda: open(os.__file__, "r+"))
attempt("open a TCP socket", lambda: socket.socket())
attempt("open a UDP socket", lambda: socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
attempt("open a local socket", lambda: socket.socket(socket.AF_UNIX))
attempt("start a process", lambda: os.fork() or os._exit(0))
attempt("become another program", lambda: os.execv("/nowhere", ["true"]))
attempt("signal its parent", lambda: os.kill(os.getppid(), 0))
attempt("raise its limits", lambda: resource.setrlimit(resource.RLIMIT_AS, (8 * 2**30, 8 * 2**30)))
attempt("take the memory", lambda: bytearray(3 * 2**30))
attempt("link out of its folder", lambda: os.symlink("/etc/passwd", "link"))
attempt("make a file in memory", lambda: os.memfd_create("x"))
attempt("become root again", lambda: os.setresuid(0, 0, 0))
attempt("give a file away", lambda: os.chown("/dev/null", 0, 0))
attempt("change its user", lambda: os.setresuid(1, 1, 1))
print(json.dumps(found))
"""
needs_walls = pytest.mark.skipif(
    not (sys.platform == "linux" and landlockpy.supported() and seccompy.supported()), reason="the kernel has not both"
)


@pytest.fixture
def fresh_host() -> Iterator[None]:
    """A host that is started in the test, and none after it."""
    _host.stop()
    yield
    _host.stop()


def tried(folder: Path, **environment: str) -> dict[str, str]:
    """What came of each attempt."""
    (folder / "scratch").mkdir()
    for name in ("file.step", "others.step"):
        (folder / name).write_text("x")
    command = [sys.executable, "-c", TRIES, str(folder), str(folder / "others.step")]
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=60, check=False, env=os.environ | environment
    )
    assert done.returncode == 0, done.stderr
    found: dict[str, str] = json.loads(done.stdout)
    return found


@needs_walls
def test_behind_its_walls_the_kernel_does_its_own_work_and_nothing_else(tmp_path: Path) -> None:
    found = tried(tmp_path, walls="up")
    own = {name for name in found if name.startswith("own: ")}
    assert len(found) == 26
    assert {name for name, how in found.items() if how == "done"} == own
    assert set(found.values()) == {"done", "EACCES", "EPERM", "ENOENT", "MemoryError", "ValueError"}
    assert not (tmp_path / "beside").exists()


@needs_walls
def test_without_them_the_same_attempts_succeed(tmp_path: Path) -> None:
    found = tried(tmp_path)
    assert found.pop("become another program") == "ENOENT"
    needs_root = {"change its user", "become root again", "give a file away", "read its parent's memory"}
    needs_root |= {"write the installation"}
    assert {name for name, how in found.items() if how != "done"} <= ({*needs_root} if os.getuid() else set())


@needs_walls
def test_all_of_them_are_up(fresh_host: None) -> None:
    start_host()
    assert missing_walls() == host_missing() == ()


@pytest.fixture
def no_seccomp(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, fresh_host: None) -> None:
    """A module on the path of the host's process that says that there is no seccomp."""
    (tmp_path / "seccompy.py").write_text("raise ImportError('the kernel has no seccomp')")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))


def test_without_a_wall_no_file_is_read_and_the_worker_may_try_again(no_seccomp: None, tmp_path: Path) -> None:
    with pytest.raises(WallsMissing, match=r"no file is read.*the CAD kernel.*seccomp; QUERYCAD_WALLS=available"):
        ingest(EXAMPLE, ModelStore(tmp_path / "store"))
    home = tmp_path / "home"
    (home / "files/ab").mkdir(parents=True)
    (home / "files/ab" / ("ab" * 32)).write_bytes(EXAMPLE.read_bytes())
    outcome = make_tasks(SegworkerSettings(home=home)).table()
    told = json.loads(next(iter(outcome.values()))({"model": "ab" * 32, "file_name": "a.step"}))
    assert told["failure"]["retryable"]
    assert "seccomp" in told["failure"]["message"]


def test_where_it_is_said_a_file_is_read_without_a_wall_and_the_model_tells_so(
    no_seccomp: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("QUERYCAD_WALLS", Walls.AVAILABLE)
    warnings = ingest(EXAMPLE, ModelStore(tmp_path / "store")).load_model().warnings
    assert "the file was read without these walls: seccomp" in warnings


def test_a_segworker_without_a_wall_does_not_start(no_seccomp: None, redis_url: str) -> None:
    command = [sys.executable, "-m", "querycad_segworker.worker"]
    environment = os.environ | {"QUERYCAD_REDIS_URL": redis_url}
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, env=environment)
    assert done.returncode == 1
    assert done.stderr.strip().splitlines()[-1].startswith("querycad_segworker: no file is read: these walls")


def test_measuring_is_limited_in_memory_as_reading_is() -> None:
    assert kernel_process.Reach().memory_bytes == kernel_process.MEMORY_BYTES == 4 * 2**30
