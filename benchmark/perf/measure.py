"""How fast is it? Every measurement stands beside its baseline, taken in the same run on the same machine."""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel, ConfigDict
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from benchmark.scoring.items import BadBenchmark
from querycad.runtime import EmbeddedRuntime
from querycad_sandbox import Sandbox
from querycad_segworker.errors import FileProblem
from querycad_segworker.local import LocalPartFinder

from .figures import QUESTIONS, Measurement, NotMeasured, Series, percentile, times_ms
from .ingest import Readings, ingest_measurements, memory_measurements
from .recognition import growth_measurements, recognition_measurements
from .sandbox import EMPTY_PROGRAM, sandbox_measurements
from .vision import vision_measurements
from .workers import workers_measurements


class PartMeasurements(BaseModel):
    """The figures of one part. `left_out` says why there are none, or not all."""

    model_config = ConfigDict(frozen=True)

    name: str
    measurements: tuple[Measurement, ...]
    series: tuple[Series, ...] = ()
    left_out: str = ""
    seconds: float = 0.0


class Measurements(BaseModel):
    """All figures of one run."""

    model_config = ConfigDict(frozen=True)

    python: str
    parts: tuple[PartMeasurements, ...]

    @property
    def measurements(self) -> tuple[Measurement, ...]:
        """The figures of all parts."""
        return tuple(one for part in self.parts for one in part.measurements)


@dataclass(frozen=True, slots=True)
class PerfOptions:
    """What is measured, and how often. `limit_s`: after it no further figure is begun."""

    models: tuple[Path, ...]
    questions: int = 200
    repeat: int = 3
    only: tuple[str, ...] = ()
    limit_s: float = 600.0


@dataclass(frozen=True, slots=True)
class _Run:
    """What the parts share."""

    options: PerfOptions
    scratch: Path
    readings: Readings


def measure(options: PerfOptions, progress: Callable[[str], None] = lambda _: None) -> Measurements:
    """All figures, or those of the parts in `only`. `progress` is told which part is being measured.

    Raises BadBenchmark when a model cannot be read, or there is no such part.
    """
    unknown = next((name for name in options.only if name not in PARTS), None)
    if unknown is not None:
        raise BadBenchmark(f"there is no part {unknown!r}; there are: {', '.join(PARTS)}")
    deadline = time.monotonic() + options.limit_s
    with tempfile.TemporaryDirectory(prefix="querycad-perf-") as folder:
        run = _Run(options, Path(folder), Readings(options.models, options.repeat, Path(folder)))
        found = [_part(name, run, deadline, progress) for name in options.only or PARTS]
    return Measurements(python=sys.version.split()[0], parts=tuple(found))


def _part(name: str, run: _Run, deadline: float, progress: Callable[[str], None]) -> PartMeasurements:
    measurements: list[Measurement] = []
    series: list[Series] = []
    left_out, start = "", time.monotonic()
    try:
        if start > deadline:
            raise NotMeasured(f"the time was up ({run.options.limit_s:.0f} s)")
        progress(name)
        for one in PARTS[name](run):
            if isinstance(one, Series):
                series.append(one)
            else:
                measurements.append(one)
            if time.monotonic() > deadline:
                raise NotMeasured(f"stopped: the time was up ({run.options.limit_s:.0f} s)")
    except NotMeasured as reason:
        left_out = str(reason)
    return PartMeasurements(
        name=name,
        measurements=tuple(measurements),
        series=tuple(series),
        left_out=left_out,
        seconds=round(time.monotonic() - start, 1),
    )


def _questions(run: _Run) -> Iterator[Measurement]:
    """A question on a known model, against the sandbox's run of an empty program."""
    model, count = run.options.models[0], run.options.questions
    sandbox = Sandbox(workers=1)
    with EmbeddedRuntime(run.scratch / "models", sandbox) as runtime:
        finder = _known(runtime, model)
        for question in QUESTIONS:
            runtime.ask(model, question)
        asked = times_ms(lambda i: runtime.ask(model, QUESTIONS[i % len(QUESTIONS)]), count)
        empty = times_ms(lambda _: sandbox.run(EMPTY_PROGRAM, finder), count)
    for share, limit_ms in ((50, 50.0), (99, None)):
        value = percentile(asked, share)
        yield Measurement(
            name=f"question on a known model, p{share}",
            value=value,
            unit="ms",
            baseline_name="empty program in the sandbox",
            baseline=percentile(empty, share),
            limit=f"under {limit_ms:g} ms" if limit_ms else "",
            holds=value < limit_ms if limit_ms else None,
        )
    yield Measurement(
        name="questions a second, one after the other",
        value=1e3 * len(asked) / sum(asked),
        unit="1/s",
        baseline_name="empty programs in the sandbox",
        baseline=1e3 * len(empty) / sum(empty),
    )


def _rendering(run: _Run) -> Iterator[Measurement]:
    """Rendering and aligning, networks apart, against casting every pixel's ray."""
    with EmbeddedRuntime(run.scratch / "models") as runtime:
        known = [(model.stem, _known(runtime, model).artefacts) for model in run.options.models]
    yield from vision_measurements(known, run.options.repeat)


def _known(runtime: EmbeddedRuntime, model: Path) -> LocalPartFinder:
    """The model, read now, so that no question is measured that waits for it."""
    try:
        return runtime.model(model)
    except FileProblem as problem:
        raise BadBenchmark(f"{model}: {problem}") from problem


PARTS: dict[str, Callable[[_Run], Iterator[Measurement | Series]]] = {
    "questions": _questions,
    "sandbox": lambda run: sandbox_measurements(5 * run.options.questions),
    "ingest": lambda run: ingest_measurements(run.readings),
    "memory": lambda run: memory_measurements(run.readings),
    "recognition": lambda run: recognition_measurements(run.options.models, run.readings),
    "rendering": _rendering,
    "faces": lambda _: growth_measurements(),
    "workers": lambda run: workers_measurements(run.options.models[0], run.scratch),
}
"""What can be measured, in the order of the table: what users wait for first."""


def print_measurements(found: Measurements, console: Console) -> None:
    """The figures as a table."""
    table = Table("what", title=f"speed, Python {found.python}", title_justify="left")
    for name in ("value", "baseline", "ratio"):
        table.add_column(name, justify="right")
    table.add_column("baseline is")
    table.add_column("to hold")
    for part in found.parts:
        for one in part.measurements:
            holds = "" if one.holds is None else " [green]yes[/green]" if one.holds else " [red]no[/red]"
            numbers = (_number(one.value, one.unit), _number(one.baseline, one.unit), f"{one.ratio:.2f}")
            table.add_row(escape(one.name), *numbers, escape(one.baseline_name), escape(one.limit) + holds)
        if part.left_out:
            table.add_row(f"[red]{part.name}[/red]", "–", "–", "–", f"not measured: {escape(part.left_out)}", "")
        table.add_section()
    console.print(table)


def _number(value: float, unit: str) -> str:
    return f"{value:.3g} {unit}" if value < 100 else f"{value:.0f} {unit}"
