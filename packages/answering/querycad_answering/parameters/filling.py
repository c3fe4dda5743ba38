"""The values of parameters: each is asked, typed, and told in the frame and unit that are wanted, or it says why not.

Nothing is guessed: what is not sure enough has no value, but a reason and alternatives, so that a person is asked.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from querycad_answering.answering import NO_LLM, answer_question
from querycad_answering.llm import LlmWriter
from querycad_answering.understanding import ModelView, Run
from querycad_contracts import (
    AnswerOptions,
    AnswerRecord,
    AnswerType,
    Expectation,
    LengthUnit,
    ModelSummary,
    Part,
)
from querycad_contracts.parameters import (
    GivenFrame,
    ModelFrame,
    ParameterRequest,
    ParameterSet,
    ParametersRequest,
    ParameterStatus,
    ParameterType,
    ParameterValue,
)

from .candidate_values import Candidates, Found, names, plain
from .formatting import NotInFrame, Telling
from .frames import MODEL, Rigid
from .placing import Placing, frame_of
from .wording import question_of

SHOWN = 5
"""Alternatives that are told."""
FACES = 1000
TIED = 0.01
"""Two values whose confidence differs by less are as likely: neither is known, however low the bar is set."""
MOST_SURE = 0.99
"""Probabilities of several readings are rounded, and calibrated one by one: their sum proves nothing."""


def fill_parameters(
    asked: ParametersRequest,
    view: ModelView,
    run: Run,
    *,
    other: Callable[[], Sequence[Part]] | None = None,
    summary: ModelSummary | None = None,
    llm: LlmWriter = NO_LLM,
) -> ParameterSet:
    """What are the parameters? `view` and `run` are of the model, `other` gives the parts of the other model.

    Never raises for what is wrong with a parameter: its `reason` says it.
    """
    filling = _Filling(asked, view, run, other, summary, llm)
    found = tuple(filling.value(each) for each in asked.parameters)
    return ParameterSet(
        unit=asked.unit,
        angle_unit=asked.angle_unit,
        parameters=found,
        open=tuple(each.name for each in found if each.status is not ParameterStatus.ANSWERED),
    )


@dataclass(frozen=True, slots=True)
class _Filling:
    """What `fill_parameters` is given, and each of the parameters by it."""

    asked: ParametersRequest
    view: ModelView
    run: Run
    other: Callable[[], Sequence[Part]] | None
    summary: ModelSummary | None
    llm: LlmWriter

    def value(self, one: ParameterRequest) -> ParameterValue:
        """What became of one parameter?"""
        unit = one.unit or self.asked.unit
        wanted = one.frame or self.asked.frame
        frame, why_no_frame = self._frame(one, unit)
        telling = Telling(unit, self.asked.angle_unit, frame or MODEL, is_models=isinstance(wanted, ModelFrame))
        if frame is None:
            candidates = Candidates(reason=why_no_frame)
        elif one.type is ParameterType.MATES:
            candidates = self._placing(telling).mates(one, self._parts(), self.other, self.asked.other)
        elif one.type in _PLACED or (one.type is ParameterType.POINT and one.side is not None):
            candidates = self._placed(one, telling)
        else:
            candidates = self._typed(one, telling)
        return self._told(one, candidates, telling, wanted if telling.has_place(one.type) else None)

    def _typed(self, one: ParameterRequest, telling: Telling) -> Candidates:
        """Values of an answer's types: the best reading of the question, and the others."""
        kind = AnswerType(one.type.value)
        record = self._answer(question_of(one), telling.unit, kind)
        if record.answer is None:
            return Candidates(reason=_why(record), asked=record.question)
        sure = record.confidence if record.confidence is not None else 0.0
        readings = [(record.answer, sure, record.understood_as, record.parts, record.code)]
        readings += [
            (other.answer, other.confidence or 0.0, other.understood_as, (), other.code)
            for other in record.alternatives
            if other.answer.type is kind
        ]
        try:
            found = [
                Found(*telling.answer(answer), confidence, meant, parts, code)
                for answer, confidence, meant, parts, code in readings
            ]
        except NotInFrame as error:
            return Candidates(reason=str(error), asked=record.question)
        reason = "" if self._is_sure(sure) else self._several(one, telling.unit)
        return Candidates(found, reason, record.question, _taken_for(record) + _left_out(record))

    def _several(self, one: ParameterRequest, unit: LengthUnit) -> str:
        """Why one value cannot be told: there are several, if that is sure."""
        kind = _PLURALS.get(one.type)
        record = self._answer(question_of(one), unit, kind) if kind is not None else None
        if record is None or record.answer is None or not self._is_sure(record.confidence):
            return ""
        return f"there are several: {record.answer.text}"

    def _placed(self, one: ParameterRequest, telling: Telling) -> Candidates:
        """Poses, axes, grasps and the ends of a side: the question names a part, at which they are."""
        record = self._answer(question_of(one), telling.unit, None)
        if record.answer is None:
            return Candidates(reason=_why(record), asked=record.question)
        placing = self._placing(telling)
        best, *others = [placing.at(one, reading) for reading in placing.readings(record)]
        found: list[Found] = []
        for each in (found for candidates in (best, *others) for found in candidates.found):
            same = next((known for known in found if known.value == each.value), None)
            if same is None:
                found.append(each)
            else:  # readings exclude each other: that either is meant is as probable as both together
                same.confidence = min(MOST_SURE, same.confidence + each.confidence)
        # words such as "tip" say where on the part: the ends of the part tell that, and no reading of the question
        return Candidates(found, best.reason, record.question, _taken_for(record))

    def _is_sure(self, confidence: float | None) -> bool:
        return confidence is not None and confidence >= self.asked.least_confidence

    def _told(self, one: ParameterRequest, candidates: Candidates, telling: Telling, frame: Any) -> ParameterValue:
        ranked = sorted(candidates.found, key=lambda each: -each.confidence)
        best = ranked[0] if ranked else None
        fields: dict[str, Any] = {
            "name": one.name,
            "type": one.type,
            "unit": telling.unit_name(one.type),
            "frame": frame,
            "asked": candidates.asked,
        }
        if best is None:
            reason = candidates.reason or "nothing in the model answers this"
            return ParameterValue(**fields, status=ParameterStatus.UNANSWERED, reason=reason)
        tied = len(ranked) > 1 and ranked[1].confidence > best.confidence - TIED
        sure = self._is_sure(best.confidence) and not candidates.doubts and not tied
        shown = ranked[1:] if sure else ranked
        alternatives = tuple(each.alternative() for each in shown[:SHOWN])
        fields |= {
            "confidence": round(best.confidence, 3),
            "understood_as": best.understood_as,
            "alternatives": alternatives,
        }
        if not sure:
            several = f"it may be {_listed([each.text for each in shown[:SHOWN]])}"
            reason = "; ".join(filter(None, (several, candidates.reason, *candidates.doubts)))
            return ParameterValue(**fields, status=ParameterStatus.UNSURE, reason=reason)
        faces = tuple(face for part in best.parts for face in part.faces)[:FACES]
        return ParameterValue(
            **fields,
            status=ParameterStatus.ANSWERED,
            value=plain(best.value),
            text=best.text,
            parts=names(best.parts),
            faces=faces,
            code=best.code,
        )

    def _answer(self, question: str, unit: LengthUnit, kind: AnswerType | None) -> AnswerRecord:
        options = AnswerOptions(
            codegen=self.asked.codegen,
            grounding=self.asked.grounding,
            expect=Expectation(type=kind) if kind is not None else None,
            least_confidence=0.0,  # how sure is sure enough is said of the parameter
        )
        return answer_question(question, self.run, self.view, unit, options, summary=self.summary, llm=self.llm)

    def _frame(self, one: ParameterRequest, unit: LengthUnit) -> tuple[Rigid | None, str]:
        """Whose coordinates are wanted? None, and why, where it is a part's that is not found."""
        wanted = one.frame or self.asked.frame
        if isinstance(wanted, ModelFrame):
            return MODEL, ""
        if isinstance(wanted, GivenFrame):
            return Rigid.of_matrix(wanted.matrix, unit.metres), ""
        part, why = self._part_called(wanted.part)
        if part is None:
            return None, f"the frame is not known: {why}"
        frame = frame_of(part, self.run)
        return frame, "" if frame is not None else f"the frame is not known: {part.id} has no axes of its own"

    def _part_called(self, called: str) -> tuple[Part | None, str]:
        by_id = {part.id: part for part in self._parts()}
        if called in by_id:
            return by_id[called], ""
        record = self._answer(f"Where is {called}?", self.asked.unit, None)
        parts = [by_id[part.id] for part in record.parts if part.id in by_id]
        if len(parts) == 1 and self._is_sure(record.confidence):
            return parts[0], ""
        if record.answer is None:
            return None, _why(record)
        return None, f"'{called}' may be {_listed([part.id for part in parts]) or 'several things'}"

    def _parts(self) -> Sequence[Part]:
        assert self.view.contents is not None
        return self.view.contents()[1]

    def _placing(self, telling: Telling) -> Placing:
        return Placing({part.id: part for part in self._parts()}, self.run, telling)


_PLURALS = {
    ParameterType.LENGTH: AnswerType.LENGTHS,
    ParameterType.NUMBER: AnswerType.NUMBERS,
    ParameterType.AREA: AnswerType.AREAS,
    ParameterType.VOLUME: AnswerType.VOLUMES,
    ParameterType.ANGLE: AnswerType.ANGLES,
    ParameterType.POINT: AnswerType.POINTS,
    ParameterType.DIRECTION: AnswerType.DIRECTIONS,
    ParameterType.SIZE: AnswerType.SIZES,
}
_NOT_CHECKED = "not checked: "
_PLACED = (ParameterType.POSE, ParameterType.APPROACH, ParameterType.INSERTION, ParameterType.GRASPS)


def _taken_for(record: AnswerRecord) -> tuple[str, ...]:
    """What the answer took on trust, such as a part for another: a person reads that beside it, a robot cannot."""
    return tuple(warning for warning in record.warnings if warning.startswith(_NOT_CHECKED))


def _left_out(record: AnswerRecord) -> tuple[str, ...]:
    """What the question says and the answer passed over, unless it is said not to be checked."""
    told = {warning.removeprefix(_NOT_CHECKED) for warning in _taken_for(record)}
    words = [word for word in record.ignored if word not in told]
    return (f"not taken into account: {', '.join(words)}",) if words else ()


def _why(record: AnswerRecord) -> str:
    failure = record.failure
    if failure is None:
        return "there is no answer"
    nearest = f" (known here: {', '.join(failure.nearest)})" if failure.nearest else ""
    return f"{failure.message}{nearest}"


def _listed(texts: Sequence[str]) -> str:
    return ", or ".join(dict.fromkeys(texts))
