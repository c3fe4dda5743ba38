"""How far something sticks out, goes in, or lies above the ground and below the top."""

from __future__ import annotations

from dataclasses import replace

from querycad_contracts import Side

from . import modifiers
from .asking import Asked
from .meaning import Boundary, Distance, Get, Measure, NounClass, Overhang, Query, Selection
from .phrases import target
from .relations import of_whole
from .text import Text
from .values import get

_SIDE_OF_PLACE = {
    "+z": Side.TOP,
    "-z": Side.BOTTOM,
    "-x": Side.LEFT,
    "+x": Side.RIGHT,
    "-y": Side.FRONT,
    "+y": Side.BACK,
}


def reach(text: Text, start: int, end: int) -> Query | None:
    """'(how far does) the shaft stick out (of the plate)', '(how much do) the rings stand above the flange'.

    What sticks out has a height, what goes in a depth; of what passes through another part, what lies outside of it.
    """
    asserted = text.match("be", start, end) is not None
    at = text.skip(start, end, "be", "do")
    for stop in range(at + 1, end):
        for category, measure in (("protrude", Measure.HEIGHT), ("sink", Measure.DEPTH)):
            found = text.after(category, stop, end)
            if asserted and found == stop + 1 == end:
                continue  # 'the whole stand': after 'is' a verb in its plain form is a noun
            of = text.attempt(target, at, stop) if found is not None else None
            if found is None or of is None:
                continue
            side = _towards(text, found, end)
            if isinstance(of, Selection) and side is not None and measure is Measure.HEIGHT and not of.phrases[0].sides:
                of = Selection(tuple(replace(phrase, sides=(side,)) for phrase in of.phrases))
            named = modifiers.sides(text, found, end)
            if named is not None and measure is Measure.HEIGHT and isinstance(of, Selection):
                of = Selection(tuple(replace(phrase, sides=named[0].sides) for phrase in of.phrases))
            past = text.word_at(found, end, "over", "beyond", "past", "above")
            out_of = text.word_at(found, end, "of", "from", "through", "out") or past
            out_of = out_of and measure is Measure.HEIGHT and (named is None or past)
            inner = text.skip(found + 1, end, "side_preposition")
            rim = text.skip(text.skip(inner, end, "article"), end, "side", "edge", "side_noun") if past else inner
            inner = rim + 1 if past and text.word_at(rim, end, "of") else inner  # 'over the left edge of the board'
            holder = text.attempt(target, inner, end) if out_of else None
            bodily = isinstance(holder, Selection) and holder.noun_class is not NounClass.FACE
            bodily = bodily and not text.find("face_noun", found, end)
            if isinstance(of, Selection) and isinstance(holder, Selection) and bodily:
                if past:  # the side that it is past decides nothing about where it is seen from
                    of = Selection(tuple(replace(phrase, sides=()) for phrase in of.phrases))
                return Overhang(of, holder)
            if found < end:
                text.leave_out(found, end)
            return get(text, Asked((measure,)), of)
    return None


def reach_in(text: Text, start: int, end: int, measure: Measure) -> Query | None:
    """'(how high) do the fins rise above the base', '(how deep) does the hole go in'."""
    found = reach(text, start, end)
    return found if isinstance(found, Get) and found.measures == (measure,) else None


def _towards(text: Text, at: int, end: int) -> Side | None:
    """Which side does 'below', 'above', 'to the right of' lead to?"""
    place = text.match("place", at, end)
    return _SIDE_OF_PLACE.get(place[0]) if place else None


def above_ground(text: Text, start: int, end: int) -> Query | None:
    """'(at what height) above the bottom is the hole', '(how far) below the top face is the shaft'."""
    noun = text.skip(start + 1, end)
    under = text.word_at(start, end, "below", "under", "beneath")
    above = text.word_at(start, end, "above", "over")
    ground = text.after("ceiling", noun, end) if under else text.after("ground", noun, end) if above else None
    if ground is None:
        return None
    after = of_whole(text, ground, end) or ground
    if after == ground and text.word_at(ground, end, "of"):
        after = next((i for i in range(ground, end) if text.match("be", i, end) or text.match("do", i, end)), ground)
        text.leave_out(ground, after)
    of = target(text, text.skip(after, end, "be", "do"), end)
    boundary = Boundary(Side.TOP if under else Side.BOTTOM)
    return Distance(of, boundary, True, 2) if isinstance(of, Selection) else None
