"""Comparisons: what two measures give together, and which is more."""

from __future__ import annotations

from collections.abc import Iterator

from querycad_contracts import Measure, Relation, Side
from querycad_language.forms import Check, Combine, Distance, Get, Plane, Target
from querycad_language.measures import is_length
from querycad_language.readings.asked import asked_in
from querycad_language.readings.drafts import Draft
from querycad_language.readings.question import Question
from querycad_language.tokens import Kind


def comparisons(question: Question) -> Iterator[Draft]:
    """'How much longer is the spindle than the lever?', 'What is the ratio of length to width of the keyway?'"""
    yield from _compared(question)
    yield from _combined(question)


def _compared(question: Question) -> Iterator[Draft]:
    """'How much longer is A than B?', 'Is A longer than B?'"""
    text, start = question.text, question.asking[0]
    than = min(text.at_words("than"), default=None)
    scales = [span for i in range(start, len(text)) if (span := text.find(i, "scale"))]
    comparative = next((span for span in scales if span.value.degree in ("more", "less")), None)
    if than is None or comparative is None:
        return
    parts = [m for m in question.mentions if not m.pronoun]
    right = [m for m in parts if m.start > than][:1]
    left = [m for m in parts if m.start < than][-1:] or [m for m in parts if m.start > than][1:2]
    if not left or not right or text.tokens[than + 1].kind in (Kind.QUANTITY, Kind.NUMBER):
        return
    measure, used = comparative.value.measure, {than} | set(comparative.tokens) | left[0].used | right[0].used
    named = next((one for one in asked_in(question) if is_length(one.measures[0])), None)
    if measure is Measure.MAGNITUDE and named is not None:  # 'larger in diameter'
        measure, used = named.measures[0], used | named.used
    a, b = Get((measure,), left[0].query), Get((measure,), right[0].query)
    lead = range(start, comparative.start)
    if any(text.is_word(i, "much", "many") for i in range(*question.asking)):
        used |= set(lead)
        yield Draft(Combine("apart", a, b), {"combined": 1.0}, used)
        if measure is Measure.HEIGHT and a.target is not None and b.target is not None:  # which lies higher
            tops = Distance(Plane(Side.TOP, a.target), Plane(Side.TOP, b.target))
            for form in (tops, Distance(a.target, b.target, "centers", axis=2)):
                yield Draft(form, {"level": 1.0, "combined": 1.0}, used)
    elif text.find(start, "be", "do") or text.is_word(start, "which"):
        relation = Relation.MORE if comparative.value.degree == "more" else Relation.LESS
        yield Draft(Check(a, relation, b), {"check": 1.0}, used | {start})


def _combined(question: Question) -> Iterator[Draft]:
    """'the ratio of length to width of A', 'the sum of the heights of A and B'."""
    span = next(iter(question.text.all("operation")), None)
    if span is None:
        return
    asked = [one for one in asked_in(question) if one.start > span.start] or asked_in(question)
    owners = [m for m in question.mentions if not m.pronoun]
    owners = [m for m in owners if m.start > span.start] or owners
    if not asked:
        return
    used = set(span.tokens) | {i for one in asked[:2] for i in one.used} | {i for m in owners[:2] for i in m.used}
    measures = [measure for one in asked for measure in one.measures]
    targets: list[Target] = [m.query for m in owners[:2]] or [None]
    if len(measures) > 1 or len(owners) > 1:
        left = Get((measures[0],), targets[0])
        right = Get((measures[1] if len(measures) > 1 else measures[0],), targets[-1])
        yield Draft(Combine(span.value, left, right), {"combined": 1.0}, used)
