"""Comparisons: what two measures give together, and which is more."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from itertools import pairwise

from querycad_contracts import Measure, Relation, Side
from querycad_language.forms import Check, Combine, Distance, Get, Plane, Reduce, Target, Which
from querycad_language.lexicon import Span
from querycad_language.measures import is_length
from querycad_language.phrases import Mention, replace_fields
from querycad_language.phrases.sizes import COMPARISONS
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question, used_by
from querycad_language.readings.requested_measures import asked_in
from querycad_language.tokens import Kind

from .anchors import pairs_named

_PLAIN = dict.fromkeys((Measure.OUTER_DIAMETER, Measure.INNER_DIAMETER), Measure.DIAMETER)


def comparisons(question: Question) -> Iterator[Parse]:
    """'How much longer is the spindle than the lever?', 'What is the ratio of length to width of the keyway?'"""
    yield from _compared(question)
    yield from _which(question)
    yield from _combined(question)
    yield from _clearances(question)


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
    measure, named = _of_noun(question, comparative.value.measure)
    used = {than, *comparative.tokens, *left.used, *right.used, *named}
    times = comparative.start - 1 - text.is_word(comparative.start - 1, "as")  # '2 times as wide', 'many times wider'
    ratio = text.is_word(times, "time")
    a, b = Get((measure,), left.query), Get((own.value.measure if own else measure,), right.query)
    used.update(range(than, own.end) if own else ())  # 'taller than it is wide', 'as long as the block is deep'
    if ratio and text.tokens[times - 1].kind is Kind.NUMBER:
        used.update(range(times - 1, comparative.start))
        factor = Check(Combine("ratio", a, b), Relation.EQUAL, text.tokens[times - 1].value)
        yield Parse(factor, {"check": 1.0}, used | {start})
    elif any(text.is_word(i, "much", "many") for i in range(*question.asking)):
        used.update(range(start, comparative.start))
        yield Parse(Combine("ratio" if ratio else "apart", a, b), {"combined": 1.0}, used)
        if not ratio and measure is Measure.HEIGHT and left.query and right.query:  # how much higher it ends
            tops = Distance(Plane(Side.TOP, left.query), Plane(Side.TOP, right.query))
            yield Parse(tops, {"combined": 1.0, "level_top": 1.0}, used)
    elif text.find(start, "be", "do") or text.is_word(start, "which") or question.closed:
        relation = COMPARISONS.get(comparative.value.degree, Relation.EQUAL)
        yield Parse(Check(a, relation, b), {"check": 1.0}, used | {start})


def _of_noun(question: Question, measure: Measure) -> tuple[Measure, AbstractSet[int]]:
    """'larger in diameter': what is compared, and the words for it."""
    named = next((one for one in asked_in(question) if is_length(one.measures[0])), None)
    if measure is not Measure.MAGNITUDE or named is None:
        return measure, frozenset()
    return _PLAIN.get(named.measures[0], named.measures[0]), named.used  # 'the larger diameter' is no outer one here


def _which(question: Question) -> Iterator[Parse]:
    """'Which is longer, the spindle or the lever?', 'Is the lug or the rib higher?'"""
    text, either = question.text, question.text.at_words("or")
    start = question.asking[0]  # 'which of the lug and the rib is thicker?'
    both = text.is_word(0, "compare") or (text.find(start, "ask") and text.is_word(start + 1, "of", "between"))
    either |= text.at_words("and") if both else set()
    pairs = ((a, b) for a, b in pairwise(question.parts) if not either.isdisjoint(range(a.end, b.start)))
    chosen = both or question.chooses or (question.closed and not text.has("than"))
    left, right = next(pairs, (None, None)) if chosen else (None, None)
    scale = next((span for span in text.all("scale") if span.value.degree != "positive"), None)
    has = next((i for i in text.at_words("more", "less") if text.find(i + 1, "measure")), None)  # 'has more thickness'
    if left is None or right is None or (scale is None and has is None):
        return  # neither is asked for
    more = text.is_word(has or 0, "more") if scale is None else scale.value.degree in ("more", "most")
    which = text.at_words("which", "what", "compare")
    named = used_by(left, right, *(m for m in question.parts if m.start - 1 in which))  # 'which lug'
    rank = next((rank for m in (left, right) for rank in m.part.ranks), None)  # 'A or B that has the greater height'
    measure, said = _of_noun(question, scale.value.measure if scale is not None else Measure.MAGNITUDE)
    measure = rank.measure if rank is not None and rank.measure else measure
    words = (_said(question, left), _said(question, right))
    a, b = (Get((measure,), replace_fields(m.part, ranks=())) for m in (left, right))
    used = {question.asking[0], *which, *either, *(scale.tokens if scale is not None else (has,)), *named, *said}
    yield Parse(Which(a, Relation.MORE if more else Relation.LESS, b, words), {"combined": 1.0}, used)


def _said(question: Question, mention: Mention) -> str:
    """The noun phrase without its article."""
    begin = question.text.skip(mention.start, "article")
    owned = (i for i in range(begin, mention.end) if question.text.is_possessive(i) or question.text.is_word(i, "that"))
    return " ".join(token.raw for token in question.text.tokens[begin : next(owned, mention.end)])


def _combined(question: Question) -> Iterator[Parse]:
    """'the ratio of length to width of A', 'the sum of the heights of A and B'."""
    text, owners = question.text, [m for m in question.mentions if not m.pronoun][:2]
    two = len(owners) > 1 and text.is_word(owners[0].end, "and")  # 'the total width of A and B'
    spans = [span for span in text.all("operation", *["total"] * two) if span.value != "share"]
    numbers = [i for i in sorted(text.at_words("time")) if text.tokens[i - 1].kind is Kind.NUMBER and question.closed]
    spans += [Span(i - 1, i + 1, "times", "ratio") for i in numbers]  # 'is the width of A 2 times that of B'
    spans += [Span(i, i + 1, "exceed", "apart") for i in text.at_words("exceed") if text.has("much")]
    if not spans:
        return
    span, named = spans[0], asked_in(question)
    asked = [one for one in named if one.start >= span.start][:2]
    if len(asked) < (2 if span.value == "ratio" else 1):  # 'the length to width ratio', 'width difference of A and B'
        before = [one for one in named if one.start < span.start]
        asked = [*before[-2 + len(asked) :], *asked]
    measures = [measure for one in asked for measure in one.measures][:2]
    targets: list[Target] = [m.query for m in owners] or [None]
    several = owners[0].query if len(owners) == 1 else None
    if span.value == "apart" and len(measures) == 1 and several is not None and several.plural:
        ends = (Get((measures[0],), several, reduce) for reduce in (Reduce.LARGEST, Reduce.SMALLEST))
        used = {*span.tokens, *owners[0].used, *asked[0].used, *text.at_words("between")}
        yield Parse(Combine("apart", *ends), {"combined": 1.0}, used)  # 'the difference in width of the two lugs'
    if measures and len(measures) + len(targets) > 2:
        left, right = (Get((measures[at],), targets[at]) for at in (0, -1))
        used = used_by(*owners).union(span.tokens, *(one.used for one in asked))
        form = Combine("plus" if span.category == "total" else span.value, left, right)
        factor = Check(form, Relation.EQUAL, text.tokens[span.start].value)
        yield Parse(factor, {"check": 1.0}, used) if span.category == "times" else Parse(form, {"combined": 1.0}, used)


def _clearances(question: Question) -> Iterator[Parse]:
    """'How much play has the pin in its bore, on diameter?': what a bore has more than what runs in it."""
    text = question.text
    asked = text.at_phrases("gap") and text.at_phrases("on_diameter")
    for first, second, used in pairs_named(question.parts, "in", "on", "between") if asked else ():
        form = Distance(first, second, "on radius" if text.has("radial", "radius") else "on diameter")
        yield Parse(form, {"combined": 1.0}, used | text.covered("gap", "on_diameter"))
