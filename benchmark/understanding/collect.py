"""The candidates of every question, with features and whether their value is right: what the weights are fitted on."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from itertools import groupby, islice
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from querycad_answering.affinity import MOST_WAYS, Affinity
from querycad_answering.candidates import absences, candidates, with_value
from querycad_answering.part_traits import part_traits
from querycad_contracts import Grounded, Part, PartQuery, RunOutcome, RunStatus
from querycad_language.readings.reader import Reader
from querycad_sandbox import Sandbox
from querycad_segworker.errors import FileProblem
from querycad_segworker.grounding.names import vocabulary
from querycad_segworker.ingest import ingest
from querycad_segworker.local import LocalPartFinder
from querycad_segworker.model import ModelStore

from .data import MISSING, Question, is_right

LIMIT = 12
"""Candidates of a question that are run for fitting; more than for an answer, so that weights see what was wrong."""


@dataclass(frozen=True, slots=True)
class Tried:
    """One candidate of a question."""

    features: dict[str, float]
    value: Any
    right: bool
    code: str
    absent: bool = False
    """Is it the reading of a part that the model lacks? Then there is nothing to run, and that is the answer."""
    parts: tuple[tuple[str, ...], ...] = ()
    """The traits of the parts of each query, as the product looks at them."""


@dataclass(frozen=True, slots=True)
class Row:
    """A question with its candidates."""

    question: Question
    tried: tuple[Tried, ...]


_ROWS = TypeAdapter(list[Row])


def collect(asked: Sequence[Question], store: Path, jobs: int = 2) -> list[Row]:
    """The candidates of all questions, model by model."""
    ordered = sorted(asked, key=lambda one: str(one.file))
    groups = [list(group) for _, group in groupby(ordered, key=lambda one: str(one.file))]
    with ProcessPoolExecutor(jobs) as pool:
        return [row for part in pool.map(_of_model, groups, [store] * len(groups)) for row in part]


def kept(rows: list[Row], path: Path | None) -> list[Row]:
    """The rows, which `path` holds afterwards, if there is one."""
    if path is not None:
        path.write_bytes(_ROWS.dump_json(rows))
    return rows


def read_kept(path: Path) -> list[Row]:
    """What `kept` wrote."""
    return _ROWS.validate_json(path.read_bytes())


def _of_model(asked: Sequence[Question], store: Path) -> list[Row]:
    try:
        finder = LocalPartFinder(ingest(asked[0].file, ModelStore(store)))
    except FileProblem as problem:
        print(f"{asked[0].file}: {problem}", file=sys.stderr)
        return [Row(one, ()) for one in asked]
    whole = next(part for part in finder.model.parts if part.kind == "model")
    with Sandbox(workers=1) as sandbox:
        return [Row(one, tuple(_tried(one, finder, whole, sandbox))) for one in asked]


def _tried(one: Question, finder: LocalPartFinder, whole: Part, sandbox: Sandbox) -> list[Tried]:
    found = []
    names = vocabulary(finder.model.parts)
    grounded: dict[PartQuery, Sequence[Grounded]] = {}

    def ground(queries: Sequence[PartQuery]) -> Sequence[Sequence[Grounded]]:
        ways = finder.ground(queries)
        grounded.update(zip(queries, ways, strict=True))
        return ways

    try:
        reader = Reader(one.question, names)
        readings, affinity = reader.readings, Affinity(reader.text.words, whole)
        ranked = candidates(readings, ground, whole, affinity, LIMIT)
    except Exception as error:
        print(f"{one.question!r}: {type(error).__name__}: {error}", file=sys.stderr)
        return []
    for candidate in ranked:
        parts = tuple(part_traits(way, whole) for way in islice(candidate.grounds.values(), MOST_WAYS))
        try:
            outcome = sandbox.run(candidate.written.code, finder, expects=candidate.written.expects, check=False)
        except FileProblem as problem:  # a measurement that the kernel could not make
            outcome = RunOutcome(status=RunStatus.CRASHED, message=str(problem))
        if outcome.status is not RunStatus.OK:
            if (
                outcome.status is RunStatus.RAISED
                and "has no" not in outcome.message
                and "not grounded" not in outcome.message
                and "empty" not in outcome.message
            ):
                print(f"{one.question!r}: {outcome.message[:200]}\n{candidate.written.code}", file=sys.stderr)
            failed = {**candidate.features, "run_failed": 1.0}
            found.append(Tried(failed, None, False, candidate.written.code, parts=parts))
            continue
        done = with_value(candidate, outcome.value, whole.extents)
        right = is_right(outcome.value, one)
        found.append(Tried(done.features, outcome.value, right, candidate.written.code, parts=parts))
    lacking = one.kind == MISSING
    return [
        *found,
        *(
            Tried(each.features, None, lacking, "", absent=True)
            for each in absences(readings, grounded, names, affinity)
        ),
    ]
