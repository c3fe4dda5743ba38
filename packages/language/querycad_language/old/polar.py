"""Questions answered by yes or no: is there, does it have, are they all, is A larger than B."""

from __future__ import annotations

import math
from dataclasses import replace

from . import modifiers
from .amounts import compared_counts, measured, second_amount
from .distances import two_selections
from .meaning import (
    Aligned,
    Bound,
    Compare,
    Count,
    Every,
    Exists,
    Get,
    Measure,
    Query,
    Relation,
    Scalar,
    Seen,
    Selection,
    Uniform,
    Whole,
    Within,
)
from .phrases import predicate, selection, target
from .readings import bounded
from .relations import whole_noun
from .text import Text
from .values import scalar, value

_MILLIMETRES = 1e-3


def polar(text: Text, start: int, end: int) -> Query | None:
    """'Is there a shaft', 'do all holes have the same diameter', 'is the slot wider than 5 mm'."""
    opening = any(text.match(c, start, end) for c in ("be", "do", "exists"))
    if not opening and not text.word_at(start, end, "can", "has", "have"):
        return None
    for rule in (_exists, _aligned, _uniform, _compared, _value_is, _whole_is, _has, _is_so, _visible):
        if found := text.attempt(rule, start, end):
            return found
    return None


def _exists(text: Text, start: int, end: int) -> Query | None:
    """'are there holes …', 'are there more than five holes', 'are there more holes on the top than on the bottom'."""
    after = text.after("exists", start, end)
    return existence(text, after, end) if after else None


def existence(text: Text, start: int, end: int) -> Query | None:
    """Whether the model has such parts, or so many of them."""
    if counts := compared_counts(text, start, end):
        return Compare(*counts)
    found = modifiers.quantity(text, start, end)
    if found and found[0].power is None and found[0].high is None and found[1] < end:
        parts = selection(text, found[1], end)
        return Compare(Count(parts), found[0].relation, found[0].low) if parts else None
    parts = selection(text, start, end)
    return Exists(parts) if parts else None


def _aligned(text: Text, start: int, end: int) -> Query | None:
    """'is the shaft perpendicular to the hole', 'are the legs parallel (to each other)'."""
    found = text.find("alignment", start, end)
    if found is None:
        return None
    at, kind, after = found
    angle = math.pi / 2 if kind == "perpendicular" else 0.0
    rest = text.skip(after, end, "reciprocal", "conjunction", "side_preposition", "article", "light")
    if rest >= end:
        pair = two_selections(text, start + 1, at, ("and",))
        return Aligned(*pair, angle) if pair else None
    first = selection(text, start + 1, at)
    second = selection(text, rest, end, first) if first else None
    return Aligned(first, second, angle) if first and second else None


def _uniform(text: Text, start: int, end: int) -> Query | None:
    """'do all holes have the same diameter', 'are all holes equally deep', 'is the diameter of all holes the same'."""
    for at in range(start + 1, end):
        found = _sameness(text, at, end)
        if found is None:
            continue
        measure, after = found
        stop = at
        while text.word_at(stop - 1, end, "the", "of", "in", "have", "has", "all", "a"):
            stop -= 1
        if measure is None and after >= end:
            return _same_value(text, start + 1, stop)
        parts = selection(text, start + 1, stop)
        if measure is None or parts is None or text.word_at(after, end, "as", "like"):
            return None
        wanted = bounded(Bound(measure, Relation.EQUAL, 0.0), parts.noun_class, text)
        return Uniform(wanted.measure, parts) if isinstance(wanted, Bound) else None
    return None


def _sameness(text: Text, start: int, end: int) -> tuple[Measure | None, int] | None:
    """'same diameter', 'equal in height', 'equally deep', 'identical': the measure, if one is named, and the end."""
    if same := text.after("same", start, end):
        named = text.match("property", same + text.word_at(same, end, "in"), end)
        return (Measure(named[0]), named[1]) if named else (None, same)
    adverb = text.after("same_adverb", start, end)
    scale = text.match("scale.positive", adverb, end) if adverb else None
    return (Measure(scale[0]), scale[1]) if scale else None


def _same_value(text: Text, start: int, end: int) -> Query | None:
    """'(is) the diameter of all holes (the same)'."""
    found = value(text, start, end)
    if isinstance(found, Get) and isinstance(found.target, Selection):
        return Uniform(found.measures[0], found.target)
    return None


def _compared(text: Text, start: int, end: int) -> Query | None:
    """'is the hole on top larger than the one on the front', 'is the object higher than it is wide'."""
    for at in range(start + 2, end):
        found = modifiers.comparative(text, at, end) or _as_much_as(text, at, end) or _equal_to(text, at, end)
        if found is None:
            continue
        measure, relation, after = found
        after = text.skip(after, end, "noise")
        first: Scalar | None = text.attempt(scalar, start + 1, at)
        if first is None:
            of = text.attempt(target, start + 1, at)
            if of is None or (isinstance(of, Selection) and of.plural and text.number(after, end)):
                return None
            first = measured(text, measure, of)
        second = second_amount(text, after, end, first)
        return Compare(first, relation, second) if second is not None else None
    return None


def _as_much_as(text: Text, start: int, end: int) -> tuple[Measure, Relation, int] | None:
    """'as deep as'."""
    scale = text.match("scale.positive", start + 1, end) if text.word_at(start, end, "as") else None
    if scale is None or not text.word_at(scale[1], end, "as"):
        return None
    return Measure(scale[0]), Relation.EQUAL, scale[1] + 1


def _equal_to(text: Text, start: int, end: int) -> tuple[Measure, Relation, int] | None:
    """'(is the width of the object) equal to (its height)'."""
    found = text.match("relation", start, end)
    if found is None or found[0] != Relation.EQUAL or text.words[found[1] - 1] not in ("to", "as"):
        return None
    return Measure.MAGNITUDE, Relation.EQUAL, found[1]


def _value_is(text: Text, start: int, end: int) -> Query | None:
    """'is the diameter of the shaft 16 mm', 'is the depth of the pocket at least 4 mm'."""
    if not text.match("be", start, end):
        return None
    for at in range(start + 2, end):
        found = modifiers.quantity(text, at, end)
        if found is None or found[0].high is not None or text.skip(found[1], end, "noise") < end:
            continue
        if first := text.attempt(scalar, start + 1, at):
            scale = _MILLIMETRES if found[0].power is None and not isinstance(first, Count) else 1.0
            return Compare(first, found[0].relation, found[0].low * scale)
    return None


def _whole_is(text: Text, start: int, end: int) -> Query | None:
    """'is the object at least 10 cm wide'."""
    at = whole_noun(text, start + 1, end)
    found = modifiers.bound(text, at, end) if at is not None else None
    if found is None or text.skip(found[1], end, "noise") < end or not isinstance(found[0], Bound):
        return None
    bound = found[0]
    if bound.high is not None or bound.measure is Measure.MAGNITUDE:
        return None
    return Compare(Get((bound.measure,), Whole()), bound.relation, bound.low)


def _has(text: Text, start: int, end: int) -> Query | None:
    """'does the part have a pocket', 'does the shaft have a diameter of 16 mm', 'does the flange have holes'."""
    if text.word_at(start, end, "has", "have", "had"):
        after = whole_noun(text, start + 1, end)
        return existence(text, text.skip(after, end, "have"), end) if after else None
    for middle in range(start + 2, end):
        after = text.after("have", middle, end)
        owner = text.attempt(target, start + 1, middle) if after is not None else None
        if owner is None or after is None:
            continue
        if isinstance(owner, Whole):
            return existence(text, after, end)
        found = modifiers.bound(text, after, end)
        if found and text.skip(found[1], end, "noise") >= end:
            if text.match("any", start + 1, end):
                return existence(text, start + 1, end)
            return Every(owner, (bounded(found[0], owner.noun_class, text),))
        many = modifiers.quantity(text, after, end)
        counted = many is not None and many[0].power is None and many[0].high is None and many[1] < end
        parts = selection(text, many[1] if many is not None and counted else after, end)
        if parts and len(parts.phrases) == 1:
            phrase = parts.phrases[0]
            held = Selection((replace(phrase, filters=(*phrase.filters, Within(owner))),))
            return Compare(Count(held), many[0].relation, many[0].low) if many is not None and counted else Exists(held)
    return None


def _is_so(text: Text, start: int, end: int) -> Query | None:
    """'are all holes blind', 'is the hole on the front threaded', 'is the largest hole on the top'."""
    if not text.match("be", start, end):
        return None
    of_sides: Every | None = None
    for middle in range(start + 2, end):
        if any(text.match(category, middle - 1, middle) for category in ("shape_adjective", "scale.positive")):
            continue  # 'the big (hole threaded)'
        owner = text.attempt(target, start + 1, middle)
        said = text.attempt(predicate, middle, end, owner) if isinstance(owner, Selection) else None
        if said is None or not isinstance(owner, Selection):
            continue
        if not any(isinstance(one, Seen) for one in said):
            return Every(owner, said)
        if of_sides is None and len(said) == 1 and _of_all(text, start, middle, owner):
            of_sides = Every(owner, said)
    return of_sides


def _of_all(text: Text, start: int, end: int, owner: Selection) -> bool:
    """Is a certain part meant, or all of them, rather than any?"""
    return owner.single or any(text.word_at(i, end, "all", "both", "each", "every") for i in range(start, end))


def _visible(text: Text, start: int, end: int) -> Query | None:
    """'is a slot visible from the left', 'can a flange be seen from the right'."""
    parts = selection(text, start + 1, end)
    if parts is None or len(parts.phrases) > 1 or not (parts.phrases[0].sides or parts.phrases[0].filters):
        return None
    return Exists(parts)
