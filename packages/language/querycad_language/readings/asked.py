"""Measures that a question names: how they are asked for, and which are asked together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from querycad_contracts import Measure
from querycad_language.forms import Reduce
from querycad_language.lexicon import Span
from querycad_language.text import Text

from .question import Question

_REDUCES = (
    ("most", Reduce.LARGEST), ("least", Reduce.SMALLEST), ("mean", Reduce.MEAN), ("different", Reduce.DIFFERENT),
    ("total", Reduce.TOTAL),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Asked:
    """A measure that is named: where, which, and how."""

    start: int
    end: int
    measures: tuple[Measure, ...]
    how: Literal["noun", "how", "verb", "reach", "where"]
    reduce: Reduce | None = None
    used: frozenset[int] = frozenset()


def asked_in(question: Question) -> list[Asked]:
    """The measures that are named, from left to right."""
    taken = {i for mention in question.mentions for i in mention.used}
    found: list[Asked] = []
    at = 0
    while at < len(question.text):
        asked = _asked_at(question, at, taken)
        if asked is not None:
            found.append(asked)
        at = asked.end if asked is not None else at + 1
    return found


def _asked_at(question: Question, at: int, taken: set[int]) -> Asked | None:
    text = question.text
    if text.is_word(at, "how"):
        return _how_many(text, at) if text.is_word(at + 1, "many") and question.is_unit(at + 2) else _how(text, at)
    return _said(text, at, taken) or _named(text, at, taken)


def _how_many(text: Text, at: int) -> Asked | None:
    """'How many millimetres deep is …?'; without a measure in the question: how large."""
    ahead = [text.find(i, "scale") for i in range(at + 3, min(len(text), at + 9))]
    scale = next((span for span in ahead if span and span.value.degree == "positive"), None)
    if scale is None:
        if text.at_phrases("measure", "distance", "reach"):
            return None
        return Asked(at, at + 3, (Measure.MAGNITUDE,), "how", used=frozenset((at, at + 1, at + 2)))
    return Asked(at, at + 3, (scale.value.measure,), "how", used=frozenset((at, at + 1, at + 2, *scale.tokens)))


def _how(text: Text, at: int) -> Asked | None:
    """'How deep is …?', 'How far does … stick out?'"""
    stuff = text.find(at + 2, "stuff") if text.is_word(at + 1, "much") else None
    if stuff is not None:  # 'how much metal is left under the slot?'
        return Asked(at, stuff.end, (Measure.THICKNESS,), "how", used=frozenset(range(at, stuff.end)))
    scale = text.find(at + 1, "scale") or text.find(at + 1 + text.is_word(at + 1, "much", "far", "exactly"), "scale")
    if scale and scale.value.degree == "positive":
        return _joined_scales(text, at, scale)
    if text.is_word(at + 1, "far", "much"):
        for i in range(at + 2, min(len(text), at + 14)):
            if reach := text.find(i, "reach"):
                return Asked(at, at + 2, (reach.value,), "reach", used=frozenset((at, at + 1, *reach.tokens)))
    return None


def _said(text: Text, at: int, taken: set[int]) -> Asked | None:
    """What a verb asks for: 'weigh', 'stick out', 'where'."""
    if (verb := text.find(at, "verbs")) and verb.value in (Measure.MASS, Measure.NAME) and at not in taken:
        return Asked(at, verb.end, (verb.value,), "verb", used=frozenset(verb.tokens))
    if (reach := text.find(at, "reach")) and at not in taken and text.has("far", "much"):
        return Asked(at, reach.end, (reach.value,), "reach", used=frozenset(reach.tokens))
    if where := text.find(at, "where"):
        return Asked(at, where.end, (Measure.POSITION,), "where", used=frozenset(where.tokens))
    return None


def _named(text: Text, at: int, taken: set[int]) -> Asked | None:
    """A noun such as 'depth'."""
    span, noun = text.find(at, "measure"), text.find(at, "noun")
    if span is None or at in taken or (noun and noun.end > span.end):
        return None
    before = range(max(0, at - 4), at)
    if span.value is Measure.AXIS and any(
        text.find(i, "axis_preposition") and not text.is_word(i, "in", "by") for i in before
    ):
        return None  # 'along the screw axis' says how a length is taken
    if text.is_word(at, "across", "middle", "tip") and span.end == at + 1 and noun:
        return None
    return _joined_measures(text, span, taken)


def _joined_scales(text: Text, at: int, scale: Span) -> Asked:
    """'How long and wide is …?'"""
    measures, end = [scale.value.measure], scale.end
    while text.is_word(end, "and", ",") and (more := text.find(end + 1 + text.is_word(end + 1, "how"), "scale")):
        measures.append(more.value.measure)
        end = more.end
    return Asked(at, end, tuple(measures), "how", used=frozenset(range(at, end)))


def _joined_measures(text: Text, span: Span, taken: set[int]) -> Asked:
    """'length, width and height': several measures of one owner; a word before them may say what becomes of them."""
    measures, end = [span.value], span.end
    while True:
        after = end
        while text.is_word(after, "and", ",", "x", "/", "&", "+", "as", "well"):
            after += 1
        after = text.skip(after, "article")
        more = text.find(after, "measure")
        if after == end or more is None or more.value in measures:
            break
        measures.append(more.value)
        end = more.end
    start, reduce = span.start, None
    used = set(range(span.start, end))
    while start > 0:
        before = start - 1
        for category, meaning in _REDUCES:
            word = text.find(before, category)
            if (
                word is not None
                and word.end == start
                and before not in taken
                and not text.is_word(before - 1, "i", "we", "you")
            ):
                reduce = reduce or meaning
                used.add(before)
                break
        else:
            break
        start = before
    return Asked(start, end, tuple(measures), "noun", reduce, frozenset(used))
