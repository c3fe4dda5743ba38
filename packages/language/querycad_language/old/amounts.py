"""Comparisons in words: 'longer than the shaft', 'how much deeper is A than B', 'more holes on top than left'."""

from __future__ import annotations

from . import modifiers
from .meaning import Calculate, Count, Get, Measure, Operation, Query, Relation, Scalar, Selection, Target
from .phrases import selection, target
from .readings import asked
from .text import Text
from .values import operand, scalar

_MILLIMETRES = 1e-3


def compared_amount(text: Text, start: int, end: int, operation: Operation) -> Query | None:
    """'(how much) longer is A than B', '(by how much) is A longer than B', '(how many times) deeper is A than B'."""
    than = next((i for i in range(start, end) if text.words[i] == "than"), None)
    if than is None:
        return None
    for at in range(start, than):
        for form in ("scale.more", "scale.less"):
            if scale := text.match(form, at, than):
                rest = [*range(start, at), *range(scale[1], than)]
                pair = _two_amounts(text, rest, than + 1, end, Measure(scale[0]))
                if pair is None:
                    return None
                swapped = form == "scale.less" and operation is Operation.MINUS
                return Calculate(operation, *(pair[::-1] if swapped else pair))
    return None


def compared_counts(text: Text, start: int, end: int) -> tuple[Count, Relation, Count] | None:
    """'more holes (are) on the top than on the bottom', 'fewer slots than holes'."""
    relation = Relation.MORE if text.word_at(start, end, "more") else Relation.LESS
    than = next((i for i in range(start, end) if text.words[i] == "than"), None)
    if than is None or not text.word_at(start, end, "more", "fewer", "less"):
        return None
    first = selection(text, start + 1, than)
    second = selection(text, than + 1, end, first) if first else None
    return (Count(first), relation, Count(second)) if first and second else None


def _two_amounts(text: Text, left: list[int], start: int, end: int, measure: Measure) -> tuple[Scalar, Scalar] | None:
    """What is compared: two values, or one measure of two noun phrases."""
    words = text.rearranged(left)
    at, stop = words.skip(0, len(left), "be", "do"), len(left)
    for place in range(at, stop):
        named = words.match("property", place + 1, stop) if words.word_at(place, stop, "in", "by") else None
        if named and (place == at or named[1] == stop):
            measure = Measure(named[0])
            at, stop = (words.skip(named[1], stop, "be"), stop) if place == at else (at, place)
            break
    first: Scalar | None = words.attempt(scalar, at, stop)
    if first is None:
        of = words.attempt(target, at, stop)
        first = measured(text, measure, of) if of is not None else None
    second = second_amount(text, start, end, first) if first is not None else None
    return (first, second) if first is not None and second is not None else None


def measured(text: Text, measure: Measure, of: Target) -> Get:
    """A measure of a target as one number: 'larger' is the diameter of round parts and the volume of others."""
    if measure is not Measure.MAGNITUDE:
        return Get((asked(measure, of, text),), of)
    is_round = isinstance(of, Selection) and of.noun_class.is_round
    measure = Measure.DIAMETER if is_round else Measure.VOLUME
    text.note(f"Larger and smaller are compared by {measure.value}.")
    return Get((measure,), of)


def second_amount(text: Text, start: int, end: int, first: Scalar) -> Scalar | None:
    """What follows 'than': 'the shaft', 'that of the shaft', '20 mm', 'it is wide', 'its inner diameter'."""
    if found := modifiers.quantity(text, start, end):
        amount, after = found
        if text.skip(after, end, "noise") >= end or modifiers.bound(text, start, end):
            return amount.low if amount.power is not None else amount.low * _MILLIMETRES
    verb = text.after("be", start + 1, end) if text.word_at(start, end, "it", "they") else None
    if isinstance(first, Get) and verb is not None and (scale := text.match("scale.positive", verb, end)):
        return Get((asked(Measure(scale[0]), first.target, text),), first.target)
    return operand(text, start, end, first)
