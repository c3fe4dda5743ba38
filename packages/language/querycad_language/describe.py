"""One plain sentence for what was understood: made from the meaning, not from the words of the question."""

from __future__ import annotations

import math
from collections.abc import Sequence

from querycad_contracts import AnswerType, Measure, PartQuery, Place, Rank, Relation, SizeFilter

from . import forms
from .forms import Distance, Form, Get, Reduce
from .lexicon import lexicon
from .measures import answer_type

_MEASURES = {
    Measure.MAGNITUDE: "size", Measure.X_EXTENT: "extent along x", Measure.Y_EXTENT: "extent along y",
    Measure.Z_EXTENT: "extent along z", Measure.POSITION: "centre", Measure.SIZE: "extents",
    Measure.CENTRE_LENGTH: "length from centre to centre", Measure.ACROSS_FLATS: "width across flats",
    Measure.ACROSS_CORNERS: "width across corners",
    Measure.FILL: "filled percentage of the bounding box", Measure.REMOVED: "volume cut away of the bounding box",
    Measure.STANDING_AREA: "area to stand on", Measure.LONG_AXIS: "axis of the largest extent",
    Measure.INERTIA: "moments of inertia, in kg m2 about x, y, z through the centre of mass,",
}  # fmt: skip
_RELATIONS = {
    Relation.UNEQUAL: "other than ", Relation.ABOUT: "about ", Relation.LESS: "less than ",
    Relation.AT_MOST: "at most ", Relation.MORE: "more than ", Relation.AT_LEAST: "at least ",
}  # fmt: skip
_REDUCES = {
    Reduce.DIFFERENT: "different values of the ", Reduce.TOTAL: "total ", Reduce.MEAN: "average ",
    Reduce.LARGEST: "largest ", Reduce.SMALLEST: "smallest ", Reduce.EACH: "", Reduce.ONE: "",
    Reduce.RANGE: "smallest and largest ",
}  # fmt: skip
_COMPARATIVES = {
    Measure.DEPTH: ("deeper", "shallower"), Measure.HEIGHT: ("higher", "lower"), Measure.WIDTH: ("wider", "narrower"),
    Measure.LENGTH: ("longer", "shorter"), Measure.THICKNESS: ("thicker", "thinner"),
    Measure.MAGNITUDE: ("larger", "smaller"),
}  # fmt: skip
_OPERATIONS = {
    "minus": "less", "ratio": "over", "share": "in percent of", "plus": "plus", "apart": "compared with",
    "per": "for each of the",
}  # fmt: skip
_UNITS = {AnswerType.AREA: (1e6, " mm²"), AnswerType.VOLUME: (1e9, " mm³"), AnswerType.ANGLE: (180 / math.pi, "°")}
_MODES = {"centers": "between centres ", "surfaces": "between surfaces ", "outsides": "over the outsides "}
_AXES = {None: "", 0: " along x", 1: " along y", 2: " along z"}
_TOWARDS = {
    "way": "side from which {0} {1} reached", "most": "side that most of {0} are seen from",
    "none": "sides without {0}", "each": "number of {0} seen from each side", "": "side of {0}: {2}",
}  # fmt: skip


def describe(form: Form) -> str:  # noqa: C901, PLR0911, PLR0912 - one case a form
    """What is asked, in plain words: 'diameter of the 8 counterbored holes visible from the top'."""
    match form:
        case Get(measures, target, reduce, density, overall):
            material = f" at {density:g} kg/m3" if density else ""
            names = " and ".join(map(_measure, measures))
            return f"{_REDUCES[reduce]}{'overall ' if overall else ''}{names} of {noun_phrase(target)}{material}"
        case forms.Count(_, Measure.FACE_COUNT | Measure.EDGE_COUNT as measure):
            return f"number of {measure.removesuffix('_count')}s of the whole model"
        case forms.Count(target, measure):
            values = f"different {_measure(measure)} values of " if measure else ""
            return f"number of {values}{noun_phrase(target)}"
        case Distance(first, second, "overlap"):
            return f"overlap of {_anchor(first)}" + (f" and {_anchor(second)}" if second != "each other" else "")
        case Distance(first, second, mode, axis, reduce):
            both = f"from {_anchor(first)} to {_anchor(second)}"
            if second == "each other":
                both = f"of {_anchor(first)} from each other"
            along = _AXES.get(axis, " along a side of the model")
            return f"{_REDUCES[reduce]}distance {_MODES.get(mode, '')}{both}{along}"
        case forms.Several(several):
            return " and ".join(map(describe, several))
        case forms.Angle(first, second):
            return f"angle between {noun_phrase(first)}" + (f" and {noun_phrase(second)}" if second else "")
        case forms.Combine(operation, left, right):
            return f"{describe(left)}, {_OPERATIONS[operation]} {describe(right)}"
        case forms.Check(left, relation, low, high):
            counted = isinstance(left, forms.Count) and isinstance(low, float)
            measure = left.measures[0] if isinstance(left, Get) else None
            value = describe(low) if not isinstance(low, float) else f"{low:g}" if counted else _stated(low, measure)
            value = f"{value} to {_stated(high, measure)}" if high is not None else value
            same = "as much as the " if relation is Relation.EQUAL and not isinstance(low, float) else ""
            return f"whether the {describe(left)} is {_RELATIONS.get(relation, '') or same}{value}"
        case forms.Which(left, relation, _, words):
            noun = _measure(left.measures[0]) if isinstance(left, Get) else "number"
            which = f"which has the {'larger' if relation is Relation.MORE else 'smaller'} {noun}"
            return f"{which}, {words[0]} or {words[1]}"
        case forms.Either(target, words):
            return f"whether {noun_phrase(target)} {'are' if target.plural else 'is'} {words[0]} or {words[1]}"
        case forms.Exists(target):
            return f"whether there are {noun_phrase(target, several=True).removeprefix('the ')}"
        case forms.Every(target, among):
            return f"whether {noun_phrase(target)} {_is(target)} among {noun_phrase(among, several=True)}"
        case forms.Uniform(get):
            return f"whether the {describe(get)} is the same for all"
        case forms.Parallel(first, second, square):
            other = f" and {noun_phrase(second)}" if second else ""
            return f"whether {noun_phrase(first)}{other} are {'square to each other' if square else 'parallel'}"
        case forms.Parts(target):
            return noun_phrase(target)
        case forms.Touching(target, other, held, negated):
            return f"{noun_phrase(target)} {'not ' * negated}{'held' if held else 'touched'} by {noun_phrase(other)}"
        case forms.Within(target, box):
            return f"whether {noun_phrase(target)} fits into {' x '.join(f'{size * 1e3:.6g}' for size in box)} mm"
        case forms.Towards(target, sides, seen):
            either = f"{', '.join(sides[:-1])} or {sides[-1]}" if sides else ""
            return _TOWARDS[seen].format(noun_phrase(target), _is(target), either)


def _is(query: PartQuery) -> str:
    return "are" if query.plural else "is"


def _measure(measure: Measure) -> str:
    return _MEASURES.get(measure, measure.value.replace("_", " "))


def _anchor(anchor: object) -> str:
    match anchor:
        case PartQuery():
            return noun_phrase(anchor)
        case forms.Plane(side, of):
            return f"the {side.value if side else 'end'} of {noun_phrase(of)}"
        case forms.Boundary(side):
            return f"the {side.value} of the model" if side else "the edge"
        case forms.Behind():
            return "the outside behind it"
        case forms.Origin():
            return "the origin"
        case _:
            return "the middle of the model"


def noun_phrase(query: PartQuery | None, several: bool = False) -> str:
    """The parts that a query asks for, in words."""
    if query is None:
        return "the whole model"
    if query.ids:
        return ", ".join(query.ids)
    words = [
        *([str(query.count)] if query.count else []),
        *(_rank(rank) for rank in query.ranks if rank.measure or rank.side),
        *query.ends,
        *(f"no {name}" for name in query.lacking),
        *query.colors,
        *query.unknown,
        *(name for name in query.adjectives if name not in query.noun.split()),
        *map(str.upper, query.threads),
        plural_of(query.noun) if (several or query.plural) and query.noun else query.noun or "part",
    ]
    tail = [_size(size) for size in query.sizes] + [_place(place) for place in query.places]
    tail += [f"nearest to {noun_phrase(rank.near)}" for rank in query.ranks if rank.near]
    tail += [f"visible from the {' or '.join(query.sides)}"] if query.sides else []
    tail += [f"not visible from the {' or '.join(query.unseen)}"] if query.unseen else []
    tail += [f"except {noun_phrase(other)}" for other in query.excluded]
    tail += [f"and {noun_phrase(other)}" for other in query.also]
    return " ".join(["the", *words, *tail])


def none_such(query: PartQuery, values: Sequence[float] = ()) -> str:
    """'no hole is wider than 80 mm; they have 5 mm to 26 mm', the ends of `values`; '' where nothing restricts."""
    said = [*query.colors, *map(_compared, query.sizes)]
    left = {"colors": (), "sizes": (), "plural": False, "count": None, "ranks": ()}
    if not said:
        said, left = list(query.adjectives), {**left, "adjectives": ()}
    noun = noun_phrase(query.model_copy(update=left)).removeprefix("the ")
    have = " to ".join(dict.fromkeys(_stated(value, query.sizes[0].measure) for value in values))
    return f"no {noun} is {' and '.join(said)}" + (f"; they have {have}" if have else "") if said else ""


def _compared(size: SizeFilter) -> str:
    more, less = _COMPARATIVES.get(size.measure or Measure.MAGNITUDE, ("", ""))
    word = {Relation.MORE: more, Relation.LESS: less}.get(size.relation)
    return f"{word} than {_stated(size.low, size.measure)}" if word else _size(size)


def _rank(rank: Rank) -> str:
    nth = {1: "", 2: "second ", 3: "third "}.get(rank.nth, f"{rank.nth}th ")
    if rank.side:
        return f"{nth}{rank.side.value}most"
    by = "" if rank.measure in (None, Measure.MAGNITUDE) else f" (by {_measure(rank.measure)})"
    return f"{nth}{'largest' if rank.most else 'smallest'}{by}"


def _size(size: SizeFilter) -> str:
    named = f"{_measure(size.measure)} " if size.measure else ""
    high = f" to {_stated(size.high, size.measure)}" if size.high is not None else ""
    return f"of {named}{_RELATIONS.get(size.relation, '')}{_stated(size.low, size.measure)}{high}"


def _place(place: Place) -> str:
    relation = {"": "of", "with": "without" if place.negated else "with"}.get(place.relation, place.relation)
    return f"{relation} {noun_phrase(place.what)}" if place.what is not None else ""


def _stated(value: float, measure: Measure | None = None) -> str:
    scale, unit = _UNITS.get(answer_type(measure or Measure.LENGTH), (1e3, " mm"))
    scale, unit = (1.0, " kg") if measure is Measure.MASS else (scale, unit)
    return f"{value * scale:.6g}{unit}"


def plural_of(noun: str) -> str:
    """What several of these are called: 'boss' gives 'bosses', 'foot' gives 'feet'."""
    *before, last = noun.split(" ")
    if last in lexicon().plurals:
        return " ".join((*before, lexicon().plurals[last]))
    if noun.endswith(("s", "x", "ch", "sh")):
        return f"{noun}es"
    return f"{noun[:-1]}ies" if noun.endswith("y") and noun[-2:-1] not in "aeiou" else f"{noun}s"
