"""How well does understanding carry over? Folds that leave out whole writers and whole models."""

from __future__ import annotations

import zlib
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

from .collect import Row
from .fit import Table, answered, calibrate, fit, sure

SURE = 0.8
"""An answer with this confidence passes as known: people do not check it."""
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


def fold_of(row: Row) -> str:
    """Which fold is a question in? Its writer's; the facts are one fold, the first questions several by model."""
    writer = row.question.writer
    if writer in ("own", "examples"):
        return f"own-{zlib.crc32(row.question.model.encode()) % OWN_FOLDS}"
    return writer.partition(":")[0]


def cross_validated(rows: Sequence[Row], prior: Table) -> list[Told]:
    """Every question, answered by weights that were fitted without its writer and without its model."""
    folds: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        folds[fold_of(row)].append(row)
    told = []
    for name, left_out in sorted(folds.items()):
        models = {row.question.model for row in left_out}
        others = [
            row for other, group in folds.items() if other != name for row in group if row.question.model not in models
        ]
        told += judged(left_out, *weights_of(others, prior))
    return told


def weights_of(rows: Sequence[Row], prior: Table) -> tuple[Table, Table]:
    """Weights and calibration fitted on these questions."""
    table = fit(rows, prior)
    return table, calibrate(rows, table)


def judged(rows: Sequence[Row], table: Table, calibration: Table) -> list[Told]:
    """What these weights make of questions."""
    found = []
    for row in rows:
        answer = answered(row, table)
        reachable = any(one.right for one in row.tried)
        found.append(
            Told(fold_of(row), row.question.writer, answer.right, reachable, answer.refused, sure(answer, calibration))
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
        groups[one.fold.partition("-")[0]].append(one)
        groups["all"].append(one)
        if one.fold not in ("facts", "cad", "cad-qa") and not one.fold.startswith("own"):
            groups["the hands"].append(one)
    lines = [f"{'left out':14} {'questions':>9} {'right':>6} {'reachable':>9} {'sure':>6} {'wrong and sure':>14}"]
    for name, ones in groups.items():
        count = len(ones)
        right, reach = sum(one.right for one in ones) / count, sum(one.reachable for one in ones) / count
        certain = [one for one in ones if one.confidence >= SURE]
        wrong = sum(not one.right for one in certain) / count
        lines.append(f"{name:14} {count:9} {right:6.3f} {reach:9.3f} {len(certain) / count:6.3f} {wrong:14.3f}")
    lines.append(f"expected calibration error {calibration_error(told):.3f}")
    return "\n".join(lines)
