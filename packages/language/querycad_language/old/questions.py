"""The frames of questions: how many, how deep, what, which, where, is there, list …; each gives a meaning or passes."""

from __future__ import annotations

from dataclasses import replace

from . import modifiers
from .amounts import compared_amount, compared_counts
from .asking import SCALARS, Asked, asked_measures
from .distances import Wording, between, between_planes, distance, two_selections
from .lexicon import LEXICON
from .meaning import (
    ENDS,
    Angle,
    Calculate,
    Get,
    Measure,
    NounClass,
    Operation,
    Parts,
    Query,
    Reduce,
    Selection,
    Span,
    Whole,
    Within,
)
from .phrases import selection, target
from .polar import polar
from .reach import above_ground, how_far, reach, reach_in
from .readings import asked, bounded
from .relations import of_whole
from .text import Text
from .tokens import Token
from .values import (
    counted,
    extent_along,
    get,
    measured_part,
    operand,
    taken_off,
    telegraphic,
    value,
)

_PLACES = (Measure.POSITION, Measure.OPENING, Measure.TIP, *ENDS)
_PREPOSITIONS = {word: Token(word, word) for word in ("of", "between", "from")}
_WH = ("how", "what", "which", "where")
_OPENERS = (*_WH, "is", "are", "does", "do", "give", "list", "name", "count")


def question(text: Text) -> Query | None:
    """What does the whole question mean?"""
    end = len(text.tokens)
    start = _polite(text, 0, end)
    extent = any(text.match(category, i, end) for i in range(end) for category in ("scale.positive", "property"))
    for at in (i for i in range(start + 1, end - 3) if extent and text.words[i] == "from"):
        if apart := text.attempt(between_planes, at, end):
            return apart  # 'how tall is it from the rail's underside to the carriage top'
    if extent and (over := text.find("spanning", start + 1, end)):
        ends = selection(text, over[2], end)
        if ends is not None and ends.plural:
            return Span(ends)
    for frame in (_framed, _fronted, _needed, _rotated, value, telegraphic, _natural):
        if start < end and (found := text.attempt(frame, start, end)):
            return found
    return None


def _natural(text: Text, start: int, end: int) -> Query | None:
    """'What is the bore of the cylinder?', 'chamfer at the rim?': the measure that the part is known by."""
    at = text.skip(start + text.word_at(start, end, "what", "which"), end, "be", "noise")
    of = selection(text, at, end)
    if of is None or len(of.phrases) > 1:
        return None
    measure = LEXICON.match("natural_measure", (of.phrases[0].noun,), 0, 1)
    return get(text, Asked((Measure(measure[0]),)), of) if measure else None


def topical(text: Text) -> Query | None:
    """'Holes on top: diameter?', 'For the shaft: what is the length?': what is asked of the parts before the colon."""
    end = len(text.tokens)
    colon = next((i for i, token in enumerate(text.tokens) if token.raw == ":"), end)
    start = _polite(text, 0, end)
    start = text.after("topic", start, end) or start
    if colon >= end - 1 or any(text.match(c, i, colon) for i in range(start, colon) for c in ("be", "do", "relative")):
        return None
    if any(text.match("modal", i, colon) and text.match("purpose", i + 1, colon) for i in range(colon)):
        return None  # 'we need to replace the gasket: which thickness?'
    asking = text.tokens[colon + 1 :]
    if (side := modifiers.sides(text, start, colon)) and side[1] == colon:  # 'top view: how many holes?'
        lead = () if side[0].prepositional else (_PREPOSITIONS["from"],)
        return Text((*asking, *lead, *text.tokens[start:colon]), text.book).attempt(question)
    if text.find("pronoun", colon, end) or not isinstance(text.attempt(target, start, colon), Selection):
        return None
    own = Text(asking).attempt(question)
    if not (own is None or (isinstance(own, Get) and isinstance(own.target, Whole))):
        located = text.word_at(start, colon, "on", "in", "at", "inside")  # 'on the left wall: how far apart are they?'
        return Text((*asking, *text.tokens[start:colon]), text.book).attempt(question) if located else None
    wh = Text(asking).match("property", 1, len(asking)) if asking[0].word in ("what", "which") else None
    asking = asking[1:] if wh is not None and wh[1] == len(asking) else asking  # 'which diameter?' names the measure
    return Text((*asking, _PREPOSITIONS["of"], *text.tokens[start:colon]), text.book).attempt(question)


def _needed(text: Text, start: int, end: int) -> Query | None:
    """'The robot needs the centres of the holes.': what is needed is asked for."""
    found = text.find("needed_by", start + 1, end)
    return text.attempt(value, found[2], end) if found else None


def _framed(text: Text, start: int, end: int) -> Query | None:
    for frame in (_by_how_much, _how_many, _how, _of_which, _what, _where, polar, _imperative):
        if found := text.attempt(frame, start, end):
            return found
    return None


def _polite(text: Text, start: int, end: int) -> int:
    """Where does the question begin behind its polite opening? 'Can you see …' stays."""
    while True:
        start = text.skip_commas(start, end)
        after = text.after("polite", start, end)
        if text.match("exists", start, end):
            return start
        if after is None:
            return _behind_chat(text, start, end)
        start = after


def _behind_chat(text: Text, start: int, end: int) -> int:
    """Where does the question begin behind 'any idea', 'I forgot', 'it would be great to know'? Where it is."""
    at = text.skip(start, end, "chat")
    if not any(text.match("person", i, at) for i in range(start, at)):
        return start
    noun = text.skip(at, end, "article")
    measured = any(
        text.match(category, noun, end) for category in ("property", "spacing", "distance", "distance_adjective")
    )
    embedded = text.word_at(at, end, *_WH) or (noun > at and measured)
    return at if embedded else start


def _fronted(text: Text, start: int, end: int) -> Query | None:
    """'From the front, how many holes …': the adjunct goes to the end, 'of the holes, which is …' to the noun."""
    for wh in range(start + 1, end):
        if not text.word_at(wh, end, *_OPENERS) or not (text.word_at(wh - 1, end, ",") or text.word_at(wh, end, *_WH)):
            continue
        adjunct = [i for i in range(start, wh) if text.words[i] != ","]
        many = text.words[wh : wh + 2] == ("how", "many")
        if text.after("topic", start, end) and many and text.match("be", _of_them(text, wh + 2, end), end):
            moved = text.rearranged([wh, wh + 1, *adjunct[1:], *range(_of_them(text, wh + 2, end), end)])
        elif text.after("topic", start, end) and text.word_at(wh, end, "which"):
            rest = wh + 1 + text.word_at(wh + 1, end, "one", "ones", "of")
            moved = text.rearranged([wh, *adjunct[1:], *range(rest, end)])
        else:
            moved = text.rearranged([*range(wh, end), *adjunct])
        if adjunct and (found := moved.attempt(_moved)):
            return found
    return None


def _of_them(text: Text, at: int, end: int) -> int:
    """Behind 'of them', 'of these'."""
    return at + 2 if text.word_at(at, end, "of") and text.word_at(at + 1, end, "them", "these", "those") else at


def _moved(text: Text) -> Query | None:
    return _framed(text, _polite(text, 0, len(text.tokens)), len(text.tokens))


def _rotated(text: Text, start: int, end: int) -> Query | None:
    """'The holes on top have what diameter': the question word comes first."""
    wh = next((i for i in range(start + 1, end) if text.word_at(i, end, *_WH)), None)
    if wh is None or text.word_at(wh - 1, end, "by"):
        return None
    before = [i for i in range(start, wh) if text.words[i] != ","]
    return text.rearranged([*range(wh, end), *before]).attempt(_moved)


def _how_many(text: Text, start: int, end: int) -> Query | None:
    """'how many holes …', 'how many more holes … than …', 'how many times longer …', 'how much …', 'count the …'."""
    opening = text.words[start : start + 3]
    if opening == ("how", "many", "times"):
        return compared_amount(text, start + 3, end, Operation.RATIO)
    if opening[:2] == ("how", "many") and (counts := compared_counts(text, start + 2, end)):
        first, _, second = counts
        return Calculate(Operation.MINUS, first, second)
    if opening[:2] == ("how", "much"):
        at = start + 2
        if (parts := _how_much_parts(text, at, end)) is not None:
            return parts
        amount = compared_amount(text, at, end, Operation.MINUS)
        found = amount or text.attempt(distance, at, end) or _property_of(text, at, end) or text.attempt(reach, at, end)
        return found or (
            counted(text, at, end) if LEXICON.is_plural(text.words[end - 1]) or _plural_noun(text, at, end) else None
        )
    after = text.after("count", start, end)
    unit = text.match("unit", after, end) if after is not None and text.words[start] == "how" else None
    if unit is not None and LEXICON.units[unit[0]][1] == 1:
        found = _how_adjective(text, unit[1], end) or compared_amount(text, unit[1], end, Operation.MINUS)
        if found is not None:
            return found  # else feet are parts
    return counted(text, after, end) if after is not None else None


def _how_much_parts(text: Text, start: int, end: int) -> Query | None:
    """'how much holes has the object': parts in the plural, right behind it, are counted."""
    noun = next((i for i in range(start, end) if LEXICON.is_plural(text.words[i])), None)
    if noun is None:
        return None
    if any(text.match(c, i, end) for i in range(start, noun + 1) for c in ("property", "be", "do", "have")):
        return None
    return counted(text, start, end)


def _by_how_much(text: Text, start: int, end: int) -> Query | None:
    """'by how much is A longer than B'."""
    if text.words[start : start + 3] != ("by", "how", "much"):
        return None
    return compared_amount(text, start + 3, end, Operation.MINUS) or text.attempt(reach, start + 3, end)


def _how(text: Text, start: int, end: int) -> Query | None:
    if not text.word_at(start, end, "how"):
        return None
    at = text.skip(start + 1, end, "noise")
    if text.word_at(at, end, "far", "close", "near", "distant") or text.match("gap", at, end):
        return how_far(text, at, end)
    return _how_adjective(text, at, end)


def _how_adjective(text: Text, start: int, end: int) -> Query | None:
    """'how deep are the holes', 'how wide and how long is the slot', 'how large is the diameter of the shaft'."""
    measures: list[Measure] = []
    at = after = start
    while scale := text.match("scale.positive", at, end):
        measures.append(Measure(scale[0]))
        after = scale[1]
        at = text.skip(after, end, "conjunction")
        at += text.word_at(at, end, "how")
    if not measures:
        return None
    flats = text.match("property", after, end)  # 'how wide across its flats is the nut'
    after = flats[1] if flats and measures == [flats[0]] and text.word_at(after, end, "across") else after
    if len(measures) == 1 and (found := text.attempt(_how_one, after, end, measures[0])):
        return found
    at = text.skip(after, end, "be", "do", "noise")
    if found := text.attempt(distance, at, end) or text.attempt(_without, at, end, measures[0]):
        return found
    if (along := extent_along(text, tuple(measures), at, end)) is not None:
        return along
    reduce = Reduce.EACH
    if together := text.find("together", at, end):
        text, at, end = (
            text.rearranged([*range(at, together[0]), *range(together[2], end)]),
            0,
            together[0] + end - together[2] - at,
        )
        reduce = Reduce.TOTAL
    of = target(text, at, end) or measured_part(text, tuple(measures), at, end)
    sized = tuple(measures) == (Measure.WIDTH, Measure.DEPTH, Measure.HEIGHT)
    wanted = Asked((Measure.SIZE,) if sized else tuple(measures), reduce)
    return get(text, wanted, of) if of is not None else None


def _how_one(text: Text, start: int, end: int, measure: Measure) -> Query | None:
    """'(how high) above the bottom is the hole', '(how large) is the radius', '(how thick) is the sheet'."""
    if measure is Measure.HEIGHT and (found := above_ground(text, start, end)):
        return found
    if measure in (Measure.HEIGHT, Measure.DEPTH) and (found := text.attempt(reach_in, start, end, measure)):
        return found
    at = text.skip(start, end, "be", "do", "noise")
    if measure is Measure.MAGNITUDE:
        return text.attempt(distance, at, end) or text.attempt(value, at, end)
    return _of_material(text, at, end) if measure is Measure.THICKNESS else None


def _of_material(text: Text, start: int, end: int) -> Query | None:
    """The thickness of 'the material', 'the sheet metal used in the object', 'the wall of the tube'."""
    at = text.skip(start, end, "article", "whole_adjective")
    after = text.after("material", at, end)
    if after is None:
        return None
    if text.word_at(after, end, "between", "at", "around", "near", "under", "above", "below"):
        return None
    of = target(text, after + 1, end) if text.word_at(after, end, "of", "in") else None
    return get(text, Asked((Measure.WALL_THICKNESS,)), of or Whole())


def _without(text: Text, start: int, end: int, measure: Measure) -> Query | None:
    """'(how high is) the object without the (height of the) shaft'."""
    found = text.find("minus", start + 1, end)
    if found is None:
        return None
    at, _, after = found
    of = text.attempt(target, start, at)
    if of is None:
        return None
    left = Get((asked(measure, of, text),), of)
    right = text.attempt(operand, after, end, left)
    if not (isinstance(of, Whole) or text.find("property", after, end)):
        return taken_off(text, after, end, left, right)
    return Calculate(Operation.MINUS, left, right) if right is not None else None


def _plural_noun(text: Text, start: int, end: int) -> bool:
    """Is one of the words a noun in the plural: '(how much) round holes (for mounting are there)'?"""
    return any(LEXICON.is_plural(text.words[i]) and modifiers.starts_noun(text, i, i + 1) for i in range(start, end))


def _property_of(text: Text, start: int, end: int) -> Query | None:
    """'(what) diameter do the holes have', '(how much) volume does the part take up', '(what) size is the shaft'."""
    named = asked_measures(text, start, end)
    if named is None:
        return None
    wanted, at = named
    limit = modifiers.bound(text, start, end) if text.match("property", start, end) else None
    at = limit[1] if limit else at
    verb = text.after("do", at, end) or text.after("be", at, end) or text.after("have", at, end)
    if verb is None and text.match("article", at, end) and not text.match("property", at + 1, end):
        verb = at
    if verb is None:
        return None
    if wanted.measures == (Measure.THICKNESS,) and (found := _of_material(text, verb, text.trimmed(verb, end))):
        return found
    if wanted.plural and text.match("occur", at, end):
        wanted = replace(wanted, reduce=Reduce.DIFFERENT)
    stop = text.trimmed(verb, end)
    if (along := extent_along(text, wanted.measures, verb, stop)) is not None:
        return along
    if (less := text.find("minus", verb + 1, stop)) and isinstance(
        held := text.attempt(target, verb, less[0]), Selection
    ):
        left = get(text, wanted, held)
        rest = taken_off(text, less[2], stop, left, text.attempt(operand, less[2], stop, left))
        if rest is not None:
            return rest
    of = target(text, verb, stop)
    if of is None and text.skip(verb, end, "verb", "light", "noise") >= end:
        of = Whole()  # 'what sheet thickness was used'
    if limit and isinstance(of, Selection):
        kept = bounded(limit[0], of.noun_class, text)
        of = Selection(tuple(replace(phrase, filters=(*phrase.filters, kept)) for phrase in of.phrases))
    return get(text, wanted, of) if of is not None else None


def _less(text: Text, wanted: Asked, start: int, end: int) -> Query | None:
    """'(what length) do the screws have without the head'."""
    less = text.find("minus", start + 1, end)
    held = text.attempt(target, start, less[0]) if less else None
    if less is None or not isinstance(held, Selection):
        return None
    left = get(text, wanted, held)
    return taken_off(text, less[2], end, left, text.attempt(operand, less[2], end, left))


def _of_which(text: Text, start: int, end: int) -> Query | None:
    """'in which direction …', 'on which side …', 'at what height …', 'to what depth …'."""
    if not text.match("wh_preposition", start, end) or not text.word_at(start + 1, end, "what", "which"):
        return None
    place = text.match("at_which", start + 2, end) if text.word_at(start, end, "at") else None
    if place is None:
        return _what(text, start + 1, end)
    if place[0] == Measure.Z and (found := above_ground(text, place[1], end)):
        return found
    at = text.skip(place[1], end, "be", "do")
    end -= place[0] == Measure.POSITION and text.word_at(end - 1, end, "centered")
    found = text.attempt(value, at, end)
    if isinstance(found, Get) and found.measures[0] in _PLACES:
        return replace(found, measures=(Measure.Z,)) if place[0] == Measure.Z else found
    of = target(text, at, end)
    return get(text, Asked((Measure(place[0]),)), of) if of is not None else None


def _what(text: Text, start: int, end: int) -> Query | None:
    if not text.word_at(start, end, "what", "which", "whose"):
        return None
    at = text.skip(start + 1, end, "noise")
    compared = text.match("scale.more", text.skip(at, end, "be"), end) or text.match(
        "scale.less", text.skip(at, end, "be"), end
    )
    if compared and any(text.word_at(i, end, "or") for i in range(compared[1], end)):
        return None  # 'which is wider, A or B'
    for rule in (_which_way, _which_side, _which_angle, _which_distance, _property_of, _what_is, _which_parts):
        if found := text.attempt(rule, at, end):
            return found
    return None


def _which_side(text: Text, start: int, end: int) -> Query | None:
    """'(on which) side is the pocket', '(from which) sides is the flange visible'."""
    noun = text.after("side_noun", start, end) if not text.word_at(start, end, "area", "surface area") else None
    noun = (of_whole(text, noun, end) or noun) if noun is not None else None
    verb = noun and (text.after("be", noun, end) or text.after("do", noun, end) or text.after("light", noun, end))
    if noun is None or not verb:
        return None
    if not text.word_at(start, end, "side", "sides", "face", "faces", "surface") and not text.find("verb", verb, end):
        return None
    of = target(text, verb, end)
    return get(text, Asked((Measure.SIDES,)), of) if isinstance(of, Selection) else None


def _which_way(text: Text, start: int, end: int) -> Query | None:
    """'(in which) direction does the shaft point', '(which) way does it face'."""
    if not text.word_at(start, end, "direction", "directions", "way"):
        return None
    verb = text.after("do", start + 1, end) or text.after("be", start + 1, end)
    point = next((i for i in range(start + 2, end) if text.match("point_verb", i, end)), None)
    of = target(text, verb, point) if verb and point else None
    if not isinstance(of, Selection):
        return None
    of_hole = of.noun_class is NounClass.HOLE  # a hole faces out of its opening, whatever the sense of its axis
    return get(text, Asked((Measure.NORMAL if of_hole else Measure.DIRECTION,)), of)


def _which_distance(text: Text, start: int, end: int) -> Query | None:
    """'(which) centre distance have two slots (in y direction)', '(what) distance do the legs have'."""
    noun = text.find("distance", start, min(end, start + 4))
    verb = noun and (text.after("have", noun[2], end) or text.after("do", noun[2], end))
    if noun is None or not verb:
        return None
    said = text.match("distance_adjective", start, noun[0] + 1)
    centers = said[0] == "centers" if said and said[0] in ("centers", "surfaces") else None
    stop = text.trimmed(verb, end)
    worded = Text((_PREPOSITIONS["between"], *text.tokens[verb:stop]), text.book)
    return between(worded, 0, len(worded.tokens), Wording(centers=centers))


def _which_angle(text: Text, start: int, end: int) -> Query | None:
    """'(what) angle do the shaft and the rib enclose', '(at what) angle is the shaft to the plate'."""
    verb = text.after("do", start + 1, end) or text.after("be", start + 1, end)
    if not text.word_at(start, end, "angle", "angles") or verb is None:
        return None
    verb = text.skip(verb, end, "light")
    verb += text.word_at(verb, end, "between")
    stop = text.trimmed(verb, end)
    own = selection(text, verb, stop)
    if own is not None and len(own.phrases) == 1 and LEXICON.match("angled_noun", (own.phrases[0].noun,), 0, 1):
        return Get((Measure.ANGLE,), own)
    pair = two_selections(text, verb, stop, ("and", "to", "with", "against"))
    return Angle(*pair) if pair else None


def _what_is(text: Text, start: int, end: int) -> Query | None:
    """'(what) is the radius of the holes', '(which) hole diameters are there'."""
    at = text.skip(start, end, "be", "noise")
    found = text.attempt(_material_thickness, at, end) or value(text, at, end)
    if not isinstance(found, Get) or at > start:
        return found
    if not isinstance(found.target, Selection):
        return None
    several = found.target.plural or any(
        named[0] in SCALARS and LEXICON.is_plural(text.words[named[1] - 1])
        for named in (text.match("property", i, end) for i in range(at, end)) if named
    )  # fmt: skip
    listed = found.reduce is Reduce.EACH and not text.match("article", at, end) and several
    return replace(found, reduce=Reduce.DIFFERENT) if listed else found


def _material_thickness(text: Text, start: int, end: int) -> Query | None:
    """'the thickness of the material'."""
    at = text.skip(start, end, "article", "whole_adjective")
    named = text.match("property", at, end)
    if named is None or named[0] != Measure.THICKNESS or not text.word_at(named[1], end, "of"):
        return None
    return _of_material(text, named[1] + 1, end)


def _which_parts(text: Text, start: int, end: int) -> Query | None:
    """'(which) holes are visible from the top', '(which) slot is the widest', '(what) is the largest hole'."""
    at = text.skip(start, end, "be")
    parts = selection(text, at, end)
    if parts is None:
        return None
    phrase = parts.phrases[0]
    if len(parts.phrases) > 1 and any(one.ranks for one in parts.phrases):
        return None  # 'which is wider, A or B'
    # 'what is the gizmo of the shaft' asks for a measure that is not known, not for gizmos in the shaft
    chosen = phrase.ranks or phrase.sides or any(not isinstance(one, Within) for one in phrase.filters)
    return Parts(parts) if chosen or (at == start and text.words[start - 1] == "which") else None


def _where(text: Text, start: int, end: int) -> Query | None:
    """'where is the hole', 'where is the tip of the shaft', 'where does the shaft end'."""
    if not text.word_at(start, end, "where"):
        return None
    at = start + 1
    at = text.skip(of_whole(text, at, end) or at, end, "be", "do", "noise")
    found = text.attempt(value, at, end)
    if isinstance(found, Get) and found.measures[0] in _PLACES:
        return found
    last = text.match("point_verb", end - 1, end)
    of = target(text, at, end - 1 if last else end)
    return get(text, Asked((Measure(last[0]) if last else Measure.POSITION,)), of) if of is not None else None


def _imperative(text: Text, start: int, end: int) -> Query | None:
    """'list the depths of the holes', 'tell me how deep the holes are', 'show me all slots on the back'."""
    after = text.after("imperative", start, end)
    if after is None:
        return None
    for frame in (_framed, _material_thickness, value):
        if found := text.attempt(frame, after, end):
            return found
    parts = None if text.match("calculation", start, end) else selection(text, after, end)
    return Parts(parts) if parts else None
