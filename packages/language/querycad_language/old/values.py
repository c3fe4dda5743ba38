"""Value expressions: 'the radius of the holes', 'hole depth', 'the shaft's diameter', 'the difference between …'."""

from __future__ import annotations

from dataclasses import replace

from . import modifiers
from .asking import BORE_WORDS, BORES, EXTENTS, SCALARS, Asked, asked_measures, is_part
from .distances import angle, distance
from .draft import MODEL_NOUN
from .lexicon import LEXICON
from .meaning import (
    ENDS,
    Calculate,
    Count,
    Get,
    Measure,
    NounClass,
    Operation,
    Phrase,
    Query,
    Reduce,
    Scalar,
    Selection,
    Target,
    Whole,
)
from .phrases import selection, target
from .readings import asked
from .relations import without_axis
from .text import Text

_ALONG = (Measure.X_EXTENT, Measure.Y_EXTENT, Measure.Z_EXTENT)
_MEASURED_THERE = {
    *EXTENTS, Measure.THICKNESS, Measure.AXIAL_LENGTH, Measure.DIAMETER, Measure.RADIUS, Measure.OUTER_DIAMETER,
    Measure.INNER_DIAMETER,
}  # fmt: skip
_TAKEN_OFF = {Measure.HEIGHT, Measure.LENGTH, Measure.AXIAL_LENGTH}
"""Extents that become less when what sticks out is taken away."""
_OF_BOX = {Measure.MAGNITUDE: Measure.SIZE, Measure.VOLUME: Measure.BOX_VOLUME}
_FASTENERS = {"screw", "bolt"}
_TUBES = {"tube", "pipe", "sleeve", "bushing", "bush", "nozzle", "collar", "ring", "cylinder", "standoff"}


def value(text: Text, start: int, end: int, like: Query | None = None) -> Query | None:
    """What does the value expression `start:end` mean? `like` completes 'the inner one', 'that of the shaft'."""
    start = text.skip(start, end)
    for rule in _RULES:
        if found := text.attempt(rule, start, end):
            return found
    return _completed(text, start, end, like) if like is not None else None


def scalar(text: Text, start: int, end: int, like: Query | None = None) -> Scalar | None:
    """Which single number does `start:end` mean?"""
    found = value(text, start, end, like)
    if isinstance(found, Get) and (len(found.measures) > 1 or found.measures[0] not in SCALARS):
        return None
    return found if isinstance(found, Scalar) else None


def get(text: Text, wanted: Asked, of: Target) -> Get | None:
    """The values of the wanted measures of parts or of the whole; None when the whole cannot have them."""
    of, thick = _of_wall(of, wanted.measures)
    measures = tuple(asked(Measure.WALL_THICKNESS if thick else measure, of, text) for measure in wanted.measures)
    if isinstance(of, Whole) and measures == (Measure.NAME,) and wanted.plural:
        return Get(measures, Selection((Phrase(MODEL_NOUN, NounClass.BODY, plural=True),)), Reduce.DIFFERENT)
    if isinstance(of, Whole) and len(measures) == 3 and set(measures) <= EXTENTS:
        text.note("Length, width and height of the whole model are given as its extents along x, y and z.")
        measures = (Measure.SIZE,)
    reduce = wanted.reduce
    if measures == (Measure.NAME,) and reduce is Reduce.EACH and isinstance(of, Selection):
        different = [replace(p, description=p.description.removeprefix("different ")) for p in of.phrases]
        if different != list(of.phrases):
            of, reduce = Selection(tuple(different)), Reduce.DIFFERENT  # 'the names of the different bodies'
    if isinstance(of, Selection) and of.phrases[0].sample and reduce is Reduce.EACH and measures[0] in SCALARS:
        reduce = Reduce.ONE
    if isinstance(of, Selection) and measures == (Measure.RADIUS,) and reduce is Reduce.EACH and not wanted.plural:
        if of.plural and LEXICON.match("dimensioned_once", (of.phrases[0].noun,), 0, 1):
            text.note("The radius of corners is one value where they share it.")
            reduce = Reduce.ONE
    if isinstance(of, Selection) and wanted.plural and reduce is Reduce.EACH and not of.single:
        of = Selection(tuple(replace(phrase, plural=True) for phrase in of.phrases))
    if measures == (Measure.SIZE,) and reduce in (Reduce.LARGEST, Reduce.SMALLEST):
        measures = (Measure.MAGNITUDE if reduce is Reduce.LARGEST else Measure.LEAST_EXTENT,)
        reduce = Reduce.EACH
    if isinstance(of, Whole) or (reduce is Reduce.TOTAL and not of.plural):
        reduce = Reduce.EACH  # 'the total length of the shaft' is its length
    return Get(measures, of, reduce, wanted.nth)


def _of_wall(of: Target, measures: tuple[Measure, ...]) -> tuple[Target, bool]:
    """'(the thickness of) the tube's wall': the wall thickness of the tube."""
    if not isinstance(of, Selection) or len(of.phrases) > 1 or measures != (Measure.THICKNESS,):
        return of, False
    words = of.phrases[0].description.split()
    if len(words) < 2 or words[-1] != "wall" or not set(words[:-1]) & _TUBES:
        return of, False
    phrase = replace(of.phrases[0], description=" ".join(words[:-1]), noun_class=NounClass.AXIAL)
    return Selection((phrase,)), True


def _inner_of(text: Text, start: int, end: int) -> Query | None:
    """'(the) inner height of the box', 'inside dimensions of the housing': of the space inside."""
    found = text.after("inner", start, end)
    named = asked_measures(text, found, end) if found is not None else None
    if named is None or not set(named[0].measures) <= {*EXTENTS, Measure.SIZE, Measure.MAGNITUDE, Measure.VOLUME}:
        return None
    wanted, at = named
    of = target(text, at + 1, end) if text.word_at(at, end, "of") else None
    if not isinstance(of, Selection) or len(of.phrases) > 1:
        return None
    phrase = of.phrases[0]
    if LEXICON.match("cut_noun", (phrase.noun,), 0, 1) or phrase.noun_class is NounClass.HOLE:
        return None
    inside = replace(phrase, description=f"inside in {phrase.description}", noun_class=NounClass.OTHER)
    return get(text, wanted, Selection((inside,)))


def telegraphic(text: Text, start: int, end: int) -> Query | None:
    """'diameter top hole': a measure, and the part without a word between."""
    named = asked_measures(text, start, end)
    of = target(text, named[1], end) if named is not None and named[1] < end else None
    return get(text, named[0], of) if named is not None and isinstance(of, Selection) else None


def _measures_of(text: Text, start: int, end: int) -> Query | None:
    """'radius of the holes', 'overall height', 'depth for each slot'."""
    named = asked_measures(text, start, end)
    if named is None:
        return None
    wanted, at = named
    at = text.skip_commas(at, end)
    rest = at
    while text.word_at(rest, end, "of", "for", "from", "has", "have", "with", "that", "which", "measured"):
        rest += 1
    if text.skip(rest, end, "noise", "light", "verb", "article") >= end and rest == at:
        return get(text, wanted, Whole())
    if rest == at and not (
        text.match("whole_of", at, end)
        or text.match("do", at, end)
        or text.match("be", at, end)
        or text.match("article", at, end)
        or text.match("verb", at, end)
    ):
        return None
    if (along := extent_along(text, wanted.measures, rest, end)) is not None:
        return along
    if rest == at and text.match("side_preposition", at, end) and not text.after("article", at + 1, end):
        return None
    before = wanted
    wanted, rest = _nested(text, wanted, rest, end)
    owned = wanted.measures == (Measure.POSITION,) and text.word_at(end - 2, end, "'s")
    last = text.match("property", end - 1, end)
    centers = last is not None and last[0] == wanted.measures[0] == Measure.POSITION and end - 1 > rest
    owned = owned or (centers and modifiers.starts_noun(text, end - 2, end - 1))  # 'of the hole centres'
    if (wanted != before or owned) and text.match("property", end - 1, end):
        wanted = replace(wanted, plural=wanted.plural or LEXICON.is_plural(text.words[end - 1]))
        end -= 1
    of = target(text, rest, end) or measured_part(text, wanted.measures, rest, end)
    if of is None:
        return None
    if "bounding" in text.words[start:end] and wanted.measures[0] in _OF_BOX:
        wanted = replace(wanted, measures=(_OF_BOX[wanted.measures[0]],))
    return get(text, wanted, of)


def measured_part(text: Text, measures: tuple[Measure, ...], start: int, end: int) -> Selection | None:
    """'the tube between the flanges': SegCAD looks where it lies; 'the posts above the floor': that is left out."""
    if not set(measures) <= _MEASURED_THERE:
        return None
    for at in range(start + 1, end - 1):
        ground = text.word_at(at, end, "above", "over") and text.after("ground", text.skip(at + 1, end), end) == end
        if not ground and not text.word_at(at, end, "between"):
            continue
        of = target(text, start, at)
        if not isinstance(of, Selection) or of.noun_class is NounClass.HOLE:
            return None
        other = None if ground else target(text, at + 1, end)
        if not isinstance(other, Selection) or len(of.phrases) > 1:
            text.leave_out(at, end)
            return of
        place = " and ".join(phrase.description for phrase in other.phrases)
        phrase = of.phrases[0]
        return Selection((replace(phrase, description=f"{phrase.description} between {place}"),))
    return None


def extent_along(text: Text, measures: tuple[Measure, ...], start: int, end: int) -> Get | None:
    """'(the length of) the part in y direction', '(the extent of) the rib in z': full extents along an axis."""
    if len(measures) > 1 or measures[0] not in EXTENTS | {Measure.SIZE, Measure.MAGNITUDE, Measure.THICKNESS}:
        return None
    if across := text.find("across_axis", start, end):
        of = target(
            text.rearranged([*range(start, across[0]), *range(across[2], end)]), 0, end - start - across[2] + across[0]
        )
        return Get((_ALONG[int(across[1])],), of) if of is not None else None
    rest, axis = without_axis(text.rearranged(range(start, end)))
    of = target(rest, 0, len(rest.tokens)) if axis is not None else None
    of = Whole() if axis is not None and not rest.tokens else of  # 'the overall size in the width direction'
    if of is None or axis is None:
        return None
    return Get((_ALONG[axis],), of)


def _nested(text: Text, wanted: Asked, start: int, end: int) -> tuple[Asked, int]:
    """'the coordinates of the tip of …' asks for the tip; 'the x coordinate of the centre of …' for the coordinate."""
    at = text.skip(start, end)
    named = text.match("property", at, end)
    if named is None or not text.word_at(named[1], end, "of"):
        if named and is_part(text, at, named[1], end):
            return wanted, start
        last = text.match("property", end - 1, end)
        if (
            wanted.measures == (Measure.POSITION,)
            and last
            and last[0] in ("tip", "opening", "position")
            and end - 1 > at
            and not text.match("shape_adjective", end - 2, end)
            and not text.match("each", end - 2, end)
            and not text.match("extreme", end - 2, end)
        ):
            return replace(wanted, measures=(Measure(last[0]),)), start
        return wanted, start
    if wanted.measures[0] in _MEASURED_THERE and Measure(named[0]) in ENDS:
        return wanted, start  # 'the diameter of the left end of the shaft'
    if wanted.measures[0] in (Measure.POSITION, Measure.DIRECTION):
        wanted = replace(wanted, measures=(Measure(named[0]),))
    return wanted, named[1] + 1


def _owned(text: Text, start: int, end: int) -> Query | None:
    """'the shaft's diameter', 'the object's height'."""
    if "'s" not in text.words[start:end]:
        return None
    marks = [i for i in range(start, end) if text.words[i] == "'s"]
    mark = next((i for i in reversed(marks) if asked_measures(text, i + 1, end)), marks[0])
    named = asked_measures(text, mark + 1, end)
    if named is None:
        return None
    wanted, after = named
    shorter = text.rearranged([*range(start, mark), *range(after, end)])
    of = target(shorter, 0, len(shorter.tokens))
    return get(text, wanted, of) if of is not None else None


def _compound(text: Text, start: int, end: int) -> Query | None:
    """'hole depth', 'largest slot width', 'shaft diameter on the right', 'different hole diameters'."""
    wanted = Asked(())
    at = start
    while True:
        at = text.skip(at, end, "article", "noise")
        if found := text.match("reduce", at, end):
            wanted, at = replace(wanted, reduce=Reduce(found[0])), found[1]
        elif (all_of := text.after("quantifier", at, end)) and text.match("reduce", all_of, end):
            at = all_of  # 'all unique hole radii'
        elif (ordinal := text.match("ordinal", at, end)) and text.match("extreme", ordinal[1], end):
            wanted, at = replace(wanted, nth=int(ordinal[0])), ordinal[1]
        elif found := text.match("extreme", at, end):
            wanted, at = replace(wanted, reduce=Reduce(found[0])), found[1]
        else:
            break
    for middle in range(at + 1, end):
        if any(text.match(c, middle - 1, end) for c in ("preposition", "be", "do", "have", "relative")):
            if not text.match("adjective_preposition", middle - 1, end):
                return None
        named = asked_measures(text, middle, end)
        if named is None or not text.match("property", middle, end):
            continue
        found_measures, after = named
        after = after + 1 if text.word_at(after, end, "of") and of_is_place(text, after, end) else after
        shorter = text.rearranged([*range(at, middle), *range(after, end)])
        of = target(shorter, 0, len(shorter.tokens))
        if of is None:
            return None
        return get(text, replace(found_measures, reduce=wanted.reduce, nth=wanted.nth), of)
    return None


def of_is_place(text: Text, start: int, end: int) -> bool:
    """Does 'of' lead to nothing but the whole model or a side?"""
    return isinstance(target(text, start + 1, end), Whole)


def _count(text: Text, start: int, end: int) -> Query | None:
    """'number of holes', 'number of different radii', 'hole count'."""
    after = text.after("count", start, end)
    noun = next((i for i in range(start + 1, end) if text.word_at(i, end, "count", "number", "quantity")), None)
    joined = noun is not None and any(text.word_at(i, noun, "and", "or", "&") for i in range(start, noun))
    led = noun is not None and any(text.match("preposition", i, end) for i in range(start, noun))
    if after is None and noun is not None and not (led or joined):
        rest = text.rearranged([*range(start, noun), *range(noun + 1, end)])
        return counted(rest, 0, len(rest.tokens))
    if after is None or text.words[start] == "how":
        return None
    return counted(text, after, end)


def counted(text: Text, start: int, end: int) -> Query | None:
    """How many of what: parts, or different values of a measure?"""
    start = text.skip(start, end)
    found = text.match("reduce", start, end)
    if found and found[0] == Reduce.DIFFERENT:
        query = value(text, found[1], end)
        if query is None and (named := asked_measures(text, found[1], end)):
            of = target(text, text.skip(named[1], end, "do"), end)
            query = get(text, named[0], of) if of else None
        if isinstance(query, Get) and isinstance(query.target, Selection):
            return Count(query.target, query.measures[0])
        start = found[1]
    if query := _named_values(text, start, end):
        return query
    if (of_sizes := text.match("property", start, end)) and of_sizes[0] in (Measure.MAGNITUDE, Measure.KIND):
        query = value(text, start, end)
        if isinstance(query, Get) and isinstance(query.target, Selection):
            return Count(query.target, query.measures[0])
    parts = selection(text, start, end)
    beside = parts is not None and any(" between " in phrase.description for phrase in parts.phrases)
    return Count(parts) if parts and not beside else None


def _named_values(text: Text, start: int, end: int) -> Query | None:
    """'(how many) hole diameters are there': different values."""
    query = text.attempt(_compound, start, end)
    if not isinstance(query, Get) or not isinstance(query.target, Selection) or not query.target.plural:
        return None
    if query.measures[0] not in SCALARS:
        return None  # 'holes top side count'
    return Count(query.target, query.measures[0])


def _with_or_without(text: Text, start: int, end: int) -> Query | None:
    """'the height of the object without the height of the shaft', '… minus …', '… plus …'."""
    for operation, category in ((Operation.MINUS, "minus"), (Operation.PLUS, "plus")):
        for at in range(start + 1, end):
            after = text.after(category, at, end)
            if after is None:
                continue
            left = text.attempt(scalar, start, at)
            right = text.attempt(operand, after, end, left)
            named = text.find("property", after, end)
            measured = named is not None and named[1] in SCALARS
            explicit = text.words[at] in ("minus", "plus") or (right is not None and measured)
            whole = isinstance(left, Get) and isinstance(left.target, Whole)
            if isinstance(left, Get | Count) and right is not None and (explicit or whole):
                return Calculate(operation, left, right)
            if operation is Operation.MINUS and (rest := taken_off(text, after, end, left, right)) is not None:
                return rest
    return None


def taken_off(
    text: Text, start: int, end: int, left: Scalar | float | None, right: Scalar | float | None
) -> Calculate | None:
    """'(the height of the motor without) the shaft': one that is there, taken away from what it is a part of."""
    if not isinstance(left, Get) or not isinstance(right, Get) or left.measures[0] not in _TAKEN_OFF:
        return None
    if not text.word_at(start, end, "the", "its", "their", "head") or not isinstance(right.target, Selection):
        return None
    if right.target.plural and not (isinstance(left.target, Selection) and left.target.plural):
        return None
    if right.measures == (Measure.LENGTH,) and right.target.noun_class is not NounClass.HOLE:
        right = replace(right, measures=(Measure.AXIAL_LENGTH,))
    assert isinstance(right.target, Selection)
    whose, what = left.target, right.target.phrases[0]
    if isinstance(whose, Selection) and whose.phrases[0].noun in _FASTENERS and what.description == what.noun == "head":
        named = replace(what, description=f"{whose.phrases[0].noun} head")  # and not the cylinder head below it
        right = replace(right, target=Selection((named, *right.target.phrases[1:])))
    return Calculate(Operation.WITHOUT, left, right)


def operand(text: Text, start: int, end: int, like: Query | float | None) -> Scalar | None:
    """A scalar, or a noun phrase of which the measure of `like` is meant: 'the shaft', 'that of the shaft'."""
    at = start
    while text.word_at(at, end, "that", "those", "of", "for", "the", "its", "their", "a"):
        at += 1
    same_part = isinstance(like, Get) and isinstance(like.target, Selection) and _bare(text, at, end)
    if same_part and isinstance(like, Get):
        found = text.attempt(_completed, at, end, like)
        if isinstance(found, Scalar):
            return found
    if number := text.attempt(scalar, at, end, None if isinstance(like, float) else like):
        return number
    if not isinstance(like, Get):
        return None
    of = target(text, at, end, like.target)
    return Get(like.measures, of, like.reduce) if of is not None else None


def _completed(text: Text, start: int, end: int, like: Query) -> Query | None:
    """'(its) inner diameter', 'the inner one', 'the smallest': the rest is taken from `like`."""
    if not isinstance(like, Get):
        return None
    start = text.skip(start, end, "article")
    if named := asked_measures(text, start, end):
        if text.skip(named[1], end, "noise", "light") >= end:
            return get(text, named[0], like.target)
    kind = BORE_WORDS.get(text.words[start]) if start < end else None
    rest = text.skip(start + 1, end, "light")
    if kind and rest >= end and (kind, like.measures[0]) in BORES:
        return replace(like, measures=(BORES[kind, like.measures[0]],))
    extreme = text.match("extreme", start, end)
    if extreme and text.skip(extreme[1], end, "light") >= end:
        return replace(like, reduce=Reduce(extreme[0]))
    return None


def _pair(text: Text, start: int, end: int, joints: tuple[str, ...]) -> tuple[Scalar, Scalar] | None:
    """Two scalars joined by one of `joints`; either may leave out what the other one says."""
    for at in range(start + 1, end):
        if not text.word_at(at, end, *joints):
            continue
        left = text.attempt(scalar, start, at)
        right = text.attempt(operand, at + 1, end, left)
        if left is None or (isinstance(left, Get) and _bare(text, start, at)):
            left = text.attempt(_left_like, start, at, right) or left
        if left is not None and right is not None:
            return left, right
    return None


def _bare(text: Text, start: int, end: int) -> bool:
    """Is a value expression only a measure's name, without a part?"""
    named = asked_measures(text, start, end)
    return named is not None and named[1] >= end


def _left_like(text: Text, start: int, end: int, right: Scalar | None) -> Scalar | None:
    found = _completed(text, start, end, right) if isinstance(right, Get) else None
    return found if isinstance(found, Get) else None


def _difference(text: Text, start: int, end: int) -> Query | None:
    """'difference between the largest and the smallest radius of …', 'difference in height between A and B'."""
    at = start
    measure = text.match("property", at, end)
    at = measure[1] if measure and text.word_at(measure[1], end, "difference") else at
    if not text.word_at(at, end, "difference", "differences"):
        return None
    rest = at + 1
    if (
        text.word_at(rest, end, "in", "of")
        and (named := text.match("property", rest + 1, end))
        and text.word_at(named[1], end, "between", "of")
    ):
        measure, rest = named, named[1]
    elif not (measure and text.word_at(measure[1], end, "difference")):
        measure = None
    if not text.word_at(rest, end, "between", "of", "from"):
        return None
    pair = _between(text, rest + 1, end, Measure(measure[0])) if measure else _pair(text, rest + 1, end, ("and", "to"))
    if pair:
        return Calculate(Operation.APART, *pair)
    several = get(text, Asked((Measure(measure[0]),)), of) if measure and (of := target(text, rest + 1, end)) else None
    found = several or text.attempt(scalar, rest + 1, end)
    if not isinstance(found, Get) or not isinstance(found.target, Selection) or not found.target.plural:
        return None  # else 'the difference between the two diameters': the largest less the smallest
    most, least = (replace(found, reduce=reduce) for reduce in (Reduce.LARGEST, Reduce.SMALLEST))
    return Calculate(Operation.MINUS, most, least)


def _between(text: Text, start: int, end: int, measure: Measure) -> tuple[Scalar, Scalar] | None:
    """The same measure of two noun phrases joined by 'and'."""
    for at in range(start + 1, end):
        if text.word_at(at, end, "and", "to"):
            first = text.attempt(target, start, at)
            second = text.attempt(target, at + 1, end, first)
            if first is not None and second is not None:
                return Get((asked(measure, first, text),), first), Get((asked(measure, second, text),), second)
    return None


def _ratio(text: Text, start: int, end: int) -> Query | None:
    """'ratio of the flange's diameter to the shaft's', 'ratio between length and width of the slot'."""
    if not text.word_at(start, end, "ratio", "quotient", "proportion"):
        return None
    rest = start + 1
    if not text.word_at(rest, end, "of", "between"):
        return None
    pair = _pair(text, rest + 1, end, ("to", "and", "over"))
    return Calculate(Operation.RATIO, *pair) if pair else None


def _sum(text: Text, start: int, end: int) -> Query | None:
    """'sum of the height of A and the height of B'; a sum over parts is a reduction of one measure."""
    if not text.word_at(start, end, "sum", "total") or not text.word_at(start + 1, end, "of"):
        return None
    pair = _pair(text, start + 2, end, ("and", "plus"))
    if pair is None or any(isinstance(side, Get) and _bare(text, start + 2, end) for side in pair):
        return None
    return Calculate(Operation.PLUS, *pair)


_RULES = (
    _count, _with_or_without, _difference, _ratio, _sum, _inner_of, distance, angle, _measures_of, _owned, _compound,
)  # fmt: skip
