"""What the product answers, from the question to the value: with questions parted, refusals, and values in order."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from itertools import groupby
from pathlib import Path

from querycad import EmbeddedRuntime
from querycad_segworker.errors import FileProblem

from .cross_validation import Told
from .data import MISSING, Question, is_right


def answered_by_product(asked: Sequence[Question], store: Path, jobs: int = 2) -> list[Told]:
    """What comes of each question, asked as a user asks it; those of one model by one process."""
    by_file = sorted(asked, key=lambda one: one.file)
    groups = [list(of) for _, of in groupby(by_file, key=lambda one: one.file)]
    with ProcessPoolExecutor(jobs) as pool:
        return [told for group in pool.map(partial(_of_model, store), groups) for told in group]


def _of_model(store: Path, asked: Sequence[Question]) -> list[Told]:
    with EmbeddedRuntime(store) as runtime:
        try:
            model = runtime.open(asked[0].file)
        except FileProblem:
            return []
        found = []
        for one in asked:
            reply = model.ask(one.question)
            value = reply.answer.value if reply.answer is not None else None
            right = is_right(value, one) if one.kind != MISSING else value is None
            found.append(
                Told(
                    fold=one.writer,
                    writer=one.writer,
                    right=right,
                    reachable=right,
                    refused=value is None,
                    confidence=reply.confidence or 0.0,
                    missing=one.kind == MISSING,
                )
            )
        return found
