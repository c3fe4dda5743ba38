"""How well does understanding carry over? Folds that leave out whole writers and whole models."""

from __future__ import annotations

import zlib
from collections import defaultdict
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from multiprocessing import get_context

from querycad_answering.affinity import FEATURE

from .affinity import Pairs, Weights
from .collect import Row
from .data import MISSING
from .fit import Answered, Table, answered, calibrate, fit, sure

SURE = 0.8
"""An answer with this confidence passes as known: people do not check it."""
LOOKED_AT = 0.4
"""What a question that the lexicon was written with in view counts in calibration, beside one by a hand.

The more they count, the smaller is the calibration error over all and the larger that over the hands; and the more of
the hands' answers are wrong and sure.
"""
OWN = {"own": "own", "examples": "own", "plain_parts": "plain"}
"""Writers who know the product, and the name of their folds."""
OWN_FOLDS = 3
"""The project's first questions have few writers: they are parted by model alone."""
WRITER_FOLDS = 5
"""Writers are left out several at a time: a fold takes minutes."""
MISSING_FOLDS = 3
"""Those who ask for what is missing are few."""
KNOWN = ("cad-qa",)
"""Writers who have a fold of their own."""
REWORDED = "reworded"
"""Writers who ask again, in their own words, what others have asked."""
KNOWN_COUNT = 3
"""How often one of the first questions, facts and CAD-Q&A counts in fitting, or the hands, six times as many, outweigh
them."""
MISSING_COUNT = 3
"""How often one by those who ask for what is missing does: hardly any other writer does.

With 1 the others gain half a percent, and of what is missing 27 % are refused instead of 48 %."""

AT_WORK = frozenset((
    "workshop_talker", "handling_researcher", "description_writer", "foundry_buyer", "drive_part_chatter",
    "peg_assembler", "model_downloader", "toolroom_planner", "redesign_inspector", "drawingless_buyer",
    "skill_parameter_technician", "spreadsheet_student", "grounding_benchmarker",
    *(f"reworded-{who}" for who in (
        "desk_colleague", "jobshop_texter", "cell_automation_engineer", "lay_describer", "from_to_measurer",
        "second_language_engineer", "mailing_purchaser", "meeting_designer",
    )),
))  # fmt: skip
"""Writers who ask as at work, and not down a list of dimensions; and those who ask the same again."""
AT_WORK_COUNT = 2
"""How often one of their questions counts: they are an eighth of all. ADR 36."""


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
    if writer in OWN:
        return f"{OWN[writer]}-{zlib.crc32(row.question.model.encode()) % OWN_FOLDS}"
    if asks_for_missing(writer):
        return f"absent-{zlib.crc32(writer.encode()) % MISSING_FOLDS}"
    if writer in KNOWN or ":" in writer:
        return writer.partition(":")[0]
    if row.question.model.startswith("specified:") and not writer.startswith(REWORDED):
        return f"specified-{zlib.crc32(writer.encode()) % WRITER_FOLDS}"
    return f"{REWORDED if writer.startswith(REWORDED) else 'asked'}-{zlib.crc32(writer.encode()) % WRITER_FOLDS}"


def is_hand(fold: str) -> bool:
    """Are these the questions of one who saw neither grammar nor lexicon?"""
    return fold not in ("facts", "cad-qa") and fold.partition("-")[0] not in OWN.values()


def asks_for_missing(fold: str) -> bool:
    """Is this a writer of questions about what the model lacks, with some about what it has beside them?"""
    return fold.startswith("absent")


_SHARED: list[tuple[Sequence[Row], Table, Table, Pairs]] = []
"""The rows, the prior, the weights of all rows, the pairs: what the processes of a cross-validation inherit."""
Judged = list[tuple[Row, Answered]]
"""Questions with their answers by weights that had not seen them."""


def cross_validated(rows: Sequence[Row], prior: Table, jobs: int = 1) -> tuple[list[Told], Table]:
    """Every question, answered by weights that were fitted without its writer and without its model; a calibration.

    The calibration of a fold is fitted on what the others came to when they were left out themselves, the one that is
    returned on all of that. What the lexicon was written with in view is answered better than what people ask: there it
    counts `LOOKED_AT`.
    """
    pairs = Pairs(rows)
    _SHARED[:] = [(rows, prior, fit(balanced(rows), prior), pairs)]
    with ProcessPoolExecutor(jobs, get_context("fork")) as pool:
        answers = pool.map(_left_out, by_fold(rows))
    folds = [list(zip(own, given, strict=True)) for own, given in zip(by_fold(rows).values(), answers, strict=True)]
    told = [one for i, own in enumerate(folds) for one in _told(own, _calibrated([*folds[:i], *folds[i + 1 :]]))]
    return told, _calibrated(folds)


def _left_out(fold: str) -> list[Answered]:
    ((rows, prior, whole, pairs),) = _SHARED
    left_out = by_fold(rows)[fold]
    table, weights = fitted(without(rows, left_out), prior, pairs, whole)
    return [replace(answered(row, table), by=None) for row in pairs.scored(left_out, weights)]


def _calibrated(folds: Sequence[Judged]) -> Table:
    told = (one for fold in folds for one in fold)
    return calibrate([(answer, 1.0 if is_hand(fold_of(row)) else LOOKED_AT) for row, answer in told])


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
    """The questions as often as they count in fitting."""
    return [row for row in rows for _ in range(_count(row.question.writer, fold_of(row)))]


def _count(writer: str, fold: str) -> int:
    if asks_for_missing(fold):
        return MISSING_COUNT
    if writer in AT_WORK:
        return AT_WORK_COUNT
    return 1 if is_hand(fold) or fold.startswith("plain") else KNOWN_COUNT


def fitted(rows: Sequence[Row], prior: Table, pairs: Pairs, begin: Table | None = None) -> tuple[Table, Weights]:
    """The weights of features, and of words with programs, fitted on these questions. `begin`: where fitting begins."""
    table = fit(balanced(rows), prior, begin)
    return {**table, FEATURE: 1.0}, pairs.fitted(balanced(rows), table)


def judged(rows: Sequence[Row], table: Table, calibration: Table) -> list[Told]:
    """What these weights make of questions."""
    return _told([(row, answered(row, table)) for row in rows], calibration)


def _told(answers: Judged, calibration: Table) -> list[Told]:
    return [
        Told(
            fold_of(row),
            row.question.writer,
            answer.right,
            any(one.right for one in row.tried),
            answer.refused,
            sure(answer, calibration),
            row.question.kind == MISSING,
        )
        for row, answer in answers
    ]


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
