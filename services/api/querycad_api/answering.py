"""The steps of one question: a program is written, run and its result typed. The same in every runtime."""

from __future__ import annotations

import time
from collections.abc import Callable

from querycad_contracts import (
    Answer,
    AnswerRecord,
    AnswerType,
    Failure,
    Grounding,
    LengthUnit,
    Part,
    Program,
    RunOutcome,
    RunStatus,
    Status,
)

from .codegen import EmptyQuestion, NotUnderstood, parse
from .typed import WrongAnswerType, typed_answer

Run = Callable[[Program], RunOutcome]
"""Runs a program against the model that the question is about."""


def answer_question(question: str, run: Run, unit: LengthUnit = LengthUnit.MM) -> AnswerRecord:
    """What is the answer? Never raises for what is wrong with a question or program: the record's `failure` says it.

    `unit` is the one that `answer.text` is written in; `answer.value` is SI whatever it is.
    """
    clock = _Clock()
    try:
        program = parse(question)
    except EmptyQuestion as error:
        return _failed(question, None, clock, Failure(category="bad_input", message=str(error)))
    except NotUnderstood as error:
        failure = Failure(category="not_understood", message=error.message, nearest=error.nearest)
        return _failed(question, None, clock, failure)
    clock.lap("codegen")
    outcome = run(program)
    clock.lap("run")
    return _record(question, program, outcome, unit, clock)


def _record(question: str, program: Program, outcome: RunOutcome, unit: LengthUnit, clock: _Clock) -> AnswerRecord:
    warnings = _warnings(program, outcome)
    missing = _missing(outcome, program)
    if missing is not None:
        failure = Failure(category="not_grounded", message=missing.message, nearest=missing.nearest)
        return _failed(question, program, clock, failure, warnings, Status.NOT_GROUNDED)
    if outcome.status is not RunStatus.OK:
        category = "program" if outcome.status in (RunStatus.RAISED, RunStatus.REFUSED) else "limit"
        failure = Failure(category=category, message=outcome.message or f"the program {outcome.status.value}")
        return _failed(question, program, clock, failure, warnings)
    try:
        answer: Answer = typed_answer(outcome.value, program.expects, unit)
    except WrongAnswerType as error:
        return _failed(question, program, clock, Failure(category="program", message=str(error)), warnings)
    return AnswerRecord(
        question=question,
        status=Status.ANSWERED,
        answer=answer,
        code=program.code,
        codegen=program.codegen,
        parts=_parts(outcome),
        timings_ms=clock.timings_ms,
        warnings=warnings,
    )


def _missing(outcome: RunOutcome, program: Program) -> Grounding | None:
    """The description without parts that leaves the question without an answer.

    A word that is not understood always does. A part that the model does not have does when a measure of it was
    asked; how many there are, and whether there is one, is answered: none.
    """
    for grounding in outcome.groundings:
        if not grounding.understood:
            return grounding
    empty = next((grounding for grounding in outcome.groundings if not grounding.parts), None)
    if empty is None:
        return None
    if outcome.status in (RunStatus.RAISED,) or outcome.value in (None, []):
        return empty
    counted = program.expects in (AnswerType.COUNT, AnswerType.BOOLEAN)
    only_empty = all(not grounding.parts for grounding in outcome.groundings)
    return empty if only_empty and not counted and isinstance(outcome.value, int | float) else None


def _warnings(program: Program, outcome: RunOutcome) -> tuple[str, ...]:
    warnings = list(program.notes)
    if program.unused_words:
        warnings.append("not taken into account: " + ", ".join(program.unused_words))
    for grounding in outcome.groundings:
        warnings.extend(grounding.warnings)
        if grounding.understood and not grounding.parts:
            warnings.append(grounding.message)
    return tuple(dict.fromkeys(warnings))


def _parts(outcome: RunOutcome) -> tuple[Part, ...]:
    """The parts that the result rests on, in the order in which the program used them."""
    known = {part.id: part for grounding in outcome.groundings for part in grounding.parts}
    return tuple(known[part_id] for part_id in dict.fromkeys(outcome.used_parts) if part_id in known)


def _failed(
    question: str,
    program: Program | None,
    clock: _Clock,
    failure: Failure,
    warnings: tuple[str, ...] = (),
    status: Status = Status.FAILED,
) -> AnswerRecord:
    return AnswerRecord(
        question=question,
        status=status,
        answer=None,
        code=program.code if program else None,
        codegen=program.codegen if program else None,
        parts=(),
        timings_ms=clock.timings_ms,
        warnings=warnings,
        failure=failure,
    )


class _Clock:
    """How long did each step take? Milliseconds by step."""

    def __init__(self) -> None:
        self.timings_ms: dict[str, float] = {}
        self._last = time.perf_counter()

    def lap(self, step: str) -> None:
        now = time.perf_counter()
        self.timings_ms[step] = round((now - self._last) * 1e3, 3)
        self._last = now
