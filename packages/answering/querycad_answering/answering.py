"""The steps of one question: programs are written, run and their results typed. The same in every runtime."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TypeVar

from querycad_contracts import (
    Agreement,
    Alternative,
    AnswerOptions,
    AnswerRecord,
    Attempt,
    Codegen,
    Expectation,
    Failure,
    LengthUnit,
    ModelSummary,
    Program,
    RunOutcome,
    Status,
    TokenUse,
)
from querycad_language.old import EmptyQuestion, NotUnderstood, parse

from .judging import Verdict, judge
from .llm import Candidate, LlmOptionRefused, LlmSettings, LlmWriter, Task
from .typed import same_value

T = TypeVar("T")
Run = Callable[[Program], RunOutcome]
"""Runs a program against the model that the question is about."""

NO_OPTIONS = AnswerOptions()
NO_LLM = LlmWriter(LlmSettings())


def answer_question(
    question: str,
    run: Run,
    unit: LengthUnit = LengthUnit.MM,
    options: AnswerOptions = NO_OPTIONS,
    *,
    summary: ModelSummary | None = None,
    llm: LlmWriter = NO_LLM,
) -> AnswerRecord:
    """What is the answer? Never raises for what is wrong with a question or program: the record's `failure` says it.

    `unit` is the one that `answer.text` is written in; `answer.value` is SI whatever it is. `summary` is what a
    language model is told of the model.
    """
    clock = _Clock()
    expect = options.expect or Expectation()

    def judged(program: Program) -> Verdict:
        outcome = clock.timed("run", partial(run, program))
        return judge(program, outcome, unit, expect)

    try:
        writer = llm.chosen(options.llm)
        parsed = clock.timed("codegen", partial(_parsed, question))
    except (EmptyQuestion, LlmOptionRefused) as error:
        outcome = _Outcome(failure=Failure(category="bad_input", message=str(error)))
        return outcome.record(question, clock)
    codegen = _codegen(options, writer.settings)
    if codegen is not Codegen.PARSER and writer.settings.is_configured:
        asked = parsed.expects if isinstance(parsed, Program) else None
        task = Task(question, judged, summary, expect, asked)
        outcome = _with_llm(task, codegen, writer, parsed, clock)
    else:
        outcome = _by_parser(parsed, judged)
        if codegen is not Codegen.PARSER:
            outcome.notes.append("no language model is set up: the parser answered")
    return outcome.record(question, clock)


def _codegen(options: AnswerOptions, settings: LlmSettings) -> Codegen:
    """Who writes programs: as the caller says, else as is set, else both where there is a language model."""
    return options.codegen or settings.codegen or (Codegen.BOTH if settings.is_configured else Codegen.PARSER)


def _parsed(question: str) -> Program | Failure:
    """The parser's program, or why it has none. Raises EmptyQuestion."""
    try:
        return parse(question)
    except NotUnderstood as error:
        return Failure(category="not_understood", message=error.message, nearest=error.nearest)


def _by_parser(parsed: Program | Failure, judged: Callable[[Program], Verdict]) -> _Outcome:
    if isinstance(parsed, Failure):
        return _Outcome(failure=parsed)
    return _Outcome(chosen=Candidate(parsed, judged(parsed)))


def _with_llm(task: Task, codegen: Codegen, writer: LlmWriter, parsed: Program | Failure, clock: _Clock) -> _Outcome:
    """What comes of the language model's programs, and of the parser's where both answer or the model has none."""
    written = clock.timed("llm", partial(writer.write, task))
    answered = [candidate for candidate in written.candidates if candidate.verdict.answer is not None]
    outcome = _Outcome(attempts=tuple(written.attempts))
    if written.error is not None:
        outcome.notes.append(str(written.error))
    if codegen is Codegen.BOTH or not answered:
        by_parser = _by_parser(parsed, task.judge)
        outcome.failure = by_parser.failure
        if by_parser.chosen is not None and by_parser.chosen.verdict.answer is not None:
            if not answered:
                outcome.notes.append("the language model wrote no program that answers: the parser answered")
            answered.insert(0 if _is_sure(by_parser.chosen) else len(answered), by_parser.chosen)
        outcome.chosen = next(iter(written.candidates), by_parser.chosen)
    if answered:
        _vote(answered, outcome)
    return outcome


def _is_sure(candidate: Candidate) -> bool:
    """Has the parser used every word as it stands? Then it is right more often than a language model."""
    return candidate.program.confidence == 1.0


def _vote(answered: Sequence[Candidate], outcome: _Outcome) -> None:
    """The answer that most programs give; of as many, the first's."""
    groups: list[list[Candidate]] = []
    for candidate in answered:
        group = next((group for group in groups if _agree(group[0], candidate)), None)
        if group is None:
            groups.append([candidate])
        else:
            group.append(candidate)
    groups.sort(key=len, reverse=True)
    outcome.chosen = groups[0][0]
    if len(answered) > 1:
        outcome.agreement = Agreement(agreeing=len(groups[0]), programs=len(answered))
    outcome.others = [group[0] for group in groups[1:]]


def _agree(a: Candidate, b: Candidate) -> bool:
    first, second = a.verdict.answer, b.verdict.answer
    return first is not None and second is not None and same_value(first, second)


@dataclass(slots=True)
class _Outcome:
    """What came of a question, as far as it is known: the program that answers, or why none does."""

    chosen: Candidate | None = None
    failure: Failure | None = None
    others: list[Candidate] = field(default_factory=list)
    agreement: Agreement | None = None
    attempts: tuple[Attempt, ...] = ()
    notes: list[str] = field(default_factory=list)

    def record(self, question: str, clock: _Clock) -> AnswerRecord:
        """The outcome as the contract has it."""
        verdict = self.chosen.verdict if self.chosen is not None else Verdict(failure=self.failure)
        program = self.chosen.program if self.chosen is not None else None
        return AnswerRecord(
            question=question,
            status=verdict.status if self.chosen is not None else Status.FAILED,
            answer=verdict.answer,
            code=program.code if program is not None else None,
            codegen=program.codegen if program is not None else None,
            parts=verdict.parts,
            timings_ms=clock.timings_ms,
            warnings=tuple(dict.fromkeys((*self.notes, *self._disagreement(), *verdict.warnings))),
            failure=verdict.failure,
            attempts=self.attempts,
            agreement=self.agreement,
            alternatives=tuple(_alternative(other) for other in self.others),
            tokens=sum((attempt.tokens for attempt in self.attempts), TokenUse()) if self.attempts else None,
        )

    def _disagreement(self) -> list[str]:
        others = [f"the program of the {_writer(other)} gives {_text(other)}" for other in self.others]
        return [f"programs disagree: {', '.join(others)}"] if others else []


def _writer(candidate: Candidate) -> str:
    codegen = candidate.program.codegen
    return codegen if codegen == "parser" else f"language model ({codegen})"


def _text(candidate: Candidate) -> str:
    return candidate.verdict.answer.text if candidate.verdict.answer is not None else "none"


def _alternative(candidate: Candidate) -> Alternative:
    answer = candidate.verdict.answer
    assert answer is not None
    return Alternative(codegen=candidate.program.codegen, code=candidate.program.code, answer=answer)


class _Clock:
    """How long did each step take? Milliseconds by step, in the order in which they began; steps within count apart."""

    def __init__(self) -> None:
        self.timings_ms: dict[str, float] = {}
        self._within_ms = 0.0

    def timed(self, step: str, work: Callable[[], T]) -> T:
        """Does the work; adds its time, without that of steps inside it, to the step's."""
        self.timings_ms.setdefault(step, 0.0)
        outer_ms, self._within_ms = self._within_ms, 0.0
        start = time.perf_counter()
        try:
            return work()
        finally:
            spent_ms = (time.perf_counter() - start) * 1e3
            self.timings_ms[step] = round(self.timings_ms[step] + spent_ms - self._within_ms, 3)
            self._within_ms = outer_ms + spent_ms
