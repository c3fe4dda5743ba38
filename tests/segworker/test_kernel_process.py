"""Processes for the CAD kernel: forked from one that has imported it, alone in their death, never left behind."""

from __future__ import annotations

import gc
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
from tests.segworker.shapes import box, compound, write_step

from querycad_segworker.ingest import ingest
from querycad_segworker.kernel_process import KernelProcess, start_host
from querycad_segworker.model import ModelStore


@pytest.fixture(scope="module")
def kernel_faces(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The kept faces of two blocks, 5 mm apart."""
    folder = tmp_path_factory.mktemp("blocks")
    shape = compound(box((10, 10, 10)), box((10, 10, 10), (0, 0, 15)))
    return str(ingest(write_step(folder / "two.step", shape), ModelStore(folder / "store")).kernel_faces)


def measured(process: KernelProcess) -> float:
    process.say(json.dumps({"what": "distance", "first": list(range(6)), "second": list(range(6, 12))}))
    return float(json.loads(process.stdout.readline())["value"])


def host() -> psutil.Process:
    start_host()
    (found,) = (child for child in psutil.Process().children() if "querycad_segworker.kernel_host" in child.cmdline())
    return found


def gone(pids: list[int], within_s: float = 20.0) -> bool:
    deadline = time.monotonic() + within_s
    while time.monotonic() < deadline:
        left = [pid for pid in pids if psutil.pid_exists(pid) and psutil.Process(pid).status() != psutil.STATUS_ZOMBIE]
        if not left:
            return True
        time.sleep(0.02)
    return False


def test_the_host_has_one_thread_since_a_fork_takes_no_other_along() -> None:
    assert host().num_threads() == 1


def test_all_work_is_forked_from_one_host(kernel_faces: str) -> None:
    gc.collect()  # models of other tests keep their kernel's process as long as they are held
    before = {child.pid for child in host().children()}
    with KernelProcess("measure", kernel_faces) as first, KernelProcess("measure", kernel_faces) as second:
        assert measured(first) == measured(second) == pytest.approx(5e-3)
        forked = {child.pid for child in host().children()} - before
        assert len(forked) == 2
    assert gone(list(forked))


def test_the_end_of_one_is_told_and_does_not_touch_another(kernel_faces: str) -> None:
    with KernelProcess("measure", kernel_faces) as first, KernelProcess("measure", kernel_faces) as second:
        assert measured(first) == pytest.approx(5e-3)
        first.kill()
        assert first.wait() == -signal.SIGKILL
        assert first.stdout.readline() == ""
        assert measured(second) == pytest.approx(5e-3)


def test_those_that_end_while_they_are_let_go_do_not_touch_another(kernel_faces: str) -> None:
    before = host().pid
    with KernelProcess("measure", kernel_faces) as stays:
        for _ in range(300):
            with KernelProcess("measure", "/missing.bin") as ends:
                assert ends.stdout.readline() == ""  # its pipe closes just before it ends
        assert measured(stays) == pytest.approx(5e-3)
    assert host().pid == before


@pytest.mark.parametrize(("name", "why"), [("damaged.bin", "could not be read again"), ("missing.bin", "No such file")])
def test_work_that_fails_ends_with_1_and_says_why(name: str, why: str, tmp_path: Path) -> None:
    (tmp_path / "damaged.bin").write_text("these are no faces")
    with (tmp_path / "errors").open("w+b") as errors:
        with KernelProcess("measure", str(tmp_path / name), errors=errors.fileno()) as process:
            assert process.wait() == 1
        errors.seek(0)
        assert why.encode() in errors.read()


def test_what_is_said_to_one_that_has_ended_goes_nowhere(tmp_path: Path) -> None:
    with KernelProcess("measure", str(tmp_path / "missing.bin")) as process:
        process.wait()
        process.say("x" * 100_000)


def test_a_host_that_was_killed_takes_its_work_along_and_is_replaced(kernel_faces: str) -> None:
    old = host()
    with KernelProcess("measure", kernel_faces) as process:
        assert measured(process) == pytest.approx(5e-3)
        worker = old.children()[0].pid
        old.kill()
        assert process.wait() == -signal.SIGKILL
        assert gone([worker])
    with KernelProcess("measure", kernel_faces) as process:
        assert measured(process) == pytest.approx(5e-3)
    assert host().pid != old.pid


CALLER = """
import sys, time
from querycad_segworker.kernel_process import KernelProcess
process = KernelProcess("measure", sys.argv[1])
process.say('{"what": "distance", "first": [0], "second": [1]}')
print(process.stdout.readline(), flush=True)
time.sleep(60)
"""


def test_nothing_outlives_a_caller_that_is_killed(kernel_faces: str) -> None:
    caller = subprocess.Popen([sys.executable, "-c", CALLER, kernel_faces], stdout=subprocess.PIPE)
    with caller:
        assert caller.stdout is not None
        assert b"value" in caller.stdout.readline()
        pids = [child.pid for child in psutil.Process(caller.pid).children(recursive=True)]
        caller.kill()
    assert len(pids) == 2
    assert gone(pids)


def test_a_forked_process_has_a_host_of_its_own(kernel_faces: str) -> None:
    ours = host().pid
    child = os.fork()
    if not child:
        code = 1
        try:
            with KernelProcess("measure", kernel_faces) as process:
                code = 0 if measured(process) > 0 and host().pid != ours else 1
        finally:
            os._exit(code)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    with KernelProcess("measure", kernel_faces) as process:
        assert measured(process) == pytest.approx(5e-3)
    assert host().pid == ours
