"""Sizes that are stated: '5 mm holes', 'with a diameter of 5 mm', 'larger than 5 mm', 'from 4 to 6 mm'."""

from __future__ import annotations

from querycad_contracts import Measure, Relation, SizeFilter
from querycad_language.text import Text
from querycad_language.tokens import Kind

from .mention import PhraseBuilder
from .words import noun_follows, scale_at

COMPARISONS = {"more": Relation.MORE, "less": Relation.LESS}
_POWERS = {-1: Measure.MASS, 0: Measure.ANGLE, 1: None, 2: Measure.AREA, 3: Measure.VOLUME}
_LINKS = (
    "with", "of", "a", "an", "the", "is", "are", "between", "from", "in", "whose", "having", "at", "=", "measuring",
    "be", "measure", "about", "size", "sized", "range", "have", "has",
)  # fmt: skip
"""Words between a measure and its value."""


def size_before(text: Text, at: int, build: PhraseBuilder) -> int:
    """'5 mm holes', 'Ø8.5 bores', 'the 40 mm deep pocket', '12 x 40 mm slot'."""
    token = text.tokens[at]
    if token.power != 1:
        return at
    measure, after = token.measure, at + 1
    if (scale := scale_at(text, after, "positive")) is not None:
        measure, after = scale.value.measure, scale.end
    elif (noun := text.find(after, "measure")) and noun_follows(text, noun.end) and not text.find(noun.end, "be"):
        measure, after = noun.value, noun.end
    build.sizes.append(SizeFilter(measure=measure, low=token.value))
    while text.is_word(after, "x") and text.is_kind(after + 1, Kind.QUANTITY):
        build.sizes.append(SizeFilter(low=text.tokens[after + 1].value))
        after += 2
    return after


def stated_size(text: Text, at: int) -> tuple[SizeFilter, int] | None:
    """A stated size that begins here, and where it ends."""
    at = text.skip(at, "article") if not text.find(at, "relation") else at
    end = min(len(text), at + 9)
    measure: Measure | None = None
    relation = Relation.EQUAL
    while at < end:
        token = text.tokens[at]
        if token.kind is Kind.QUANTITY and token.power in _POWERS:
            return _sized(text, at, measure or token.measure or _POWERS[token.power], relation)
        bare = token.kind is Kind.NUMBER and (measure or relation in COMPARISONS.values())
        bare = bare and not text.is_word(at + 1, "time")  # '2 times the width'
        if bare and not noun_follows(text, at + 1) and not text.is_word(at - 2, "more", "less", "fewer"):
            return SizeFilter(measure=measure, relation=relation, low=token.value * 1e-3), at + 1
        wide = scale_at(text, at + 1, "positive") if token.kind is Kind.NUMBER else None
        if wide is not None and not noun_follows(text, wide.end):  # 'is it 8 wide'
            return SizeFilter(measure=wide.value.measure, relation=relation, low=token.value * 1e-3), wide.end
        if scale := text.find(at, "scale"):
            if scale.value.degree in ("most", "least") or not text.is_word(scale.end, "than", "as"):
                return None
            measure = scale.value.measure if scale.value.measure is not Measure.MAGNITUDE else measure
            relation, at = COMPARISONS.get(scale.value.degree, Relation.EQUAL), text.skip(scale.end + 1, "article")
        elif span := text.find(at, "relation"):
            relation, at = relation if text.is_word(at, "of") else span.value, span.end
        elif text.find(at, "negation") and text.is_kind(at + 1, Kind.QUANTITY):
            relation, at = Relation.UNEQUAL, at + 1  # 'that are not 16 mm'
        elif (span := text.find(at, "measure")) and measure is None:
            measure, at = span.value, span.end
        elif text.is_word(at, *_LINKS):
            at += 1
        else:
            return None
    return None


def _sized(text: Text, at: int, measure: Measure | None, relation: Relation) -> tuple[SizeFilter, int]:
    low, high, end = text.tokens[at].value, None, at + 1
    both = text.is_word(end, "and") and "between" in text.words[max(0, at - 3) : at]
    joined = both or text.is_word(end, "to", "-", "through")
    up_to = text.is_word(end, "up") and text.is_word(end + 1, "to")
    upper = end + 1 + up_to + 2 * text.is_word(end + 3, "including")  # 'up to and including'
    if (joined or up_to) and relation is Relation.EQUAL and text.is_kind(upper, Kind.QUANTITY):
        high, end, relation = text.tokens[upper].value, upper + 1, Relation.BETWEEN
    if behind := text.find(end, "behind"):
        relation, end = behind.value, behind.end
    scale, noun = scale_at(text, end, "positive"), text.find(end + text.is_word(end, "in", "of"), "measure")
    if measure is None and scale is not None:
        measure, end = scale.value.measure, scale.end
    elif measure is None and noun is not None and not text.is_word(noun.end, "of"):
        measure, end = noun.value, noun.end
    return SizeFilter(measure=measure, relation=relation, low=low, high=high), end
