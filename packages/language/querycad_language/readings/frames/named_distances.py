"""Distances of set phrases: sides of a figure; the material that is left."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from dataclasses import replace

from querycad_contracts import Measure, PartKind
from querycad_language.forms import Behind, Combine, Distance, Get, Reduce
from querycad_language.phrases import places_of, replace_fields
from querycad_language.readings.parses import Features, Parse
from querycad_language.readings.question import Question

from .anchors import ends_between
from .related_parts import floored

_THICKNESSES = (Measure.THICKNESS, Measure.WIDTH, Measure.WALL_THICKNESS, Measure.LENGTH, Measure.HEIGHT)
_DRAWN = ("form", "make", "sit", "lie", "on", "in", "at", "corner", "arranged", "long", "which", "that", "its", "what")
"""Words that say of parts that they are the corners of a figure."""


def named_distances(question: Question) -> Iterator[Parse]:
    """'The lugs form a square. What is its side?', 'Side lengths of the rectangle that the pins lie on?'"""
    text = question.text
    drawn = {at for at in text.at_words("square", "rectangle", "rectangular") if not text.find(at + 1, "noun")}
    drawn |= {at for at in text.at_words("pattern", "array") if text.is_word(at - 1, "square", "rectangular")}
    for mention in question.parts if drawn and text.has("side") else ():
        if mention.part.plural and drawn.isdisjoint(mention.used):
            said = text.at_words("side", *_DRAWN) | text.at_phrases("center_to_center", "measure")
            used = {*mention.used, *drawn, *(at - 1 for at in drawn), *said}
            form = Distance(replace_fields(mention.part, count=None), "each other", "centers", reduce=Reduce.SIDES)
            yield Parse(form, {"distance": 1.0, "each_other": 1.0}, used)


def material(question: Question, get: Get, features: Features, used: AbstractSet[int]) -> Iterator[Parse]:
    """'How thick is the land between the keyways?', 'What thickness remains under the keyway?'"""
    text = question.text
    if get.measures[0] not in _THICKNESSES:
        return
    for first, second in ends_between(get.target):
        yield Parse(Distance(first, second, "surfaces"), {**features, "material_between": 1.0}, used)
    walls = ("on",) if get.measures[0] is Measure.WALL_THICKNESS else ()  # 'the wall thickness at the counterbore'
    for _, other in places_of(get.target, "around", "near", *walls):  # 'the wall around the bore'
        yield Parse(Get((Measure.WALL_THICKNESS,), other), {**features, "material_around": 1.0}, used)
    under: Features = {**features, "material_under": 1.0, "under_between": float(text.has("between"))}
    said = text.at_phrases("remaining") | text.at_words("under", "below", "beneath", "underneath", "behind")
    cuts = [(other, used) for _, other in places_of(get.target, "below", "behind")]  # 'the web underneath the pocket'
    cuts += [(mention.part, used | said | mention.used) for mention in question.parts if said]
    for cut, owned in cuts:
        yield Parse(Distance(floored(cut) or cut, Behind(), "surfaces"), under, owned)
        yield Parse(Get((Measure.BOTTOM_THICKNESS,), floored(cut) or cut), under, owned)


def under_cut(question: Question, get: Get) -> bool:
    """Is it asked how thick the lever is below the pocket? Then what is left there is meant, and not all of it."""
    known = question.text.lexicon.nouns
    below = [known[cut.noun] for _, cut in places_of(get.target, "below", "behind") if cut.noun in known]
    cut_in = any(PartKind(kind).cuts_in for noun in below for kind in noun.senses[0].kind)
    return cut_in and get.measures[0] in _THICKNESSES and get.target is not None and get.target.noun != "floor"


def less(question: Question, get: Get, features: Features, used: AbstractSet[int]) -> Iterator[Parse]:
    """Less what a part has of it: 'How high is the lever without the rib?', 'How wide is the cam without its lugs?'"""
    one = not get.measures[1:] and get.measures[0] in (*_THICKNESSES, Measure.DEPTH, Measure.VOLUME)
    for span in question.text.all("minus") if one else ():
        other = question.phrases.at(question.text.skip(span.end, "article", "measure", "function"), joined=False)
        if span.start > 1 and other is not None and other.query is not None:
            kept = tuple(place for place, _ in places_of(get.target) if not place.negated)
            target = get.target and replace_fields(get.target, places=kept, excluded=())
            combine = Combine("minus", replace(get, target=target, overall=True), Get(get.measures, other.query))
            yield Parse(combine, {**features, "less_part": 1.0}, used | set(range(span.start, other.end)))
