"""What comes of a program that was run: a typed answer with what it rests on, or why there is none."""

from __future__ import annotations

from dataclasses import dataclass

from querycad_contracts import (
    Answer,
    AnswerType,
    Expectation,
    Failure,
    FailureCategory,
    Grounding,
    LengthUnit,
    MissingAttribute,
    Part,
    PartKind,
    Program,
    RunOutcome,
    RunStatus,
    Status,
)

from .drawing.callouts import ids_text
from .quantities import measures
from .typed import Unexpected, WrongAnswerType, as_expected, is_like, typed_answer

NO_EXPECTATION = Expectation()


@dataclass(frozen=True, slots=True)
class Verdict:
    """Exactly one of `answer` and `failure`, what it rests on, and what has to be said with it.

    `missing` is the description without parts that is the reason of a failure 'not_grounded'. `wrong_type`: the
    program's result is not of the type that the question asks for.
    """

    answer: Answer | None = None
    failure: Failure | None = None
    parts: tuple[Part, ...] = ()
    warnings: tuple[str, ...] = ()
    missing: Grounding | None = None
    wrong_type: bool = False

    @property
    def status(self) -> Status:
        """How did the question end?"""
        if self.answer is not None:
            return Status.ANSWERED
        missing = self.failure is not None and self.failure.category is FailureCategory.NOT_GROUNDED
        return Status.NOT_GROUNDED if missing else Status.FAILED

    @property
    def lacking(self) -> MissingAttribute | None:
        """The measure for want of which the program ended; not one that it gave as None."""
        if self.failure is None or self.failure.category != "program" or self.wrong_type:
            return None
        return self.failure.missing_attribute


def judge(
    program: Program, outcome: RunOutcome, unit: LengthUnit = LengthUnit.MM, expect: Expectation = NO_EXPECTATION
) -> Verdict:
    """What comes of the program's run? `unit` is the one of the answer's text."""
    warnings = _warnings(program, outcome)
    missing = _missing(outcome, program)
    if missing is not None:
        failure = Failure(category=FailureCategory.NOT_GROUNDED, message=missing.message, nearest=missing.nearest)
        return Verdict(failure=failure, warnings=warnings, missing=missing)
    if (lacking := _lacking(program, outcome)) is not None:
        return Verdict(failure=lacking, warnings=warnings)
    if outcome.status is not RunStatus.OK:
        category = (
            FailureCategory.PROGRAM
            if outcome.status in (RunStatus.RAISED, RunStatus.REFUSED)
            else FailureCategory.LIMIT
        )
        message = outcome.message or f"the program {outcome.status.value}"
        failure = Failure(category=category, message=message, missing_attribute=outcome.missing_attribute)
        return Verdict(failure=failure, warnings=warnings)
    try:
        answer = as_expected(_typed(program, outcome, unit, expect), expect, unit)
    except WrongAnswerType as error:
        absent = outcome.missing_attribute
        of = f" ({absent.part or 'the model'} has no {absent.attribute})" if absent is not None else ""
        failure = Failure(category=FailureCategory.PROGRAM, message=f"{error}{of}", missing_attribute=absent)
        return Verdict(failure=failure, warnings=warnings, wrong_type=True)
    except Unexpected as error:
        return Verdict(failure=Failure(category=FailureCategory.UNEXPECTED, message=str(error)), warnings=warnings)
    return Verdict(answer=_named(answer, outcome), parts=_parts(outcome), warnings=warnings)


def _named(answer: Answer, outcome: RunOutcome) -> Answer:
    """Bodies by their names, with ids: 'Base plate (body-1), Screw (body-5..8)'."""
    if answer.type is not AnswerType.PARTS:
        return answer
    known = _known(outcome)
    told = [known.get(each.get("part")) for each in answer.value]
    ids: dict[str, list[str]] = {}
    for part in told:
        if part is None or part.kind is not PartKind.BODY or not part.name:
            return answer
        ids.setdefault(part.name, []).append(part.id)
    text = ", ".join(f"{name} ({ids_text(own)})" for name, own in ids.items())
    return answer.model_copy(update={"text": text or answer.text})


def _lacking(program: Program, outcome: RunOutcome) -> Failure | None:
    """What is wrong where the measure that the question asks for is none of the part's, or parts are too few for it?

    Programs of language models may ask for what nobody asked: their errors are sent back to them.
    """
    if program.codegen != "parser":
        return None
    known = _known(outcome)
    if outcome.empty_selection:
        message = f"the model has {len(known)} such part{'' if len(known) == 1 else 's'}: too few for what is asked"
        return Failure(category=FailureCategory.NOT_GROUNDED, message=message)
    missing = outcome.missing_attribute
    if missing is None:
        return None
    label = known[missing.part].label if missing.part in known else missing.part
    whose = f"{label} ({missing.part})" if missing.part else "the whole model"
    message = f"no {missing.attribute.replace('_', ' ')} is known of {whose}"
    return Failure(category=FailureCategory.NOT_GROUNDED, message=message, missing_attribute=missing)


def _typed(program: Program, outcome: RunOutcome, unit: LengthUnit, expect: Expectation) -> Answer:
    """The answer, of the type that the caller expects where the program's own type leaves the choice."""
    wanted = program.expects
    if expect.type is not None and (wanted is None or is_like(wanted, expect.type)):
        try:
            return typed_answer(outcome.value, expect.type, unit, program.code)
        except WrongAnswerType as error:
            raise Unexpected(str(error)) from error
    return typed_answer(outcome.value, wanted, unit, program.code)


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
    counted = _counts(program, outcome)
    only_empty = all(not grounding.parts for grounding in outcome.groundings)
    return empty if only_empty and not counted and isinstance(outcome.value, int | float) else None


def _counts(program: Program, outcome: RunOutcome) -> bool:
    """Is the result a number of parts, or whether there are any? A sum of no lengths is neither."""
    if program.expects is None:
        return isinstance(outcome.value, int) and not measures(program.code)
    return program.expects in (AnswerType.COUNT, AnswerType.BOOLEAN)


def _warnings(program: Program, outcome: RunOutcome) -> tuple[str, ...]:
    warnings = list(program.notes)
    if program.unused_words:
        warnings.append("not taken into account: " + ", ".join(program.unused_words))
    for grounding in outcome.groundings:
        warnings.extend(grounding.warnings)
        if grounding.understood and not grounding.parts:
            warnings.append(grounding.message)
    if outcome.walls_missing:
        warnings.append(f"the program ran without these walls: {', '.join(outcome.walls_missing)}")
    return tuple(dict.fromkeys(warnings))


def _known(outcome: RunOutcome) -> dict[str, Part]:
    """The parts that the program found, by id."""
    return {part.id: part for grounding in outcome.groundings for part in grounding.parts}


def _parts(outcome: RunOutcome) -> tuple[Part, ...]:
    """The parts that the result rests on, in the order in which the program used them."""
    known = _known(outcome)
    return tuple(known[part_id] for part_id in dict.fromkeys(outcome.used_parts) if part_id in known)
