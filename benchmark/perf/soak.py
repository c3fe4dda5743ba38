"""Does the service stay as it is under hours of mixed work? `make soak MINUTES=20`.

Clients ask, upload, look, list, delete, and send what is no CAD file, without a pause. Told are the latencies of each
kind of request, what was not as it should be, and how memory, handles and disk of the service grow, as slopes of lines
that fit the time after the first fifth: what a process takes once, when it does something for the first time, is no
growth. Nor is what is taken while a file is read: of each minute the least counts.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import os
import random
import statistics
import sys
import tempfile
import threading
import time
from collections import Counter, defaultdict
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import psutil

from querycad.client import Client, ClientError, ServerProblem
from querycad_contracts import ModelStatus, Status, ViewName

from .service_processes import Service, running

MODELS = tuple(Path("examples") / f"{name}.step" for name in ("flange", "bracket", "sheet_metal"))
QUESTIONS = (
    "How many holes does the object have?",
    "What is the height of the object?",
    "What is the diameter of the largest hole?",
    "Where is the center of the largest hole?",
    "What is the distance between the two largest holes?",
)
READ_S = 180.0
SAMPLE_S = 5.0
WARM = 0.2
SHARES = {"question": 80, "view": 8, "upload": 5, "list": 5, "no file": 2}
ANSWERS = 1000
"""Kept of a tenant meanwhile: as many are there after some minutes, and the store is then as large as it gets."""


class Soak:
    """Clients that work, and what came of it."""

    def __init__(self, service: Service, models: Sequence[tuple[str, Path]], until: float) -> None:
        self._service = service
        self._models = models
        self._until = until
        self._lock = threading.Lock()
        self.taken_s: dict[str, list[float]] = defaultdict(list)
        self.ends: Counter[str] = Counter()

    def work(self, seed: int) -> None:
        """One client, until the time is up."""
        rng = random.Random(seed)  # noqa: S311 - a load that can be repeated
        with Client(self._service.url) as client:
            while time.monotonic() < self._until:
                (kind,) = rng.choices([*SHARES], [*SHARES.values()])
                start = time.monotonic()
                try:
                    end = self._do(client, kind, rng)
                except (ClientError, TimeoutError, OSError) as error:
                    end = f"{type(error).__name__}: {error}"[:120]
                with self._lock:
                    self.taken_s[kind].append(time.monotonic() - start)
                    self.ends[f"{kind}: {end}"] += 1

    def _do(self, client: Client, kind: str, rng: random.Random) -> str:
        model, file = rng.choice(self._models)
        if kind == "question":
            status = client.ask(model, rng.choice(QUESTIONS)).status
            return "done" if status in (Status.ANSWERED, Status.UNSURE) else status.value
        if kind == "view":
            client.view(model, rng.choice(list(ViewName)), width=rng.randrange(100, 600), height=400)
        elif kind == "list":
            client.parts(model)
        elif kind == "no file":
            try:
                self._bad(client)
            except ServerProblem:
                return "done"
            return "accepted"
        else:
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "new.step"
                path.write_bytes(file.read_bytes() + b"/* %d */\n" % rng.getrandbits(64))
                found = client.upload(path, READ_S)
                client.delete(found.id)
                return "done" if found.status is ModelStatus.READY else found.status.value
        return "done"

    def _bad(self, client: Client) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "no.step"
            path.write_bytes(b"solid is no STEP file")
            client.upload(path, READ_S)


def sample(service: Service, home: Path) -> dict[str, float]:
    """Memory (shared pages counted once), handles and processes of the whole service, and what lies in its folder.

    Memory is told of each part, too: the store fills until it has as many answers as are kept.
    """
    handles = count = 0
    memory: dict[str, float] = defaultdict(float)
    for child in psutil.Process(service.main_pid).children():
        with contextlib.suppress(psutil.Error):
            part = f"{part_of(child)}_mib"
            for process in (child, *child.children(recursive=True)):
                memory[part] += process.memory_full_info().pss / 2**20
                handles, count = handles + process.num_fds(), count + 1
    stored = 0
    for folder, _, names in os.walk(home):  # which passes over what is gone meanwhile
        for name in names:
            with contextlib.suppress(OSError):
                stored += (Path(folder) / name).stat().st_size
    whole = {"memory_mib": sum(memory.values()), "handles": handles, "processes": count, "home_mib": stored / 2**20}
    return {**whole, **memory}


def part_of(process: psutil.Process) -> str:
    """Which part of the service is this? Its module without the package's name, a segworker by its queues."""
    line = process.cmdline()
    module = next((each for each in line if each.startswith("querycad_")), "store")
    queues = process.environ().get("QUERYCAD_SEGWORKER_QUEUES", "") if "segworker" in module else ""
    return queues or module.removeprefix("querycad_")


def report(soak: Soak, samples: list[tuple[float, dict[str, float]]], minutes: float) -> dict[str, Any]:
    """The figures, as they are committed."""
    done = sum(count for end, count in soak.ends.items() if end.endswith(": done"))
    total = sum(soak.ends.values())
    steady = samples[int(len(samples) * WARM) :]
    slopes = {f"{name} an hour": round(slope(steady, name) * 3600, 1) for name in steady[-1][1]}
    return {
        "minutes": round(minutes, 1),
        "load of the machine": [round(each, 1) for each in os.getloadavg()],
        "requests": total,
        "not as they should be": {end: count for end, count in soak.ends.items() if not end.endswith(": done")},
        "error rate": round(1 - done / total, 5),
        "latency_ms": {kind: percentiles(taken) for kind, taken in sorted(soak.taken_s.items())},
        "first": {name: round(value, 1) for name, value in steady[0][1].items()},
        "last": {name: round(value, 1) for name, value in steady[-1][1].items()},
        "slopes": slopes,
    }


def slope(samples: Sequence[tuple[float, dict[str, float]]], name: str) -> float:
    """By how much does the least of a minute grow in a second? A process that reads a file is gone in seconds."""
    least: dict[int, float] = {}
    for at, one in samples:
        minute = int(at // 60)
        least[minute] = min(one.get(name, 0.0), least.get(minute, math.inf))
    if len(least) < 2:
        return 0.0
    return statistics.linear_regression([60.0 * minute for minute in least], [*least.values()]).slope


def percentiles(taken_s: Sequence[float]) -> dict[str, float]:
    """In milliseconds."""
    ranked = sorted(taken_s)
    shares = {"p50": 0.5, "p90": 0.9, "p99": 0.99, "most": 1.0}
    found = {name: ranked[min(len(ranked) - 1, int(len(ranked) * share))] for name, share in shares.items()}
    return {"count": len(ranked)} | {name: round(value * 1e3, 1) for name, value in found.items()}


def main() -> None:
    """Runs a service and the clients, and writes the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=20.0)
    parser.add_argument("--clients", type=int, default=4)
    parser.add_argument("--out", type=Path, default=Path("build/soak.json"))
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="querycad-soak-") as folder:
        home = Path(folder) / "home"
        with running(home, settings={"QUERYCAD_TENANT_ANSWERS": str(ANSWERS)}) as service:
            with Client(service.url) as client:
                models = [(client.upload(file, READ_S).id, file) for file in MODELS]
            start = time.monotonic()
            soak = Soak(service, models, start + asked.minutes * 60)
            samples: list[tuple[float, dict[str, float]]] = []
            with ThreadPoolExecutor(asked.clients) as pool:
                working = [pool.submit(soak.work, seed) for seed in range(asked.clients)]
                while not all(each.done() for each in working):
                    samples.append((time.monotonic() - start, sample(service, home)))
                    time.sleep(SAMPLE_S)
                for each in working:
                    each.result()
            found = report(soak, samples, (time.monotonic() - start) / 60)
    asked.out.parent.mkdir(parents=True, exist_ok=True)
    asked.out.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    sys.stdout.write(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
