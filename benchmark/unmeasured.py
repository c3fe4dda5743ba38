"""Which lengths that people ask for does no part of the model have?

`python -m benchmark.unmeasured [--share 0.1] [--store FOLDER]` takes the questions whose truth is one length, but for
those of writers whom nobody has read, and prints those whose value is no measure of any part as programs see it: a
measure that is missing, a part that is not recognised or measured wrongly, or a distance between parts, which is none's
own. Words do not matter, so what is printed is not for the reader of English to mend.
"""

from __future__ import annotations

import argparse
import math
import random
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from benchmark.understanding.data import Question, questions
from querycad_contracts import Part, PartKind
from querycad_sandbox.measures import part_measures
from querycad_segworker.brep.step import quiet
from querycad_segworker.errors import FileProblem
from querycad_segworker.ingest import ingest
from querycad_segworker.model import ModelStore

CLOSE = 0.005
"""A measure that differs from the truth by less than this share is it."""
NOT_OWN = frozenset(("center", "half_extents", "opening", "tip", "tips", "axis", "normal", "area", "volume", "angle"))
"""Places, directions, and what is no length."""
SURFACES = frozenset((PartKind.FACE, PartKind.CYLINDER))
"""What every model has wherever something ends: no part that a word names."""


def lengths(parts: Sequence[Part]) -> set[float]:
    """All measures of the parts that may be lengths, metres, radii and diameters among them."""
    found: set[float] = set()
    for part in parts:
        if part.kind not in SURFACES:
            for name, value in part_measures(part).items():
                found.update(_numbers(value) if name not in NOT_OWN else ())
    return found


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, list | tuple):
        for each in value:
            yield from _numbers(each)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield float(value)


def unmeasured(asked: Sequence[Question], parts: Sequence[Part]) -> list[Question]:
    """Those of the questions about one model whose truth, a length in metres, is no measure of its parts."""
    known = lengths(parts)
    return [one for one in asked if not any(math.isclose(one.truth, value, rel_tol=CLOSE) for value in known)]


def main(arguments: Sequence[str] | None = None) -> int:
    """Asks and prints; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m benchmark.unmeasured", description=__doc__)
    parser.add_argument("--share", type=float, default=1.0, help="of the models, drawn by seed")
    parser.add_argument("--store", type=Path, default=Path("build/understanding"), help="where models are kept")
    options = parser.parse_args(arguments)
    quiet()
    by_file: dict[Path, dict[float, Question]] = defaultdict(dict)
    for one in questions():
        if one.kind == "length" and isinstance(one.truth, int | float):
            by_file[one.file].setdefault(one.truth, one)
    files = random.Random(7).sample(sorted(by_file), round(options.share * len(by_file)))  # noqa: S311 - no secret
    asked = told = 0
    for file in files:
        try:
            parts = ingest(file, ModelStore(options.store)).load_model().parts
        except FileProblem as problem:
            print(f"{file.name}: {problem}")
            continue
        asked += len(by_file[file])
        for one in unmeasured(list(by_file[file].values()), parts):
            told += 1
            print(f"{file.name}: {1e3 * one.truth:.4g} mm: {one.question}")
    print(f"lengths: {asked}, no part's: {told}, models: {len(files)}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
