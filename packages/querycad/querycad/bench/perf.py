"""How fast is it? Every measurement stands beside its baseline, taken in the same run on the same machine."""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel, ConfigDict, computed_field
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from querycad.runtime import EmbeddedRuntime
from querycad_sandbox import Sandbox
from querycad_segworker.errors import FileProblem
from querycad_segworker.model import Artefacts
from querycad_segworker.segcad.local import LocalSegCad

from .items import BadBenchmark

QUESTIONS = (
    "How many holes does the object have?",
    "What is the height of the object?",
    "What is the diameter of the holes?",
    "Where is the center of the largest hole?",
)
EMPTY_PROGRAM = "solution = 0"
CHILD_TIMEOUT_S = 300.0


class Measurement(BaseModel):
    """One figure and what it is measured against. `ratio` is value by baseline; `limit` says what is to be held."""

    model_config = ConfigDict(frozen=True)

    name: str
    value: float
    unit: str
    baseline_name: str
    baseline: float
    limit: str = ""
    holds: bool | None = None

    @computed_field  # type: ignore[prop-decorator]
    @property
    def ratio(self) -> float:
        """How many times the baseline is it?"""
        return self.value / self.baseline if self.baseline else float("inf")


class Measurements(BaseModel):
    """All figures of one run."""

    model_config = ConfigDict(frozen=True)

    python: str
    measurements: tuple[Measurement, ...]


@dataclass(frozen=True, slots=True)
class PerfOptions:
    """What is measured, and how often."""

    models: tuple[Path, ...]
    questions: int = 200
    repeat: int = 3


def measure(options: PerfOptions, progress: Callable[[str], None] = lambda _: None) -> Measurements:
    """All figures. `progress` is told what is being measured. Raises BadBenchmark when a model cannot be read."""
    found: list[Measurement] = []
    with tempfile.TemporaryDirectory(prefix="querycad-perf-") as scratch:
        for name, steps in (("questions", _questions), ("sandbox", _sandbox), ("ingest", _ingest)):
            progress(name)
            found.extend(steps(options, Path(scratch)))
    return Measurements(python=sys.version.split()[0], measurements=tuple(found))


def _questions(options: PerfOptions, scratch: Path) -> Iterator[Measurement]:
    """A question on a known model, against the sandbox's run of an empty program."""
    model = options.models[0]
    sandbox = Sandbox(workers=1)
    with EmbeddedRuntime(scratch / "models", sandbox) as runtime:
        segcad = _known(runtime, model)
        for question in QUESTIONS:
            runtime.ask(model, question)
        asked = _times_ms(lambda i: runtime.ask(model, QUESTIONS[i % len(QUESTIONS)]), options.questions)
        empty = _times_ms(lambda _: sandbox.run(EMPTY_PROGRAM, segcad), options.questions)
    for share, limit_ms in ((50, 50.0), (99, None)):
        value = _percentile(asked, share)
        yield Measurement(
            name=f"question on a known model, p{share}",
            value=value,
            unit="ms",
            baseline_name="empty program in the sandbox",
            baseline=_percentile(empty, share),
            limit=f"under {limit_ms:g} ms" if limit_ms else "",
            holds=value < limit_ms if limit_ms else None,
        )


def _known(runtime: EmbeddedRuntime, model: Path) -> LocalSegCad:
    """The model, read now, so that no question is measured that waits for it."""
    try:
        return runtime.model(model)
    except FileProblem as problem:
        raise BadBenchmark(f"{model}: {problem}") from problem


def _sandbox(options: PerfOptions, scratch: Path) -> Iterator[Measurement]:
    """An empty program in the sandbox, type check included, against a fresh isolated CPython."""
    with Sandbox(workers=1) as sandbox, EmbeddedRuntime(scratch / "models") as runtime:
        segcad = _known(runtime, options.models[0])
        sandbox.warm()
        sandbox.run(EMPTY_PROGRAM, segcad)
        inside = _times_ms(lambda _: sandbox.run(EMPTY_PROGRAM, segcad), options.questions)
    command = [sys.executable, "-I", "-c", EMPTY_PROGRAM]
    outside = _times_ms(lambda _: subprocess.run(command, check=True), max(options.questions // 10, 3))
    value = _percentile(inside, 50)
    yield Measurement(
        name="sandbox overhead, p50",
        value=value,
        unit="ms",
        baseline_name="python -I -c in a process",
        baseline=_percentile(outside, 50),
        limit="under 5 ms",
        holds=value < 5.0,
    )


def _ingest(options: PerfOptions, scratch: Path) -> Iterator[Measurement]:
    """Reading a file, against the kernel's own read and tessellation; start and imports are not counted in either."""
    totals = {"ingest": 0.0, "kernel": 0.0}
    stages_ms: dict[str, float] = {}
    for number, model in enumerate(options.models):
        folder = scratch / f"ingest-{number}"
        taken: dict[str, list[_Child]] = {"ingest": [], "kernel": []}
        for _ in range(options.repeat):  # alternating, so that both see the same machine
            for what, children in taken.items():
                children.append(_child(what, model, folder))
        seconds = {what: statistics.median(child.seconds for child in children) for what, children in taken.items()}
        totals = {what: totals[what] + seconds[what] for what in totals}
        for stage, ms in Artefacts(folder).load_model().timings_ms.items():
            stages_ms[stage] = stages_ms.get(stage, 0.0) + ms
        yield _ingest_measurement(f"ingest of {model.stem}", seconds)
        yield _memory_measurement(f"  its memory, {model.stem}", taken)
    if len(options.models) > 1:
        yield _ingest_measurement(f"ingest of {len(options.models)} models", totals)
    for stage, ms in stages_ms.items():
        yield Measurement(
            name=f"  stage '{stage}', all models",
            value=ms / 1e3,
            unit="s",
            baseline_name="all stages of ingest",
            baseline=sum(stages_ms.values()) / 1e3,
        )


def _memory_measurement(name: str, taken: Mapping[str, Sequence[_Child]]) -> Measurement:
    largest = {what: max(child.memory_bytes for child in children) / 2**20 for what, children in taken.items()}
    return Measurement(
        name=name,
        value=largest["ingest"],
        unit="MiB",
        baseline_name="kernel's read and tessellation",
        baseline=largest["kernel"],
        limit="under 1024 MiB",
        holds=largest["ingest"] < 1024,
    )


def _ingest_measurement(name: str, seconds: dict[str, float]) -> Measurement:
    return Measurement(
        name=name,
        value=seconds["ingest"],
        unit="s",
        baseline_name="kernel's read and tessellation",
        baseline=seconds["kernel"],
        limit="under 2 x",
        holds=seconds["ingest"] < 2 * seconds["kernel"],
    )


class _Child(BaseModel):
    """What `perf_child` prints."""

    seconds: float
    memory_bytes: int


def _child(what: str, model: Path, folder: Path) -> _Child:
    folder.mkdir(exist_ok=True)
    command = [sys.executable, "-m", "querycad.bench.perf_child", what, str(model.resolve()), str(folder)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=CHILD_TIMEOUT_S, check=True)
    except subprocess.CalledProcessError as error:
        last = (error.stderr.strip().splitlines() or [f"exit code {error.returncode}"])[-1]
        raise BadBenchmark(f"{model}: {what} could not be measured: {last}") from error
    except subprocess.TimeoutExpired as error:
        raise BadBenchmark(f"{model}: {what} could not be measured: {error}") from error
    outcome = folder / "outcome.json"
    problem = json.loads(outcome.read_text(encoding="utf-8")).get("message") if outcome.exists() else None
    if problem:
        raise BadBenchmark(f"{model}: {problem}")
    return _Child.model_validate_json(done.stdout)


def _times_ms(call: Callable[[int], object], count: int) -> list[float]:
    taken = []
    for i in range(count):
        start = time.perf_counter()
        call(i)
        taken.append((time.perf_counter() - start) * 1e3)
    return taken


def _percentile(values: Sequence[float], share: int) -> float:
    """The value that `share` per cent of the values do not exceed (nearest rank)."""
    ordered = sorted(values)
    return ordered[max(-(-share * len(ordered) // 100) - 1, 0)]


def print_measurements(found: Measurements, console: Console) -> None:
    """The figures as a table."""
    table = Table("what", title=f"speed, Python {found.python}", title_justify="left")
    for name in ("value", "baseline", "ratio"):
        table.add_column(name, justify="right")
    table.add_column("baseline is")
    table.add_column("to hold")
    for one in found.measurements:
        holds = "" if one.holds is None else " [green]yes[/green]" if one.holds else " [red]no[/red]"
        table.add_row(
            escape(one.name),
            f"{one.value:.3g} {one.unit}" if one.value < 100 else f"{one.value:.0f} {one.unit}",
            f"{one.baseline:.3g} {one.unit}" if one.baseline < 100 else f"{one.baseline:.0f} {one.unit}",
            f"{one.ratio:.2f}",
            escape(one.baseline_name),
            escape(one.limit) + holds,
        )
    console.print(table)
