"""What does a question cost, and how far does the service scale? `python -m benchmark.perf.scaling`; docs/scaling.md.

Measured on a service of its own: processor time of each process and bytes, for a question and for a file. A simulation
of discrete events is fed with these and runs the same processes in any number: a question holds a question process
while its program runs in a sandbox, which asks a segworker; every step goes through the store, whose shards have one
thread each. It is checked against one and two workers of this machine.
"""

from __future__ import annotations

import argparse
import heapq
import json
import math
import os
import random
import sys
import tempfile
import time
from collections import deque
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import psutil

from querycad.client import Client

from .figures import QUESTIONS
from .service import CLIENTS, known
from .service_processes import Service, running

FILE = Path("examples/flange.step")
PARTS = {
    "api": ("querycad_api.app", ""),
    "questions": ("querycad_api.worker", ""),
    "sandbox": ("querycad_sandbox.service", ""),
    "segworker": ("querycad_segworker.worker", "segcad"),
    "store": ("valkey-server", ""),
}
QUESTIONS_SIMULATED = 20_000
LOAD = 0.8
"""Of what the workers could do: what is left is for the seconds in which more come than on average."""
FASTEST = 10_000.0
"""Questions a second, beyond which no table goes."""
UTILISED = 0.7
"""Of a store's shard: a queue before a single thread grows without end towards 1."""


@dataclass(slots=True)
class Servers:
    """So many servers with one queue, first come, first served."""

    count: int
    free: int = field(init=False)
    waiting: deque[Any] = field(default_factory=deque)
    busy_s: float = 0.0

    def __post_init__(self) -> None:
        """All are free."""
        self.free = self.count


@dataclass(frozen=True, slots=True)
class Deployment:
    """How many processes there are of each kind.

    `processors`: of the one machine that all share; None: each process has its own.
    """

    api: int
    questions: int
    sandbox: int
    segworker: int
    store: int = 1
    processors: int | None = None

    @classmethod
    def of(cls, workers: int, shards: int, costs: Mapping[str, float]) -> Deployment:
        """Workers, a processor each, shared out by what each kind of process costs; a question process waits a lot."""
        kinds = ("api", "questions", "sandbox", "segworker")
        whole = sum(costs[kind] for kind in kinds)
        share = {kind: max(1, math.ceil(workers * costs[kind] / whole)) for kind in kinds}
        share["questions"] = max(2, math.ceil(share["questions"] * whole / costs["questions"]))
        return cls(**share, store=shards)


@dataclass(frozen=True, slots=True)
class Simulated:
    """What came of it: times in seconds, the share of time in which the servers of each kind worked."""

    per_s: float
    p50_s: float
    p99_s: float
    used: dict[str, float]


def simulate(
    costs: Mapping[str, float], deployment: Deployment, rate_per_s: float | None, clients: int = 0, seed: int = 1
) -> Simulated:
    """Runs questions that come at random at a rate, or from clients that ask again once they are answered.

    `costs` are seconds of processor time for one question by kind of process; each step's time is exponential.
    """
    run = _Run(costs, deployment, clients > 0, random.Random(seed))  # noqa: S311 - a simulation
    come = 0.0
    for _ in range(clients or QUESTIONS_SIMULATED):
        come += run.rng.expovariate(rate_per_s) if rate_per_s else 0.0
        run.schedule(come, "new")
    while run.events and len(run.taken) < QUESTIONS_SIMULATED:
        run.next()
    ranked = sorted(run.taken[len(run.taken) // 10 :])
    used = {name: round(server.busy_s / (run.now * server.count), 2) for name, server in run.kinds.items()}
    return Simulated(len(run.taken) / run.now, ranked[len(ranked) // 2], ranked[int(len(ranked) * 0.99)], used)


Step = tuple[str, float]


@dataclass(slots=True)
class Job:
    """A question under way: the steps that are left, and when it came."""

    steps: Iterator[Step]
    came: float


class _Run:
    """Events in the order of their time."""

    def __init__(self, costs: Mapping[str, float], deployment: Deployment, again: bool, rng: random.Random) -> None:
        self.rng = rng
        self.now = 0.0
        self.taken: list[float] = []
        self.kinds = {name: Servers(getattr(deployment, name)) for name in ("api", "sandbox", "segworker", "store")}
        self.events: list[tuple[float, int, str, Servers | None, Job | None]] = []
        self._costs = costs
        self._again = again  # closed loop
        self._holders = Servers(deployment.questions)
        self._processors = Servers(deployment.processors) if deployment.processors else None
        self._tickets = 0

    def schedule(self, when: float, what: str, server: Servers | None = None, job: Job | None = None) -> None:
        """Has something happen."""
        self._tickets += 1
        heapq.heappush(self.events, (when, self._tickets, what, server, job))

    def next(self) -> None:
        """What happens next."""
        self.now, _, what, server, job = heapq.heappop(self.events)
        if what == "off" and self._processors is not None:
            self._processors.free += 1
            if self._processors.waiting:
                self._on_processor(*self._processors.waiting.popleft())
        if server is not None and server is not self._holders:
            server.free += 1
            if server.waiting:
                self._begin(server, *server.waiting.popleft())
        self._advance(job or Job(self._question(), self.now))

    def _question(self) -> Iterator[Step]:
        yield self._step("api", 0.6)
        yield self._step("store", 0.3)
        yield "hold", 0.0
        yield self._step("store", 0.2)
        yield self._step("questions", 0.7)
        for _ in range(2):  # readings are grounded, then the program calls
            yield self._step("store", 0.15)
            yield self._step("segworker", 0.5)
        yield self._step("sandbox", 1.0)
        yield self._step("questions", 0.3)
        yield self._step("store", 0.2)
        yield "release", 0.0
        yield self._step("api", 0.4)

    def _step(self, kind: str, share: float) -> Step:
        return kind, self.rng.expovariate(1 / (self._costs[kind] * share))

    def _advance(self, job: Job) -> None:
        """Goes on until the question waits for something, or has its answer."""
        for kind, seconds in job.steps:
            if kind == "release":
                self._release()
            elif kind == "hold":
                if not self._holders.free:
                    self._holders.waiting.append(job)
                    return
                self._holders.free -= 1
            elif kind == "questions":  # in the process that it holds
                self._on_processor(self._holders, job, seconds)
                return
            else:
                server = self.kinds[kind]
                if server.free:
                    self._begin(server, job, seconds)
                else:
                    server.waiting.append((job, seconds))
                return
        self.taken.append(self.now - job.came)
        if self._again:
            self.schedule(self.now, "new")

    def _release(self) -> None:
        if self._holders.waiting:
            self.schedule(self.now, "go", None, self._holders.waiting.popleft())
        else:
            self._holders.free += 1

    def _begin(self, server: Servers, job: Job, seconds: float) -> None:
        server.free -= 1
        server.busy_s += seconds
        self._on_processor(server, job, seconds)

    def _on_processor(self, server: Servers, job: Job, seconds: float) -> None:
        """A process that has its turn takes a processor; on machines of their own each has one."""
        if self._processors is None:
            self.schedule(self.now + seconds, "done", server, job)
        elif self._processors.free:
            self._processors.free -= 1
            self.schedule(self.now + seconds, "off", server, job)
        else:
            self._processors.waiting.append((server, job, seconds))


def measured(workers: int, seconds: float) -> dict[str, Any]:
    """A service with so many workers, asked by clients without a pause: rate, times, processor time by process."""
    with tempfile.TemporaryDirectory(prefix="querycad-scaling-") as folder:
        home = Path(folder) / "home"
        with running(home, workers) as service, Client(service.url) as client:
            used = _used(service, "querycad_segworker.worker", "ingest")
            start = time.monotonic()
            model = known(client, FILE)
            read = {
                "wall_s": time.monotonic() - start,
                "cpu_s": _used(service, *("querycad_segworker.worker", "ingest")) - used,
            }
            kept = sum(path.stat().st_size for path in (home / "models").rglob("*") if path.is_file())
            before = {name: _used(service, *which) for name, which in PARTS.items()}
            log_before = _log_bytes(home)
            deadline = time.monotonic() + seconds

            def ask(_: int) -> list[float]:
                taken: list[float] = []
                with Client(service.url) as own:
                    while time.monotonic() < deadline:
                        begun = time.monotonic()
                        own.ask(model, QUESTIONS[len(taken) % len(QUESTIONS)])
                        taken.append(time.monotonic() - begun)
                return taken

            begun = time.monotonic()
            with ThreadPoolExecutor(CLIENTS) as pool:
                taken = sorted(each for some in pool.map(ask, range(CLIENTS)) for each in some)
            wall = time.monotonic() - begun
            spent = {name: _used(service, *which) - before[name] for name, which in PARTS.items()}
            return {
                "workers": workers,
                "questions": len(taken),
                "per_s": round(len(taken) / wall, 1),
                "p50_s": round(taken[len(taken) // 2], 3),
                "p99_s": round(taken[int(len(taken) * 0.99)], 3),
                "load": round(os.getloadavg()[0], 1),
                "processors_got": round(sum(spent.values()) / wall, 2),
                "cpu_s": {name: round(each / len(taken), 5) for name, each in spent.items()},
                "store_bytes": round((_log_bytes(home) - log_before) / len(taken)),
                "file": {
                    "bytes": FILE.stat().st_size,
                    "kept_bytes": kept,
                    **{name: round(each, 2) for name, each in read.items()},
                },
            }


def _used(service: Service, module: str, queue: str) -> float:
    """Seconds of processor time of a child and what it has started, those that have ended included."""
    child = psutil.Process(service.pid(module, queue))
    whole = [child, *child.children(recursive=True)]
    total = 0.0
    for process in whole:
        try:
            times = process.cpu_times()
        except psutil.Error:
            continue
        total += times.user + times.system + times.children_user + times.children_system
    return total


def _log_bytes(home: Path) -> int:
    """What the store has written: every change is on its log."""
    return sum(path.stat().st_size for path in (home / "store").rglob("*") if path.is_file())


def main() -> None:
    """Measures, checks the simulation, and simulates what is not here."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=30.0, help="of each measurement")
    parser.add_argument("--out", type=Path, default=Path("build/scaling.json"))
    asked = parser.parse_args()
    real = [measured(workers, asked.seconds) for workers in (1, 2)]
    costs = real[0]["cpu_s"]
    checked = []
    for one in real:
        found = _here(one)
        checked.append({"workers": one["workers"], **_told(found)})
    rows = []
    for workers in (1, 2, 10, 100, 1_000, 10_000):
        most = LOAD * workers / sum(cost for name, cost in costs.items() if name != "store")
        rate = min(FASTEST, most)
        for shards in sorted({1, max(1, round(rate * costs["store"] / UTILISED + 0.5))}):
            found = simulate(costs, Deployment.of(workers, shards, costs), rate)
            rows.append({"workers": workers, "shards": shards, "offered_per_s": round(rate, 1), **_told(found)})
    report = {"measured": real, "simulated here": checked, "simulated": rows}
    asked.out.parent.mkdir(parents=True, exist_ok=True)
    asked.out.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    sys.stdout.write(json.dumps(report, indent=1) + "\n")


def _here(one: Mapping[str, Any]) -> Simulated:
    """What the simulation says of a measurement on this machine, whose processors others use, too.

    Where more want a processor than there are, each gets its share of the time: a step takes so much longer.
    """
    processors = psutil.cpu_count() or 1
    slower = max(1.0, one["load"] / processors)
    costs = {name: cost * slower for name, cost in one["cpu_s"].items()}
    alone = processors if slower == 1.0 else None
    return simulate(costs, Deployment(1, one["workers"] + 1, 2, one["workers"], 1, alone), None, CLIENTS)


def _told(found: Simulated) -> dict[str, Any]:
    times = {"p50_s": round(found.p50_s, 3), "p99_s": round(found.p99_s, 3)}
    return {"per_s": round(found.per_s, 1), **times, "used": found.used}


if __name__ == "__main__":
    main()
