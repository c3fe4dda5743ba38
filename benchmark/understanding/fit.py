"""Fits the weights that rank readings: a log-linear model with the programs latent, learned from the truths alone.

The probability of a candidate is the softmax of its features times the weights; a question's likelihood is the
probability of all candidates whose value is right (several programs can give it). That the part is not there is a
candidate too, right where it is missing. How probable it is that none is right is fitted after that. L2 keeps weights
near their rough first guess.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize, minimize_scalar
from scipy.sparse import csr_array
from scipy.special import logsumexp

from querycad_answering.affinity import FEATURE
from querycad_answering.confidence import calibrated, doubts, odds
from querycad_answering.ranking import NONE, key

from .collect import Row, Tried
from .data import MISSING

L2 = 0.5
"""Chosen by cross-validation among 0.1, 0.5 and 2."""
CAUTION = 1.25
"""A wrong answer weighs that much more than a right one in calibration: wrong and sure is the worst outcome."""
Table = dict[str, float]


@dataclass(frozen=True, slots=True)
class Answered:
    """What a table of weights answers to a question: the value with the most probability, and features of the doubt."""

    right: bool
    probability: float
    features: Table
    score: float
    refused: bool
    by: Tried | None = None
    """The most probable candidate of this value."""


def fit(rows: Sequence[Row], prior: Table, begin: Table | None = None, l2: float = L2) -> Table:
    """The weights that make the right values most likely. `begin`: near them, to be there sooner."""
    usable = [row for row in rows if any(one.right for one in row.tried) and not all(one.right for one in row.tried)]
    names = sorted({name for row in usable for one in row.tried for name in one.features} - {FEATURE})
    index = {name: i for i, name in enumerate(names)}
    start = np.array([prior.get(name, 0.0) for name in names])
    first = start if begin is None else np.array([begin.get(name, 0.0) for name in names])
    matrix, right = _matrix(usable, index)
    turned = matrix.T.tocsr()
    of_right = log_odds_of_right(usable, right)

    def loss(w: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        value, slope = of_right(matrix @ w)
        return value + l2 * float(((w - start) ** 2).sum()), turned @ slope + 2 * l2 * (w - start)

    found = minimize(loss, first, jac=True, method="L-BFGS-B", options={"maxiter": 300})
    table = {name: round(float(value), 3) for name, value in zip(names, found.x, strict=True) if abs(value) >= 5e-4}
    return {**table, NONE: round(_none(rows, table), 3)}


def log_odds_of_right(
    rows: Sequence[Row], right: NDArray[np.bool_]
) -> Callable[[NDArray[np.float64]], tuple[float, NDArray[np.float64]]]:
    """How unlikely are the right candidates of these questions by their scores, and the slope by each score?"""
    counts = [len(row.tried) for row in rows]
    begins = np.cumsum([0, *counts[:-1]])
    owner = np.repeat(np.arange(len(rows)), counts)

    def told(scores: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        whole = _logsumexp(scores, begins, owner)
        good = _logsumexp(np.where(right, scores, -1e9), begins, owner)
        slope = np.exp(scores - whole[owner]) - np.where(right, np.exp(scores - good[owner]), 0.0)
        return float((whole - good).sum()), slope

    return told


def _logsumexp(scores: NDArray[np.float64], begins: NDArray[np.int64], owner: NDArray[np.int64]) -> NDArray[np.float64]:
    """Of each question's candidates."""
    top = np.maximum.reduceat(scores, begins)
    return np.asarray(top + np.log(np.add.reduceat(np.exp(scores - top[owner]), begins)))


def _none(rows: Sequence[Row], table: Table) -> float:
    """The score that none of the candidates has against theirs, so that it is as often right as they say."""
    right, whole = [], []
    for row in rows:
        scores = [(one.right, score(one, table)) for one in row.tried]
        whole.append(logsumexp([score for _, score in scores] or [-math.inf]))
        right.append(logsumexp([score for is_right, score in scores if is_right] or [-math.inf]))
    good, all_told = np.array(right), np.array(whole)
    any_right = np.isfinite(good)

    def loss(score: float) -> float:
        return float((np.logaddexp(all_told, score) - np.where(any_right, good, score)).sum())

    return float(minimize_scalar(loss, bounds=(-10.0, 5.0), method="bounded").x)


def score(one: Tried, table: Table) -> float:
    """The weights of a candidate's features, added up."""
    return math.fsum(table.get(name, 0.0) * value for name, value in one.features.items())


def _matrix(rows: Sequence[Row], index: dict[str, int]) -> tuple[csr_array, NDArray[np.bool_]]:
    """(candidates, features), and which candidates are right."""
    tried = [one for row in rows for one in row.tried]
    told = [[(index[name], value) for name, value in one.features.items() if name in index] for one in tried]
    columns, values = ([pair[i] for own in told for pair in own] for i in (0, 1))
    ends = np.cumsum([0, *map(len, told)])
    matrix = csr_array((values, columns, ends), shape=(len(tried), len(index)))
    return matrix, np.array([one.right for one in tried], dtype=np.bool_)


def answered(row: Row, table: Table) -> Answered:
    """What is answered with these weights; equal values count together. Refused where `Ranked.is_absent` would be."""
    runs = [one for one in row.tried if one.absent or (one.value is not None and one.value != [])]
    if not runs:
        return Answered(row.question.kind == MISSING, 0.0, {}, 0.0, True)
    scores = np.array([score(one, table) for one in runs])
    shares = np.exp(scores - logsumexp([*scores, table.get(NONE, -math.inf)]))
    absent = math.fsum(share for one, share in zip(runs, shares, strict=True) if one.absent)
    if absent > math.fsum(shares) - absent:
        return Answered(row.question.kind == MISSING, 0.0, {}, 0.0, True)
    groups: dict[str, list[int]] = {}
    for i, one in enumerate(runs):
        if not one.absent:
            groups.setdefault(key(one.value), []).append(i)
    best = max(groups.values(), key=lambda members: float(shares[members].sum()))
    top = max(best, key=lambda i: float(scores[i]))
    return Answered(
        runs[top].right, float(shares[best].sum()), runs[top].features, float(scores[top]), False, runs[top]
    )


def calibrate(answers: Sequence[tuple[Answered, float]], l2: float = 5.0) -> Table:
    """How probable is it that an answer is right? Logistic weights of its share and of its doubts.

    `answers`: by weights that had not seen their questions, or confidence is too high; and what each counts.
    """
    counted = np.array([count for one, count in answers if not one.refused])
    told = [one for one, _ in answers if not one.refused]
    against = [doubts(one.features, one.score) for one in told]
    names = sorted({name for found in against for name in found})
    matrix = np.array(
        [
            [1.0, odds(one.probability), *(found[name] for name in names)]
            for one, found in zip(told, against, strict=True)
        ]
    )
    right = np.array([one.right for one in told], dtype=np.float64)

    weight = counted * np.where(right > 0, 1.0, CAUTION)

    def loss(w: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        z = matrix @ w
        p = 1 / (1 + np.exp(-z))
        value = float((weight * (np.logaddexp(0, z) - right * z)).sum()) + l2 * float((w[1:] ** 2).sum())
        return value, matrix.T @ (weight * (p - right)) + 2 * l2 * np.r_[0.0, w[1:]]

    found = minimize(loss, np.zeros(matrix.shape[1]), jac=True, method="L-BFGS-B")
    return dict(zip(("bias", "share", *names), (round(float(v), 3) for v in found.x), strict=True))


def sure(one: Answered, calibration: Table) -> float:
    """The probability that an answer is right."""
    return 0.0 if one.refused else calibrated(one.probability, one.features, one.score, calibration)
