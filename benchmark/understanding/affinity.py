"""Fits the table of `querycad_answering.affinity`: a weight for each word with each trait of a program or part."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.sparse import csr_array

from querycad_answering.affinity import FEATURE, PART_SHARE, SLOTS, code, grams, placed, slot, traits
from querycad_language.text import Text

from .collect import Row
from .fit import Table, log_odds_of_right, score

L2 = 0.1
"""Chosen on questions that nothing is fitted on, among 0.05, 0.1, 0.2, 0.4 and 0.7."""
ROUNDS = 25
"""Of the minimiser: more change nothing."""
Weights = NDArray[np.float64]


class Pairs:
    """The pairs of all questions with all their candidates, as one matrix that the folds share."""

    def __init__(self, rows: Sequence[Row]) -> None:
        columns, values, ends = [np.zeros(0, np.int32)], [np.zeros(0, np.float32)], [0]
        self._of: dict[int, range] = {}
        for row in rows:
            told = grams(Text(row.question.question).words)
            own = np.array([code(gram) for gram in told], np.uint64)
            alone = np.array([code(gram) for gram in told if " " not in gram], np.uint64)
            share, known = 1 / math.sqrt(len(own) or 1), dict[str, NDArray[np.int32]]()
            begin = len(ends) - 1
            for one in row.tried:
                found = [_slots(own, trait, known) for trait in traits(one.features)]
                parts = [
                    _slots(alone, placed(place, trait), known)
                    for place, group in enumerate(one.parts)
                    for trait in group
                ]
                columns.append(np.concatenate([*found, *parts, np.zeros(0, np.int32)]))
                of_program = sum(map(len, found))
                count = len(columns[-1])
                values.append(np.where(np.arange(count) < of_program, share, PART_SHARE * share).astype(np.float32))
                ends.append(ends[-1] + count)
            self._of[id(row)] = range(begin, len(ends) - 1)
        shape = (len(ends) - 1, SLOTS)
        self._matrix = csr_array((np.concatenate(values), np.concatenate(columns), np.array(ends)), shape=shape)
        self._matrix.sum_duplicates()

    def fitted(self, rows: Sequence[Row], table: Table) -> Weights:
        """The weights that make right values most likely, beside those of the table."""
        usable = [
            row for row in rows if any(one.right for one in row.tried) and not all(one.right for one in row.tried)
        ]
        tried = [one for row in usable for one in row.tried]
        matrix = self._matrix[[at for row in usable for at in self._of[id(row)]]]
        base = np.array([score(one, table) - table.get(FEATURE, 0.0) * one.features.get(FEATURE, 0.0) for one in tried])
        loss = log_odds_of_right(usable, np.array([one.right for one in tried], dtype=np.bool_))
        turned = matrix.T.tocsr()

        def told(weights: Weights) -> tuple[float, Weights]:
            value, slope = loss(base + matrix @ weights)
            return value + L2 * float(weights @ weights), turned @ slope + 2 * L2 * weights

        found = minimize(told, np.zeros(SLOTS), jac=True, method="L-BFGS-B", options={"maxiter": ROUNDS})
        return np.asarray(found.x)

    def scored(self, rows: Sequence[Row], weights: Weights) -> list[Row]:
        """The rows, with what these weights say of each candidate."""
        found = []
        for row in rows:
            own = self._of[id(row)]
            told = self._matrix[own.start : own.stop] @ weights
            tried = (
                replace(one, features={**one.features, FEATURE: float(value)})
                for one, value in zip(row.tried, told, strict=True)
            )
            found.append(replace(row, tried=tuple(tried)))
        return found


def _slots(grams_of: NDArray[np.uint64], trait: str, known: dict[str, NDArray[np.int32]]) -> NDArray[np.int32]:
    if trait not in known:
        known[trait] = np.array([slot(int(gram), code(trait)) for gram in grams_of], np.int32)
    return known[trait]
