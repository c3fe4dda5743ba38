"""Has the score fallen? The recorded floor, the trend, and the summary of a run that is committed."""

from __future__ import annotations

import datetime
from collections.abc import Sequence
from pathlib import Path

from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError

from .failures import FailureClass
from .items import BadBenchmark
from .results import Result, Results, counts


class Count(BaseModel):
    """How many questions of a set are right."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    questions: int
    strict: int
    tolerant: int


class Fall(BaseModel):
    """A set that is below its floor."""

    model_config = ConfigDict(frozen=True)

    benchmark: str
    set: str
    floor: Count
    now: Count

    def __str__(self) -> str:
        return (
            f"{self.benchmark}, {self.set}: {self.now.strict} strict and {self.now.tolerant} tolerant of "
            f"{self.now.questions}; the floor is {self.floor.strict} and {self.floor.tolerant} "
            f"of {self.floor.questions}"
        )


class Summary(BaseModel):
    """One run in small: what the trend and the committed results hold."""

    model_config = ConfigDict(frozen=True)

    date: datetime.date
    codegen: str
    scores: dict[str, dict[str, Count]]
    """By benchmark and set."""
    failures: dict[str, dict[FailureClass, int]]
    """By benchmark, wrong answers by class."""
    wrong: dict[str, tuple[str, ...]]
    """By benchmark, the keys of the answers that are wrong within tolerance."""


_Floor = dict[str, dict[str, Count]]
_FLOOR: TypeAdapter[_Floor] = TypeAdapter(_Floor)


def by_set(results: Sequence[Result]) -> dict[str, Count]:
    """How many are right in each set?"""
    found = {}
    for name in sorted({result.set for result in results}):
        questions, strict, tolerant = counts(result for result in results if result.set == name)
        found[name] = Count(questions=questions, strict=strict, tolerant=tolerant)
    return found


def read_floor(path: Path) -> _Floor:
    """Which floor is recorded, by benchmark and set? Empty without a file. Raises BadBenchmark."""
    if not path.is_file():
        return {}
    try:
        return _FLOOR.validate_json(path.read_bytes())
    except ValidationError as error:
        raise BadBenchmark(f"{path}: {error}") from error


def falls(runs: Sequence[Results], floor: _Floor) -> tuple[Fall, ...]:
    """Which sets have fewer right answers than recorded, by either rule? A set that was not run has none."""
    found = []
    for run in runs:
        now = by_set(run.results)
        for name, least in floor.get(run.benchmark, {}).items():
            count = now.get(name, Count(questions=0, strict=0, tolerant=0))
            if count.strict < least.strict or count.tolerant < least.tolerant:
                found.append(Fall(benchmark=run.benchmark, set=name, floor=least, now=count))
    return tuple(found)


def summary(runs: Sequence[Results], date: datetime.date) -> Summary:
    """The runs in small."""
    wrong = {run.benchmark: [result for result in run.results if not result.tolerant] for run in runs}
    return Summary(
        date=date,
        codegen=", ".join(dict.fromkeys(run.options.codegen for run in runs if run.options)),
        scores={run.benchmark: by_set(run.results) for run in runs},
        failures={
            name: {failure: n for failure in FailureClass if (n := sum(r.failure is failure for r in results))}
            for name, results in wrong.items()
        },
        wrong={name: tuple(result.key for result in results) for name, results in wrong.items()},
    )


def record(runs: Sequence[Results], folder: Path, date: datetime.date) -> tuple[Path, ...]:
    """Keeps the run in `folder`: a line of `trend.jsonl`, `results-<date>.json`, the floor raised where it is higher.

    Returns the paths written. The floor never sinks by itself: who wants it lower edits it, and says why.
    """
    found = summary(runs, date)
    trend, kept, floor = folder / "trend.jsonl", folder / f"results-{date.isoformat()}.json", folder / "floor.json"
    with trend.open("a", encoding="utf-8") as stream:
        stream.write(found.model_dump_json(include={"date", "codegen", "scores"}) + "\n")
    kept.write_text(found.model_dump_json(indent=1) + "\n", encoding="utf-8")
    raised = _raised(read_floor(floor), found.scores)
    floor.write_bytes(_FLOOR.dump_json(raised, indent=1) + b"\n")
    return trend, kept, floor


def _raised(floor: _Floor, scores: _Floor) -> _Floor:
    merged = {name: dict(sets) for name, sets in floor.items()}
    for name, sets in scores.items():
        for set_name, now in sets.items():
            least = merged.setdefault(name, {}).get(set_name, now)
            merged[name][set_name] = Count(
                questions=now.questions,
                strict=max(least.strict, now.strict),
                tolerant=max(least.tolerant, now.tolerant),
            )
    return merged
