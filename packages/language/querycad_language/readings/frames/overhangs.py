"""Overhangs: how far a part stands out beyond another one."""

from __future__ import annotations

from collections.abc import Iterator

from querycad_contracts import Side
from querycad_language.forms import Distance, Plane
from querycad_language.readings.drafts import Draft
from querycad_language.readings.question import Question

from .anchors import planes_of, without

_BEYOND = ("above", "over", "beyond", "past", "below", "proud", "higher", "out")


def overhangs(question: Question) -> Iterator[Draft]:
    """Between the outer planes of two parts on one side.

    'By how much does the spindle project above the nut?', 'How far does the pin stick out beyond the lever?'
    """
    text = question.text
    reach = next((span for span in text.all("reach")), None)
    nouns = [m for m in question.mentions if m.query is not None and not m.pronoun]
    word = min(text.at_words(*_BEYOND, *(("from",) if reach else ())), default=None)
    if word is None or not nouns or not (reach or text.has("projection", "overhang", "protrusion", "much", "far")):
        return
    plane = next((one for one in planes_of(question) if isinstance(one.anchor, Plane) and one.at >= word), None)
    first = nouns[0].query
    assert first is not None
    used = set(nouns[0].used) | ({*reach.tokens} if reach else set()) | {word}
    used |= text.at_words("how", "much", "far", "projection", "overhang")
    if plane is not None and isinstance(plane.anchor, Plane):
        yield Draft(Distance(Plane(plane.anchor.side, first), plane.anchor), {"overhang": 1.0}, used | plane.used)
    elif len(nouns) > 1 and nouns[1].query is not None and nouns[1].head > word:
        side = Side.BOTTOM if text.is_word(word, "below") else Side.TOP
        beyond, used_too = nouns[1].query, used | nouns[1].used
        features = {"overhang": 1.0, "overhang_side": 1.0}
        yield Draft(Distance(Plane(side, first), Plane(side, beyond)), features, used_too)
        yield Draft(Distance(Plane(None, first), Plane(None, beyond)), {"overhang": 1.0}, used_too)
    for place in first.places:
        if place.what is not None and place.relation in ("above", "below", "of", "on"):
            side = place.side or (Side.BOTTOM if place.relation == "below" else Side.TOP)
            part = without(first, place)
            features = {"overhang": 1.0, "overhang_side": 1.0}
            yield Draft(Distance(Plane(side, part), Plane(side, place.what)), features, used)
            yield Draft(Distance(Plane(None, part), Plane(None, place.what)), {"overhang": 1.0}, used)
