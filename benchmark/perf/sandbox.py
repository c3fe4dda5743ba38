"""What does the sandbox cost? Beside a fresh Python in a process, and the same in bubblewrap, in the same run."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Any, Final

import httpx

from querycad_contracts import FaceQuery, Grounded, Grounding, PartQuery, RunLimits, RunStatus, Shape, Side, Vector
from querycad_sandbox import Sandbox
from querycad_sandbox.control import RunControl

from .figures import Measurement, percentile, times_ms

EMPTY_PROGRAM: Final = "solution = 0"
FOR_EVER: Final = "while True:\n    pass"
WORKERS: Final = 2
THREADS: Final = 4
A_SECOND: Final = 200
WAITING: Final = 32
WAIT_S: Final = 0.25
PYTHON: Final = (sys.executable, "-I", "-c", EMPTY_PROGRAM)
BUBBLEWRAP: Final = ("bwrap", "--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc", "--unshare-all", "--clearenv")
START_S: Final = 60.0
GROWTH: Final = 1.1
"""Memory may grow by so much between the first tenth of the runs and the last, for the allocator's sake."""


class NoPartFinder:
    """Of programs that ask nothing; who asks waits, as if a segworker were busy."""

    def __init__(self, control: RunControl | None = None) -> None:
        self._control = control

    def look(self, phrase: str) -> Grounding:
        """What was seen: nothing."""
        return Grounding(description=phrase, sides=None, parts=(), understood=True, seen_by="")

    def find_parts(self, description: str | PartQuery, sides: Sequence[Side] | None = None) -> Grounding:
        """Nothing, after a while in which the run holds no interpreter."""
        del sides
        if self._control is not None:
            self._control.release()
        time.sleep(WAIT_S)
        return Grounding(description=str(description), sides=None, parts=(), understood=True, message="there are none")

    def ground(self, queries: Sequence[PartQuery]) -> tuple[tuple[Grounded, ...], ...]:
        """Never asked."""
        raise NotImplementedError

    def shape(self) -> Shape:
        """Never asked."""
        raise NotImplementedError

    def parts(self) -> Any:
        """Never asked."""
        raise NotImplementedError

    def faces(self, ids: Sequence[int]) -> Any:
        """Never asked."""
        raise NotImplementedError

    def find_faces(self, query: FaceQuery) -> Any:
        """Never asked."""
        raise NotImplementedError

    def extent(self, part: str, direction: Vector) -> float:
        """Never asked."""
        raise NotImplementedError

    def distance(self, part_a: str, part_b: str) -> float:
        """Never asked."""
        raise NotImplementedError

    def overlap(self, part_a: str, part_b: str) -> float:
        """Never asked."""
        raise NotImplementedError

    def edge_distance(self, part: str) -> float:
        """Never asked."""
        raise NotImplementedError


def sandbox_measurements(runs: int) -> Iterator[Measurement]:
    """`runs` empty programs one after the other, and ten times as many for the memory; a twentieth of the baselines."""
    with Sandbox(workers=WORKERS) as sandbox:
        sandbox.warm()

        def run(_: int) -> None:
            assert sandbox.run(EMPTY_PROGRAM, NoPartFinder()).status is RunStatus.OK

        times_ms(run, 20)
        yield from _overhead(times_ms(run, runs), max(runs // 20, 5))
        yield from _throughput("in this process", run, runs, os.getpid())
        yield _killed(sandbox)
        yield _waiting(sandbox)
        yield _memory(run, runs)
    with _service() as (client, pid):

        def post(_: int) -> None:
            client.post("/runs", json={"code": EMPTY_PROGRAM, "model": "0" * 64}).raise_for_status()

        times_ms(post, 20)
        yield from _throughput("over HTTP", post, runs, pid)


def _overhead(inside: Sequence[float], baselines: int) -> Iterator[Measurement]:
    found = {"python -I in a process": PYTHON, "the same in bubblewrap": (*BUBBLEWRAP, *PYTHON)}
    for name, command in found.items():
        if shutil.which(command[0]) is None or subprocess.run(command, capture_output=True, check=False).returncode:
            continue  # no bubblewrap here, or no namespaces for it
        outside = times_ms(partial(_start, command), baselines)
        for share, limit_ms in ((50, 5.0), (99, 20.0)):
            value = percentile(inside, share)
            yield Measurement(
                name=f"sandbox overhead, p{share}",
                value=value,
                unit="ms",
                baseline_name=f"{name}, p{share}",
                baseline=percentile(outside, share),
                limit=f"under {limit_ms:g} ms",
                holds=value < limit_ms,
            )


def _start(command: Sequence[str], _: int = 0) -> None:
    subprocess.run(command, check=True)


def _throughput(name: str, run: Callable[[int], object], runs: int, pid: int) -> Iterator[Measurement]:
    """Runs a second; and what a run takes of the processors, which is the same on a busy machine."""

    def a_second(call: Callable[[int], object], count: int) -> float:
        with ThreadPoolExecutor(THREADS) as threads:
            started = time.perf_counter()
            list(threads.map(call, range(count)))
            return count / (time.perf_counter() - started)

    others = max(runs // 20, 5)
    before = sum(_computed(pid).values())
    value = a_second(run, runs)
    cpu_ms = (sum(_computed(pid).values()) - before) * 1e3 / os.sysconf("SC_CLK_TCK") / runs
    before_s = _ended_children_s()
    baseline = a_second(partial(_start, PYTHON), others)
    yield Measurement(
        name=f"runs a second, {name}",
        value=value,
        unit="1/s",
        baseline_name="python -I in a process",
        baseline=baseline,
        limit=f"over {A_SECOND} 1/s on 2 cores",
        holds=value > A_SECOND,
    )
    yield Measurement(
        name=f"processor time of a run, {name}",
        value=cpu_ms,
        unit="ms",
        baseline_name="python -I in a process",
        baseline=(_ended_children_s() - before_s) * 1e3 / others,
        limit=f"under {2000 / A_SECOND:g} ms: {A_SECOND} 1/s on 2 cores",
        holds=cpu_ms < 2000 / A_SECOND,
    )


def _ended_children_s() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _killed(sandbox: Sandbox) -> Measurement:
    """Kills the interpreter of one of several runs: how many of them are lost?"""
    started = threading.Event()

    def run(number: int) -> RunStatus:
        if number:
            started.wait()
            return sandbox.run(EMPTY_PROGRAM, NoPartFinder()).status
        return sandbox.run(FOR_EVER, NoPartFinder(), RunLimits(duration_s=30)).status

    with ThreadPoolExecutor(THREADS) as threads:
        before = _computed(os.getpid())
        victims = [threads.submit(run, 0)]
        busy = _busy(before)
        others = [threads.submit(run, number) for number in range(1, 200)]
        started.set()
        os.kill(busy, signal.SIGKILL)
        lost = sum(each.result() is not RunStatus.OK for each in victims + others)
    return Measurement(
        name="runs lost, of 200 around it",
        value=lost,
        unit="runs",
        baseline_name="interpreters killed",
        baseline=1,
        limit="only its own",
        holds=lost == 1,
    )


def _waiting(sandbox: Sandbox) -> Measurement:
    """How long do many runs take that wait for the segworker at once?"""

    def run(_: int) -> RunStatus:
        control = RunControl()
        return sandbox.run("solution = len(find_parts('hole'))", NoPartFinder(control), control=control).status

    with ThreadPoolExecutor(WAITING) as threads:
        started = time.perf_counter()
        assert set(threads.map(run, range(WAITING))) == {RunStatus.OK}
        value = time.perf_counter() - started
    return Measurement(
        name=f"{WAITING} runs waiting for the segworker on {WORKERS} interpreters",
        value=value,
        unit="s",
        baseline_name="one such wait",
        baseline=WAIT_S,
        limit=f"under {WAITING // WORKERS} x, one after the other",
        holds=value < WAIT_S * WAITING / WORKERS,
    )


def _memory(run: Callable[[int], object], runs: int) -> Measurement:
    with ThreadPoolExecutor(WORKERS) as threads:
        list(threads.map(run, range(runs)))
        before = _resident_mib()
        list(threads.map(run, range(9 * runs)))
    after = _resident_mib()
    return Measurement(
        name=f"memory after {10 * runs:,} runs",
        value=after,
        unit="MiB",
        baseline_name=f"after {runs:,}",
        baseline=before,
        limit=f"under {GROWTH:g} x",
        holds=after < GROWTH * before,
    )


def _processes(pid: int) -> list[int]:
    """The process and its children."""
    found = [pid]
    for task in Path(f"/proc/{pid}/task").iterdir():
        with suppress(OSError):  # a thread that has ended
            found.extend(map(int, (task / "children").read_text().split()))
    return found


def _computed(pid: int) -> dict[int, int]:
    """Clock ticks that the process and each of its children has computed for."""
    found = {}
    for each in _processes(pid):
        with suppress(OSError):
            fields = Path(f"/proc/{each}/stat").read_text().rpartition(")")[2].split()
            found[each] = int(fields[11]) + int(fields[12])
    return found


def _busy(before: dict[int, int]) -> int:
    """The child that computes now."""
    while True:
        for pid, ticks in _computed(os.getpid()).items():
            if pid != os.getpid() and ticks >= before.get(pid, 0) + 10:
                return pid


def _resident_mib() -> float:
    """Of this process and its children."""
    pages = 0
    for pid in _processes(os.getpid()):
        with suppress(OSError):
            pages += int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


@contextmanager
def _service() -> Iterator[tuple[httpx.Client, int]]:
    """The sandbox's service in a process of its own; it needs no broker for programs that ask nothing."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    environment = {**os.environ, "QUERYCAD_SANDBOX_PORT": str(port), "QUERYCAD_REDIS_URL": "redis://127.0.0.1:1/0"}
    command = [sys.executable, "-m", "querycad_sandbox.service"]
    with subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL) as process:
        try:
            with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=30, trust_env=False) as client:
                deadline = time.monotonic() + START_S
                while time.monotonic() < deadline:
                    with suppress(httpx.TransportError):
                        client.get("/livez").raise_for_status()
                        break
                    time.sleep(0.1)
                yield client, process.pid
        finally:
            process.terminate()
