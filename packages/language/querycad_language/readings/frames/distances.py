"""Distances and angles: between two parts, every two of several, a part and a plane or place; and overhangs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, pairwise, permutations, product, zip_longest
from typing import Literal, NamedTuple

from querycad_contracts import Measure, PartKind, PartQuery, Side
from querycad_language.forms import Anchor, Angle, Boundary, Distance, Plane, Reduce, Several
from querycad_language.phrases import places_of, replace_fields, without
from querycad_language.readings.owners import kinds_of
from querycad_language.readings.parses import Features, Parse
from querycad_language.readings.question import Question
from querycad_language.readings.requested_measures import EXTREMES, asked_in
from querycad_language.text import Text

from .anchors import NEAREST, WHOLE, Spot, anchors_of, ends_between, pairs_named, plane_of, planes_of
from .axes import axes_listed, axis_named
from .related_parts import floored, is_cut, rimmed

Mode = Literal["centers", "surfaces", "outsides", "usual"]
NEAR = 3  # words between 'over the outsides' and the measure that it belongs to
_ROUND = frozenset((PartKind.HOLE, PartKind.BOSS, PartKind.CYLINDER, PartKind.BODY))
_RIMS = ("rim", "brim", "top", "top edge", "upper edge", "mouth")
BORDERS = ("edge", "wall", "flank", "side", "end", "face", "rim", "beginning", "start")
"""What has a nearer one of: 'to the near edge of the slot'."""
_CENTRE_OF = frozenset(("center", "middle", "axis", "position", "centroid", "centerline"))
_HIGH = (Measure.HEIGHT, Measure.CENTER_HEIGHT, Measure.Z)
_ACROSS = (Measure.WIDTH, Measure.THICKNESS, Measure.LENGTH)
_APART = (*_HIGH, *_ACROSS, Measure.DEPTH)
"""Measures that between two parts are distances: 'the height of A above B'."""
_AGAINST = ("from", "against", "relative", "compared", "off", "to", "with")  # before what something leans against
_WEBS = ("web", "bridge", "land", "ligament", "partition", "strip", "margin", "rib")  # what is left between two cuts
REACHES = ("projection", "overhang", "protrusion", "setback", "offset")
_UNDER = ("under", "underneath", "beneath")
_BEYOND = ("above", "over", "beyond", "past", "below", "behind", "proud", "higher", "out", "overhang", "off", *_UNDER)
_DRAWN = ("form", "make", "sit", "lie", "on", "in", "at", "corner", "arranged", "long", "which", "that", "its", "what")
"""Words that say of parts that they are the corners of a figure."""


class _Words(NamedTuple):
    """Words that ask for a distance."""

    start: int
    end: int
    mode: Mode
    used: set[int]
    named: bool = True
    level: bool = False  # 'how high above …?' is not asked of every two


class _Pair(NamedTuple):
    """What a distance is measured between, with the tokens and features of both ends."""

    first: Anchor
    second: Anchor | Literal["each other"]
    used: set[int]
    features: Features


def distances(question: Question) -> Iterator[Parse]:
    """'How far apart are the two keyways?', 'What is the distance between the keyway and the shoulder?'"""
    text = question.text
    for start, end, said, used, named, level in _distance_words(question):
        axis, along = axis_named(question)
        reduce, extreme = _extreme(question, start, end)
        mode, centred = _mode(question, said)
        axes, listed = axes_listed(question)
        if text.at_phrases("gap") and (total := text.covered("total")):  # 'play, both sides together'
            reduce, extreme = Reduce.TOTAL, extreme | total
        for first, second, more, features in _pairs(question, start):
            all_pairs = second == "each other"
            if level and all_pairs:
                continue
            if reduce in EXTREMES.values() and isinstance(first, PartQuery):
                if all_pairs or not (first.definite or first.ranks):  # of all: 'the two furthest apart'
                    first = replace_fields(first, count=None, ranks=(), plural=True)
            if question.in_degrees:  # 'how far apart in degrees'
                if isinstance(first, PartQuery) and isinstance(second, PartQuery | str):
                    other = second if isinstance(second, PartQuery) else None
                    yield Parse(Angle(first, other), {"angle_of_parts": 1.0}, used | more)
                continue
            nearest = reduce is Reduce.SMALLEST and not extreme & text.at_words("first")
            if nearest and isinstance(second, PartQuery) and mode == "usual":
                mode = "surfaces"  # the shortest way from one to the other
            every = all_pairs and reduce is Reduce.ONE
            near = text.covered("least") - more  # 'the two closest holes', 'two holes opposite each other'
            across = every and text.at_words("opposite", "opposing")
            of_all = Reduce.LARGEST if across else Reduce.SMALLEST if every and near else reduce
            form = _of_holders(Distance(first, second, mode, axis, of_all))
            features = {"distance" if named else "distance_unnamed": 1.0, **features}
            yield Parse(form, features, used | more | along | extreme | centred | (across or set()))
            if all_pairs and axes:
                several = Several(tuple(replace(form, axis=one) for one in axes))
                yield Parse(several, {**features, "axes_listed": 1.0}, used | more | listed | centred)


def _of_holders(form: Distance) -> Distance:
    """'The inner faces of the two webs', 'across the outer faces of the lugs': of the webs, of the lugs."""
    first = form.first
    if form.second != "each other" or not (isinstance(first, PartQuery) and PartKind.FACE in kinds_of(first)):
        return form
    holder = next((what for _, what in places_of(first, "of", "") if what.plural), None)
    mode: Mode = "outsides" if "outer" in first.adjectives else "surfaces"
    return form if holder is None else replace(form, first=holder, mode=mode)


def _distance_words(question: Question) -> Iterator[_Words]:
    text = question.text
    yield from _unnamed(question)
    for span in text.all("outside_to_outside"):
        near = {i for i in text.at_phrases("measure") if span.start - NEAR < i < span.end + NEAR}
        yield _Words(span.start, span.end, "outsides", {*span.tokens, *near})
    for span in text.all("distance", "gap"):
        noun = text.find(span.start, "noun")
        other = (noun and noun.end > span.end) or text.is_word(span.start - 1, "angular")  # a pitch circle is no pitch
        slot = text.is_word(span.start, "clearance") and text.find(span.end, "noun")  # 'the clearance slot'
        if question.in_question(span.start) and not (other or slot):
            used = {*span.tokens, *text.at_phrases("between")}
            for at in text.at_words("how") if span.category == "gap" else ():  # 'how wide is the gap'
                used |= {at, *(scale.tokens if (scale := text.find(at + 1, "scale")) else ())}
            yield _Words(span.start, span.end, "surfaces" if span.category == "gap" else "usual", used)
    yield from _left_between(question)
    for at in range(*question.asking):
        if text.is_word(at, "how"):
            yield from _how(text, at)
        elif measure := text.find(at, "measure"):
            diagonal = measure.value in (Measure.DIAGONAL, Measure.ACROSS_CORNERS)
            if diagonal and text.is_word(measure.end, "between"):  # 'the diagonal between two opposite holes'
                yield _Words(at, measure.end, "centers", {*measure.tokens, measure.end})
            ahead = text.at_words("above", "over", "below", "between", "from", "off", "to") - text.covered("over_all")
            if measure.value in _APART and any(i >= measure.end for i in ahead):
                yield _Words(at, measure.end, "centers" if measure.value in _HIGH else "surfaces", set(measure.tokens))


def _left_between(question: Question) -> Iterator[_Words]:
    """'the least metal between the lugs', 'the thinnest web between the bores'."""
    text = question.text
    for span in text.all("stuff") if text.has("between") or {*text.words} >= {"from", "to"} else ():
        if question.in_question(span.start) and text.is_word(span.end, "between", "left", "remaining", "standing"):
            yield _Words(span.start, span.end, "surfaces", {*span.tokens, *text.at_phrases("remaining", "between")})
    for at in text.at_words(*_WEBS):
        if text.is_word(at + 1, "between") and question.in_question(at):
            yield _Words(at, at + 1, "surfaces", {at, at + 1})
    for between in text.at_words("between"):  # 'what web is left between', 'how much land remains between'
        begin = between
        while text.find(begin - 1, "remaining", "be", "do", "modal") or text.is_word(begin - 1, "there"):
            begin -= 1
        stuff = next((m for m in question.parts if m.end == begin and not m.part.plural), None)
        if stuff is not None and text.is_word(stuff.start - 1, "what", "which", "much") and begin < between:
            yield _Words(stuff.start, between, "surfaces", set(range(stuff.start - 1, between + 1)))


def _unnamed(question: Question) -> Iterator[_Words]:
    """'hole center to hole center', 'from the pin to the edge': neither a distance nor a measure is named."""
    text = question.text
    measures = [span for i in range(*question.asking) if (span := text.find(i, "measure"))]
    counts = (span.start for span in text.all("count") if question.unit(span.end) is None)
    if any(map(question.in_question, (*text.at_phrases("distance", "gap"), *counts))):
        return
    joining = text.at_words("to", "above", "from")
    sized = (one for one in measures if one.value is Measure.SIZE and text.is_word(one.end, "from", "between"))
    sizes = {i for one in sized for i in one.tokens}  # 'the dimension from the axis to the flat'
    points = (Measure.POSITION, Measure.AXIS, Measure.TIP, *([Measure.SIZE] if len(joining) > 1 or sizes else ()))
    centred = _centred(text)
    if not centred and any(span.value not in points and not span.value.endswith("_end") for span in measures):
        return
    if any(token.power == 1 for token in text.tokens) or text.at_phrases("remaining"):
        joining |= text.at_words("between")
    inside = joining - {0, len(text) - 1} or joining & text.at_words("between")
    if centred or (inside and (len(anchors_of(question)) > 1 or any(m.part.places for m in question.parts))):
        yield _Words(-1, 0, "usual", joining | sizes, named=bool(sizes))


def _how(text: Text, at: int) -> Iterator[_Words]:
    """'How far …?', 'How much gap …?', 'How high above …?'"""
    gap = any(text.find(i, "gap") for i in range(at + 2, at + 5))
    apart = text.at_words("between", "separate", *({"from"} if text.has("to") else ()))
    if text.is_word(at + 1, "much") and (stuff := text.stuff(at)) and apart:
        yield _Words(at, stuff.end, "surfaces", {*range(at, stuff.end), *text.at_phrases("remaining"), *apart})
    if text.is_word(at + 1, "far", "close") or (text.is_word(at + 1, "much") and gap):
        if not any(text.find(i, "reach") for i in range(at + 2, at + 14)):
            apart = {i for i in text.at_words("apart", "away", "from", "each", "other") if i > at}
            apart |= {at + 2} if text.is_word(at + 2, "in", "inwards", "up", "down", "along") else set()
            yield _Words(at, at + 2, "usual", {at, at + 1} | apart)
    elif scale := text.find(at + 1, "scale"):
        measure, said = scale.value.measure, set(range(at, scale.end))
        if measure in _ACROSS and apart:  # 'how wide is it from the pin to the slot'
            yield _Words(at, scale.end, "surfaces", said | apart)
        high = measure is Measure.HEIGHT and text.at_words("above", "over", "below", "from", "off")
        if high and max(high) > at + 1:
            yield _Words(at, scale.end, "centers", said, level=True)
        below = {i for i in text.at_words("below", "beneath", "under") if i > at + 1}
        if measure is Measure.DEPTH and below:  # 'how deep below the rim'
            yield _Words(at, scale.end, "surfaces", said | below, level=True)


def _centred(text: Text) -> set[int]:
    """The words for 'centre to centre'; none in 'edge to edge, not centre to centre'."""
    return {
        i for span in text.all("center_to_center") if not text.find(span.start - 1, "negation") for i in span.tokens
    }


def _mode(question: Question, mode: Mode) -> tuple[Mode, set[int]]:
    """From where to where: between centres, between surfaces, or as usual for such parts; and the words for it."""
    text = question.text
    ends = {mention.end + text.is_possessive(mention.end) for mention in question.mentions}
    named = {i for i in text.at_words(*_CENTRE_OF) if text.is_word(i + 1, "of", "to", "from") or i in ends}
    if centred := _centred(text) or named:
        return "centers", centred
    inside = {i for i in text.at_words("inside", "internally") if i + 1 == len(text) or text.is_break(i + 1)}
    near = {at for at in text.at_words(*NEAREST, "near") if text.is_word(at + 1, *BORDERS)}
    asks, begins = any(text.find(question.asking[0] + i, "ask") for i in (0, 1)), ("begin", "begins", "start", "starts")
    near |= {at for at in text.at_words("beginning", *begins) if asks or text.is_word(at + 1, "of")}
    cuts = [m for m in question.parts if is_cut(m.part) or is_cut(rimmed(m.part))]  # 'the edge of the hole'
    near |= {i for m in cuts for i in {*m.used, m.start - 2} if text.is_word(i, "edge", "rim", "border", "outline")}
    facing = near | inside | text.covered("surface_to_surface")
    if text.has("between") or {*text.words} >= {"from", "to"}:
        facing |= text.at_phrases("remaining")
    outside = mode == "outsides" and facing & text.covered("outside_to_outside")
    return ("surfaces", facing) if facing and not outside else (mode, set())


def _extreme(question: Question, start: int, end: int) -> tuple[Reduce, set[int]]:
    """The largest, the smallest, or all different ones of several distances."""
    text = question.text
    for at in sorted(text.at_words("diagonal", "diagonally")):
        if not any(text.find(i, "negation") for i in range(at - 3, at)):
            return Reduce.LARGEST, {at}
    for at in range(start - 2, end + 1):
        if span := text.find(at, "most", "least"):
            return EXTREMES[span.category], {at}
    for span in text.all("most", "least"):  # 'at its thinnest'
        if text.is_word(span.start - 1, "its", "the", "their") and text.is_word(span.start - 2, "at"):
            return EXTREMES[span.category], {span.start - 2, span.start - 1, span.start}
    first, last = text.at_words("first"), text.at_words("last")
    if first and last and min(first) < max(last):  # 'from the first hole to the last one'
        return Reduce.LARGEST, first | last
    if first and text.has("from") and not last:  # 'how far from the left end to the first hole'
        return Reduce.SMALLEST, first
    each = {i for i in text.at_phrases("different") if question.in_question(i)}
    return (Reduce.DIFFERENT, each) if each else (Reduce.ONE, set())


def _pairs(question: Question, start: int) -> Iterator[_Pair]:
    """Every two parts of a plural one; two that are named; one from the middle or the outside of the model."""
    text, named = question.text, _ends(question)
    spots = [*chain.from_iterable(named)]
    for spot in spots:
        behind = max(spot.used) + 1
        for first, second in ends_between(spot.anchor if isinstance(spot.anchor, PartQuery) else None):
            yield _Pair(first, second, spot.used, {"place_between": 1.0})
            for other in spots if second == "each other" and text.is_word(behind, "and") else ():
                if behind < min(other.used) <= behind + 3:  # 'the wall between the bore and the edge', which is no part
                    used = spot.used | other.used | text.at_words("closest", "nearest")
                    yield _Pair(replace_fields(first, plural=False), other.anchor, used, {"place_between": 1.0})
    ends = [spots for spots in named if not all(spot.at == start for spot in spots)]  # 'the gap' is no end of itself
    after = [spots for spots in ends if spots[0].at >= start]
    before = [spots for spots in ends if spots[0].at < start]
    beside = text.at_phrases("neighbor")
    several = beside or text.has("one", "next", "other", "each") or text.find(start - 1, "noun")  # 'stud spacing'
    single = len(ends) > 1 and text.has("from", "between") and not several  # 'from the floor of the keyway to the axis'
    for _, anchor, used, mate in chain.from_iterable([*after[:3], *before[-3:]]):
        if isinstance(anchor, PartQuery) and not (mate or anchor.also or (single and not anchor.plural)):
            anchor = replace_fields(anchor, count=None, plural=True) if beside else anchor
            yield _Pair(anchor, "each other", used | beside, {"each_other": 1.0, "count_two": float(anchor.count == 2)})
    yield from _two(text, before, after)
    yield from _levels(text, ends)
    for spot in chain.from_iterable([*after[:2], *before[-1:]]):
        yield from _from_model(spot)


def _ends(question: Question) -> list[list[Spot]]:
    """What a distance can be measured from, from left to right; what the same words can mean stands together."""
    found: list[list[Spot]] = []
    for spot in anchors_of(question):
        if not found or all(spot.used.isdisjoint(other.used) for other in found[-1]):
            found.append([])
        found[-1].append(spot)
    return found


def _two(text: Text, before: Sequence[list[Spot]], after: Sequence[list[Spot]]) -> Iterator[_Pair]:
    """Two anchors behind the words that ask, one before and one behind them, or both before: 'rib to hub distance'."""
    pairs = [*pairwise(after), *([(before[-1], after[0])] if before and after else pairwise(before[-2:]))]
    pairs += [(after[0], after[2])] if len(after) > 2 else []
    for one, two in chain.from_iterable(product(ones, others) for ones, others in pairs):
        used = one.used | two.used
        bounds = [end.anchor for end in (one, two) if isinstance(end.anchor, Boundary) and text.find(end.at, "side")]
        side, other = (bound.side for bound in bounds) if len(bounds) == 2 else (None, None)
        if side and side.opposite is other:  # 'from the left side to the right'
            one = one._replace(anchor=Plane(side, WHOLE))
        owner = one.anchor.of if isinstance(one.anchor, Plane) else one.anchor
        itself = isinstance(owner, PartQuery) and two.anchor in (owner, Plane(None, owner))  # 'the slot to its end'
        if isinstance(one.anchor, PartQuery) and one.anchor == two.anchor:  # 'eye to eye'
            both = replace_fields(one.anchor, plural=True)
            yield _Pair(both, "each other", used, {"each_other": 1.0, "two_anchors": 1.0})
        compound = text.find(max(one.used) + 1, "distance") and text.is_word(min(two.used) - 1, "of", "in", "on")
        pair = not (compound and isinstance(two.anchor, PartQuery))  # 'the hole spacing of the grid' is of its holes
        if pair and not itself and (one.placed or two.placed):
            mate = {"axis_of_mate": 1.0} if one.mate or two.mate else {}
            yield _Pair(one.anchor, two.anchor, used, {"two_anchors": 1.0, **mate, "led": _led(text, one, two)})


def _led(text: Text, one: Spot, two: Spot) -> float:
    """Do a 'from' and a 'to' stand before the two anchors: 'the height from the seat to the rim'? 0.5: one of both."""
    begins, ends = text.at_words("from", "between"), text.at_words("to", "and", "until", "till")
    leads = []
    for first in (min(one.used), min(two.used)):
        start = max((i for i in range(first - 3, first) if text.find(i, "noun")), default=first - 3)
        leads.append(set(range(start, first)))
    both = any(a & begins and b & ends for a, b in (leads, leads[::-1]))
    return 1.0 if both else 0.5 * any(lead & (begins | ends) for lead in leads)


def _levels(text: Text, ends: Sequence[list[Spot]]) -> Iterator[_Pair]:
    """'How high above the base is the bore?': from the top or the underside of what is named, or from the ground."""
    for span in (one for one in text.all("place") if one.value in ("above", "below")):
        behind = next((spots for spots in ends if spots[0].at >= span.end), None)
        others = [spots for spots in ends if spots is not behind][:3]
        for spot, base in product(chain.from_iterable(others), behind or ()):
            used = spot.used | base.used | set(span.tokens)
            if isinstance(spot.anchor, PartQuery | Plane) and isinstance(base.anchor, PartQuery):
                yield _Pair(Plane(Side.BOTTOM, base.anchor), spot.anchor, used, {"level": 1.0})
                yield _Pair(Plane(Side.TOP, base.anchor), spot.anchor, used, {"level": 1.0, "level_top": 1.0})
    for spot in chain.from_iterable(ends):
        under_it = {i for i in text.at_words(*_UNDER) if max(spot.used) - 4 < i < spot.at}
        if isinstance(spot.anchor, PartQuery) and under_it and text.at_phrases("gap"):  # 'clearance under the handle'
            yield _Pair(Plane(Side.BOTTOM, spot.anchor), Boundary(Side.BOTTOM), spot.used | under_it, {"level": 1.0})


def _from_model(spot: Spot) -> Iterator[_Pair]:
    """From the place in the phrase itself."""
    if isinstance(spot.anchor, PartQuery):
        for also in spot.anchor.also:  # 'between the upper holes and the lower holes'
            yield _Pair(replace_fields(spot.anchor, also=()), also, spot.used, {"two_anchors": 1.0})
        for place, holder in places_of(spot.anchor, "of", "above", "below", "on", "in", "near"):
            for other in (holder, plane_of(holder)):
                if other is not None:
                    yield _Pair(without(spot.anchor, place), other, spot.used, {"place_as_anchor": 1.0})


def overhangs(question: Question) -> Iterator[Parse]:
    """'By how much does the spindle project above the nut?', 'How far below the hub does the lug end?'"""
    text, nouns = question.text, question.parts
    reach = next(iter(text.all("reach")), None)
    named = bool(nouns) and nouns[0].part.noun in REACHES
    word = min(text.at_words(*_BEYOND, *(("from",) if reach or named else ())), default=None)
    high = any(span.value is Measure.HEIGHT for span in text.all("measure"))
    if word is None or not nouns or not (reach or high or text.has(*REACHES, "much", "far")):
        return
    of = places_of(nouns[0].part, "of") if named else ()  # 'the overhang of the pin'
    first = replace(nouns[0], query=of[0][1]) if of else nouns[0]
    other = next((mention for mention in nouns[1:] if mention.head > word), None)
    if first.start > word and other is not None:  # 'how far below the rim do they end'
        first, other = other, first
    plane = next((one for one in planes_of(question) if one.at >= word and one.used.isdisjoint(first.used)), None)
    used = {word, *first.used, *(reach.tokens if reach else ())}
    used |= text.at_words("how", "much", "far", "length", "height", *REACHES)
    if plane is not None and isinstance(plane.anchor, Plane):
        yield Parse(Distance(Plane(plane.anchor.side, first.part), plane.anchor), {"overhang": 1.0}, used | plane.used)
    elif other is not None:
        used |= other.used
        ends = [(one, plane_of(one)) for one in (first.part, rimmed(other.part) or other.part)]  # 'the face of the web'
        bare = [p.of if isinstance(p, Plane) and not (p.side or "inner" in one.adjectives) else one for one, p in ends]
        form = Distance(Plane(None, bare[0]), Plane(None, bare[1]))
        yield Parse(form, {"overhang": 1.0}, used)
        around = {i for at in text.at_words("side", "end") if text.find(at - 1, "each") for i in (at - 1, at)}
        if around := around | text.at_words("sideways", "radially"):
            yield Parse(replace(form, mode="outsides"), {"overhang": 1.0}, used | around)
    if text.is_word(word, "below") and other is not None and other.part.noun in _RIMS:  # 'how far below the rim'
        down = Side.BOTTOM if reach and reach.value is Measure.DEPTH else Side.TOP
        level = next((Plane(Side.TOP, what) for _, what in places_of(other.part, "of")), Boundary(Side.TOP))
        yield Parse(Distance(Plane(down, first.part), level), {"overhang": 1.0, "level_top": 1.0}, used)
    own = next((one for one in planes_of(question) if one.used & first.used), None)
    for place, holder in places_of(first.part, "above", "below", "of", "on"):
        standing = without(first.part, place)
        yield Parse(Distance(Plane(None, standing), Plane(None, holder)), {"overhang": 1.0}, used)
        if own is not None and isinstance(own.anchor, Plane):  # 'the tops of the pins below the edge of the tray'
            levels = Distance(Plane(own.anchor.side, standing), Plane(own.anchor.side, holder))
            yield Parse(levels, {"overhang": 1.0, "level_top": 1.0}, used | own.used)


def insertions(question: Question) -> Iterator[Parse]:
    """'How deep does the plug sit in the socket?', 'Engagement of the pin in the hub?': how far one is in another."""
    text = question.text
    asks = text.at_words("deep", "far", "much") & {at + 1 for at in text.at_words("how")}
    named, into = text.covered("engagement"), text.at_words("in", "into", "inside", "within")
    words = named | asks | {at - 1 for at in asks} | into | text.covered("entering", "reach")
    wanted = named or (into and any(at > min(asks, default=len(text)) for at in text.at_phrases("entering")))
    for first, second, used in pairs_named(question.parts, "in") if wanted else ():
        yield Parse(Distance(first, second, "within"), {"insertion": 1.0}, used | words)


def opposites(question: Question) -> Iterator[Parse]:
    """'From the floor of the keyway to the opposite side of the bore?', 'Flat to the opposite wall of the shaft?'"""
    text = question.text
    named = [(m.part, m.used) for m in question.parts]
    named += [(what, m.used) for m in question.parts for _, what in places_of(m.part)]
    named += [(cut, m.used) for m in question.parts if (cut := floored(m.part)) is not None]
    across = text.at_words("opposite", "far", "across", "straight", "to", "from", "wall", "side", "floor", "bottom")
    beyond = text.has("opposite") or any(text.is_word(i + 1, "side", "wall", "face") for i in text.at_words("far"))
    for (flat, used), (other, more) in permutations(named, 2) if beyond else ():
        if (is_cut(flat) or flat.noun == "flat") and not _ROUND & {*kinds_of(flat)} and _ROUND & {*kinds_of(other)}:
            yield Parse(Distance(flat, other, "across"), {"across_round": 1.0}, used | more | across)


def angles(question: Question) -> Iterator[Parse]:
    """'What is the angle between the two flaps?', 'At which angle does the rib meet the lever?'"""
    text = question.text
    for asked in asked_in(question):
        leans = asked.measures == (Measure.INCLINATION,) and len(question.parts) > 1 and text.has(*_AGAINST)
        plain = asked.measures in ((Measure.ANGLE,), (Measure.INCLUDED_ANGLE,), (Measure.ANGULAR_PITCH,))
        if not (plain or leans) or not question.in_question(asked.start):
            continue
        between, next_to = bool(text.at_phrases("between")), text.at_phrases("neighbor")
        joining = text.at_phrases("between", "neighbor") if between else text.at_words("apart", *_AGAINST)
        joining |= {i for span in text.all("measure") if span.value is Measure.AXIS for i in span.tokens}
        features: Features = {"angle_between" if between else "angle_of_parts": 1.0}
        for first, second in zip_longest(question.parts, question.parts[1:]):
            used = {*asked.used, *first.used, *joining}
            if first.plural or next_to or any(place.relation == "between" for place in first.part.places):
                yield Parse(Angle(first.part, None), features, used)
                if next_to:  # 'between two neighbouring holes': of all of them
                    yield Parse(Angle(replace_fields(first.part, count=None, plural=True), None), features, used)
            if second is not None:
                yield Parse(Angle(first.part, second.part), features, used | second.used)


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
