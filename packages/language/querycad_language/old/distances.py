"""Distances, spacings and angles between parts, points of the whole model and its outer planes."""

from __future__ import annotations

from dataclasses import dataclass, replace

from querycad_contracts import Side

from . import modifiers
from .lexicon import LEXICON
from .meaning import (
    Angle,
    Boundary,
    Distance,
    Get,
    Measure,
    NounClass,
    Origin,
    Place,
    Plane,
    Query,
    Reduce,
    Selection,
    Whole,
)
from .phrases import selection
from .relations import of_whole, without_axis
from .text import Text
from .tokens import Token

_CENTERS_NOTE = "The distance of like or round parts is taken between their centres, as on a drawing."
_SURFACES_NOTE = "The distance is taken between the surfaces: the gap."
_OWN_CENTER = ("center", "centers", "axis", "axes", "centerline", "centerlines")
"""'the holes' axes': what of a part a distance is taken from."""


@dataclass(frozen=True, slots=True)
class Wording:
    """How a distance is asked for, apart from between what."""

    reduce: Reduce = Reduce.EACH
    centers: bool | None = None
    axis: int | None = None
    alike: bool = False


@dataclass(frozen=True, slots=True)
class End:
    """One end of a distance; `place` None is the edge of the model."""

    place: Place | None
    centers: bool | None = None


def distance(text: Text, start: int, end: int) -> Query | None:
    """'the maximal distance between two holes along the width', 'the gap between the legs', 'the hole spacing'."""
    wording = Wording()
    at = start
    while True:
        at = text.skip(at, end)
        if (found := text.match("distance_adjective", at, end)) and not text.match("distance", at, end):
            wording = _adjective(text, wording, found[0])
        elif (found := text.match("reduce", at, end)) or (found := text.match("extreme", at, end)):
            wording = replace(wording, reduce=Reduce(found[0]))
        else:
            break
        at = found[1]
    for noun in range(at, end):
        if text.match("preposition", noun, end) or text.match("be", noun, end):
            break
        if after := text.after("spacing", noun, end):
            return _spacing(text.rearranged([*range(at, noun), *range(after, end)]), wording)
    named = text.match("distance", at, end)
    if named is None:
        return None
    if named[0] == "surfaces" and wording.centers is None:
        wording = replace(wording, centers=False)
    if query := text.attempt(between, named[1], end, wording):
        return query
    if end > named[1] and not text.match("preposition", named[1], end) and LEXICON.is_plural(text.words[end - 1]):
        worded = Text((Token("of", "of"), *text.tokens[named[1] : end]), text.book)
        return between(worded, 0, len(worded.tokens), wording)
    return None


def _adjective(text: Text, wording: Wording, word: str) -> Wording:
    if word in ("centers", "surfaces"):
        return replace(wording, centers=word == "centers")
    if word in "xyz":
        if word == "x":
            text.note("Horizontal is taken as the x direction, the width.")
        return replace(wording, axis="xyz".index(word))
    return wording


def between(text: Text, start: int, end: int, wording: Wording) -> Query | None:
    """The distance with this wording between what `start:end` names: 'between A and B', 'from A to B', 'of A to B'."""
    text, axis = without_axis(_without_reciprocal(text, start, end))
    wording = wording if axis is None else replace(wording, axis=axis)
    for category, reduce in (("opposite", Reduce.LARGEST), ("stacked", Reduce.SMALLEST)):
        if (found := text.find(category, 0, len(text.tokens))) and wording.reduce is Reduce.EACH:
            text = text.rearranged([*range(found[0]), *range(found[2], len(text.tokens))])
            text.note("Opposite parts are those farthest apart, parts side by side those nearest to each other.")
            wording = replace(wording, reduce=reduce)
    if text.find("adjacent", 0, len(text.tokens)):
        if wording.reduce not in (Reduce.EACH, Reduce.SMALLEST):
            return None
        wording = replace(wording, reduce=Reduce.SMALLEST, alike=True)
    ends = _ends(text, 0, len(text.tokens))
    if ends is None:
        return None
    first, second = ends
    if first.place is None or (second is not None and second.place is None):
        parts = second.place if first.place is None and second is not None else first.place
        if not isinstance(parts, Selection):
            return None
        text.note("The distance to the edge is taken from the part's surface to the outer edge of its face.")
        return Get((Measure.EDGE_DISTANCE,), parts, wording.reduce)
    return _distance(text, first, second, wording)


def _without_reciprocal(text: Text, start: int, end: int) -> Text:
    """The span without 'from each other'."""
    found = text.find("reciprocal", start, end)
    kept = [*range(start, end)] if found is None else [*range(start, found[0]), *range(found[2], end)]
    return text.rearranged(kept)


def _distance(text: Text, first: End, second: End | None, wording: Wording) -> Query | None:
    said = [
        centers
        for centers in (wording.centers, first.centers, second.centers if second else None)
        if centers is not None
    ]
    places = [first.place] if second is None else [first.place, second.place]
    if any(isinstance(place, Plane) for place in places):
        return _from_plane(first.place, second.place if second else None, said)
    if said:
        centers = said[0]
    else:
        centers = _between_centers(places)
        text.note(_CENTERS_NOTE if centers else _SURFACES_NOTE)
    if isinstance(first.place, Boundary) and second is not None and isinstance(second.place, Boundary):
        opposite = first.place.side.opposite is second.place.side
        axis = next(i for i, value in enumerate(first.place.side.outward) if value)
        return Get(((Measure.WIDTH, Measure.DEPTH, Measure.HEIGHT)[axis],), Whole()) if opposite else None
    if not any(isinstance(place, Selection) for place in places) or first.place is None:
        return None
    other = second.place if second is not None else None
    return Distance(first.place, other, centers, wording.axis, wording.reduce, wording.alike)


def _from_plane(first: Place | None, second: Place | None, said: list[bool]) -> Query | None:
    """From a plane of parts to another plane along the same axis, or to parts."""
    if first is None or second is None or isinstance(first, Whole | Origin) or isinstance(second, Whole | Origin):
        return None
    axes = {axis_of(place.side) for place in (first, second) if isinstance(place, Plane | Boundary)}
    parts = next((place for place in (first, second) if isinstance(place, Selection)), None)
    centers = said[0] if said else parts is None or parts.noun_class.is_round
    return Distance(first, second, centers, axes.pop()) if len(axes) == 1 else None


def axis_of(side: Side) -> int:
    """Along which axis does a side look: 0, 1 or 2?"""
    return next(i for i, value in enumerate(side.outward) if value)


def _between_centers(places: list[Place | None]) -> bool:
    """Is a distance meant between centres, where the words leave it open?

    Drawings dimension like features, and round ones, by their centres or axes. Between faces, and between unlike parts
    that are not all round, it is the gap.
    """
    phrases = [phrase for place in places if isinstance(place, Selection) for phrase in place.phrases]
    nouns = {phrase.noun for phrase in phrases}
    like = len(nouns) == 1 and all(phrase.noun_class is not NounClass.FACE for phrase in phrases)
    only_parts = all(isinstance(place, Selection) for place in places)
    return (like and only_parts) or all(phrase.noun_class.is_round for phrase in phrases)


def _spacing(text: Text, wording: Wording) -> Query | None:
    """The distance from one part of a row to its neighbour: the smallest one between any two."""
    text, axis = without_axis(text)
    wording = wording if axis is None else replace(wording, axis=axis)
    at = text.skip(0, len(text.words), "conjunction")
    at = at + 1 if text.word_at(at, len(text.words), "of", "between", "for", "among") else at
    at = text.skip(at, len(text.words))
    parts = selection(text, text.after("adjacent", at, len(text.words)) or at, len(text.words))
    if parts is None:
        return None
    if wording.reduce is Reduce.LARGEST:
        return Distance(parts, None, True, wording.axis, Reduce.LARGEST)
    text.note("The spacing is taken as the smallest distance between the centres of any two of the parts.")
    return Distance(parts, None, True, wording.axis, Reduce.SMALLEST, alike=True)


def _ends(text: Text, start: int, end: int) -> tuple[End, End | None] | None:
    at = text.skip(start, end, "be", "verb", "light", "conjunction", "noise")
    preposition = text.words[at] if at < end else ""
    if preposition in ("between", "of", "from", "to", "among", "for", "separating"):
        at += 1
    else:
        return None
    at = text.skip(at, end, "conjunction")
    joints = ("and", "to") if preposition == "between" else ("to", "from", "and")
    for joint in joints:
        for middle in range(at + 1, end):
            runs = text.match("verb", middle - 1, end) and not text.match("noun_verb", middle - 1, end)
            if text.word_at(middle, end, joint) and not runs:
                first = text.attempt(_end, at, middle, None)
                like = first.place if first and isinstance(first.place, Selection) else None
                second = text.attempt(_end, middle + 1, end, like)
                if second and isinstance(second.place, Selection) and first is None:
                    first = text.attempt(_end_like, at, middle, second.place)
                if first and second:
                    shared = End(second.place, first.centers if second.centers is None else second.centers)
                    return first, shared
    alone = _end(text, at, end, None)
    if alone is None or not isinstance(alone.place, Selection):
        return None
    if preposition == "to" or (preposition == "for" and not alone.place.plural):
        return None
    return alone, None


def _end_like(text: Text, start: int, end: int, like: Selection) -> End | None:
    """'the largest (and the smallest hole on the top)': the noun, sides and filters of the other end."""
    found = _end(text, start, end, like)
    if found is None or not isinstance(found.place, Selection):
        return None
    other = like.phrases[0]
    phrase = replace(found.place.phrases[0], sides=other.sides, filters=other.filters)
    return End(Selection((phrase,)), found.centers)


def _before_center(text: Text, at: int, end: int) -> int | None:
    """Where do the parts end in 'the hole's center', 'the bore axis'? None where no such point is named last."""
    if not text.word_at(end - 1, end, *_OWN_CENTER) or end - 2 < at:
        return None
    if text.word_at(end - 2, end, "'s"):
        return end - 2
    return end - 1 if modifiers.starts_noun(text, end - 2, end - 1) else None


def _end(text: Text, start: int, end: int, like: Selection | None) -> End | None:
    """One end: 'the centre of the shaft', 'the origin', 'the edge of the object', 'the top', 'one of the holes'."""
    at = text.skip(start, end)
    at = text.after("adjacent", at, end) or at
    if (origin := text.after("origin", at, end)) and origin >= end:
        return End(Origin(), True)
    if point := text.match("center", at, end):
        after = of_whole(text, point[1], end) or point[1]
        if after >= end:
            return End(Whole(), True)
    if _is_edge(text, at, end):
        return End(None)
    side = text.match("side", text.skip(at, end, "whole_adjective"), end)
    if side:
        after = text.skip(side[1], end, "side_noun", "edge")
        if (of_whole(text, after, end) or after) >= end:
            return End(Boundary(Side(side[0])))
    if plane := plane_of(text, at, end):
        return End(plane)
    centers = None
    if found := text.match("point_of", at, end):
        centers, at = found[0] == "centers", text.skip(found[1], end)
        at = text.after("adjacent", at, end) or at
    elif stop := _before_center(text, at, end):
        centers, end = True, stop
    elif (lead := text.match("center", at, end)) and text.word_at(lead[1], end, "of"):
        centers, at = True, lead[1] + 1
    parts = selection(text, at, end, like)
    if parts is None:
        return None
    return End(parts, centers)


def plane_of(text: Text, start: int, end: int) -> Plane | None:
    """'the underside of the foot', 'the flange's front face', 'the carriage top': an outermost plane of parts."""
    at = text.skip(start, end, "article", "noise", "whole_adjective")
    if (side := text.match("side", at, end)) is not None:
        after = text.skip(side[1], end, "side_noun", "edge")
        if text.word_at(after, end, "of") and text.match("article", after + 1, end):
            of = selection(text, after + 1, end)
            return Plane(Side(side[0]), of) if of is not None and not of.phrases[0].sides else None
        return None
    for last in range(end - 1, at, -1):
        side = text.match("side", last, end)
        if side is None or text.skip(side[1], end, "side_noun", "edge") < end:
            continue
        led = any(text.match(category, last - 1, last) for category in ("article", "side_preposition", "verb", "light"))
        of = None if led else selection(text, at, last - text.word_at(last - 1, last, "'s"))
        return Plane(Side(side[0]), of) if of is not None and not of.phrases[0].sides else None
    return None


def between_planes(text: Text, start: int, end: int) -> Distance | None:
    """'from the rail's underside to the carriage top': how far such planes are apart."""
    if not text.word_at(start, end, "from"):
        return None
    for middle in range(start + 2, end - 1):
        if text.word_at(middle, end, "to"):
            first, second = text.attempt(_end, start + 1, middle, None), text.attempt(_end, middle + 1, end, None)
            if first is None or second is None:
                continue
            places = (first.place, second.place)
            if all(isinstance(place, Plane | Boundary) for place in places) and Plane in map(type, places):
                found = _distance(text, first, second, Wording())
                return found if isinstance(found, Distance) else None
    return None


def _is_edge(text: Text, start: int, end: int) -> bool:
    """'the edge', 'the edge of the object', 'the part's edge', 'the plate edge'; not the edge of a hole."""
    if edge := text.after("edge", start, end):
        if (of_whole(text, edge, end) or edge) >= end:
            return True
        return text.word_at(edge, end, "of") and _is_solid(selection(text, edge + 1, end))
    last = next((i for i in range(start + 1, end) if text.after("edge", i, end) == end), None)
    if last is None:
        return False
    return of_whole(text, start, last) == last or _is_solid(selection(text, start, last))


def _is_solid(parts: Selection | None) -> bool:
    """Is it something with an outer edge, and nothing that is cut in?"""
    if parts is None or len(parts.phrases) > 1 or parts.noun_class is NounClass.HOLE:
        return False
    return LEXICON.match("cut_noun", (parts.phrases[0].noun,), 0, 1) is None


def angle(text: Text, start: int, end: int) -> Query | None:
    """'angle between the shaft and the rib', 'angle of the legs to each other'."""
    if not text.word_at(start, end, "angle", "angles", "inclination"):
        return None
    at = text.skip(start + 1, end, "verb", "light")
    if not text.word_at(at, end, "between", "of", "from"):
        return None
    own = selection(text, at + 1, end) if text.word_at(at, end, "of") else None
    if own is not None and len(own.phrases) == 1 and LEXICON.match("angled_noun", (own.phrases[0].noun,), 0, 1):
        return Get((Measure.ANGLE,), own)
    if (next_to := text.find("adjacent", at + 1, end)) is not None:
        around = selection(text.rearranged(range(next_to[2], end)), 0, end - next_to[2])
        return _around(around, text) if around is not None and around.plural else None
    pair = two_selections(text, at + 1, end, ("and", "to", "with", "against", "relative"))
    return Angle(*pair) if pair else None


def _around(parts: Selection, text: Text) -> Angle:
    text.note("The angle between neighbours is taken as seen from the middle of all of them.")
    return Angle(parts, None, seen=True)


def two_selections(
    text: Text, start: int, end: int, joints: tuple[str, ...]
) -> tuple[Selection, Selection | None] | None:
    """Two noun phrases joined by one of `joints`, or one in the plural."""
    for middle in range(start + 1, end):
        if text.word_at(middle, end, *joints):
            first = text.attempt(_axis_of, start, middle, None)
            second = text.attempt(_axis_of, middle + 1, end, first)
            if first and second:
                return first, second
    alone = _axis_of(text, start, end, None)
    return (alone, None) if alone and alone.plural else None


def _axis_of(text: Text, start: int, end: int, like: Selection | None) -> Selection | None:
    at = text.skip(start, end)
    if (
        (named := text.match("property", at, end))
        and named[0] in ("axis", "direction", "normal")
        and text.word_at(named[1], end, "of")
    ):
        at = named[1] + 1
    return selection(text, text.skip(at, end), end, like)
