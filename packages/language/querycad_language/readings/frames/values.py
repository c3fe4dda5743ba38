"""Values: a measure of a part or of the whole; the whole against the box around it, the axis that parts run along."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace
from itertools import pairwise

from querycad_contracts import Measure, PartKind
from querycad_language.forms import LONGEST, SHORTER, Behind, Combine, Distance, Get, Reduce, Target
from querycad_language.measures import EXTENTS, is_length
from querycad_language.phrases import places_of, replace_fields
from querycad_language.readings.owners import Owner, kinds_of, owners_of
from querycad_language.readings.parses import Features, Parse
from querycad_language.readings.question import Question, used_by
from querycad_language.readings.requested_measures import EXTREMES, SIZES, Requested, asked_in
from querycad_language.text import Text
from querycad_language.tokens import DENSITY, Kind

from .anchors import ends_between
from .axes import axes_listed, axis_named, own_axis_named
from .related_parts import floored, of_related, within

VECTORS = frozenset((Measure.AXIS, Measure.NORMAL, Measure.DIRECTION, Measure.POSITION, Measure.TIP, Measure.OPENING))
ADDITIVE = frozenset((Measure.AREA, Measure.VOLUME, Measure.LENGTH, Measure.MASS))
_STACKED = frozenset((Measure.THICKNESS, Measure.WIDTH))
"""Measures that add up where 'total' stands right before them."""
_ALONG = (*_STACKED, Measure.DEPTH, Measure.LENGTH, Measure.HEIGHT, *SIZES)
MOST_TOGETHER = 3  # measures of one part that people ask for in one sentence
_SHARED = (Reduce.DIFFERENT, Reduce.MEAN, Reduce.RANGE, Reduce.TOTAL)
_OF_SEVERAL = (Reduce.LARGEST, Reduce.SMALLEST, *_SHARED)
"""What becomes of the values of several parts."""
_LONG = (Measure.LENGTH, *SIZES)
_CORNERS = (Measure.DIAGONAL, Measure.ACROSS_CORNERS)
_SAYS_BOX = ("box", "block", "volume", "much", "size", "part")
_THICKNESSES = (Measure.THICKNESS, Measure.WIDTH, Measure.WALL_THICKNESS, Measure.LENGTH, Measure.HEIGHT)
_ANGLES = (Measure.ANGLE, Measure.DRAFT, Measure.INCLINATION)
_RUNNING = frozenset(("along", "parallel", "run", "lie", "coordinate", "follow", "go", "point", "stretch", "direction"))
_TURNING = frozenset(("about", "around", "turn", "spin", "rotate", "revolve"))
_JOINTS = ("and", ",", "&", "x", "then", "by")
_OVERALL = frozenset(("overall", "total", "complete", "entire", "whole", "full", "maximum"))
_ALONG_AXES = {**dict(enumerate(EXTENTS)), LONGEST: Measure.LONG_SIDE, SHORTER: Measure.SHORT_SIDE}


def values(question: Question) -> Iterator[Parse]:
    """A measure of a part or of the whole: 'How deep is the dovetail?', 'What is the width of the lever?'"""
    shared = (Measure.VOLUME,) if question.text.at_phrases("overlap") else ()
    asked_for = [one for one in asked_in(question) if one.measures != shared]
    within = [one for one in asked_for if question.in_question(one.start)] or asked_for
    for asked in [*within, *_together(question, asked_for)]:
        for owner in owners_of(question, asked):
            parse = _value(question, asked, owner)
            get = parse.form
            assert isinstance(get, Get)
            yield from _both_diameters(question, get, parse)
            yield from of_related(question, asked, get, parse)
            if not _under_cut(get):
                yield from _with_axis(question, get, parse)
            yield from less(question, get, parse.features, parse.used)
            yield from material(question, get, parse.features, parse.used)


def _together(question: Question, asked_for: Sequence[Requested]) -> Iterator[Requested]:
    """'How deep is the slot, and how long is it?': measures of one owner that are asked one after the other."""
    text = question.text
    lengths = [one for one in asked_for if question.in_question(one.start) and all(map(is_length, one.measures))]
    lengths = [one for one in lengths if not _is_aside(text, one.start)]
    sides = [one for one in lengths if one.measures[0] not in SIZES]
    if sum(len(one.measures) for one in sides) > 1:  # 'the size of the window, width first and then height'
        lengths = sides
    ones = list({one.measures: one for one in reversed(lengths)}.values())[::-1]
    measures = tuple(dict.fromkeys(measure for one in ones for measure in one.measures))
    joined = all(any(text.is_word(i, *_JOINTS) for i in range(a.end, b.start)) for a, b in pairwise(ones))
    if len(ones) > 1 and len(measures) <= MOST_TOGETHER and joined:
        yield replace(ones[0], measures=measures, used=frozenset().union(*(one.used for one in ones)))


def _is_aside(text: Text, start: int) -> bool:
    """Does a measure only say where: 'the groove under the full diameter', 'between the body and the rear diameter'?

    Or what is left out: 'the plate thickness (not counting the radii)'.
    """
    if text.words[:start].count("(") > text.words[:start].count(")"):
        return True
    for at in range(start - 1, max(-1, start - 5), -1):
        if text.is_word(at, "and", "then"):
            return any(text.find(i, "between") for i in range(at - 5, at))
        if (lead := text.find(at, "place")) and lead.value not in ("of", "in", "with"):
            return True
        if text.tokens[at].kind is Kind.SYMBOL or text.find(at, "place", "ask"):
            break
    return False


def _value(question: Question, asked: Requested, owner: Owner) -> Parse:
    """The measures of one owner."""
    text, target = question.text, within(owner.target) if asked.inside else owner.target
    compound = target is not None and "link_compound" in owner.features
    several = any(text.tokens[i].plural for i in range(asked.start, asked.end))
    if target is not None and compound and several and len(asked.measures) == 1:
        target = replace_fields(target, plural=True)  # 'both bore diameters'
    reduce, used = _reduce(question, asked, target)
    extreme = text.find(min(owner.used, default=0) - 1, "most", "least") if compound else None
    if extreme is not None and reduce in (Reduce.ONE, Reduce.EACH):  # 'the minimum bore diameter'
        reduce = EXTREMES[extreme.category]
        used |= set(extreme.tokens)
    if target is not None and (reduce is Reduce.MEAN or (compound and reduce in _OF_SEVERAL)):
        target = replace_fields(target, plural=True)
    used |= asked.used | owner.used
    faces = (m for m in question.parts if (m.part.ends or m.part.sides) and used.isdisjoint(m.used))
    if target is not None and asked.measures == (Measure.OPENING,) and (face := next(faces, None)) is not None:
        target = replace_fields(target, sides=face.part.ends or face.part.sides)  # 'break through the left face'
        used |= face.used
    features = {**owner.features, f"asked_{asked.how}": 1.0}
    if asked.how == "noun" and asked.measures[0] in VECTORS:
        features["asked_vector"] = 1.0
    words = _OVERALL if is_length(asked.measures[0]) else _OVERALL - {"total"}  # 'total volume': a sum
    overall = {i for i in range(asked.start - 2, asked.start) if text.is_word(i, *words)}
    counted = text.at_words("incl", "included", "including") and not (text.has("not") or places_of(target, "below"))
    reduce = Reduce.EACH if counted and reduce is Reduce.TOTAL else reduce  # 'total length, head included'
    behind = asked.measures[0] in _ALONG and (counted or text.at_words("overall"))  # 'how long is it overall'
    if overall or behind or text.is_word(asked.start, *{"overall", "total"} & words):
        features["overall_whole" if target is None else "overall_part"] = 1.0
    whole = target is not None and not text.lexicon.wholes.isdisjoint(target.adjectives)
    over_all = bool(overall or counted or whole or text.at_phrases("over_all"))
    over_all = over_all and asked.measures in ((Measure.LENGTH,), (Measure.THICKNESS,))
    used |= text.covered("over_all") if over_all else set()
    density, said = density_of(text) if {Measure.MASS, Measure.INERTIA} & set(asked.measures) else (None, set())
    return Parse(Get(asked.measures, target, reduce, density, over_all), features, used | overall | said)


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


def _under_cut(get: Get) -> bool:
    """Is it asked how thick the lever is below the pocket? Then what is left there is meant, and not all of it."""
    kinds = [kind for _, cut in places_of(get.target, "below", "behind") for kind in kinds_of(cut)]
    cut_in = any(PartKind(kind).cuts_in for kind in kinds)
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


def density_of(text: Text) -> tuple[float | None, set[int]]:
    """The density that is stated, or that of the material that is named; and the words for it. Nothing has one of 0."""
    stated = {at: token.value for at, token in enumerate(text.tokens) if token.power == DENSITY and token.value > 0}
    densities = [*stated.values(), *(span.value for span in text.all("material"))]
    if not densities:
        return None, set()
    return densities[0], {*stated, *text.covered("density"), *text.covered("material")}


def _both_diameters(question: Question, get: Get, parse: Parse) -> Iterator[Parse]:
    """'Both diameters of the bush', 'the bore and outside diameter of the ring': inner and outer."""
    text = question.text
    both = text.at_words("both", "two") if get.measures == (Measure.DIAMETER,) else set()
    said = text.at_words("inside", "outside", "inner", "outer", "bore", "stepped", "step")
    if both and said and get.target is not None and (not get.target.plural or text.has("stepped", "step")):
        measures = (Measure.INNER_DIAMETER, Measure.OUTER_DIAMETER)
        yield Parse(replace(get, measures=measures), parse.features, parse.used | both | said)


def _with_axis(question: Question, get: Get, parse: Parse) -> Iterator[Parse]:
    """'How long is it in y direction?' is the extent along y."""
    text = question.text
    (axis, used), (axes, listed) = axis_named(question, parse.used), axes_listed(question)
    further = text.at_phrases("measure") - listed - parse.used  # 'size: long side, short side, height'
    found: list[tuple[tuple[Measure, ...], set[int]]] = []
    if axes and {*axes} <= _ALONG_AXES.keys() and get.measures[0] in SIZES and not further:
        found.append((tuple(_ALONG_AXES[one] for one in axes if isinstance(one, int)), listed))
    if axis is not None and axis < LONGEST and len(get.measures) == 1 and get.measures[0] in _ALONG:
        found.append(((EXTENTS[axis],), used))
    found += _taken_across(question, get)
    against = {i for span in text.all("measure") if span.value is Measure.AXIS for i in span.tokens}
    against |= {i for at in text.at_words("per") if text.is_word(at + 1, "side") for i in (at, at + 1)}
    if get.measures[0] in (Measure.ANGLE, Measure.INCLINATION) and against:
        found.append(((Measure.DRAFT,), against))  # 'the angle of the cone to the centreline', 'per side'
    for span in text.all("leaning") if get.measures[0] in (*_ANGLES, Measure.MAGNITUDE) else ():
        begin = span.start - 1 - text.is_word(span.start - 1, "the", "global", "world", "straight", "perfectly")
        if text.is_word(begin, "from", "to", "against", "off", "with", "above", "and", "between"):
            found.append(((Measure(span.value),), {*range(begin, span.end), *text.covered("axis")}))
    for measures, said in found:
        yield Parse(replace(get, measures=measures), {**parse.features, "along_axis": 1.0}, parse.used | said)
    yield parse


def _taken_across(question: Question, get: Get) -> Iterator[tuple[tuple[Measure, ...], set[int]]]:
    """'How wide across the corners', 'how long from centre to centre', 'how thick from face to face'."""
    text, over = question.text, question.text.at_words("across", "over", "between")
    for word, measure in (("flat", Measure.ACROSS_FLATS), ("corner", Measure.ACROSS_CORNERS)):
        if get.measures == (Measure.WIDTH,) and over and text.has(word):
            yield (measure,), over | text.at_words(word)
    last = {i for i in over if i + 1 == len(text) or text.tokens[i + 1].kind is Kind.SYMBOL}
    if get.measures == (Measure.MAGNITUDE,) and last:  # 'how big is it across?'
        yield (Measure.DIAMETER,), last
    for words, measure in (("over_all", Measure.LENGTH), ("facewise", Measure.WIDTH)):
        said = ((span, text.words[span.start : span.end]) for span in text.all(words))
        ends = [span for span, phrase in said if phrase[0] in ("lengthwise", "lengthways") or "to" in phrase]
        if get.measures in ((Measure.MAGNITUDE,), (Measure.SIZE,)) and ends:  # 'what does it measure end to end?'
            yield (measure,), {i for span in ends for i in span.tokens}
    if get.measures == (Measure.LENGTH,) and (centred := text.covered("center_to_center")):
        yield (Measure.CENTRE_LENGTH,), centred
    if len(get.measures) == 1 and get.measures[0] in _ALONG and (own := own_axis_named(question)):
        yield (Measure.AXIAL_EXTENT,), own


def _reduce(question: Question, asked: Requested, target: Target) -> tuple[Reduce, set[int]]:
    """What becomes of the values: one each, the shared one, the different ones, their sum, …?"""
    text = question.text
    each = set(filter(question.in_question, text.at_phrases("each")))
    single = text.at_words("each") & each  # 'the total length of each slot'
    plural = target is not None and not single and (target.plural or bool(text.at_phrases("sum")))
    if asked.reduce is not None:
        adds = asked.measures[0] in ADDITIVE | _STACKED or bool(text.at_phrases("sum"))
        if asked.reduce is not Reduce.TOTAL or (plural and adds):
            return asked.reduce, set()
    used: set[int] = set()
    for meaning in _SHARED:
        for at in sorted(filter(question.in_question, text.at_phrases(meaning.value))):
            span = text.find(at, meaning.value)
            within = any(text.is_word(i, "in", "within") for i in (at - 2, at - 1))
            no_range = meaning is Reduce.RANGE and (within or not plural)
            if span is None or no_range or (meaning is Reduce.MEAN and text.is_word(at - 1, "i", "we", "you")):
                continue
            adds = asked.measures[0] in ADDITIVE or text.find(at, "sum") is not None
            if meaning is not Reduce.TOTAL or (plural and adds):
                return meaning, set(span.tokens)
            used |= set(span.tokens)
    if target is not None and (each or (target.plural and not target.sample)):
        return Reduce.EACH, used | each
    return Reduce.ONE, used


def wholes(question: Question) -> Iterator[Parse]:
    """'Which share of the box around it does it take up?', 'Which direction is the model largest in, x, y or z?'"""
    text = question.text
    named = used_by(*(m for m in question.mentions if m.query is None))
    yield from _against_box(question, named)
    scales = [span for span in text.all("scale") if span.value.degree == "most" and span.value.measure in _LONG]
    longest = text.at_words("furthest").union(*(span.tokens for span in scales))
    axes = text.at_phrases("axis") | text.at_words("axis", "direction")
    asks = any(text.is_word(i, "which", "what", "name", "or") for i in range(*question.asking))
    used = longest | axes | named | text.at_phrases("measure", "ask", "axis_preposition", "passing")
    if longest and axes and asks and not question.parts:
        yield Parse(Get((Measure.LONG_AXIS,), None), {"along_axis": 1.0, "asked_noun": 1.0}, used)
    led = text.at_words(*_RUNNING, *_TURNING)
    either = text.has("or") and len({span.value for span in text.all("axis")}) > 1
    far = {i: 6 if text.is_word(i + 1, "of") else 2 + text.is_word(i + 1, "coordinate") for i in text.at_phrases("ask")}
    which = any("axis" in text.words[i + 1 : i + end] for i, end in far.items())  # 'which of the coordinate axes'
    which |= asks and text.has("axis") and (len(text.at_words("x", "y", "z")) > 1 or bool(text.at_phrases("parallel")))
    for mention in question.parts[:2] if led and (which or either) else ():
        bare = tuple(name for name in mention.part.adjectives if "parallel" not in name)  # 'does it run along x or y?'
        form = Get((Measure.LONG_AXIS,), replace_fields(mention.part, adjectives=bare))
        yield Parse(form, {"along_axis": 1.0, "asked_noun": 1.0}, used | led | mention.used | text.at_words("or"))


def _against_box(question: Question, named: set[int]) -> Iterator[Parse]:
    """'What volume goes into chips, from a block of that size?', 'corner to corner of its box'."""
    text = question.text
    boxes = text.covered("boxes")
    shares = {i for span in text.all("operation") if span.value == "share" for i in span.tokens}
    for measure, said in (
        (Measure.FILL, shares | text.covered("filling")),
        (Measure.REMOVED, text.covered("cutting")),
        (Measure.DIAGONAL, {i for span in text.all("measure") if span.value in _CORNERS for i in span.tokens}),
    ):
        if boxes and said and not question.closed:
            around = boxes | named | text.covered("stuff") | text.at_words(*_SAYS_BOX)
            around |= text.at_words("opposite", "long") if measure is Measure.DIAGONAL else set()
            yield Parse(Get((measure,), None), {"asked_noun": 1.0}, said | around)
