"""The steps of one question: programs are written, run and their results typed. The same in every runtime."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import TypeVar

from querycad_contracts import (
    Agreement,
    Alternative,
    Answer,
    AnswerOptions,
    AnswerRecord,
    AnswerType,
    Attempt,
    Codegen,
    Description,
    Expectation,
    Failure,
    FailureCategory,
    GroundedBy,
    LengthUnit,
    Measure,
    ModelSummary,
    Part,
    PartKind,
    PictureRequest,
    Program,
    RunOutcome,
    Status,
    TokenUse,
    Unit,
)
from querycad_contracts.answers import LEAST_CONFIDENCE
from querycad_language.forms import Get
from querycad_language.tokens import MAX_CHARS

from .addressing import folded
from .compound import clauses, together
from .confidence import AS_ONE, BY_SIGHT_AT_MOST, OTHER_CLASS
from .conversation import NotFollowed, not_followed, stands_alone
from .drawing.asked_units import asked_unit, in_asked_unit, without_asked_unit
from .drawing.callouts import ids_text, told_parts
from .drawing.describing import describe
from .eyes.mark_voting import Place
from .eyes.visual_questions import Seeing
from .judging import Verdict, judge
from .llm import Candidate, LlmOptionRefused, LlmSettings, LlmWriter, Parsed, Task
from .llm.reference import BY_SIGHT
from .overview import asks_for_overview, asks_what_parts_are
from .ranking import SHOWN
from .typed import Unexpected, as_expected, same_value
from .understanding import ModelView, Run, Understanding, Understood

T = TypeVar("T")

NO_OPTIONS = AnswerOptions()
NO_LLM = LlmWriter(LlmSettings())
SURER = 0.2
"""By so much surer than all of them together, a question that may be several is read as one: of 35 such among 5,901
the one value was right in 30, all values together in one."""
SURE = 0.8
"""An answer of the parser that is at least as probable goes before a language model's."""


def answer_question(
    question: str,
    run: Run,
    view: ModelView,
    unit: LengthUnit = LengthUnit.MM,
    options: AnswerOptions = NO_OPTIONS,
    *,
    summary: ModelSummary | None = None,
    llm: LlmWriter = NO_LLM,
    place: Place | None = None,
) -> AnswerRecord:
    """What is the answer? Never raises for what is wrong with a question or program: the record's `failure` says it.

    `unit` is the one that `answer.text` is written in, unless the words ask for another; `answer.value` is SI whatever
    it is. `view` is what readings are ranked on, `summary` what a language model is told of the model, `place` who
    draws it for eyes, where any are set up.
    """
    if (none := no_question(question)) is not None:
        return none
    question = folded(question)
    least = LEAST_CONFIDENCE if options.least_confidence is None else options.least_confidence
    terms = _Terms(run, view, asked_unit(question) or unit, options.expect or Expectation(), least)
    try:
        writer = llm.chosen(options.llm)
    except LlmOptionRefused as error:
        return terms.refused(question, str(error))
    codegen = options.codegen or writer.settings.default_codegen
    by_sight = options.grounding is GroundedBy.EYES
    seeing = _seeing(writer, place, by_sight or codegen is Codegen.AGENT)
    if seeing is not None:
        terms = replace(terms, run=seeing.running(run), view=seeing.viewing(view) if by_sight else view)
    try:
        asked_for, at_most = _stands_alone(question, options, terms)
    except NotFollowed as error:
        return terms.record(question, _Outcome(failure=not_followed(error)))
    terms = replace(terms, unit=asked_unit(asked_for) or terms.unit)
    understanding = Understanding(without_asked_unit(asked_for), terms.view, terms.expect, at_most)
    if (told := _told(understanding, terms)) is not None:
        return terms.record(question, told)
    if codegen is not Codegen.PARSER and writer.settings.is_configured:
        outcome = _by_llm(understanding, terms, codegen, writer, summary, seeing)
    else:
        both = _compound(understanding, terms)
        if both is not None and terms.expect.type is None:
            return both.model_copy(update={"question": question})
        outcome = _by_parser(terms.read(understanding))
        if codegen is not Codegen.PARSER:
            outcome.notes.append("no language model is set up: the parser answered")
    if seeing is not None:
        outcome.notes += seeing.notes
        outcome.looked = seeing.tokens
    return terms.record(question, outcome)


def described(run: Run, view: ModelView, unit: LengthUnit = LengthUnit.MM) -> Description | None:
    """What is the model, and what can be asked about it? None where the view does not say what the model holds.

    Every question that it suggests has been answered, surely and truly, before.
    """
    if view.contents is None:
        return None
    by_parser, bare = AnswerOptions(codegen=Codegen.PARSER), replace(view, contents=None)

    def ask(question: str) -> Answer | None:
        record = answer_question(question, run, bare, unit, by_parser)
        return record.answer if record.status is Status.ANSWERED else None

    return describe(*view.contents(), unit, ask)


def _stands_alone(question: str, options: AnswerOptions, terms: _Terms) -> tuple[str, float]:
    """The question with what it leans on put in: parts that are pointed at, questions before. Raises NotFollowed.

    And how sure an answer can be at most: as sure as it is which parts the questions before were about.
    """
    if not options.context and options.selection is None:
        return stands_alone(question, (), None, tuple, lambda _: None), 1.0
    contents = terms.view.contents
    if contents is None:
        raise NotFollowed("the parts of the model are not known here, to which the question refers")
    alone = options.model_copy(update={"codegen": Codegen.PARSER, "context": (), "selection": None, "expect": None})

    at_most = 1.0

    def before(text: str) -> list[str] | None:
        nonlocal at_most
        record = answer_question(text, terms.run, terms.view, terms.unit, alone)
        at_most = min(at_most, 1.0 if record.confidence is None else record.confidence)
        found = [part.id for part in record.parts if part.kind is not PartKind.MODEL]
        return found if found or not record.parts else None

    text = stands_alone(question, options.context, options.selection, lambda: contents()[1], before)
    return text, at_most


def _told(understanding: Understanding, terms: _Terms) -> _Outcome | None:
    """What comes of a question that no program answers: what the model is, what a part is. None for any other."""
    question, addressed = understanding.question, understanding.addressed
    parts: tuple[Part, ...] = ()
    contents, unit = terms.view.contents, terms.unit
    if asks_for_overview(question) and (found := described(terms.run, terms.view, unit)) is not None:
        text, meant = found.text, "a description of the model"
    elif contents is not None and asks_what_parts_are(addressed):
        known = contents()[1]
        parts = tuple(part for part in known if part.id in addressed.ids)
        text, meant = told_parts(parts, known, unit), f"what {ids_text([part.id for part in parts])} is"
    else:
        return None
    answer = Answer(value=text, type=AnswerType.TEXT, unit=Unit.NONE, text=text)
    try:
        as_expected(answer.model_copy(update={"text": meant}), terms.expect)
    except Unexpected as error:
        return _Outcome(failure=Failure(category=FailureCategory.UNEXPECTED, message=str(error)))
    program = Program(code="", codegen="parser", expects=AnswerType.TEXT, confidence=1.0)
    verdict = Verdict(answer=answer, parts=parts)
    return _by_parser(Understood(program, verdict, 1.0, meant, notes=addressed.notes))


def _compound(understanding: Understanding, terms: _Terms) -> AnswerRecord | None:
    """What comes of several questions in one; None for any other."""
    best = None
    if understanding.refused is None:
        best = terms.clock.timed("codegen", lambda: understanding.likeliest(terms.timed_run))
    asked = clauses(understanding.reader, best)
    alone = AnswerOptions(codegen=Codegen.PARSER, least_confidence=terms.least)
    records = [
        answer_question(one, terms.run, terms.view, terms.unit, alone.model_copy(update={"context": asked[:index]}))
        for index, one in enumerate(asked)
    ]
    both = together(records, lambda one: terms.judged(one, terms.timed_run(one)).answer) if records else None
    if records and both is None:
        understanding.at_most = min(understanding.at_most, OTHER_CLASS)  # one of them is not answered
    if both is not None and both.confidence is not None:
        single = understanding.answered(terms.run, terms.unit)
        if single.verdict.answer is not None and (single.confidence or 0.0) > both.confidence + SURER:
            understanding.at_most = min(understanding.at_most, AS_ONE)
            return None
    return both


def no_question(question: str) -> AnswerRecord | None:
    """The record of what is no question, as it is empty, too long or no text; None of what may be one."""
    sendable = question.encode(errors="replace").decode()
    if len(question) > MAX_CHARS:
        why = f"the question has more than {MAX_CHARS:,} characters"
    elif not question.strip():
        why = "the question is empty"
    elif sendable != question:
        why = "the question is no valid Unicode text"
    else:
        return None
    failure = Failure(category=FailureCategory.BAD_INPUT, message=why)
    return _Outcome(failure=failure).record(folded(sendable), _Clock(), LEAST_CONFIDENCE)


def _seeing(writer: LlmWriter, place: Place | None, wanted: bool) -> Seeing | None:
    """The question's eyes, where it may need any and there are some."""
    eyes = writer.eyes if wanted and place is not None else None
    return None if eyes is None or place is None else Seeing(eyes, place)


def _tools(
    settings: LlmSettings, seeing: Seeing | None
) -> tuple[tuple[str, ...], Callable[[PictureRequest], bytes] | None]:
    """Which functions of the guest API are there by sight, and who draws: pictures only for who takes them."""
    if seeing is None:
        return (), None
    return (BY_SIGHT, seeing.picture) if settings.llm_images else (("look",), None)


def _asked_type(understanding: Understanding) -> AnswerType | None:
    """The type that the best reading asks for; None where the question's words are not known well enough."""
    best = next(iter(understanding.ranked), None)
    if best is None or understanding.refused is not None or "named_only" in best.features:
        return None
    form = best.reading.form
    if isinstance(form, Get) and Measure.MAGNITUDE in form.measures:
        return None  # 'how large': which size is meant, no word says
    return best.written.expects


def _parsed(found: Understood) -> Parsed | None:
    answer = found.verdict.answer
    if answer is None or found.program is None:
        return None
    return Parsed(answer, found.understood_as, found.program.confidence >= SURE)


def _by_parser(found: Understood) -> _Outcome:
    if found.program is None:
        return _Outcome(failure=found.verdict.failure, understood=found)
    return _Outcome(chosen=Candidate(found.program, found.verdict), understood=found)


def _by_llm(
    understanding: Understanding,
    terms: _Terms,
    codegen: Codegen,
    writer: LlmWriter,
    summary: ModelSummary | None,
    seeing: Seeing | None,
) -> _Outcome:
    """What comes of the language model's programs, and of the parser's where both answer or the model has none."""
    parsed = cache(lambda: terms.read(understanding))
    task = Task(
        understanding.question,
        terms.timed_run,
        terms.judged,
        summary,
        terms.expect,
        terms.clock.timed("codegen", partial(_asked_type, understanding)),
        lambda: understanding.readings,
        lambda: _parsed(parsed()),
        *_tools(writer.settings, seeing),
    )
    written = terms.clock.timed("llm", partial(writer.write, task, looks=codegen is Codegen.AGENT))
    answered = [candidate for candidate in written.candidates if candidate.verdict.answer is not None]
    outcome = _Outcome(attempts=tuple(written.attempts))
    if written.error is not None:
        outcome.notes.append(str(written.error))
    if written.question:
        outcome.failure = Failure(
            category=FailureCategory.NOT_UNDERSTOOD, message=f"the language model asks: {written.question}"
        )
        return outcome
    if written.is_unsure:
        outcome.is_unsure, outcome.chosen, outcome.others = True, answered[0], answered[1:]
        return outcome
    if codegen is Codegen.BOTH or not answered or written.yields:
        by_parser = _by_parser(parsed())
        outcome.failure, outcome.understood = by_parser.failure, by_parser.understood
        if by_parser.chosen is not None and by_parser.chosen.verdict.answer is not None:
            if not answered:
                outcome.notes.append("the language model wrote no program that answers: the parser answered")
            answered.insert(0 if by_parser.chosen.program.confidence >= SURE else len(answered), by_parser.chosen)
        outcome.chosen = next(iter(written.candidates), by_parser.chosen)
    if answered:
        _vote(answered, outcome)
    return outcome


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


@dataclass(frozen=True, slots=True)
class _Terms:
    """How is one question answered? What runs programs, what readings are ranked on, in which unit, as what."""

    run: Run
    view: ModelView
    unit: LengthUnit
    expect: Expectation
    least: float
    """An answer less probable than this is unsure."""
    clock: _Clock = field(default_factory=_Clock)

    def timed_run(self, program: Program) -> RunOutcome:
        """What comes of the program?"""
        return self.clock.timed("run", partial(self.run, program))

    def judged(self, program: Program, came: RunOutcome) -> Verdict:
        """Is what came of a program an answer?"""
        return judge(program, came, self.unit, self.expect)

    def read(self, understanding: Understanding) -> Understood:
        """What does the parser answer?"""
        return self.clock.timed("codegen", lambda: understanding.answered(self.timed_run, self.unit))

    def record(self, question: str, outcome: _Outcome) -> AnswerRecord:
        """The outcome as the contract has it."""
        return outcome.record(question, self.clock, self.least)

    def refused(self, question: str, message: str) -> AnswerRecord:
        """The record of a question that cannot be read as one."""
        failure = Failure(category=FailureCategory.BAD_INPUT, message=message)
        return self.record(question, _Outcome(failure=failure))


@dataclass(slots=True)
class _Outcome:
    """What came of a question, as far as it is known: the program that answers, or why none does."""

    chosen: Candidate | None = None
    failure: Failure | None = None
    understood: Understood | None = None
    """What the parser made of the question, where it was asked."""
    others: list[Candidate] = field(default_factory=list)
    agreement: Agreement | None = None
    is_unsure: bool = False
    """Who wrote the programs does not say which of the answers is right."""
    attempts: tuple[Attempt, ...] = ()
    notes: list[str] = field(default_factory=list)
    looked: TokenUse = field(default_factory=TokenUse)
    """What looking at pictures took."""

    def record(self, question: str, clock: _Clock, least: float) -> AnswerRecord:
        """The outcome as the contract has it. An answer less probable than `least` is unsure."""
        verdict = self.chosen.verdict if self.chosen is not None else Verdict(failure=self.failure)
        program = self.chosen.program if self.chosen is not None else None
        understood = self._understood()
        alternatives = self._alternatives(understood)
        status, answer = verdict.status, verdict.answer
        confidence = understood.confidence if understood is not None else None
        if confidence is not None and any(part.evidence.source == "vision" for part in verdict.parts):
            confidence = min(confidence, BY_SIGHT_AT_MOST)
        notes = understood.notes if understood is not None else ()
        answer = in_asked_unit(question, answer) if answer is not None else None
        alternatives = tuple(
            one.model_copy(update={"answer": in_asked_unit(question, one.answer)}) for one in alternatives
        )
        any_asked = bool(self.attempts) or self.looked != TokenUse()
        if answer is not None and answer.type is AnswerType.BOOLEAN and least:
            least = (1 + least) / 2  # a coin is right in half of all cases
        if answer is not None and (self.is_unsure or (confidence is not None and confidence < least)):
            status, answer = Status.UNSURE, _perhaps(answer, understood, alternatives)
        return AnswerRecord(
            question=question,
            status=status,
            answer=answer,
            code=program.code if program is not None and program.code else None,
            codegen=program.codegen if program is not None and program.code else None,
            parts=verdict.parts,
            timings_ms=clock.timings_ms,
            warnings=tuple(dict.fromkeys((*self.notes, *notes, *self._disagreement(), *verdict.warnings))),
            failure=verdict.failure,
            confidence=confidence,
            understood_as=understood.understood_as if understood is not None else "",
            ignored=understood.ignored if understood is not None else (),
            attempts=self.attempts,
            agreement=self.agreement,
            alternatives=alternatives,
            tokens=sum((attempt.tokens for attempt in self.attempts), self.looked) if any_asked else None,
        )

    def _understood(self) -> Understood | None:
        """What the parser made of it, where the answer is its own, or the same."""
        found = self.understood
        if found is None or self.chosen is None or found.program is None:
            return found if self.chosen is None else None
        return found if self.chosen.program is found.program or _agree(self.chosen, self._parsed(found)) else None

    def _parsed(self, found: Understood) -> Candidate:
        assert found.program is not None
        return Candidate(found.program, found.verdict)

    def _alternatives(self, understood: Understood | None) -> tuple[Alternative, ...]:
        """Programs that disagree, then the other readings, each value once."""
        found = [_alternative(other, self.understood) for other in self.others]
        readings = understood.others if understood is not None and self.chosen is not None else ()
        answers = [one.answer for one in found]
        return (*found, *(one for one in readings if not any(same_value(one.answer, known) for known in answers)))

    def _disagreement(self) -> list[str]:
        if self.is_unsure:
            return []
        others = [f"the program of the {_writer(other)} gives {_text(other)}" for other in self.others]
        return [f"programs disagree: {', '.join(others)}"] if others else []


def _perhaps(answer: Answer, understood: Understood | None, alternatives: Sequence[Alternative]) -> Answer:
    """The answer with a text that says what else may be meant."""
    meant = understood.understood_as if understood is not None else ""
    shown = [(answer.text, meant), *((one.answer.text, one.understood_as) for one in alternatives)][:SHOWN]
    texts = [f"{text} ({said})" if said else text for text, said in shown]
    return answer.model_copy(update={"text": "perhaps " + ", or ".join(texts)})


def _writer(candidate: Candidate) -> str:
    codegen = candidate.program.codegen
    return codegen if codegen == "parser" else f"language model ({codegen})"


def _text(candidate: Candidate) -> str:
    return candidate.verdict.answer.text if candidate.verdict.answer is not None else "none"


def _alternative(candidate: Candidate, understood: Understood | None) -> Alternative:
    answer = candidate.verdict.answer
    assert answer is not None
    program = candidate.program
    own = understood is not None and program is understood.program
    return Alternative(
        codegen=program.codegen,
        code=program.code,
        answer=answer,
        understood_as=understood.understood_as if understood is not None and own else "",
        confidence=understood.confidence if understood is not None and own else None,
    )
