"""Answers that another system gave elsewhere, to be scored: a folder, or one file.

A folder has the layout of the questions: `<set>/<id>/answers.txt`, one Python literal in SI units a line, an empty line
where there is none. A file is one JSON object from the question's key, such as "abc/00000013/0", to the literal as
text, to a plain JSON value, or to null. `results.json` of a run is read too, and scored anew.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from .failures import Override
from .items import BadBenchmark, Benchmark, Item, literal
from .results import Result, Results, load_results, overruled, result_of
from .systems import Reply


def score_answers(benchmark: Benchmark, answers: Path, overrides: Mapping[str, Override]) -> Results:
    """How many of these answers are right? A question without one is wrong. Raises BadBenchmark."""
    items = benchmark.items
    given = _from_folder(answers, items) if answers.is_dir() else _from_file(answers)
    unknown = sorted(set(given) - {item.key for item in items})
    if unknown:
        raise BadBenchmark(f"{answers}: there is no question {unknown[0]}")
    return Results(
        benchmark=benchmark.name, results=tuple(_scored(item, given.get(item.key), overrides) for item in items)
    )


def _scored(item: Item, given: str | Result | None, overrides: Mapping[str, Override]) -> Result:
    if not isinstance(given, Result):
        return result_of(item, _reply(given), overrides)
    again = result_of(item, replace(_reply(given.answer), type=given.type), overrides)
    failure = None if again.tolerant else given.failure or again.failure
    update = {"label": again.label, "strict": again.strict, "tolerant": again.tolerant, "failure": failure}
    return overruled(given.model_copy(update=update), overrides)


def _reply(answer: str | None) -> Reply:
    if answer is None or not answer.strip():
        return Reply()
    try:
        return Reply(value=literal(answer))
    except ValueError as error:
        return Reply(failure="program", message=str(error))


def _from_folder(folder: Path, items: Sequence[Item]) -> dict[str, str | Result | None]:
    given: dict[str, str | Result | None] = {}
    for set_name, model in dict.fromkeys((item.set, item.id) for item in items):
        path = folder / set_name / model / "answers.txt"
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        given.update({f"{set_name}/{model}/{index}": line for index, line in enumerate(lines)})
    if not given:
        raise BadBenchmark(f"{folder}: no <set>/<id>/answers.txt for any of the questions")
    return given


def _from_file(path: Path) -> dict[str, str | Result | None]:
    try:
        read: Any = json.loads(path.read_bytes())
    except OSError as error:
        raise BadBenchmark(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise BadBenchmark(f"{path}: no JSON: {error}") from error
    if not isinstance(read, dict):
        raise BadBenchmark(f"{path}: no JSON object from question to answer")
    if "results" in read:
        return {result.key: result for result in load_results(path).results}
    return {key: value if isinstance(value, str) or value is None else repr(value) for key, value in read.items()}
