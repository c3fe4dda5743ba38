"""A question without a language model: its readings are grounded and ranked, and the best few programs are run."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from querycad_contracts import (
    Alternative,
    AnswerType,
    Expectation,
    Failure,
    Grounded,
    LengthUnit,
    Measure,
    ModelSummary,
    Part,
    PartQuery,
    Program,
    RunOutcome,
    RunStatus,
)
from querycad_language.forms import Count, Every, Exists, Get, Parts, Reduce
from querycad_language.lexicon import lexicon
from querycad_language.phrases import bare_of
from querycad_language.readings.reader import Reader

from .addressing import Addressed, address, folded, is_certain, is_restricted, may_name_parts, names_all, reader_of
from .affinity import Affinity
from .candidates import CALLED_SO, Absence, Candidate, Ground, absences, candidates, things, with_value
from .companion_values import beside, is_of_whole, of_height, reads_height, standing
from .confidence import PASSED_OVER, most, skipped, unchecked
from .drawing.callouts import ids_text, told_parts
from .drawing.meaning import describe
from .drawing.numbers import significant
from .drawing.threads import asks_for_screw, with_screw
from .judging import Verdict, judge
from .ranking import SHOWN, Ranked, Value, ranked, softmax
from .typed import is_like
from .unanswerable import Refused, cannot_know, nothing_asked, unread
from .value_order import in_order, order_of

UNTRIED = 0.05
"""Share of the probability that programs may hold which are never run: what they would give counts as another value."""
GRAMS_BELOW_KG = 0.1
"""Lighter parts are told in grams."""
SHOWN_SHARE = 0.02
"""A reading with less of the probability is no alternative."""

LIKELY = 0.15
"""As likely as the likeliest reading is, at least, another one that an agent is told of."""

KIN = 0.5
"""So probable must it be, more likely than not, that a noun which is no product's, 'keyway' or 'rib', means parts of a
like kind where the model has none of its own: less would be an answer about parts that are called otherwise."""
_HOW_FAR = re.compile(r"\bhow (far|long|wide|deep|high|tall|thick)\b", re.IGNORECASE)
_PLACES = (AnswerType.POINT, AnswerType.POINTS, AnswerType.DIRECTION, AnswerType.DIRECTIONS)
"""What nobody means who asks how far something is."""
_ALL_SUCH = {"ids": (), "definite": False, "plural": True, "count": None}
Run = Callable[[Program], RunOutcome]
"""Runs a program against the model that the question is about."""


@dataclass(frozen=True, slots=True)
class ModelView:
    """What the ranking of readings looks at: how queries are grounded on the model, and what stands for the whole."""

    ground: Ground
    whole: Part
    names: frozenset[str] = frozenset()
    """Words of the product names in the file."""
    kinds: tuple[str, ...] = ()
    """Kinds of part that the model has, the most frequent first."""
    contents: Callable[[], tuple[ModelSummary, Sequence[Part]]] | None = None
    """What a description is made of: the summary of the model, and all its parts."""


@dataclass(frozen=True, slots=True)
class Understood:
    """The best reading with its answer, or why there is none: `failure`, or the verdict's own."""

    program: Program | None = None
    verdict: Verdict = field(default_factory=Verdict)
    confidence: float | None = None
    understood_as: str = ""
    ignored: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    """How names of parts were taken."""
    others: tuple[Alternative, ...] = ()


class Understanding:
    """One question on one model. Nothing is read before it is asked for, and nothing run before `answered`."""

    def __init__(self, question: str, view: ModelView, expect: Expectation, at_most: float = 1.0) -> None:
        """No answer is surer than `at_most`."""
        self.question = folded(question)
        self._view = view
        self._expect = expect
        self.at_most = at_most
        self._outcomes: dict[str, RunOutcome] = {}
        self.grounded: dict[PartQuery, Sequence[Grounded]] = {}

    @cached_property
    def _asked(self) -> Refused:
        return Refused(reader_of(self.addressed, self._view.names), self._view.kinds)

    @property
    def reader(self) -> Reader:
        """The question as it is read."""
        return self._asked.reader

    @cached_property
    def addressed(self) -> Addressed:
        """The question with the parts that it names by their ids."""
        if self._view.contents is None or not may_name_parts(self.question):
            return Addressed((self.question,))
        return address(self.question, self._view.contents()[1])

    @cached_property
    def affinity(self) -> Affinity:
        """How well the words of the question go with programs."""
        return Affinity(self.reader.text.words, self._view.whole)

    @cached_property
    def ranked(self) -> list[Candidate]:
        """The programs that may answer, the best first; those of the expected type where any is."""
        found = candidates(self.reader.readings, self._ground, self._view.whole, self.affinity)
        found = [one for one in found if names_all(one.reading, self.addressed.ids)] or found
        if _HOW_FAR.search(self.question):
            found = [one for one in found if one.written.expects not in _PLACES] or found
        wanted = self._expect.type
        fitting = [one for one in found if wanted is None or is_like(one.written.expects, wanted)]
        return [self._ordered(one) for one in fitting or found]

    def _ordered(self, candidate: Candidate) -> Candidate:
        """The candidate with its values in the order that the question asks for."""
        order, written = order_of(self.reader.text), candidate.written
        if order is None:
            return candidate
        return replace(candidate, written=replace(written, code=in_order(written.code, written.expects, order)))

    def _ground(self, queries: Sequence[PartQuery]) -> Sequence[Sequence[Grounded]]:
        ways = self._view.ground(queries)
        self.grounded.update(zip(queries, ways, strict=True))
        return ways

    @cached_property
    def refused(self) -> Failure | None:
        """Why is no program run at all?"""
        if self.addressed.failure is not None:
            return self.addressed.failure.model_copy(update={"nearest": self._view.kinds})
        asked = self._asked
        best = next(iter(self.ranked), None)
        return cannot_know(asked, best) or nothing_asked(asked, best)

    @cached_property
    def absences(self) -> list[Absence]:
        """The readings of parts that the model may lack, the best first."""
        _ = self.ranked  # which grounds the queries
        return absences(self.reader.readings, self.grounded, self._view.names, self.affinity)

    @property
    def readings(self) -> tuple[str, ...]:
        """How the question may be understood, in plain words, the likeliest first; a few, and none that is unlikely.

        A small language model took "radius of the whole model", a hundredth as likely, for what was asked.
        """
        best = max((one.score for one in self.ranked), default=0.0)
        likely = (one for one in self.ranked if math.exp(one.score - best) >= LIKELY)
        return tuple(dict.fromkeys(meant(one) for one in likely))[:SHOWN]

    def tried(self, run: Run, every: bool = False) -> list[Candidate]:
        """The candidates after their runs: all, or as many as it takes until the best value cannot be overtaken."""
        found: list[Candidate] = []
        scores = [one.score for one in self.ranked]
        for index, candidate in enumerate(self.ranked):
            found.append(self._ran(candidate, run))
            if not every and _is_settled(found, scores[index + 1 :]):
                break
        return found

    def likeliest(self, run: Run) -> Candidate | None:
        """The candidate with the most probable value; where none has a value the best of all."""
        tried = self.tried(run)
        found = self.ranking(tried, [one.score for one in self.ranked[len(tried) :]]).values if tried else ()
        return found[0].candidate if found else next(iter(self.ranked), None)

    def ranking(self, tried: Sequence[Candidate], untried: Sequence[float] = ()) -> Ranked:
        """The values of programs that ran, against those that did not, and against parts that are not there."""
        return ranked(tried, untried, () if self.addressed.ids else self.absences)

    def missing(self, ranking: Ranked) -> Failure | None:
        """Which part is not there, where that is more probable than all values together?

        Not so of a noun for products that stands alone, as 'the beam': the one body of a file may be one.
        """
        best = ranking.values[0].candidate.features if ranking.values else {}
        query = self.absences[0].query if ranking.is_absent else None
        noun = lexicon().nouns.get(query.noun) if query is not None and "whole_alone" in best else None
        if query is None or (noun is not None and noun.product and bare_of(query, query.noun)):
            return None
        return self._asked.absent(self.absences[0])

    def _may_lack(self, ranking: Ranked) -> Iterator[str]:
        """That the part may be missing, where that is more probable than the best value."""
        if ranking.absent > max((one.share for one in ranking.values), default=0.0):
            yield f"it may not be there: {self._asked.absent(self.absences[0]).message}"

    def _ran(self, candidate: Candidate, run: Run) -> Candidate:
        code = candidate.written.code
        if code not in self._outcomes:
            self._outcomes[code] = run(_program(candidate))
        outcome = self._outcomes[code]
        if outcome.status is not RunStatus.OK:
            return with_value(candidate, None, self._view.whole.extents)
        return with_value(candidate, outcome.value, self._view.whole.extents)

    def answered(self, run: Run, unit: LengthUnit, every: bool = False) -> Understood:
        """What is the most probable answer, and what else may be meant? Or is what is asked about not there?

        Where none that ran first is of the type that is wanted, `every` one runs.
        """
        if self.refused is not None:
            return Understood(verdict=Verdict(failure=self.refused))
        tried = self.tried(run, every)
        untried = [one.score for one in self.ranked[len(tried) :]]
        ranking = self.ranking(tried, untried)
        if (missing := self.missing(ranking)) is not None:
            return Understood(verdict=Verdict(failure=missing))
        found, told = ranking.values, math.fsum(one.share for one in ranking.values)
        for index, best in enumerate(self._certain(one, told) for one in found):
            verdict = self._verdict(best.candidate, best.confidence, unit)
            if verdict.answer is not None:
                if (missing := self._stood_in_for(best)) is not None:
                    return Understood(verdict=Verdict(failure=missing))
                rest = [one for i, one in enumerate(found) if i != index]
                others = self._others(best.candidate, rest, unit)
                notes = [
                    *self._may_lack(ranking),
                    *beside(best.candidate, unit),
                    *self._because(best.candidate, run, unit),
                ]
                if (other := self._standing(best.candidate, run, unit)) is not None:
                    others, notes = (other[0], *others)[:SHOWN], [*notes, other[1]]
                return self._understood(best, verdict, others, notes)
            if best.candidate.value == [] and best.candidate.written.expects is AnswerType.PARTS:
                break  # that none is so is likelier than the other readings
        if untried and self._expect.type is not None:
            return self.answered(run, unit, every=True)
        if not tried:
            return Understood(verdict=Verdict(failure=unread(self._asked)))
        first = found[0].candidate if found else tried[0]
        return Understood(_program(first), self._verdict(first, 0.0, unit), understood_as=meant(first))

    def _certain(self, best: Value, told: float) -> Value:
        """The value with the confidence that it has where every part is named by its id, and no word is passed over.

        Then nothing is left to find: it is as sure as the share of its meaning among all that is told, `told`. So is
        the centre of the whole, where the words name the whole.
        """
        ids = self.addressed.ids
        form = best.candidate.reading.form
        whole = isinstance(form, Get) and form.target is None and form.measures == (Measure.POSITION,)
        named = bool(ids) and is_certain(form) and names_all(best.candidate.reading, ids)
        named = named or (whole and bool(self.reader.text.at_phrases("whole")))  # 'the center of the object' is one
        sure = max(best.confidence, best.share / told) if named and not skipped(best.candidate) else best.confidence
        if ids and not (names_all(best.candidate.reading, ids) and self._fits(best.candidate)):
            sure = min(sure, PASSED_OVER)
        return replace(best, confidence=min(sure, most(best.candidate, self.reader.text), self.at_most))

    def _fits(self, candidate: Candidate) -> bool:
        """Are the parts that are named by their ids what is said beside: is hole 4 blind in 'the blind hole 4'?

        And is what is said of them meant in its own sense? A hole that has a tap drill's diameter need not be threaded.
        """
        restricted = [query for query in candidate.grounds if query.ids and is_restricted(query)]
        ways = self._view.ground([query.model_copy(update=_ALL_SUCH) for query in restricted]) if restricted else ()
        return "adjective_wider" not in candidate.features and all(
            set(query.ids) <= {part.id for part in found[0].parts}
            for query, found in zip(restricted, ways, strict=True)
        )

    def _stood_in_for(self, best: Value) -> Failure | None:
        """The part that is counted, or looked for, where only the whole model or a guess stands for it.

        Of what is measured, the part that is no product, a keyway or a rib, where parts of a like kind hardly do.
        """
        counts = isinstance(best.candidate.reading.form, Count | Exists)
        for query, taken in best.candidate.grounds.items():
            noun = lexicon().nouns.get(query.noun) if query.known else None
            whole = taken.features.get("whole_sense") and not CALLED_SO & taken.features.keys()
            unlikely = noun is not None and not noun.product and best.confidence < KIN
            guess = counts and (whole or "guessed" in taken.features) and query.noun not in things()
            if guess or (unlikely and "kin_instead" in taken.features):
                return self._asked.absent(Absence(query, taken, {}))  # no propeller is on a flange
        return None

    def _verdict(self, candidate: Candidate, confidence: float, unit: LengthUnit) -> Verdict:
        program = _program(candidate, confidence)
        verdict = judge(program, self._outcomes[candidate.written.code], unit, self._expect)
        form = candidate.reading.form
        if verdict.answer is not None and self._expect.type is None and asks_for_screw(self.reader):
            return replace(verdict, answer=with_screw(verdict.answer, verdict.parts))
        listed = isinstance(form, Parts) and self.reader.text.at_words("list", "listed")
        if listed and verdict.answer is not None and verdict.parts and self._view.contents is not None:
            text = told_parts(verdict.parts, self._view.contents()[1], unit)
            return replace(verdict, answer=verdict.answer.model_copy(update={"text": text}))
        if verdict.answer is not None and isinstance(form, Get) and form.measures == (Measure.MASS,):
            kg = verdict.answer.value
            small = isinstance(kg, float) and kg < GRAMS_BELOW_KG
            text = f"{significant(kg * 1e3)} g" if small else f"{verdict.answer.text} kg"
            return replace(verdict, answer=verdict.answer.model_copy(update={"text": text}))
        if verdict.answer is not None and isinstance(form, Get) and form.reduce is Reduce.RANGE:
            text = verdict.answer.text.replace(f" {unit.value}, ", " to ").replace(", ", " to ")
            return replace(verdict, answer=verdict.answer.model_copy(update={"text": text}))
        return verdict

    def _standing(self, candidate: Candidate, run: Run, unit: LengthUnit) -> tuple[Alternative, str] | None:
        """The height along the axis that the model stands on, where that is not the file's; with a note."""
        if self._view.contents is None or not reads_height(candidate):
            return None  # all parts are a lot to ask for
        summary, parts = self._view.contents()
        whole = is_of_whole(candidate, alone=len(summary.shape.bodies) < 2)
        found = standing(self.reader.text, summary, parts) if whole else None
        if found is None:
            return None
        code = f"solution = shape.extents[{found.axis}]"
        program = _program(candidate).model_copy(update={"code": code})
        answer = judge(program, run(program), unit, self._expect).answer
        if answer is None:
            return None
        note = of_height(found, answer.text)
        meaning = f"height along {'xyz'[found.axis]} of the whole model"
        return Alternative(codegen="parser", code=code, answer=answer, understood_as=meaning), note

    def _because(self, candidate: Candidate, run: Run, unit: LengthUnit) -> Iterator[str]:
        """What was compared, of an answer of yes or no."""
        before = candidate.written.code.rpartition("solution = ")[0]
        for form, expression, expects in candidate.written.compared:
            asked = {"code": f"{before}solution = {expression}", "expects": expects}
            program = _program(candidate).model_copy(update=asked)
            answer = judge(program, run(program), unit, Expectation()).answer
            if answer is not None and answer.text:
                yield f"{'angles' if form is None else describe(form)}: {answer.text}"

    def _understood(
        self, best: Value, verdict: Verdict, others: tuple[Alternative, ...], notes: Sequence[str]
    ) -> Understood:
        candidate = best.candidate
        return Understood(
            program=_program(candidate, best.confidence),
            verdict=verdict,
            confidence=round(best.confidence, 3),
            understood_as=meant(candidate),
            notes=(*self.addressed.notes, *self._taken_for_whole(candidate), *notes),
            ignored=tuple(dict.fromkeys((*skipped(candidate), *unchecked(candidate)))),
            others=others,
        )

    def _taken_for_whole(self, candidate: Candidate) -> Iterator[str]:
        """The product in 'piston rings', where the model is taken for it and has no such name."""
        for query, grounded in candidate.grounds.items():
            for place in query.places if grounded.features.get("compound_whole") else ():
                noun = place.what.noun if place.what is not None else ""
                known = lexicon().nouns.get(noun)
                if noun and (known is None or known.product) and not set(noun.split()) & self._view.names:
                    yield f"not checked: '{noun}', taken for the whole model"

    def _others(self, best: Candidate, rest: Sequence[Value], unit: LengthUnit) -> tuple[Alternative, ...]:
        """The other values that may be meant, the most probable first."""
        found: list[Alternative] = []
        for value in rest:
            verdict = self._verdict(value.candidate, value.confidence, unit)
            if verdict.answer is not None and value.share >= SHOWN_SHARE and len(found) < SHOWN:
                one = Alternative(
                    codegen="parser",
                    code=value.candidate.written.code,
                    answer=verdict.answer,
                    understood_as=_told_apart(value.candidate, best),
                    confidence=round(value.confidence, 3),
                )
                found.append(one)
        return tuple(found)


def meant(candidate: Candidate) -> str:
    """What is asked, in plain words; a noun that is taken for all of the model is said to be."""
    said = describe(candidate.reading.form)
    for query in candidate.grounds:
        said = said.replace(", ".join(query.ids), ids_text(query.ids)) if len(query.ids) > 1 else said
    whole = any(part.kind == "model" for grounded in candidate.grounds.values() for part in grounded.parts)
    whole = whole and not isinstance(candidate.reading.form, Every)
    return f"{said}, which is the whole model" if whole else said


def _told_apart(candidate: Candidate, best: Candidate) -> str:
    """What is asked by another reading than the best one; where the words are the same, what of the parts differs."""
    said = meant(candidate)
    if said != meant(best):
        return said
    count, other = (sum(len(one.parts) for one in each.grounds.values()) for each in (candidate, best))
    if count != other:
        return f"{said}, {count} of them"
    return f"{said}, in another sense of {'the measure' if candidate.written.option else 'the noun'}"


def _program(candidate: Candidate, confidence: float = 0.0) -> Program:
    return Program(
        code=candidate.written.code,
        codegen="parser",
        expects=candidate.written.expects,
        confidence=confidence,
        unused_words=skipped(candidate),
        notes=tuple(f"not checked: {said}" for said in unchecked(candidate)),
    )


def _is_settled(tried: Sequence[Candidate], untried: Sequence[float]) -> bool:
    """Can no program that is left make another value the best?"""
    if not untried:
        return True
    found = ranked(tried, untried).values
    if not found:
        return False
    runs = [one.score for one in tried if one.value is not None and one.value != []]
    left = math.fsum(softmax([*runs, *untried])[len(runs) :])
    second = found[1].share if len(found) > 1 else 0.0
    return left <= UNTRIED and found[0].share > second + left
