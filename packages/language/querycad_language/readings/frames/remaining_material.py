"""Remains: the material between or below cuts, and a measure less what a part has of it."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from dataclasses import replace

from querycad_contracts import Measure, PartKind
from querycad_language.forms import Behind, Combine, Distance, Get
from querycad_language.phrases import places_of, replace_fields
from querycad_language.readings.parses import Features, Parse
from querycad_language.readings.question import Question

from .anchors import ends_between
from .related_parts import floored

_THICKNESSES = (Measure.THICKNESS, Measure.WIDTH, Measure.WALL_THICKNESS, Measure.LENGTH, Measure.HEIGHT)


def material(question: Question, get: Get, features: Features, used: AbstractSet[int]) -> Iterator[Parse]:
    """'How thick is the land between the keyways?', 'What thickness remains under the keyway?'"""
    text = question.text
    if get.measures[0] not in _THICKNESSES:
        return
    for first, second in ends_between(get.target):
        yield Parse(Distance(first, second, "surfaces"), {**features, "material_between": 1.0}, used)
    for _, other in places_of(get.target, "around", "near"):  # 'the wall around the bore'
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
    """Less what a part has of it: 'How high is the lever without the rib?', 'How long is it under its head?'"""
    text = question.text
    lengths = (Measure.HEIGHT, Measure.LENGTH, Measure.DEPTH, Measure.WIDTH, Measure.THICKNESS, Measure.VOLUME)
    if get.measures[0] not in lengths or len(get.measures) > 1:
        return
    for span in [*text.all("minus"), *(span for span in text.all("place") if span.value == "below")]:
        other = question.phrases.at(text.skip(span.end, "article", "measure", "function"), joined=False)
        if other is None or other.query is None or (span.category == "minus" and span.start < 2):
            continue
        head = text.is_word(other.head, "head") and (get.target is None or get.target.noun != other.query.noun)
        if span.category == "place" and not head:
            continue  # screws are measured under the head (ISO 4014), nothing else is
        target = get.target
        if target is not None:
            kept = tuple(p for p in target.places if not p.negated and p.what != other.query)
            target = replace_fields(target, places=kept, excluded=())
        owned = used | set(range(span.start, other.end))
        part = Measure.HEIGHT if span.category == "place" else get.measures[0]
        combine = Combine("minus", replace(get, target=target, overall=True), Get((part,), other.query))
        yield Parse(combine, {**features, "less_part": 1.0}, owned)
