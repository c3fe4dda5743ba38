"""How fast is recognition? Beside another open recogniser, and as models grow.

Each time is taken by `benchmark.recognition_speed` in a process of its own, which may crash or run out of time.
"""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path

from pydantic import BaseModel

from benchmark import ROOT

from .figures import Measurement, NotMeasured, Series
from .ingest import Readings

SCRIPT = "benchmark.recognition_speed"
OTHER = "quiddity"
FASTER = 10
MOST_FACES = 2500
"""Of the solids that grow: a minute in all on two cores; the script by itself goes to 20,000."""
MOST_EXPONENT = 1.1
"""Of n log n: what is left for small models, whose time does not grow, and for a busy machine."""
TIMEOUT_S = 400.0


class Run(BaseModel):
    """What the script says of a file; `failure` is empty when the recogniser came through."""

    seconds: float = math.nan
    faces: int = 0
    failure: str = ""


class Growth(BaseModel):
    """What the script says of solids that grow: the exponent of n log n that fits best."""

    runs: tuple[Run, ...]
    exponent: float


def recognition_measurements(models: Sequence[Path], readings: Readings) -> Iterator[Measurement]:
    """Processor seconds of every file, beside the other recogniser's; beside the kernel's reading where it is absent.

    Raises NotMeasured where the script fails.
    """
    is_there = find_spec(OTHER) is not None
    ours, theirs, through = 0.0, 0.0, 0
    for number, model in enumerate(models):
        own = _run("querycad", model)
        if own.failure:
            raise NotMeasured(f"{model}: {own.failure}")
        other = _run(OTHER, model) if is_there else Run(seconds=readings.of(model, number).kernel_s)
        if other.failure:
            continue
        ours, theirs, through = ours + own.seconds, theirs + other.seconds, through + 1
        yield _faster(f"recognition of {model.stem}", own.seconds, other.seconds, is_there)
    if through:
        yield _faster(f"recognition of {through} models", ours, theirs, is_there)
    if is_there:
        yield Measurement(
            name="models that recognition came through",
            value=len(models),
            unit="",
            baseline_name=OTHER,
            baseline=through,
            limit="all",
            holds=True,
        )


def _faster(name: str, ours_s: float, theirs_s: float, is_other: bool) -> Measurement:
    return Measurement(
        name=name,
        value=ours_s,
        unit="s",
        baseline_name=OTHER if is_other else "kernel's read and tessellation",
        baseline=theirs_s,
        limit=f"{FASTER} x faster" if is_other else "",
        holds=FASTER * ours_s <= theirs_s if is_other else None,
    )


def _run(system: str, model: Path) -> Run:
    return Run.model_validate_json(_script("time", system, str(model.resolve())))


def growth_measurements() -> Iterator[Measurement | Series]:
    """Recognition of one solid of a growing number of faces. Raises NotMeasured."""
    found = Growth.model_validate_json(_script("scaling", "--most", str(MOST_FACES), "--json"))
    runs = [run for run in found.runs if not run.failure]
    if len(runs) < len(found.runs) or len(runs) < 2:
        raise NotMeasured("; ".join(run.failure for run in found.runs if run.failure) or "too few sizes")
    first = runs[0]
    scale = first.seconds / (first.faces * math.log(first.faces))
    expected = [scale * run.faces * math.log(run.faces) for run in runs]
    for run, baseline in zip(runs, expected, strict=True):
        yield Measurement(
            name=f"recognition of {run.faces} faces",
            value=run.seconds,
            unit="s",
            baseline_name=f"n log n from {first.faces} faces",
            baseline=baseline,
        )
    yield Measurement(
        name="exponent of n log n that fits",
        value=found.exponent,
        unit="",
        baseline_name="n log n",
        baseline=1.0,
        limit=f"under {MOST_EXPONENT:g}",
        holds=found.exponent < MOST_EXPONENT,
    )
    yield Series(
        name="recognition as models grow",
        x_name="faces",
        y_name="processor seconds",
        x=tuple(run.faces for run in runs),
        y=tuple(run.seconds for run in runs),
        expected_name="n log n from the smallest",
        expected=tuple(expected),
        is_logarithmic=True,
    )


def _script(*arguments: str) -> str:
    """The last line that the script prints, a JSON object. Raises NotMeasured."""
    command = [sys.executable, "-m", SCRIPT, *arguments]
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=TIMEOUT_S, check=True)
        return done.stdout.strip().splitlines()[-1]
    except subprocess.CalledProcessError as error:
        last = (error.stderr.strip().splitlines() or [f"exit code {error.returncode}"])[-1]
        raise NotMeasured(f"{SCRIPT}: {last}") from error
    except subprocess.TimeoutExpired as error:
        raise NotMeasured(f"{SCRIPT} did not end within {TIMEOUT_S:.0f} s") from error
