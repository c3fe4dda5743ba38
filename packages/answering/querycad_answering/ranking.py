"""Which of the candidates answers, how sure is it, and what else can be meant?

The candidates that ran get shares of probability by their fitted scores; those with the same value count together. How
probable it is that the best value is right is calibrated on top, from its share and from what speaks against it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from querycad_contracts import AnswerType
from querycad_language.weights import weights

from .candidates import Absence, Candidate
from .confidence import SAY_NOTHING, calibrated

NONE = "none_right"
"""The weight that says how probable it is that no candidate is right: their scores count against it."""
SHOWN = 3
"""So many readings are shown where none is sure: people choose between two or three."""

TOLD = 0.1
"""Of readings with one value that which passes over least is told, where it is so likely beside the likeliest."""


@dataclass(frozen=True, slots=True)
class Value:
    """One value that can be the answer, with the candidate that it is told by."""

    candidate: Candidate
    share: float
    confidence: float
    """The probability that the value is right, by calibration."""


def key(value: Any) -> str:
    """What makes two values the same: five digits; a list of equal values is one value."""
    if isinstance(value, bool):
        return repr(value)
    if isinstance(value, float | int):
        return f"{value:.5g}"
    if isinstance(value, list | tuple):
        keys = [key(v) for v in value]
        return keys[0] if len(set(keys)) == 1 else f"[{','.join(keys)}]"
    return repr(value)


@dataclass(frozen=True, slots=True)
class Ranked:
    """The values that can be the answer, and how probable it is that the model lacks what is asked about."""

    values: tuple[Value, ...] = ()
    """The most probable first."""
    absent: float = 0.0

    @property
    def is_absent(self) -> bool:
        """Is it more probable that the part is not there than that any of the values is right?"""
        return self.absent > math.fsum(one.share for one in self.values)


def ranked(tried: Sequence[Candidate], untried: Sequence[float] = (), absences: Sequence[Absence] = ()) -> Ranked:
    """The different values of the candidates that gave one, against the readings of parts that are not there.

    `untried` are the scores of those that were not run: their share of the probability goes to no value. Nor does
    that of `none_right`.
    """
    runs = [
        one for one in tried if one.value is not None and (one.value != [] or one.written.expects is AnswerType.PARTS)
    ]
    listing = bool(runs) and max(runs, key=lambda one: one.score).written.expects is AnswerType.PARTS
    lacking = [] if listing else [one.score for one in absences]  # no truth that is fitted on is a list
    none = -math.inf if listing else weights().get(NONE, -math.inf)
    shares = softmax([*(one.score for one in runs), *lacking, *untried, none])
    groups: dict[str, list[int]] = {}
    for i, one in enumerate(runs):
        groups.setdefault(key(one.value), []).append(i)
    found = []
    for members in groups.values():
        best = max(members, key=lambda i: shares[i])
        share = math.fsum(shares[i] for i in members)
        told = min(
            (i for i in members if shares[i] >= TOLD * shares[best]), key=lambda i: (_passed(runs[i]), -shares[i])
        )
        found.append(Value(runs[told], share, calibrated(share, runs[best].features, runs[best].score)))
    absent = math.fsum(shares[len(runs) : len(runs) + len(lacking)])
    return Ranked(tuple(sorted(found, key=lambda one: one.share, reverse=True)), absent)


def _passed(one: Candidate) -> int:
    """How many words that mean something does a reading pass over?"""
    return sum(kind not in SAY_NOTHING for kind, _ in one.reading.skipped)


def softmax(scores: Sequence[float]) -> list[float]:
    """Shares of one that grow with the scores."""
    if (top := max(scores)) == -math.inf:
        return [0.0] * len(scores)
    weights = [math.exp(score - top) for score in scores]
    total = math.fsum(weights)
    return [weight / total for weight in weights]
