"""Overhangs: how far a part stands out beyond another one, between their outer planes on one side."""

from __future__ import annotations

from collections.abc import Iterator

from querycad_contracts import PartQuery, Side
from querycad_language.forms import Distance, Plane
from querycad_language.phrases import places_of, without
from querycad_language.readings.parses import Parse
from querycad_language.readings.question import Question

from .anchors import planes_of, rimmed

_BEYOND = ("above", "over", "beyond", "past", "below", "behind", "proud", "higher", "out", "overhang")


def overhangs(question: Question) -> Iterator[Parse]:
    """'By how much does the spindle project above the nut?', 'How far below the hub does the lug end?'"""
    text = question.text
    reach = next(iter(text.all("reach")), None)
    nouns = question.parts
    word = min(text.at_words(*_BEYOND, *(("from",) if reach else ())), default=None)
    if word is None or not nouns or not (reach or text.has("projection", "overhang", "protrusion", "much", "far")):
        return
    first, other = nouns[0], next((mention for mention in nouns[1:] if mention.head > word), None)
    side = Side.BOTTOM if text.has("below") else Side.TOP
    if first.start > word and other is not None:  # 'how far below the rim do they end'
        first, other, side = other, first, side.opposite
    plane = next((one for one in planes_of(question) if one.at >= word and one.used.isdisjoint(first.used)), None)
    used = {word, *first.used, *(reach.tokens if reach else ())}
    used |= text.at_words("how", "much", "far", "projection", "overhang")
    if plane is not None and isinstance(plane.anchor, Plane):
        yield Parse(Distance(Plane(plane.anchor.side, first.part), plane.anchor), {"overhang": 1.0}, used | plane.used)
    elif other is not None:
        base, used = rimmed(other.part) or other.part, used | other.used
        yield from _beyond(first.part, base, side, used)
        around = {i for at in text.at_words("side") if text.find(at - 1, "each") for i in (at - 1, at)}
        if around := around | text.at_words("sideways", "radially"):
            form = Distance(Plane(None, first.part), Plane(None, base), "outsides")
            yield Parse(form, {"overhang": 1.0}, used | around)
    for place, holder in places_of(first.part, "above", "below", "of", "on"):
        towards = place.side or (Side.BOTTOM if place.relation == "below" else Side.TOP)
        yield from _beyond(without(first.part, place), holder, towards, used)


def _beyond(part: PartQuery, other: PartQuery, side: Side, used: set[int]) -> Iterator[Parse]:
    yield Parse(Distance(Plane(side, part), Plane(side, other)), {"overhang": 1.0, "overhang_side": 1.0}, used)
    yield Parse(Distance(Plane(None, part), Plane(None, other)), {"overhang": 1.0}, used)
