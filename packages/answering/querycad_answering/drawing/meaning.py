"""One plain sentence for what was understood: made from the meaning, not from the words of the question."""

from __future__ import annotations

from querycad_contracts import Measure, PartQuery, Relation
from querycad_language import forms
from querycad_language.describe import RELATIONS, measure_name, noun_phrase, stated
from querycad_language.forms import Distance, Form, Get, Reduce
from querycad_language.phrases import bare_of

_REDUCES = {
    Reduce.DIFFERENT: "different values of the ", Reduce.TOTAL: "total ", Reduce.MEAN: "average ",
    Reduce.LARGEST: "largest ", Reduce.SMALLEST: "smallest ", Reduce.EACH: "", Reduce.ONE: "",
    Reduce.RANGE: "smallest and largest ",
}  # fmt: skip
_OPERATIONS = {
    "minus": "less", "ratio": "over", "share": "in percent of", "plus": "plus", "apart": "compared with",
    "per": "for each of the",
}  # fmt: skip
_FACING = {
    "same": "look to the same side", "opposite": "look to opposite sides", "across": "lie opposite each other",
}  # fmt: skip
_MODES = {
    "centers": "between centres ", "surfaces": "between surfaces ", "outsides": "over the outsides ",
    "beyond": "beyond, ", "on diameter": "on diameter ", "on radius": "on radius ",
}  # fmt: skip
_AXES = {
    None: "",
    0: " along x",
    1: " along y",
    2: " along z",
    forms.HORIZONTAL: " horizontally",
    forms.VERTICAL: " vertically",
}
_TOWARDS = {
    "none": "sides that none of {0} are seen from", "most": "side that most of {0} are seen from",
    "each": "number of {0} seen from each side", "": "side of {0}: {2}",
}  # fmt: skip


def describe(form: Form) -> str:  # noqa: C901, PLR0911, PLR0912 - one case a form
    """What is asked, in plain words: 'diameter of the 8 counterbored holes visible from the top'."""
    match form:
        case Get(measures, target, reduce, density, overall):
            material = f" at {density:g} kg/m3" if density else ""
            names = " and ".join(map(measure_name, measures))
            return f"{_REDUCES[reduce]}{'overall ' if overall else ''}{names} of {noun_phrase(target)}{material}"
        case forms.Count(_, Measure.FACE_COUNT | Measure.EDGE_COUNT as measure):
            return f"number of {measure.removesuffix('_count')}s of the whole model"
        case forms.Count(target, measure):
            values = f"different {measure_name(measure)} values of " if measure else ""
            return f"number of {values}{noun_phrase(target)}"
        case Distance():
            return _distance(form)
        case forms.Several(several):
            return " and ".join(map(describe, several))
        case forms.Angle(first, second):
            return f"angle between {_both(first, second)}"
        case forms.Combine(operation, left, right):
            return f"{describe(left)}, {_OPERATIONS[operation]} {describe(right)}"
        case forms.Check():
            return _check(form)
        case forms.Which(left, relation, _, words):
            noun = measure_name(left.measures[0]) if isinstance(left, Get) else "number"
            which = f"which has the {'larger' if relation is Relation.MORE else 'smaller'} {noun}"
            return f"{which}, {words[0]} or {words[1]}"
        case forms.Either(target, words):
            return f"whether {noun_phrase(target)} {'are' if target.plural else 'is'} {words[0]} or {words[1]}"
        case forms.Exists(target):
            return f"whether there are {noun_phrase(target, several=True).removeprefix('the ')}"
        case forms.AtBothEnds(target):
            return f"whether there are {noun_phrase(target, several=True).removeprefix('the ')} at both ends"
        case forms.Every(target, among) if bare_of(target, "object"):
            return f"whether the model is one of {noun_phrase(among, several=True)}"
        case forms.Every(target, among):
            return f"whether {noun_phrase(target)} {_is(target)} among {noun_phrase(among, several=True)}"
        case forms.Uniform(get):
            return f"whether the {describe(get)} is the same for all"
        case forms.Parallel(first, second, square, in_line):
            said = "on one line" if in_line else "square to each other" if square else "parallel"
            return f"whether {_both(first, second)} are {said}"
        case forms.Facing(first, second, how):
            return f"whether {_both(first, second)} {_FACING[how]}"
        case forms.Parts(target):
            return noun_phrase(target)
        case forms.Towards(target, sides, seen):
            either = f"{', '.join(sides[:-1])} or {sides[-1]}"
            return _TOWARDS[seen].format(noun_phrase(target), _is(target), either)


def _distance(form: Distance) -> str:
    match form:
        case Distance(first, second, "overlap"):
            return f"overlap of {_anchor(first)}" + (f" and {_anchor(second)}" if second != "each other" else "")
        case Distance(first, second, "within"):
            return f"how far {_anchor(first)} reaches into {_anchor(second)}"
        case Distance(first, second, "across"):
            return f"distance from the floor of {_anchor(first)} to the opposite side of {_anchor(second)}"
        case Distance(first, reduce=Reduce.SIDES):
            return f"sides of the rectangle of {_anchor(first)}"
        case Distance(first, second, mode, axis, reduce):
            both = f"from {_anchor(first)} to {_anchor(second)}"
            if second == "each other":
                both = f"of {_anchor(first)} from each other"
            of_part = f" along {noun_phrase(axis)}" if isinstance(axis, PartQuery) else ""
            along = of_part or _AXES.get(axis if isinstance(axis, int) else None, " along a side of the model")
            return f"{_REDUCES[reduce]}distance {_MODES.get(mode, '')}{both}{along}"


def _check(form: forms.Check) -> str:
    match form:
        case forms.Check(Distance(first, second, "amid"), Relation.AT_MOST, 0.0):
            return f"whether {_anchor(first)} lies in the middle of {_anchor(second)}"
        case forms.Check(Distance(first, second, "beyond" | "beyond both" as mode), Relation.MORE, 0.0):
            ends = " on both sides" if mode == "beyond both" else ""
            return f"whether {_anchor(first)} reaches beyond {_anchor(second)}{ends}"
        case forms.Check(left, relation, low, high):
            counted = isinstance(left, forms.Count) or getattr(left, "operation", "") == "ratio"
            measure = Measure.ANGLE if isinstance(left, forms.Angle) else None
            measure = left.measures[0] if isinstance(left, Get) else measure
            value = describe(low) if not isinstance(low, float) else f"{low:g}" if counted else stated(low, measure)
            value = f"{value} to {stated(high, measure)}" if high is not None else value
            same = "as much as the " if relation is Relation.EQUAL and not isinstance(low, float) else ""
            return f"whether the {describe(left)} is {RELATIONS.get(relation, '') or same}{value}"


def _both(first: PartQuery, second: PartQuery | None) -> str:
    return noun_phrase(first) + (f" and {noun_phrase(second)}" if second else "")


def _is(query: PartQuery) -> str:
    return "are" if query.plural else "is"


def _anchor(anchor: object) -> str:
    match anchor:
        case PartQuery():
            return noun_phrase(anchor)
        case forms.Plane(side, of):
            return f"the {side.value if side else 'end'} of {noun_phrase(of)}"
        case forms.Boundary(None, of, int() as axis):
            return f"the nearer {'long side' if axis == forms.SHORTER else 'end'} of {noun_phrase(of)}"
        case forms.Boundary(side):
            return f"the {side.value} of the model" if side else "the edge"
        case forms.Behind():
            return "the outside behind it"
        case forms.Origin():
            return "the origin"
        case forms.MassCentre():
            return "the center of mass"
        case _:
            return "the middle of the model"
