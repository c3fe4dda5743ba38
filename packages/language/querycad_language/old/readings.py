"""Which measure is meant where the words leave it open? The class of the noun decides, and the reading is noted."""

from __future__ import annotations

from .meaning import ENDS, AnyOf, Bound, ByMeasure, ByPlace, Filter, Get, Measure, NounClass, Order, Rank, Target, Whole
from .text import Text

_LENGTHS_OF_ROUND = {
    (Measure.LENGTH, NounClass.HOLE): (Measure.DEPTH, "The length of a hole is taken as its depth along its axis."),
    (Measure.LENGTH, NounClass.AXIAL): (
        Measure.AXIAL_LENGTH,
        "The length of what sticks out is taken along its own axis.",
    ),
}
_STEPS = "A stepped hole is as large as its widest step and as small as its narrowest."
_SIZES: dict[NounClass, tuple[Measure, str]] = {
    NounClass.HOLE: (Measure.DIAMETER, "The size of a hole is taken as its diameter."),
    NounClass.FACE: (Measure.AREA, "The size of a face is taken as its area."),
}
_SIZE = (Measure.SIZE, "The size is given as the full extents along x, y and z.")
_SIZES_OF_NOUN: dict[str, tuple[Measure, str]] = {
    **dict.fromkeys(
        ("fillet", "rounding", "round", "blend"), (Measure.RADIUS, "The size of a rounding is taken as its radius.")
    ),
    **dict.fromkeys(
        ("chamfer", "bevel"), (Measure.LEAST_EXTENT, "The size of a chamfer is how much it takes off the edge.")
    ),
}
"""How big something is, by the class of its noun, and by the noun itself."""
_OF_NOUN = {
    **{
        (Measure.THICKNESS, noun): (Measure.WALL_THICKNESS, "The thickness of a tube is that of its wall.")
        for noun in ("tube", "pipe", "sleeve", "bushing", "bush", "nozzle")
    },
    **{
        (Measure.THICKNESS, noun): (Measure.DIAMETER, "The thickness of a round bar is its diameter.")
        for noun in ("shaft", "rod", "pin", "axle", "spindle", "dowel", "peg", "stud", "cylinder", "column", "pillar")
    },
    (Measure.THICKNESS, "nut"): (Measure.LEAST_EXTENT, "The thickness of a nut is how long it is along its axis."),
    (Measure.DIAMETER, "countersink"): (Measure.OUTER_DIAMETER, "The diameter of a countersink is its widest."),
    (Measure.RADIUS, "countersink"): (Measure.OUTER_RADIUS, "The radius of a countersink is its widest."),
}
"""What a measure means of one noun and of no other."""
_OF_EXTREME = {
    (Measure.OUTER_RADIUS, Measure.RADIUS): Measure.OUTER_RADIUS,
    (Measure.OUTER_RADIUS, Measure.DIAMETER): Measure.OUTER_DIAMETER,
    (Measure.INNER_RADIUS, Measure.RADIUS): Measure.INNER_RADIUS,
    (Measure.INNER_RADIUS, Measure.DIAMETER): Measure.INNER_DIAMETER,
}
"""The radius of the largest hole is the one that makes it the largest."""
_NOTES = {
    Measure.DEPTH: "Depth is taken along the part's own axis, from its opening to its bottom.",
    Measure.WIDTH: "The width of a hole is that of its widest step.",
    Measure.EDGE_DISTANCE: "The distance to the edge is taken from the part's surface to the outer edge of its face.",
    **dict.fromkeys(ENDS, "An end of a part is the middle of its box on that side."),
    Measure.POSITION: "The position of a part is its centre; of a hole, half-way between its ends on its axis.",
}


def asked(measure: Measure, target: Target, text: Text) -> Measure:
    """Which measure is asked for when `measure` is said of `target`?"""
    if isinstance(target, Whole):
        return _of_whole(measure, text)
    noun = target.noun_class
    if measure is Measure.MAGNITUDE:
        measure, note = _SIZES_OF_NOUN.get(target.phrases[0].noun) or _SIZES.get(noun, _SIZE)
        text.note(note)
        return measure
    if named := _OF_NOUN.get((measure, target.phrases[0].noun)):
        text.note(named[1])
        return named[0]
    if measure is Measure.DIRECTION:
        if noun.is_round:
            text.note("The direction of a round part is taken as that of its axis.")
            return Measure.AXIS
        return Measure.NORMAL
    if measure is Measure.WALL_THICKNESS and not noun.is_round:
        return Measure.THICKNESS
    measure = _length(measure, noun, text)
    ranks = target.phrases[0].ranks
    if ranks and isinstance(ranks[-1].order, ByMeasure):
        measure = _OF_EXTREME.get((ranks[-1].order.measure, measure), measure)
    of_holes = measure in (Measure.DEPTH, Measure.WIDTH)
    if measure in _NOTES and (noun is NounClass.HOLE or not of_holes):
        text.note(_NOTES[measure])
    return measure


def _of_whole(measure: Measure, text: Text) -> Measure:
    if measure is Measure.MAGNITUDE:
        return Measure.SIZE
    if measure is Measure.WALL_THICKNESS:
        return Measure.THICKNESS
    if measure is Measure.LENGTH:
        text.note("The length of the whole model is taken as its longest extent.")
    if measure in (Measure.DIAMETER, Measure.OUTER_DIAMETER, Measure.RADIUS, Measure.OUTER_RADIUS):
        text.note("The diameter of the whole model is taken as the extent that two of its directions share.")
    return measure


def _length(measure: Measure, noun: NounClass, text: Text) -> Measure:
    measure, note = _LENGTHS_OF_ROUND.get((measure, noun), (measure, ""))
    if note:
        text.note(note)
    return measure


def bounded(condition: Filter, noun: NounClass, text: Text) -> Filter:
    """Which measure does a filter look at?"""
    if isinstance(condition, AnyOf):
        return AnyOf(tuple(_bounded(one, noun, text) for one in condition.bounds))
    return _bounded(condition, noun, text) if isinstance(condition, Bound) else condition


def _bounded(condition: Bound, noun: NounClass, text: Text) -> Bound:
    measure = _length(condition.measure, noun, text)
    if measure is Measure.MAGNITUDE:
        if noun.is_round:
            measure = Measure.DIAMETER
        else:
            text.note("The size of a part that is not round is taken as its longest extent.")
    low = condition.low
    if isinstance(low, Get) and low.measures == (Measure.MAGNITUDE,):
        low = Get((measure,), low.target, low.reduce)
    return Bound(measure, condition.relation, low, condition.high)


def ranked(rank: Rank, noun: NounClass, text: Text) -> Rank:
    """Which measure do superlatives order by?"""
    if not isinstance(rank.order, ByMeasure):
        return rank
    measure = _length(rank.order.measure, noun, text)
    order: Order = ByMeasure(measure)
    across = measure is Measure.MAGNITUDE or (measure is Measure.WIDTH and noun is NounClass.HOLE)
    across = across or (measure is Measure.THICKNESS and noun is NounClass.AXIAL)
    if measure in (Measure.RADIUS, Measure.DIAMETER) or (across and noun.is_round):
        text.note(_STEPS)
        outer = rank.largest or noun is not NounClass.HOLE  # a flange with a narrow bore is not the smallest
        order = ByMeasure(Measure.OUTER_RADIUS if outer else Measure.INNER_RADIUS)
    elif measure is Measure.MAGNITUDE:
        largest = Measure.VOLUME if noun is NounClass.BODY else Measure.AREA
        text.note(f"Large and small are compared by {largest.value}.")
        order = ByMeasure(largest)
    elif measure is Measure.HEIGHT and (noun is NounClass.HOLE or (noun is NounClass.BODY and not rank.largest)):
        text.note("High and low are taken as the position in z.")
        order = ByPlace(2)
    return Rank(order, rank.largest, rank.nth, rank.count)
