"""Modifiers of a noun phrase that need no other noun phrase: quantities, bounds on measures, sides, superlatives."""

from __future__ import annotations

from dataclasses import dataclass, replace

from querycad_contracts import Side

from .meaning import AnyOf, Bound, ByMeasure, ByPlace, Measure, Rank, Relation
from .text import Text
from .tokens import Kind

_MEASURE_OF_POWER = {2: Measure.AREA, 3: Measure.VOLUME}
_UNITLESS = {Measure.AREA: 1e-6, Measure.VOLUME: 1e-9}
_AXES = "xyz"
_LOWER = (Relation.MORE, Relation.AT_LEAST)
_UPPER = (Relation.LESS, Relation.AT_MOST)


@dataclass(frozen=True, slots=True)
class Quantity:
    """A value, or a range, as it stands in the question; `power` None when no unit was said."""

    relation: Relation
    low: float
    high: float | None
    power: int | None
    spelled: bool = False
    """Written as a word, such as 'two'."""


def quantity(text: Text, start: int, end: int) -> tuple[Quantity, int] | None:
    """Which quantity stands here: '5.5 mm', 'at least 4 mm', 'between 4 and 6 mm', '4 mm or more'?"""
    relation = None if text.word_at(start, end, "between", "from") else text.match("relation", start, end)
    at = text.skip(relation[1], end) if relation else start
    if text.word_at(at, end, "between", "from"):
        spanned = _range(text, text.skip(at + 1, end), end)
        if spanned or text.word_at(at, end, "between"):
            return spanned
        relation, at = ("at_least", at), text.skip(at + 1, end)
    if spanned := _range(text, at, end):
        return spanned
    first = text.number(at, end)
    if first is None and relation and text.word_at(at, end, "one"):
        return Quantity(Relation(relation[0]), 1.0, None, None, True), at + 1
    if first is None:
        return None
    kind = Relation(relation[0]) if relation else Relation.EQUAL
    if after := text.match("relation_after", at + 1, end):
        kind, at = Relation(after[0]), after[1] - 1
    return Quantity(kind, first.value, None, first.power, first.raw.isalpha()), at + 1


def _range(text: Text, start: int, end: int) -> tuple[Quantity, int] | None:
    """'4 to 6 mm', '4 - 6 mm', '5 mm ± 0.1 mm'."""
    first, second = text.number(start, end), text.number(start + 2, end)
    if first is None or second is None or first.power not in (None, second.power):
        return None
    if text.word_at(start + 1, end, "±"):
        low, high = first.value - second.value, first.value + second.value
    elif text.word_at(start + 1, end, "to", "and", "-", "till", "until"):
        low, high = sorted((first.value, second.value))
    else:
        return None
    return Quantity(Relation.BETWEEN, low, high, second.power), start + 3


def bound(text: Text, start: int, end: int) -> tuple[Bound | AnyOf, int] | None:
    """Which bound on a measure stands here: 'with a diameter of 5 mm', '10 mm deep', 'deeper than 9 mm'?"""
    at = start
    while at < end:
        if first := _bound(text, at, end):
            return _alternatives(text, *first, end)
        after = text.after("lead", at, end)
        if after is None:
            return None
        at = after
    return None


def _bound(text: Text, start: int, end: int) -> tuple[Bound, int] | None:
    return _measure_first(text, start, end) or _comparative_first(text, start, end) or _quantity_first(text, start, end)


def _alternatives(text: Text, first: Bound, start: int, end: int) -> tuple[Bound | AnyOf, int]:
    """'3 mm or 5 mm': either value; 'at least 3 mm and at most 5 mm', 'from 3 up to 5 mm': a range."""
    joined = text.word_at(start, end, "or", "and", "but")
    second = _quantity_first(text, text.skip(start + joined, end), end)
    if (
        second is None
        or second[0].measure not in (Measure.MAGNITUDE, first.measure)
        or not isinstance(first.low, float)
    ):
        return first, start
    other, after = second
    if first.relation in _LOWER and other.relation in _UPPER and isinstance(other.low, float):
        return Bound(first.measure, Relation.BETWEEN, first.low, other.low), after
    either = text.word_at(start, end, "or") or (joined and first.relation is other.relation is Relation.EQUAL)
    return (AnyOf((first, replace(other, measure=first.measure))), after) if either else (first, start)


def _measure_first(text: Text, start: int, end: int) -> tuple[Bound, int] | None:
    """'a diameter of at least 4 mm', 'radius between 4 and 6 mm', 'a diameter that is larger than 5 mm'."""
    named = text.match("property", start, end)
    if named is None:
        return None
    at = named[1]
    while True:
        found = quantity(text, at, end)
        if found and not (found[0].spelled and found[0].power is None):  # 'the diameter of the four holes'
            return _in_si(text, Measure(named[0]), found[0]), found[1]
        if (compared := comparative(text, at, end)) and (found := quantity(text, compared[2], end)):
            return _in_si(text, Measure(named[0]), replace(found[0], relation=compared[1])), found[1]
        after = text.after("measure_link", at, end)
        if after is None:
            return None
        at = after


def comparative(text: Text, start: int, end: int) -> tuple[Measure, Relation, int] | None:
    """'deeper than', 'not larger in diameter than', 'wider than or equal to': measure, relation and where it ends."""
    negated = text.word_at(start, end, "not", "no")
    for form, relation in (("scale.more", Relation.MORE), ("scale.less", Relation.LESS)):
        found = text.match(form, start + negated, end)
        if found is None:
            continue
        measure, at = _in_measure(text, Measure(found[0]), found[1], end)
        than = text.match("than", at, end)
        if than is None:
            return None
        if than[0] == "inclusive":
            relation = Relation.AT_LEAST if relation is Relation.MORE else Relation.AT_MOST
        return measure, relation.negated if negated else relation, than[1]
    return None


def _in_measure(text: Text, measure: Measure, start: int, end: int) -> tuple[Measure, int]:
    """'(larger) in diameter', '(biggest) by volume': that measure, else the one given."""
    if text.word_at(start, end, "in", "by") and (named := text.match("property", start + 1, end)):
        return Measure(named[0]), named[1]
    return measure, start


def _comparative_first(text: Text, start: int, end: int) -> tuple[Bound, int] | None:
    """'deeper than 9 mm', 'larger in diameter than 5 mm', 'larger than 5 mm in diameter'."""
    compared = comparative(text, start, end)
    found = quantity(text, text.skip(compared[2], end), end) if compared else None
    if compared is None or found is None or found[0].spelled:
        return None
    measure, at = _measure_after(text, found[1], end) or (compared[0], found[1])
    return _in_si(text, measure, replace(found[0], relation=compared[1])), at


def _quantity_first(text: Text, start: int, end: int) -> tuple[Bound, int] | None:
    """'5.5 mm in diameter', 'at least 12 mm deep', '5.5 mm', 'smaller than 5 mm'."""
    found = quantity(text, start, end)
    if found is None or found[0].power == 0 or (found[0].spelled and found[0].power is None):
        return None
    amount, at = found
    at += text.word_at(at, end, "-")
    if after := _measure_after(text, at, end):
        measure, at = after
        if tail := text.match("relation_after", at, end):
            amount, at = replace(amount, relation=Relation(tail[0])), tail[1]
        return _in_si(text, measure, amount), at
    return None if amount.power is None else (_in_si(text, Measure.MAGNITUDE, amount), at)


def _measure_after(text: Text, start: int, end: int) -> tuple[Measure, int] | None:
    """Which measure is named after a quantity: '… deep', '… in diameter', '… diameter', '… across'?"""
    if scale := text.match("scale.positive", start, end):
        return Measure(scale[0]), scale[1]
    at = start + text.word_at(start, end, "in", "of")
    if (named := text.match("property", at, end)) and not text.word_at(named[1], end, "of"):
        return Measure(named[0]), named[1]
    return (Measure.MAGNITUDE, start + 1) if text.word_at(start, end, "across") else None


def _in_si(text: Text, measure: Measure, amount: Quantity) -> Bound:
    """The bound in SI; its measure is told by the unit where no word tells it."""
    if measure is Measure.MAGNITUDE and amount.power is not None:
        measure = _MEASURE_OF_POWER.get(amount.power, measure)
    low, high = amount.low, amount.high
    if amount.power is None:
        scale = _UNITLESS.get(measure, 1e-3)
        text.note("Numbers without a unit are taken as millimetres.")
        low, high = float(f"{low * scale:.12g}"), None if high is None else float(f"{high * scale:.12g}")
    if amount.relation is Relation.ABOUT:
        text.note("'About' is taken as within 10 percent.")
    return Bound(measure, amount.relation, low, high)


@dataclass(frozen=True, slots=True)
class Sides:
    """Sides that a phrase names; `noun` is the word 'face' or 'surface' when they qualify it ('the top face')."""

    sides: tuple[Side, ...]
    all_of_them: bool
    noun: str
    prepositional: bool
    at: bool = False
    """'At the top': what lies at that end, where nothing is visible from there."""
    seen: bool = False
    """Looked at from there ('visible from the top', 'from above'), and not only said to be there ('on the top')."""


def sides(text: Text, start: int, end: int, verbs: bool = True) -> tuple[Sides, int] | None:
    """Which sides stand here: 'from above', 'on the top surface', 'top', 'visible from the left or the right'?

    `verbs` says whether verbs of seeing and being somewhere may precede them.
    """
    at = text.skip(start, end, "verb") if verbs else start
    found: list[Side] = []
    noun, prepositional = "", False
    while one := _side(text, at, end):
        side, noun, with_preposition, at = one
        prepositional = prepositional or with_preposition
        found.append(side)
        joined = text.skip(at, end, "conjunction")
        if joined == at or not _side(text, joined, end):
            break
        at = joined
    if not found:
        return None
    seen = any(text.match("seeing", i, at) or text.match("side_word", i, at) for i in range(start, at))
    ended = text.word_at(text.skip(start, at, "verb"), at, "at") and not noun
    return Sides(tuple(dict.fromkeys(found)), "both" in text.words[start:at], noun, prepositional, ended, seen), at


def _side(text: Text, start: int, end: int) -> tuple[Side, str, bool, int] | None:
    """One side: which, the noun it qualifies, whether a preposition leads to it, and where it ends."""
    if start and text.match("side_of_name", start - 1, start):
        return None  # 'table top'
    if whole := text.match("side_word", start, end):
        return Side(whole[0]), "", True, whole[1]
    at = start
    led = text.match("side_preposition", at + 1, end) or text.match("verb", at + 1, end)
    if text.word_at(at, end, "inside") and led:
        return None  # 'the inside on the left', 'the inside visible from the top'
    while (after := text.after("side_preposition", at, end)) or (at > start and (after := text.after("verb", at, end))):
        at = after
    preposition = at > start
    at = text.skip(at, end, "article", "noise")
    if text.word_at(at, end, "both", "either"):
        at = text.skip(at + 1, end, "side_preposition", "article")
    bare = text.skip(at, end, "whole_adjective")
    at = bare if text.match("side", bare, end) else at
    named = text.match("side", at, end)
    if named is None or text.after("not_a_side", named[1], end):
        return None
    noun = text.after("side_noun", named[1], end)
    if preposition and noun is None and at > start + 1 and start and starts_noun(text, named[1], end):
        return None  # 'holes in the rear panel': the side belongs to the panel
    return Side(named[0]), text.words[noun - 1] if noun else "", preposition, noun or named[1]


_FUNCTION = (
    "verb", "light", "be", "do", "have", "preposition", "conjunction", "lead", "relation", "noise", "side", "negation",
    "whole", "whole_of", "place", "centered", "near", "relative", "unit", "extreme", "scale.more", "scale.less",
    "scale.most", "scale.least", "axis_preposition", "half", "place_extreme", "than", "quantifier", "article",
    "point_verb", "scale.positive", "edge", "side_noun", "center", "property",
)  # fmt: skip


def starts_noun(text: Text, at: int, end: int) -> bool:
    """Does a word stand here that a part is named with, and none of the grammar's?"""
    if at >= end or text.tokens[at].kind is not Kind.WORD:
        return False
    if not any(text.match(category, at, end) for category in _FUNCTION):
        return not any(text.after("side_noun", i, end) for i in range(at + 1, min(end, at + 3)))
    return False


def rank(text: Text, start: int, end: int) -> tuple[Rank, int] | None:
    """Which superlative stands here: 'second largest', 'with the smallest diameter', 'leftmost'?"""
    at, led_by_of = start, False
    while at < end:
        if found := _superlative(text, at, end):
            names_measure = any(text.match("property", i, found[1]) for i in range(at, found[1]))
            return found if names_measure or not led_by_of else None
        after = text.after("lead", at, end)
        if after is None:
            return None
        led_by_of = led_by_of or text.word_at(at, end, "of", "in", "at", "for", "by")
        at = after
    return None


def _superlative(text: Text, start: int, end: int) -> tuple[Rank, int] | None:
    at, nth, count = start, 1, 1
    if ordinal := text.match("ordinal", at, end):
        nth, at = int(ordinal[0]), ordinal[1]
    elif (number := text.number(at, end)) and number.power is None and number.value == int(number.value) > 1:
        count, at = int(number.value), at + 1
    if placed := text.match("place_extreme", at, end):
        return Rank(ByPlace(_AXES.index(placed[0][1])), placed[0][0] == "+", nth, count), placed[1]
    if nth == count == 1 and (found := _measure_is_extreme(text, at, end)):
        return found
    extreme = text.match("extreme", at, end)
    measured = text.match("property", extreme[1], end) if extreme else None
    if extreme and measured and not text.word_at(measured[1], end, "of", "between"):
        return Rank(ByMeasure(Measure(measured[0])), extreme[0] == "largest", nth, count), measured[1]
    for form, largest in (("scale.most", True), ("scale.least", False), ("scale.more", True), ("scale.less", False)):
        if (scale := text.match(form, at, end)) and not text.match("side", at, end):
            measure, after = _in_measure(text, Measure(scale[0]), scale[1], end)
            named = text.match("property", after, end) if measure is Measure.MAGNITUDE else None
            if named and not text.word_at(named[1], end, "of", "between", "than"):  # 'with the larger diameter'
                measure, after = Measure(named[0]), named[1]
            bodies = text.match("whole", after, end) or text.match("whole_plural", after, end)
            if text.word_at(at, end, "highest", "lowest") and bodies:  # 'the highest part in the assembly'
                return Rank(ByPlace(2), largest, nth, count), after
            return None if text.match("than", after, end) else (Rank(ByMeasure(measure), largest, nth, count), after)
    return None


def _measure_is_extreme(text: Text, start: int, end: int) -> tuple[Rank, int] | None:
    """'(whose) diameter is the largest'."""
    named = text.match("property", start, end)
    verb = text.after("be", named[1], end) if named else None
    extreme = text.match("extreme", text.skip(verb, end), end) if verb is not None else None
    if named is None or extreme is None:
        return None
    return Rank(ByMeasure(Measure(named[0])), extreme[0] == "largest"), extreme[1]
