"""How far something sticks out, goes in, or lies above the ground and below the top."""

from __future__ import annotations

from dataclasses import replace

from querycad_contracts import Side

from . import modifiers
from .asking import Asked
from .distances import Wording, between
from .meaning import Boundary, Distance, Get, Measure, NounClass, Overhang, Plane, Query, Reduce, Selection, Target
from .phrases import target
from .relations import of_whole
from .text import Text
from .tokens import Token
from .values import get

_OUTWARD = {
    **dict.fromkeys((Side.LEFT, Side.RIGHT), Measure.X_EXTENT),
    **dict.fromkeys((Side.FRONT, Side.BACK), Measure.Y_EXTENT),
    **dict.fromkeys((Side.TOP, Side.BOTTOM), Measure.HEIGHT),
}
_MUTUAL = {
    "farthest": Reduce.LARGEST,
    "furthest": Reduce.LARGEST,
    "closest": Reduce.SMALLEST,
    "nearest": Reduce.SMALLEST,
}
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
            return _reaching(text, of, measure, found, end)
    return None


def _reaching(text: Text, of: Target, measure: Measure, found: int, end: int) -> Query | None:
    """What sticks out or goes in, by what follows the verb: where to, out of what, past what."""
    if isinstance(of, Selection) and measure is Measure.DEPTH and _is_below_top(text, found, end):
        return Distance(Plane(Side.BOTTOM, of), Boundary(Side.TOP), True, 2)
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
    if named is not None and measure is Measure.HEIGHT and text.word_at(found, end, "from", "of", "out"):
        measure = _OUTWARD[named[0].sides[0]]  # a logo on the left side is as high as it stands out to the left
    return get(text, Asked((measure,)), of)


def _is_below_top(text: Text, at: int, end: int) -> bool:
    """'(go) below the top face', '(go below) the top of the plate'."""
    below = text.word_at(at, end, "below", "under", "beneath")
    noun = text.skip(at + below, end)
    ceiling = text.after("ceiling", noun, end) if below or text.word_at(at - 1, at, "below") else None
    return ceiling is not None and (ceiling >= end or text.word_at(ceiling, end, "of"))


def reach_in(text: Text, start: int, end: int, measure: Measure) -> Query | None:
    """'(how high) do the fins rise above the base', '(how deep) does the hole go in'."""
    found = reach(text, start, end)
    below = isinstance(found, Distance) and measure is Measure.DEPTH
    return found if below or (isinstance(found, Get) and found.measures == (measure,)) else None


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
    if ground is None or modifiers.starts_noun(text, ground, end):
        return None  # 'above the base plate'
    after = of_whole(text, ground, end) or ground
    if after == ground and text.word_at(ground, end, "of"):
        after = next((i for i in range(ground, end) if text.match("be", i, end) or text.match("do", i, end)), ground)
        text.leave_out(ground, after)
    verb = text.match("point_verb", end - 1, end)
    ending = verb[0] if verb and verb[0] in ("tip", "opening") else None
    of = target(text, text.skip(after, end, "be", "do"), end - (ending is not None))
    boundary = Boundary(Side.TOP if under else Side.BOTTOM)
    if ending is not None and isinstance(of, Selection):  # it begins where it is nearer
        near = boundary.side if ending == "opening" else boundary.side.opposite
        return Distance(Plane(near, of), boundary, True, 2)
    return Distance(of, boundary, True, 2) if isinstance(of, Selection) else None


def how_far(text: Text, start: int, end: int) -> Query | None:
    """'how far apart are A and B', 'how far is A from B', 'how far does A stick out'."""
    at = start + text.word_at(start, end, "far", "close", "near", "distant")
    at += text.word_at(at, end, "down", "in", "up", "out", "inwards", "outwards", "downwards", "upwards")
    at = text.skip(text.after("gap", at, end) or at, end, "be", "do", "noise")
    if found := text.attempt(reach, at, end) or above_ground(text, at, end):
        return found
    mutual = text.find("reciprocal", at, end)
    bounds = {"most": Reduce.LARGEST, "maximum": Reduce.LARGEST, "least": Reduce.SMALLEST, "minimum": Reduce.SMALLEST}
    bound = next((i for i in range(at, end - 1) if text.words[i] == "at" and text.words[i + 1] in bounds), end)
    kept = [i for i in range(at, end) if mutual is None or not mutual[0] <= i < mutual[2]]
    kept = [i for i in kept if i not in (bound, bound + 1) and text.words[i] not in ("can", "could", "be")]
    kept = [i for i in kept if text.words[i] not in ("apart", "away", "located", "separated", "together")]
    if kept and text.words[kept[0]] == "from":  # 'how far from the edge is the hole'
        verb = next((n for n, i in enumerate(kept) if text.match("be", i, end)), None)
        kept = kept if verb is None else [*kept[verb + 1 :], *kept[:verb]]
    leads = (text.words[i] == "from" and not text.match("verb", i - 1, end) for i in kept)
    preposition = "of" if any(leads) else "between"
    extreme = next((i for i in kept if text.words[i] in _MUTUAL), None)  # 'the two farthest holes'
    reduce = Reduce.EACH if extreme is None or preposition == "of" else _MUTUAL[text.words[extreme]]
    reduce = bounds[text.words[bound + 1]] if bound < end else reduce
    kept = kept if reduce is Reduce.EACH else [i for i in kept if i != extreme]
    worded = Text((Token(preposition, preposition), *(text.tokens[i] for i in kept)), text.book)
    return between(worded, 0, len(worded.tokens), Wording(reduce))
