"""What parts and measures are called: phrases made from the meaning, not from the words of a question."""

from __future__ import annotations

import math
from collections.abc import Sequence

from querycad_contracts import AnswerType, Measure, PartQuery, Place, Rank, Relation, SizeFilter

from .lexicon import lexicon
from .measures import answer_type

_MEASURES = {
    Measure.MAGNITUDE: "size", Measure.X_EXTENT: "extent along x", Measure.Y_EXTENT: "extent along y",
    Measure.Z_EXTENT: "extent along z", Measure.POSITION: "centre", Measure.SIZE: "extents",
    Measure.CENTRE_LENGTH: "length from centre to centre", Measure.ACROSS_FLATS: "width across flats",
    Measure.ACROSS_CORNERS: "width across corners",
    Measure.FILL: "filled percentage of the bounding box", Measure.REMOVED: "volume cut away of the bounding box",
    Measure.STANDING_AREA: "area to stand on", Measure.LONG_AXIS: "coordinate axis (x, y or z)",
    Measure.INERTIA: "moments of inertia, in kg m2 about x, y, z through the centre of mass,",
}  # fmt: skip
RELATIONS = {
    Relation.UNEQUAL: "other than ", Relation.ABOUT: "about ", Relation.LESS: "less than ",
    Relation.AT_MOST: "at most ", Relation.MORE: "more than ", Relation.AT_LEAST: "at least ",
}  # fmt: skip
_COMPARATIVES = {
    Measure.DEPTH: ("deeper", "shallower"), Measure.HEIGHT: ("higher", "lower"), Measure.WIDTH: ("wider", "narrower"),
    Measure.LENGTH: ("longer", "shorter"), Measure.THICKNESS: ("thicker", "thinner"),
    Measure.MAGNITUDE: ("larger", "smaller"),
}  # fmt: skip
_UNITS = {AnswerType.AREA: (1e6, " mm²"), AnswerType.VOLUME: (1e9, " mm³"), AnswerType.ANGLE: (180 / math.pi, "°")}


def measure_name(measure: Measure) -> str:
    """What a measure is called."""
    return _MEASURES.get(measure, measure.value.replace("_", " "))


def noun_phrase(query: PartQuery | None, several: bool = False) -> str:
    """The parts that a query asks for, in words."""
    if query is None:
        return "the whole model"
    if query.ids:
        return ", ".join(query.ids)
    words = [
        *([str(query.count)] if query.count else []),
        *(_rank(rank) for rank in query.ranks if not (rank.near or rank.edge)),
        *query.ends,
        *(f"no {name}" for name in query.lacking),
        *query.colors,
        *query.unknown,
        *(name for name in query.adjectives if name not in query.noun.split()),
        *map(str.upper, query.threads),
        plural_of(query.noun) if (several or query.plural) and query.noun else query.noun or "part",
    ]
    tail = [_size(size) for size in query.sizes] + [place_phrase(place) for place in query.places]
    tail += [f"nearest to {noun_phrase(rank.near)}" for rank in query.ranks if rank.near]
    seen = {"visible": query.sides, "not visible": query.unseen}
    tail += [f"{how} from the {' or '.join(sides)}" for how, sides in seen.items() if sides]
    tail += [f"except {noun_phrase(other)}" for other in query.excluded]
    tail += [f"and {noun_phrase(other)}" for other in query.also]
    return " ".join(["the", *words, *tail])


def none_such(query: PartQuery, values: Sequence[float] = ()) -> str:
    """'no hole is wider than 80 mm; they have 5 mm to 26 mm', the ends of `values`; '' where nothing restricts."""
    left = {"colors": (), "sizes": (), "plural": False, "count": None, "ranks": ()}
    if not (said := [*query.colors, *map(_compared, query.sizes)]):
        said, left = [*query.adjectives], {**left, "adjectives": ()}
    noun = noun_phrase(query.model_copy(update=left)).removeprefix("the ")
    have = " to ".join(dict.fromkeys(stated(value, query.sizes[0].measure) for value in values))
    return f"no {noun} is {' and '.join(said)}" + (f"; they have {have}" if have else "") if said else ""


def _compared(size: SizeFilter) -> str:
    more, less = _COMPARATIVES.get(size.measure or Measure.MAGNITUDE, ("", ""))
    word = {Relation.MORE: more, Relation.LESS: less}.get(size.relation)
    return f"{word} than {stated(size.low, size.measure)}" if word else _size(size)


def _rank(rank: Rank) -> str:
    nth = {1: "", 2: "second ", 3: "third "}.get(rank.nth, f"{rank.nth}th ")
    if rank.side:
        return f"{nth}{rank.side.value}most"
    if rank.is_unordered:
        return nth.strip()
    measure = rank.measure or Measure.MAGNITUDE
    more, less = _COMPARATIVES.get(measure, _COMPARATIVES[Measure.MAGNITUDE])
    by = "" if measure in _COMPARATIVES else f" (by {measure_name(measure)})"
    return f"{nth}{(more if rank.most else less).removesuffix('er')}est{by}"


def _size(size: SizeFilter) -> str:
    named = f"{measure_name(size.measure)} " if size.measure else ""
    high = f" to {stated(size.high, size.measure)}" if size.high is not None else ""
    return f"of {named}{RELATIONS.get(size.relation, '')}{stated(size.low, size.measure)}{high}"


def place_phrase(place: Place) -> str:
    """Where parts are, in words: 'in the small boss', 'on the top of the housing'."""
    if place.what is None:
        return ""
    relation = {"": "of", "with": "without" if place.negated else "with"}.get(place.relation, place.relation)
    if place.side is not None:
        relation = f"{'on' if relation == 'of' else relation} the {place.side} of"
    return f"{relation} {noun_phrase(place.what)}"


def stated(value: float, measure: Measure | None = None) -> str:
    """A stated value of a measure, in mm, mm², mm³, degrees or kg."""
    if measure is Measure.MASS:
        return f"{value:.6g} kg"
    scale, unit = _UNITS.get(answer_type(measure or Measure.LENGTH), (1e3, " mm"))
    return f"{value * scale:.6g}{unit}"


def plural_of(noun: str) -> str:
    """What several of these are called: 'boss' gives 'bosses', 'foot' gives 'feet'."""
    *before, last = noun.split(" ")
    if plural := lexicon().plurals.get(last):
        return " ".join((*before, plural))
    if noun.endswith(("s", "x", "ch", "sh")):
        return f"{noun}es"
    return f"{noun[:-1]}ies" if noun.endswith("y") and noun[-2:-1] not in "aeiou" else f"{noun}s"
