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
from querycad_language.weights import calibration, weights

from .candidates import Absence, Candidate

Features = dict[str, float]
NONE = "none_right"
"""The weight that says how probable it is that no candidate is right: their scores count against it."""
SHOWN = 3
"""So many readings are shown where none is sure: people choose between two or three."""

_DOUBTS: dict[str, tuple[str, ...]] = {
    "skipped": (
        "skip_number", "skip_side", "skip_measure", "skip_negation", "skip_comparison", "skip_adjective",
    ),
    "noun": ("skip_noun",),
    "unknown": ("skip_unknown", "aside_unknown"),
    "unknown_words": ("unknown_words",),
    "unknown_whole": ("unknown_whole",),
    "guessed": ("guessed",),
    "passed": ("parts_passed", "owner_passed", "link_whole"),
    "aside": ("aside_noun", "aside_number", "aside_side", "aside_measure", "aside_comparison"),
    "dropped": (
        "adjective_dropped", "size_dropped", "place_dropped", "place_unknown", "compound_dropped", "compound_unknown",
        "trait_dropped", "trait_unknown", "color_dropped", "thread_dropped", "rank_dropped", "nth_dropped",
        "nth_unchecked",
    ),
    "denied": ("place_denied", "end_denied"),
    "several": ("values_several_for_one", "several_for_one", "values_differ_for_each"),
    "chosen": ("group_for_one", "group_for_plural"),
    "alike": ("alike_for_one",),
    "kin": ("sense_kin", "sense_wide", "kin_instead"),
    "stretched": ("sense_stretch", "sense_rank"),
    "measure": ("measure_derived", "measure_foreign"),
    "miscounted": ("count_differs", "count_group", "one_for_plural"),
    "whole": ("whole_hollow",),
    "empty": ("empty", "nothing", "counts_none", "value_zero"),
    "none_there": ("exists_none",),
    "yes_no": ("form_check", "form_every", "form_uniform", "form_exists", "form_parallel", "form_within"),
    "choice": ("form_towards", "form_either", "form_which"),
    "apart": ("form_distance", "form_combine", "form_angle"),
    "long": ("words",),
    "strange": ("strange_words",),
    "whole_model": ("whole_sense",),
    "named": ("file_named", "by_name"),
    "odd": ("named_only", "value_is_extent", "value_too_large", "material_under", "material_between"),
}  # fmt: skip
"""What may speak against an answer, whatever else there is: the groups of features that calibration looks at."""


SAY_NOTHING = ("chatter", "function", "courtesy")
"""Classes of words that may be skipped without a word about it."""
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
        found.append(Value(runs[told], share, confidence(share, runs[best].features, runs[best].score)))
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


def doubts(features: Features, score: float) -> Features:
    """What speaks against an answer, by kind; the score itself is among it."""
    found = {name: math.fsum(abs(features.get(one, 0.0)) for one in members) for name, members in _DOUBTS.items()}
    return {**found, "score": score / 5}


def odds(share: float) -> float:
    """The log odds of a share, kept finite."""
    share = min(max(share, 1e-3), 1 - 1e-3)
    return math.log(share / (1 - share))


def confidence(share: float, features: Features, score: float, table: Features | None = None) -> float:
    """The probability that an answer is right: logistic in its share and its doubts, fitted in cross-validation."""
    table = table if table is not None else calibration()
    z = table.get("bias", 0.0) + table.get("share", 1.0) * odds(share)
    z += math.fsum(table.get(name, 0.0) * value for name, value in doubts(features, score).items())
    return 1 / (1 + math.exp(-z))
