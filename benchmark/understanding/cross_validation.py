"""How well does understanding carry over? Folds that leave out whole writers and whole models."""

from __future__ import annotations

import zlib
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

from .collect import Row
from .data import MISSING
from .fit import Answered, Table, answered, calibrate, fit, sure

SURE = 0.8
"""An answer with this confidence passes as known: people do not check it."""
PARTS = 5
"""Calibration looks at questions that were left out, so many parts one after the other."""
LOOKED_AT = 0.4
"""What a question that the lexicon was written with in view counts in calibration, beside one by a hand.

The more they count, the smaller is the calibration error over all and the larger that over the hands; and the more of
the hands' answers are wrong and sure.
"""
OWN_FOLDS = 5
"""The project's first questions have few writers: they are parted by model alone."""


@dataclass(frozen=True, slots=True)
class Told:
    """What came of one question that its fold had not seen."""

    fold: str
    writer: str
    right: bool
    reachable: bool
    """Is a right value among the candidates that ran?"""
    refused: bool
    confidence: float
    missing: bool = False
    """Is what is asked about not there, so that a refusal is right?"""


def fold_of(row: Row) -> str:
    """Which fold is a question in? Its writer's; the facts are one fold, the first questions several by model."""
    writer = row.question.writer
    if writer in ("own", "examples"):
        return f"own-{zlib.crc32(row.question.model.encode()) % OWN_FOLDS}"
    return writer.partition(":")[0]


def is_hand(fold: str) -> bool:
    """Are these the questions of one who saw neither grammar nor lexicon?"""
    return fold not in ("facts", "cad-qa") and not fold.startswith("own-")


def asks_for_missing(fold: str) -> bool:
    """Is this a writer of questions about what the model lacks, with some about what it has beside them?"""
    return fold.startswith("absent")


def cross_validated(rows: Sequence[Row], prior: Table) -> list[Told]:
    """Every question, answered by weights that were fitted without its writer and without its model."""
    whole = fit(balanced(rows), prior)
    return [
        one
        for left_out in by_fold(rows).values()
        for one in judged(left_out, *weights_of(without(rows, left_out), prior, whole))
    ]


def by_fold(rows: Sequence[Row]) -> dict[str, list[Row]]:
    """The questions of each fold."""
    folds: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        folds[fold_of(row)].append(row)
    return dict(sorted(folds.items()))


def without(rows: Sequence[Row], left_out: Sequence[Row]) -> list[Row]:
    """The questions of other folds, about other models."""
    folds, models = {fold_of(row) for row in left_out}, {row.question.model for row in left_out}
    return [row for row in rows if fold_of(row) not in folds and row.question.model not in models]


def balanced(rows: Sequence[Row]) -> list[Row]:
    """The questions as they count in fitting: those that are no hand's twice, or the hands outweigh all others.

    Left out in cross-validation, the others gain a third of a percent by it, and the hands lose a tenth.
    """
    return [*rows, *(row for row in rows if not is_hand(fold_of(row)))]


def weights_of(rows: Sequence[Row], prior: Table, begin: Table | None = None) -> tuple[Table, Table]:
    """Weights fitted on these questions, and a calibration fitted on those that parts of the weights had not seen.

    What the lexicon was written with in view is answered better than what people ask: for how probable an answer is it
    counts `LOOKED_AT`. `begin`: where fitting begins.
    """
    table = fit(balanced(rows), prior, begin)
    folds = by_fold(rows)
    answers: list[tuple[Answered, float]] = []
    for part in range(PARTS):
        names = list(folds)[part::PARTS]
        seen = fit(balanced(without(rows, [row for name in names for row in folds[name]])), prior, table)
        answers += [(answered(row, seen), 1.0 if is_hand(name) else LOOKED_AT) for name in names for row in folds[name]]
    return table, calibrate(answers)


def judged(rows: Sequence[Row], table: Table, calibration: Table) -> list[Told]:
    """What these weights make of questions."""
    found = []
    for row in rows:
        answer = answered(row, table)
        reachable = any(one.right for one in row.tried)
        found.append(
            Told(
                fold_of(row),
                row.question.writer,
                answer.right,
                reachable,
                answer.refused,
                sure(answer, calibration),
                row.question.kind == MISSING,
            )
        )
    return found


def calibration_error(told: Sequence[Told], bins: int = 10) -> float:
    """Expected calibration error: how far confidence and share of right answers lie apart, weighted over ten bins."""
    known = [one for one in told if not one.refused]
    error = 0.0
    for i in range(bins):
        inside = [one for one in known if i / bins <= one.confidence < (i + 1) / bins + (i == bins - 1)]
        if inside:
            apart = sum(one.confidence - one.right for one in inside)
            error += abs(apart) / len(known)
    return error


def risk_and_coverage(told: Sequence[Told]) -> list[tuple[float, float, float]]:
    """(threshold, share of questions answered, share of those that are wrong) for thresholds from 0 to 0.95."""
    rows = []
    for step in range(20):
        threshold = step / 20
        given = [one for one in told if not one.refused and one.confidence >= threshold]
        if given:
            rows.append((threshold, len(given) / len(told), sum(not one.right for one in given) / len(given)))
    return rows


def summary(told: Sequence[Told]) -> str:
    """A table by fold, and the figures over all."""
    groups: dict[str, list[Told]] = defaultdict(list)
    for one in told:
        if asks_for_missing(one.fold):  # half of them and more have no value
            groups["missing" if one.missing else "not missing"].append(one)
            continue
        groups[one.fold.partition("-")[0]].append(one)
        groups["all"].append(one)
        if is_hand(one.fold):
            groups["the hands"].append(one)
    titles = f"{'questions':>9} {'right':>6} {'reachable':>9} {'sure':>6} {'wrong and sure':>14} {'refused':>8}"
    lines = [f"{'left out':14} {titles}"]
    for name, ones in groups.items():
        count = len(ones)
        right, reach = sum(one.right for one in ones) / count, sum(one.reachable for one in ones) / count
        certain = [one for one in ones if one.confidence >= SURE]
        wrong = sum(not one.right for one in certain) / count
        refused = sum(one.refused for one in ones) / count
        lines.append(
            f"{name:14} {count:9} {right:6.3f} {reach:9.3f} {len(certain) / count:6.3f} {wrong:14.3f} {refused:8.3f}"
        )
    lines += [f"calibration error, {name}: {calibration_error(groups[name]):.3f}" for name in ("all", "the hands")]
    return "\n".join(lines)
