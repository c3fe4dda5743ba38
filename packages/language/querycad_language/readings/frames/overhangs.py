"""Overhangs: how far a part stands out beyond another one."""

from __future__ import annotations

from collections.abc import Iterator

from querycad_contracts import PartQuery, Side
from querycad_language.forms import Distance, Plane
from querycad_language.phrases import places_of
from querycad_language.readings.drafts import Draft
from querycad_language.readings.question import Question

from .anchors import planes_of, without

_BEYOND = ("above", "over", "beyond", "past", "below", "proud", "higher", "out")


def overhangs(question: Question) -> Iterator[Draft]:
    """Between the outer planes of two parts on one side.

    'By how much does the spindle project above the nut?', 'How far does the pin stick out beyond the lever?'
    """
    text = question.text
    reach = next(iter(text.all("reach")), None)
    nouns = question.parts
    word = min(text.at_words(*_BEYOND, *(("from",) if reach else ())), default=None)
    if word is None or not nouns or not (reach or text.has("projection", "overhang", "protrusion", "much", "far")):
        return
    plane = next((one for one in planes_of(question) if one.at >= word), None)
    first = nouns[0].part
    used = {word, *nouns[0].used, *(reach.tokens if reach else ())}
    used |= text.at_words("how", "much", "far", "projection", "overhang")
    if plane is not None and isinstance(plane.anchor, Plane):
        yield Draft(Distance(Plane(plane.anchor.side, first), plane.anchor), {"overhang": 1.0}, used | plane.used)
    elif len(nouns) > 1 and nouns[1].head > word:
        side = Side.BOTTOM if text.is_word(word, "below") else Side.TOP
        yield from _beyond(first, nouns[1].part, side, used | nouns[1].used)
    for place, other in places_of(first, "above", "below", "of", "on"):
        side = place.side or (Side.BOTTOM if place.relation == "below" else Side.TOP)
        yield from _beyond(without(first, place), other, side, used)


def _beyond(part: PartQuery, other: PartQuery, side: Side, used: set[int]) -> Iterator[Draft]:
    yield Draft(Distance(Plane(side, part), Plane(side, other)), {"overhang": 1.0, "overhang_side": 1.0}, used)
    yield Draft(Distance(Plane(None, part), Plane(None, other)), {"overhang": 1.0}, used)
