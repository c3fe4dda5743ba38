"""What does reading a file cost? Beside the kernel's own read and tessellation, in processes of their own."""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel

from benchmark import ROOT
from benchmark.scoring.items import BadBenchmark
from querycad_segworker.model import Artefacts

from .figures import Measurement

CHILD_TIMEOUT_S = 300.0
BASELINE = "kernel's read and tessellation"
MEMORY_MIB = 1024


class Child(BaseModel):
    """What `perf_child` prints."""

    seconds: float
    cpu_seconds: float
    memory_bytes: int


@dataclass(frozen=True, slots=True)
class Reading:
    """Both ways of one file: median seconds, largest memory in MiB; and seconds of ingest's stages."""

    name: str
    ingest_s: float
    kernel_s: float
    ingest_cpu_s: float
    kernel_cpu_s: float
    ingest_mib: float
    kernel_mib: float
    stages_s: dict[str, float]


class Readings:
    """Reads files both ways. What is measured once serves every part that asks for it."""

    def __init__(self, models: Sequence[Path], repeat: int, scratch: Path) -> None:
        self._models, self._repeat, self._scratch = models, repeat, scratch
        self._known: dict[Path, Reading] = {}

    def __iter__(self) -> Iterator[Reading]:
        """One file after the other, each when it is asked for. Raises BadBenchmark."""
        for number, model in enumerate(self._models):
            yield self.of(model, number)

    def of(self, model: Path, number: int = 0) -> Reading:
        """Both ways of this file."""
        if model not in self._known:
            self._known[model] = _read(model, self._repeat, self._scratch / f"ingest-{number}")
        return self._known[model]


def _read(model: Path, repeat: int, folder: Path) -> Reading:
    taken: dict[str, list[Child]] = {"ingest": [], "kernel": []}
    for _ in range(repeat):  # alternating, so that both see the same machine
        for what, children in taken.items():
            children.append(_child(what, model, folder))
    seconds = {what: statistics.median(child.seconds for child in children) for what, children in taken.items()}
    cpu_s = {what: statistics.median(child.cpu_seconds for child in children) for what, children in taken.items()}
    mib = {what: max(child.memory_bytes for child in children) / 2**20 for what, children in taken.items()}
    stages_s = {stage: ms / 1e3 for stage, ms in Artefacts(folder).load_model().timings_ms.items()}
    return Reading(
        name=model.stem,
        ingest_s=seconds["ingest"],
        kernel_s=seconds["kernel"],
        ingest_cpu_s=cpu_s["ingest"],
        kernel_cpu_s=cpu_s["kernel"],
        ingest_mib=mib["ingest"],
        kernel_mib=mib["kernel"],
        stages_s=stages_s,
    )


def ingest_measurements(readings: Readings) -> Iterator[Measurement]:
    """Seconds of every file, and of ingest's stages; start and imports are not counted."""
    read = []
    for one in readings:
        read.append(one)
        yield _seconds(f"ingest of {one.name}", one.ingest_s, one.kernel_s)
    if len(read) > 1:
        yield _seconds(f"ingest of {len(read)} models", sum(r.ingest_s for r in read), sum(r.kernel_s for r in read))
    yield Measurement(
        name="  processor time, which hardly depends on what else the machine does",
        value=sum(one.ingest_cpu_s for one in read),
        unit="s",
        baseline_name=BASELINE,
        baseline=sum(one.kernel_cpu_s for one in read),
    )
    stages = {stage: sum(one.stages_s.get(stage, 0.0) for one in read) for stage in read[0].stages_s}
    for stage, seconds in stages.items():
        yield Measurement(
            name=f"  stage '{stage}', all models",
            value=seconds,
            unit="s",
            baseline_name="all stages of ingest",
            baseline=sum(stages.values()),
        )


def _seconds(name: str, ingest_s: float, kernel_s: float) -> Measurement:
    return Measurement(
        name=name,
        value=ingest_s,
        unit="s",
        baseline_name=BASELINE,
        baseline=kernel_s,
        limit="under 2 x",
        holds=ingest_s < 2 * kernel_s,
    )


def memory_measurements(readings: Readings) -> Iterator[Measurement]:
    """The largest resident memory of the process that reads the file."""
    for one in readings:
        yield Measurement(
            name=f"memory of ingest, {one.name}",
            value=one.ingest_mib,
            unit="MiB",
            baseline_name=BASELINE,
            baseline=one.kernel_mib,
            limit=f"under {MEMORY_MIB} MiB",
            holds=one.ingest_mib < MEMORY_MIB,
        )


def _child(what: str, model: Path, folder: Path) -> Child:
    folder.mkdir(exist_ok=True)
    command = [sys.executable, "-m", "benchmark.perf.ingest_child", what, str(model.resolve()), str(folder.resolve())]
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=CHILD_TIMEOUT_S, check=True)
    except subprocess.CalledProcessError as error:
        last = (error.stderr.strip().splitlines() or [f"exit code {error.returncode}"])[-1]
        raise BadBenchmark(f"{model}: {what} could not be measured: {last}") from error
    except subprocess.TimeoutExpired as error:
        raise BadBenchmark(f"{model}: {what} could not be measured: {error}") from error
    outcome = folder / "outcome.json"
    problem = json.loads(outcome.read_text(encoding="utf-8")).get("message") if outcome.exists() else None
    if problem:
        raise BadBenchmark(f"{model}: {problem}")
    return Child.model_validate_json(done.stdout)
