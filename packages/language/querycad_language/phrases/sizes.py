"""Sizes that are stated: '5 mm holes', 'with a diameter of 5 mm', 'larger than 5 mm', 'from 4 to 6 mm'."""

from __future__ import annotations

from querycad_contracts import Measure, Relation, SizeFilter
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .mention import Draft
from .words import noun_follows

_COMPARISONS = {"more": Relation.MORE, "less": Relation.LESS}
_LINKS = (
    "with", "of", "a", "an", "the", "is", "are", "between", "from", "in", "whose", "having", "at", "=", "measuring",
    "be", "measure", "about", "size", "sized", "range", "have", "has",
)  # fmt: skip
"""Words between a measure and its value."""


def size_before(text: Text, at: int, draft: Draft) -> int:
    """'5 mm holes', 'Ø8.5 bores', 'the 40 mm deep pocket', '12 x 40 mm slot'."""
    token = text.tokens[at]
    if token.power != 1:
        return at
    after = at + 1
    scale = text.find(after, "scale")
    measure = token.measure
    if scale is not None and scale.value.degree == "positive":
        measure, after = scale.value.measure, scale.end
    elif (noun := text.find(after, "measure")) and noun_follows(text, noun.end) and not text.find(noun.end, "be"):
        measure, after = noun.value, noun.end
    draft.sizes.append(SizeFilter(measure=measure, low=token.value))
    while text.is_word(after, "x") and after + 1 < len(text) and text.tokens[after + 1].kind is Kind.QUANTITY:
        draft.sizes.append(SizeFilter(low=text.tokens[after + 1].value))
        after += 2
    return after


def stated_size(text: Text, at: int) -> tuple[SizeFilter, int] | None:
    """A stated size that begins here, and where it ends."""
    at = text.skip(at, "article") if not text.find(at, "relation") else at
    start = at
    measure: Measure | None = None
    relation = Relation.EQUAL
    for _ in range(7):
        if at >= len(text):
            return None
        token = text.tokens[at]
        if token.kind is Kind.QUANTITY and token.power in (0, 1):
            return _sized(text, at, measure or token.measure, relation)
        if (
            token.kind is Kind.NUMBER
            and measure is not None
            and not text.is_word(at + 1, "hole")
            and at + 1 <= len(text)
            and not noun_follows(text, at + 1)
        ):
            return SizeFilter(measure=measure, relation=relation, low=token.value * 1e-3), at + 1
        if scale := text.find(at, "scale"):
            if scale.value.degree in ("most", "least") or not text.is_word(scale.end, "than", "as"):
                return None
            measure = scale.value.measure if scale.value.measure is not Measure.MAGNITUDE else measure
            relation, at = _COMPARISONS.get(scale.value.degree, Relation.EQUAL), scale.end + 1
        elif span := text.find(at, "relation"):
            if not text.is_word(at, "of") or relation is Relation.EQUAL:
                relation = span.value if not text.is_word(at, "of") else relation
            at = span.end
        elif (span := text.find(at, "measure")) and measure is None:
            measure, at = span.value, span.end
        elif text.is_word(at, *_LINKS):
            at += 1
        else:
            return None
        if at - start > 8:
            return None
    return None


def _sized(text: Text, at: int, measure: Measure | None, relation: Relation) -> tuple[SizeFilter, int]:
    token = text.tokens[at]
    low, high, end = token.value, None, at + 1
    if (
        text.is_word(end, "to", "and", "-", "up to")
        and end + 1 < len(text)
        and text.tokens[end + 1].kind is Kind.QUANTITY
    ):
        if relation is Relation.EQUAL and (
            text.words[end] != "and" or any(text.is_word(i, "between") for i in range(max(0, at - 3), at))
        ):
            high, end, relation = text.tokens[end + 1].value, end + 2, Relation.BETWEEN
    if behind := text.find(end, "behind"):
        relation, end = behind.value, behind.end
    scale = text.find(end, "scale")
    if scale is not None and scale.value.degree == "positive" and measure is None:
        measure, end = scale.value.measure, scale.end
    elif measure is None:
        after = end + 1 if text.is_word(end, "in", "of") else end
        if (span := text.find(after, "measure")) and not text.is_word(span.end, "of"):
            measure, end = span.value, span.end
    return SizeFilter(measure=measure, relation=relation, low=low, high=high), end
