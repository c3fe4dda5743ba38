"""Comparisons: what two measures give together, and which is more."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise, takewhile
from typing import cast

from querycad_contracts import Measure, PartQuery, Relation, Side
from querycad_language.forms import Check, Combine, Count, Distance, Get, Plane, Reduce, Target, Which
from querycad_language.lexicon import Span
from querycad_language.measures import is_length
from querycad_language.phrases import Mention, bare_of, replace_fields
from querycad_language.phrases.sizes import COMPARISONS
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question
from querycad_language.readings.requested_measures import asked_in
from querycad_language.tokens import Kind

from .anchors import pairs_named

_PLAIN = dict.fromkeys((Measure.OUTER_DIAMETER, Measure.INNER_DIAMETER), Measure.DIAMETER)


def comparisons(question: Question) -> Iterator[Parse]:
    """'How much longer is the spindle than the lever?', 'What is the ratio of length to width of the keyway?'"""
    yield from _compared(question)
    yield from _of_two(question)
    yield from _which(question)
    yield from _combined(question)
    yield from _shares(question)
    yield from _clearances(question)
    yield from _more_of(question)


def _compared(question: Question) -> Iterator[Parse]:
    """'How much longer is A than B?', 'Is A longer than B?', 'Is A as long as B?', 'Is it taller than it is wide?'"""
    text, start = question.text, question.asking[0]
    scales = [span for i in range(start, len(text)) if (span := text.find(i, "scale"))]
    alike = next((one for one in scales if text.is_word(one.start - 1, "as") and text.is_word(one.end, "as")), None)
    comparative = next((span for span in scales if span.value.degree in ("more", "less")), alike)
    than = alike.end if alike is comparative and alike else min(text.at_words("than"), default=None)
    if than is None or comparative is None:
        return
    parts = [m for m in question.mentions if not m.pronoun or m.query is None]
    behind = [m for m in parts if m.start > than and not (m.pronoun and text.is_word(m.end, "of"))]  # 'than that of'
    before = [m for m in parts if m.start < than][-1:] or behind[1:2]
    other = next(filter(None, (text.find(i, "scale") for i in range(than + 1, len(text)))), None)
    itself = all(m.pronoun for m in behind)
    own = other if other and other.value.degree == "positive" and (itself or text.find(other.start - 1, "be")) else None
    if not before or not (behind or own) or text.tokens[than + 1].kind in (Kind.QUANTITY, Kind.NUMBER):
        return
    left, right = before[0], (before if own and itself else behind)[0]
    measure, used = comparative.value.measure, {than, *comparative.tokens, *left.used, *right.used}
    measure, used = _of_noun(question, measure, used)
    times = comparative.start - 1 - text.is_word(comparative.start - 1, "as")  # '2 times as wide', 'many times wider'
    ratio = times if text.is_word(times, "time") else None
    factor = text.tokens[times - 1].value if ratio is not None and text.tokens[times - 1].kind is Kind.NUMBER else None
    a, b = Get((measure,), left.query), Get((own.value.measure if own else measure,), right.query)
    used.update(range(than, own.end) if own else ())  # 'taller than it is wide', 'as long as the block is deep'
    if ratio is not None and factor is not None:
        used.update(range(times - 1, comparative.start))
        yield Parse(Check(Combine("ratio", a, b), Relation.EQUAL, factor), {"check": 1.0}, used | {start})
    elif any(text.is_word(i, "much", "many") for i in range(*question.asking)):
        used.update(range(start, comparative.start))
        yield Parse(Combine("apart" if ratio is None else "ratio", a, b), {"combined": 1.0}, used)
        if ratio is None and measure is Measure.HEIGHT and left.query and right.query:  # how much higher it ends
            tops = Distance(Plane(Side.TOP, left.query), Plane(Side.TOP, right.query))
            yield Parse(tops, {"combined": 1.0, "level_top": 1.0}, used)
    elif text.find(start, "be", "do") or text.is_word(start, "which") or question.closed:
        relation = COMPARISONS.get(comparative.value.degree, Relation.EQUAL)
        yield Parse(Check(a, relation, b), {"check": 1.0}, used | {start})


def _of_noun(question: Question, measure: Measure, used: set[int]) -> tuple[Measure, set[int]]:
    """'larger in diameter': what is compared, and the words for it."""
    named = next((one for one in asked_in(question) if is_length(one.measures[0])), None)
    if measure is not Measure.MAGNITUDE or named is None:
        return measure, used
    said = _PLAIN.get(named.measures[0], named.measures[0])  # 'the larger diameter' is no outer one here
    return said, used | named.used


def _which(question: Question) -> Iterator[Parse]:
    """'Which is longer, the spindle or the lever?', 'Is the lug or the rib higher?'"""
    text, either = question.text, question.text.at_words("or")
    start = question.asking[0]  # 'which of the lug and the rib is thicker?'
    both = text.find(start, "ask") and text.is_word(start + 1, "of", "between")
    either |= text.at_words("and") if both else set()
    pairs = ((a, b) for a, b in pairwise(question.parts) if not either.isdisjoint(range(a.end, b.start)))
    chosen = both or question.chooses or (question.closed and not text.has("than"))
    left, right = next(pairs, (None, None)) if chosen else (None, None)
    scale = next((span for span in text.all("scale") if span.value.degree != "positive"), None)
    if left is None or right is None or scale is None:
        return  # neither is asked for
    relation = Relation.MORE if scale.value.degree in ("more", "most") else Relation.LESS
    which = text.at_words("which", "what")
    used = {question.asking[0], *which, *either, *scale.tokens, *left.used, *right.used}
    used = used.union(*(m.used for m in question.parts if m.start - 1 in which))  # 'which lug'
    measure, used = _of_noun(question, scale.value.measure, used)
    words = (_said(question, left), _said(question, right))
    form = Which(Get((measure,), left.part), relation, Get((measure,), right.part), words)
    yield Parse(form, {"combined": 1.0}, used)


def _said(question: Question, mention: Mention) -> str:
    """The noun phrase without its article."""
    begin = question.text.skip(mention.start, "article")
    tokens = takewhile(lambda token: token.kind is not Kind.POSSESSIVE, question.text.tokens[begin : mention.end])
    return " ".join(token.raw for token in tokens)


def _combined(question: Question) -> Iterator[Parse]:
    """'the ratio of length to width of A', 'the sum of the heights of A and B'."""
    text, owners = question.text, [m for m in question.mentions if not m.pronoun][:2]
    two = len(owners) > 1 and text.is_word(owners[0].end, "and")  # 'the total width of A and B'
    spans = text.all("operation", *["total"] * two)
    numbers = [i for i in sorted(text.at_words("time")) if text.tokens[i - 1].kind is Kind.NUMBER and question.closed]
    other = [Span(i - 1, i + 1, "times", "ratio") for i in numbers]  # 'is the width of A 2 times that of B'
    other += [Span(i, i + 1, "exceed", "apart") for i in text.at_words("exceed") if text.has("much")]
    span = next((one for one in (*spans, *other) if one.value != "share"), None)
    if span is None:
        return
    asked = [one for one in asked_in(question) if one.start >= span.start][:2]
    if len(asked) < (2 if span.value == "ratio" else 1):  # 'the length to width ratio', 'width difference of A and B'
        before = [one for one in asked_in(question) if one.start < span.start]
        asked = [*before[-2 + len(asked) :], *asked]
    measures = [measure for one in asked for measure in one.measures]
    targets: list[Target] = [m.query for m in owners] or [None]
    several = owners[0].query if len(owners) == 1 else None
    if span.value == "apart" and len(measures) == 1 and several is not None and several.plural:
        # 'the difference in width between the two lugs'
        ends = (Get((measures[0],), several, reduce) for reduce in (Reduce.LARGEST, Reduce.SMALLEST))
        used = {*span.tokens, *owners[0].used, *asked[0].used, *text.at_words("between")}
        yield Parse(Combine("apart", *ends), {"combined": 1.0}, used)
    if measures and len(measures) + len(targets) > 2:
        left = Get((measures[0],), targets[0])
        right = Get((measures[min(1, len(measures) - 1)],), targets[-1])
        used = set(span.tokens).union(*(one.used for one in asked), *(one.used for one in owners))
        form = Combine("plus" if span.category == "total" else span.value, left, right)
        if span.category == "times":
            yield Parse(Check(form, Relation.EQUAL, text.tokens[span.start].value), {"check": 1.0}, used)
        else:
            yield Parse(form, {"combined": 1.0}, used)


def _shares(question: Question) -> Iterator[Parse]:
    """'What percentage of the lugs are drilled?': of the ones that only their noun names."""
    text = question.text
    span = next((one for one in text.all("operation") if one.value == "share"), None)
    targets = [m.part for m in question.parts if m.part.plural][:2]
    if span is None or not targets:
        return
    whole = next((one for one in targets if bare_of(one, one.noun.split()[-1])), None)
    part = next((one for one in targets if one is not whole), None)
    used = set(span.tokens).union(*(m.used for m in question.parts))
    said = next((one for one in text.all("adjective") if used.isdisjoint(one.tokens)), None)
    if part is None and whole is not None and said is not None:  # '… of the lugs goes through'
        part, used = replace_fields(whole, adjectives=(said.value.name,)), used | set(said.tokens)
    if part is not None:
        noun = part.noun.split()[-1]
        whole = whole or PartQuery(noun=noun, words=(noun,), plural=True)
        yield Parse(Combine("share", Count(part), Count(whole)), {"combined": 1.0}, used)


def _clearances(question: Question) -> Iterator[Parse]:
    """'How much play has the pin in its bore, on diameter?': what a bore has more than what runs in it."""
    text = question.text
    said, radial = text.covered("gap", "on_diameter"), text.has("radial", "radius")
    asked = all(map(text.at_phrases, ("gap", "on_diameter")))
    for first, second, used in pairs_named(question.parts, "in", "on", "between") if asked else ():
        form = Distance(first, second, "on radius" if radial else "on diameter")
        yield Parse(form, {"combined": 1.0}, {*used, *said})


def _more_of(question: Question) -> Iterator[Parse]:
    """'How many more slots than lugs are there?': the number of one less that of the other."""
    text = question.text
    apart = {i for span in text.all("operation") if span.value == "apart" for i in span.tokens}
    apart |= {i for i in text.at_words("minus", "subtract") if text.find(i, "minus") or text.is_word(i, "subtract")}
    counted = {i for at in text.at_phrases("count") for i in (at, at + 1)}
    several = [replace_fields(m.part, also=()) for m in question.parts if m.part.plural]
    several += [also for m in question.parts for also in m.part.also]
    if apart and len(several) == 2 and (counted or not asked_in(question)):  # 'the number of slots minus that of lugs'
        fewer = Combine("apart", Count(several[0]), Count(several[1]))
        yield Parse(fewer, {"combined": 1.0}, {*apart, *counted}.union(*(m.used for m in question.parts)))
    than = min(text.at_words("than"), default=None)
    more = next((i for i in text.at_words("more", "fewer") if text.is_word(i - 1, "many", "there")), None)
    if than is None or more is None or not (text.is_word(more - 2, "how") or question.closed):
        return
    left = next((m for m in question.parts if more < m.start < than), None)
    right = next((m for m in question.parts if m.start > than), None)
    if left is not None and right is not None:
        one, other = Count(left.part), Count(right.part)
        relation = Relation.MORE if text.is_word(more, "more") else Relation.LESS
        form: Check | Combine = Check(one, relation, other) if question.closed else Combine("apart", one, other)
        yield Parse(form, {"combined": 1.0}, {more - 2, more - 1, more, than, *left.used, *right.used})


def _of_two(question: Question) -> Iterator[Parse]:
    """'Is one lug thicker than the other, and by how much?', 'Which of the two is thicker, and by how much?'"""
    text = question.text
    scales = (span for span in text.all("scale") if question.in_question(span.start))
    scale = next((span for span in scales if span.value.degree in ("more", "less")), None)
    one = next((m for m in question.parts if text.is_word(m.start, "one") or text.is_word(m.start - 2, "one")), None)
    thans = (at for at in text.at_words("than") if question.in_question(at))
    than = next((at for at in thans if text.is_word(text.skip(at + 1, "article"), "other")), None)
    much = next((at for at in sorted(text.at_words("much", "many")) if text.is_word(at - 1, "how")), None)
    two = (m for m in question.parts if text.is_word(m.start - 1, "which") or m.part.count == 2)
    both = next((m for m in two if text.is_word(m.start - 1, "of", "which")), None)
    if scale is None or ((one is None or than is None) and (both is None or much is None)):
        return
    named = cast("Mention", one if than is not None and one is not None else both)
    said = {*scale.tokens, *named.used, *range(than or much or 0, len(text))}
    measure, used = _of_noun(question, scale.value.measure, said)
    target = replace_fields(named.part, plural=True, definite=False, sample=False)
    most, least = (Get((measure,), target, reduce) for reduce in (Reduce.LARGEST, Reduce.SMALLEST))
    apart = Combine("apart", most, least)
    yield Parse(
        apart if much is not None else Check(apart, Relation.MORE, 0.0),
        {"combined": 1.0},
        used | set(range(question.asking[0], scale.start)),
    )
