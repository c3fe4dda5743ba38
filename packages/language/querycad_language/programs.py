"""From a form and the parts that it was grounded on to a Python program over the guest API."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from querycad_contracts import AnswerType, Measure, Part, PartQuery, Relation, Side

from .forms import (
    LONGEST,
    SHORTER,
    Angle,
    Behind,
    Boundary,
    Check,
    Combine,
    Count,
    Distance,
    Every,
    Exists,
    Form,
    Get,
    Origin,
    Parallel,
    Parts,
    Plane,
    Reduce,
    Target,
    Uniform,
)
from .measures import WHOLE, Grade, answer_type, is_length, of_several, options

_VECTORS = (".extents", ".center", ".half_extents", ".tip", ".opening", ".axis", ".normal")
_SLACK = 1e-6
_SYMBOLS = {
    Relation.LESS: ("<", "-"),
    Relation.AT_MOST: ("<=", "+"),
    Relation.MORE: (">", "+"),
    Relation.AT_LEAST: (">=", "-"),
}


@dataclass(frozen=True, slots=True)
class Written:
    """A program, the type of its result, and how natural the measures that it reads are for the parts."""

    code: str
    expects: AnswerType
    grades: tuple[Grade, ...] = ()
    option: int = 0


Grounds = Mapping[PartQuery, tuple[Sequence[Part], int]]
"""The parts that each query of a form was grounded on, and which of its groundings that is."""


class Unwritable(Exception):
    """The form makes no sense of these parts: a distance with one part only, say."""


def write(form: Form, grounds: Grounds, whole: Part, option: int = 0) -> Written:
    """The program for a form. `option`: which meaning of the measure for these parts. Raises Unwritable."""
    return _Writer(grounds, whole, option).written(form)


class _Writer:
    def __init__(self, grounds: Grounds, whole: Part, option: int) -> None:
        self._grounds = grounds
        self._whole = whole
        self._option = option
        self._lines: list[str] = []
        self._names: dict[PartQuery, str] = {}
        self._grades: list[Grade] = []

    def written(self, form: Form) -> Written:
        result, kind = self._form(form)
        code = "\n".join([*self._lines, f"solution = {result}"])
        return Written(code, kind, tuple(self._grades), self._option)

    # Parts

    def _parts(self, query: PartQuery) -> str:
        """The variable with the parts of a query."""
        if query not in self._names:
            name = "parts" if not self._names else f"others{len(self._names) if len(self._names) > 1 else ''}"
            self._names[query] = name
            _, sense = self._grounds[query]
            self._lines.append(f"{name} = find_parts({_call(query, sense)})")
        return self._names[query]

    def _of(self, query: PartQuery) -> Sequence[Part]:
        return self._grounds[query][0]

    def _read(self, measure: Measure, parts: Sequence[Part], scalar: bool = False) -> str:
        """The expression of a measure for parts of these kinds, '{0}' for the part; one number of each if `scalar`."""
        if not parts:
            return "{0}." + measure.value
        counts: dict[str, int] = {}
        for part in parts:
            counts[part.kind] = counts.get(part.kind, 0) + 1
        usual = max(counts, key=lambda kind: counts[kind])
        sample = next(part for part in parts if part.kind == usual)
        known = [one for one in options(measure, sample) if not (scalar and one[0].endswith(_VECTORS))]
        if self._option >= len(known):
            raise Unwritable
        expression, grade = known[self._option]
        self._grades.append(grade)
        return expression

    def _beside(self, measure: Measure, others: Sequence[Measure], parts: Sequence[Part]) -> str:
        """The same where length and width are asked together: of a body they are its longest sides, longest first."""
        both = Measure.LENGTH in others and Measure.WIDTH in others
        if both and all(part.kind in WHOLE for part in parts) and measure in (Measure.LENGTH, Measure.WIDTH):
            return "max({0}.extents)" if measure is Measure.LENGTH else "sorted({0}.extents)[1]"
        return self._read(measure, parts)

    # Forms

    def _form(self, form: Form) -> tuple[str, AnswerType]:  # noqa: C901, PLR0911 - one case a form
        match form:
            case Get():
                return self._get(form)
            case Count(target, None):
                return f"len({self._parts(target)})", AnswerType.COUNT
            case Count(target, measure) if measure is not None:
                return f"len(different({self._listed(measure, target)}))", AnswerType.COUNT
            case Exists(target):
                return f"len({self._parts(target)}) > 0", AnswerType.BOOLEAN
            case Parts(target):
                return self._parts(target), AnswerType.PARTS
            case Distance():
                return self._distance(form)
            case Angle(first, second):
                return self._pairwise(first, second, "a.angle_to(b)", Reduce.ONE), AnswerType.ANGLE
            case Combine():
                return self._combine(form)
            case Check():
                return self._check(form), AnswerType.BOOLEAN
            case Every(target, among):
                found, kept = self._parts(target), self._parts(among)
                return f"0 < len({found}) and all(p.id in [q.id for q in {kept}] for p in {found})", AnswerType.BOOLEAN
            case Uniform(get):
                assert get.target is not None
                return f"len(different({self._listed(get.measures[0], get.target)}, 5e-05)) == 1", AnswerType.BOOLEAN
            case Parallel(first, second, square):
                angles = self._pairwise(first, second, "a.angle_to(b)", Reduce.EACH)
                limit = "abs(angle - 1.5707963267948966)" if square else "angle"
                return f"all({limit} < 0.01 for angle in {angles})", AnswerType.BOOLEAN
        raise Unwritable

    def _listed(self, measure: Measure, target: PartQuery) -> str:
        expression = self._read(measure, self._of(target), scalar=True)
        return f"[{expression.format('p')} for p in {self._parts(target)}]"

    def _get(self, form: Get) -> tuple[str, AnswerType]:
        if form.target is None:
            return self._of_whole(form)
        parts = self._of(form.target)
        if not parts:
            raise Unwritable
        name = self._parts(form.target)
        if len(form.measures) > 1:
            values = ", ".join(self._beside(measure, form.measures, parts).format("p") for measure in form.measures)
            kinds = {answer_type(measure) for measure in form.measures}
            kind = answer_type(form.measures[0], True) if len(kinds) == 1 else AnswerType.NUMBERS
            self._lines.append(f"values = [({values}) for p in {name}]")
            return "[v for row in values for v in row] if len(set(values)) != 1 else list(values[0])", kind
        measure = form.measures[0]
        if measure is Measure.COLOR:
            self._lines.append(f"names = [p.name for p in {name}]")
            return "[body.color for body in shape.bodies if body.name in names]", AnswerType.TEXTS
        if measure is Measure.TIP and self._read(measure, parts) == "{0}.tip":
            self._lines.append(f"tips = [tip for p in {name} for tip in p.tips]")
            return "tips[0] if len(tips) == 1 else tips", answer_type(measure, True)
        expression = self._read(measure, parts) if measure is not Measure.TIP else "{0}.center"
        if measure is Measure.MASS:
            expression = f"{expression} * {_density(form):g}"
        kind = answer_type(measure)
        if measure in (Measure.SIZE, Measure.MAGNITUDE):
            kind = (
                AnswerType.SIZE
                if "extents" in expression and "[" not in expression and "(" not in expression
                else AnswerType.LENGTH
            )
        values = f"[{expression.format('p')} for p in {name}]"
        every = (
            form.reduce in (Reduce.DIFFERENT, Reduce.LARGEST, Reduce.SMALLEST)
            and expression == f"{{0}}.{measure.value}"
        )
        if every and measure in (Measure.RADIUS, Measure.DIAMETER) and any(len(part.radii) > 1 for part in parts):
            scale = "2 * " if measure is Measure.DIAMETER else ""  # of stepped holes every step has one
            values = f"[{scale}r for p in {name} for r in (p.radii if hasattr(p, 'radii') else [p.radius])]"
        return self._reduced(values, form.reduce, kind)

    def _reduced(self, values: str, reduce: Reduce, kind: AnswerType) -> tuple[str, AnswerType]:
        scalar = kind in (
            AnswerType.LENGTH,
            AnswerType.AREA,
            AnswerType.VOLUME,
            AnswerType.ANGLE,
            AnswerType.NUMBER,
            AnswerType.COUNT,
        )
        many = of_several(kind)
        match reduce:
            case Reduce.EACH:
                return values, many
            case Reduce.DIFFERENT:
                return (f"different({values})" if scalar else f"sorted(set({values}))"), many
            case Reduce.TOTAL if scalar:
                return f"sum({values})", kind
            case Reduce.MEAN if scalar:
                self._lines.append(f"values = {values}")
                return "sum(values) / len(values)", kind
            case Reduce.LARGEST if scalar:
                return f"max({values})", kind
            case Reduce.SMALLEST if scalar:
                return f"min({values})", kind
            case _:
                self._lines.append(f"values = {values}")
                same = "len(different(values, 1e-05)) == 1" if scalar else "len(values) == 1"
                return f"values[0] if {same} else values", kind

    def _of_whole(self, form: Get) -> tuple[str, AnswerType]:
        if form.measures[0] is Measure.MASS:
            return f"shape.volume * {_density(form):g}", AnswerType.NUMBER
        if form.measures[0] in (Measure.NAME, Measure.COLOR):
            name = form.measures[0].value
            return f"[body.{name} for body in shape.bodies]", AnswerType.TEXTS
        if set(form.measures) == {Measure.LENGTH, Measure.WIDTH, Measure.HEIGHT} or set(form.measures) == {
            Measure.WIDTH,
            Measure.DEPTH,
            Measure.HEIGHT,
        }:
            return "shape.extents", AnswerType.SIZE
        values = [self._beside(measure, form.measures, [self._whole]) for measure in form.measures]
        known = [self._of_model(value) for value in values]
        if len(values) == 1:
            measure = form.measures[0]
            kind = answer_type(measure)
            if measure in (Measure.SIZE, Measure.MAGNITUDE):
                kind = AnswerType.SIZE if known[0] == "shape.extents" else AnswerType.LENGTH
            return known[0], kind
        return f"[{', '.join(known)}]", answer_type(form.measures[0], True)

    def _of_model(self, expression: str) -> str:
        """What is read of `shape`; of the part that stands for the model where the shape does not have it."""
        if _of_shape(expression.format("shape")):
            return expression.format("shape")
        line = 'model = find_parts({"noun": "object"})[0]'
        if line not in self._lines:
            self._lines.append(line)
        return expression.format("model")

    def _scalar(self, get: Get, pick: str = "max") -> str:
        """One number of a part or the whole; of several parts the largest."""
        if get.target is None:
            if get.measures[0] in (Measure.MAGNITUDE, Measure.SIZE, Measure.POSITION):
                raise Unwritable
            return self._of_whole(get)[0]
        expression = self._read(get.measures[0], self._of(get.target), scalar=True)
        return f"{pick}({expression.format('p')} for p in {self._parts(get.target)})"

    def _combine(self, form: Combine) -> tuple[str, AnswerType]:
        kind = answer_type(form.left.measures[0])
        if form.operation == "minus" and form.left.target is not None and form.left.target.plural:
            left = self._read(form.left.measures[0], self._of(form.left.target)).format("p")
            return f"[{left} - {self._scalar(form.right)} for p in {self._parts(form.left.target)}]", answer_type(
                form.left.measures[0], True
            )
        left, right = self._scalar(form.left), self._scalar(form.right)
        match form.operation:
            case "ratio":
                return f"({left}) / ({right})", AnswerType.NUMBER
            case "plus":
                return f"{left} + {right}", kind
            case "apart":
                return f"abs({left} - ({right}))", kind
            case _:
                return f"{left} - ({right})", kind

    def _check(self, form: Check) -> str:
        if isinstance(form.left, Count):
            return f"len({self._parts(form.left.target)}) == {int(form.low) if isinstance(form.low, float) else 0}"
        measure = form.left.measures[0]
        if form.left.target is None:
            if measure in (Measure.MAGNITUDE, Measure.SIZE, Measure.POSITION):
                raise Unwritable
            values = f"[{self._of_whole(form.left)[0]}]"
        else:
            values = self._listed(measure, form.left.target)
        low = repr(form.low) if isinstance(form.low, float) else self._scalar(form.low)
        self._lines.append(f"values = {values}")
        slack = (
            "5e-05"
            if is_length(measure)
            else f"{abs(form.low) * 1e-3 + 1e-12 if isinstance(form.low, float) else 1e-9:g}"
        )
        match form.relation:
            case Relation.BETWEEN:
                return f"all({low} - {_SLACK:g} <= v <= {form.high!r} + {_SLACK:g} for v in values)"
            case Relation.EQUAL:
                return f"all(abs(v - {low}) <= {slack} for v in values)"
            case Relation.UNEQUAL:
                return f"all(abs(v - {low}) > {slack} for v in values)"
            case Relation.ABOUT:
                return f"all(abs(v - {low}) <= 0.1 * {low} for v in values)"
            case _:
                symbol, sign = _SYMBOLS[form.relation]
                return f"all(v {symbol} {low} {sign} {_SLACK:g} for v in values)"

    # Distances

    def _pairwise(self, first: PartQuery, second: Target, expression: str, reduce: Reduce) -> str:
        parts = self._parts(first)
        if second is None:
            if len(self._of(first)) < 2:
                raise Unwritable
            loop = f"for i, a in enumerate({parts}) for b in {parts}[i + 1 :]"
        else:
            loop = f"for a in {parts} for b in {self._parts(second)} if a.id != b.id"
        self._lines.append(f"found = [{expression} {loop}]")
        if "center[" in expression and reduce not in (
            Reduce.LARGEST,
            Reduce.EACH,
        ):  # along an axis, of those that lie apart
            self._lines.append(f"found = [d for d in found if d > {_SLACK:g}] or found")
        match reduce:
            case Reduce.EACH:
                return "found"
            case Reduce.LARGEST:
                return "max(found)"
            case Reduce.SMALLEST:
                return "min(found)"
            case Reduce.DIFFERENT:
                return "different(found)"
            case _:
                return "found[0] if len(different(found, 1e-05)) == 1 else min(found)"

    def _axis(self, axis: int | None) -> int | None:
        """Which of x, y, z: the sides of the model by their length where the words say so."""
        if axis not in (LONGEST, SHORTER):
            return axis
        order = sorted(range(3), key=lambda i: self._whole.extents[i], reverse=True)
        return order[axis - LONGEST]

    def _distance(self, form: Distance) -> tuple[str, AnswerType]:
        form = replace(form, axis=self._axis(form.axis))
        first, second = form.first, form.second
        if isinstance(first, Plane) or isinstance(second, Plane):
            return self._from_plane(first, second), AnswerType.LENGTH
        if not isinstance(first, PartQuery):
            first, second = second, first  # type: ignore[assignment]
        if not isinstance(first, PartQuery):
            raise Unwritable
        kind = AnswerType.LENGTHS if form.reduce is Reduce.DIFFERENT else AnswerType.LENGTH
        if isinstance(second, Behind):
            second = Boundary(self._behind(self._of(first)))
            form = replace(form, mode="surfaces")
        if isinstance(second, Boundary | Origin) or second is None:
            return self._to_place(first, second, form), kind
        other = second if isinstance(second, PartQuery) else None
        parts = [*self._of(first), *(self._of(other) if other is not None else ())]
        between = self._between(form, parts, other is not None)
        reduce = form.reduce
        return self._pairwise(first, other, between, reduce), kind

    def _behind(self, parts: Sequence[Part]) -> Side:
        """The side that the openings of these parts look away from; the bottom where they have none."""
        normal = next((part.normal for part in parts if part.normal is not None), None)
        if normal is None:
            return Side.BOTTOM
        return max(Side, key=lambda side: -sum(a * b for a, b in zip(side.outward, normal, strict=True)))

    def _from_plane(self, first: object, second: object) -> str:
        """Along the normal of a part's outer plane, to another plane, to a boundary of the model, or to parts."""
        plane, other = (first, second) if isinstance(first, Plane) else (second, first)
        assert isinstance(plane, Plane)
        axis = next(i for i, value in enumerate(plane.side.outward) if value)
        at = self._plane_at(plane, axis)
        if isinstance(other, Plane):
            return f"abs({at} - ({self._plane_at(other, axis)}))"
        if isinstance(other, Boundary):
            if other.side is None or not other.side.outward[axis]:
                raise Unwritable
            corner = "max" if other.side.outward[axis] > 0 else "min"
            return f"abs({at} - shape.{corner}_corner[{axis}])"
        if isinstance(other, Origin):
            return f"abs({at})"
        if not isinstance(other, PartQuery):
            raise Unwritable
        parts = self._parts(other)
        center = f"abs(p.center[{axis}] - ({at}))"
        ends = [f"abs(p.center[{axis}] {sign} p.half_extents[{axis}] - ({at}))" for sign in "+-"]
        round_parts = any(part.axis is not None for part in self._of(other))
        modes = [center, f"max({', '.join(ends)})", f"min({', '.join(ends)})"]
        expression = self._chosen(modes if round_parts else [modes[2], modes[1], modes[0]])
        self._lines.append(f"found = [{expression} for p in {parts}]")
        return "found[0] if len(different(found, 1e-05)) == 1 else found"

    def _plane_at(self, plane: Plane, axis: int) -> str:
        sign, pick = ("+", "max") if plane.side.outward[axis] > 0 else ("-", "min")
        if not self._of(plane.of):
            raise Unwritable
        return f"{pick}(q.center[{axis}] {sign} q.half_extents[{axis}] for q in {self._parts(plane.of)})"

    def _between(self, form: Distance, parts: Sequence[Part], two: bool) -> str:
        """The distance of 'a' and 'b': of round or like parts between centres, else from surface to surface."""
        if not parts:
            raise Unwritable
        flat = all(
            part.kind in ("body", "prism", "rib", "protrusion", "wall", "face") and part.diameter is None
            for part in parts
        )
        alike = len({part.kind for part in parts}) == 1
        usual = alike or all(part.axis is not None for part in parts)
        modes = (
            [form.mode]
            if form.mode != "usual"
            else (["centers", "surfaces"] if usual and not (flat and two) else ["surfaces", "centers"])
        )
        if self._option >= len(modes):
            raise Unwritable
        self._grades.append("own" if self._option == 0 else "derived")
        centers = modes[self._option] == "centers"
        if form.axis is not None:
            apart = f"abs(a.center[{form.axis}] - b.center[{form.axis}])"
            return (
                apart if centers else f"max(0.0, {apart} - a.half_extents[{form.axis}] - b.half_extents[{form.axis}])"
            )
        return "a.center_distance(b)" if centers else "a.distance_to(b)"

    def _to_place(self, first: PartQuery, place: Boundary | Origin | None, form: Distance) -> str:
        parts = self._parts(first)
        found = self._of(first)
        if isinstance(place, Boundary) and place.side is None:
            expression = "p.edge_distance()"
            modes = [expression]
            if form.mode != "surfaces" and found and found[0].radius is not None:
                modes = (
                    ["p.edge_distance() + p.radius", expression]
                    if form.mode == "centers"
                    else [expression, "p.edge_distance() + p.radius"]
                )
            expression = self._chosen(modes)
        elif isinstance(place, Boundary):
            assert place.side is not None
            i = next(i for i, value in enumerate(place.side.outward) if value)
            positive = place.side.outward[i] > 0
            center = f"shape.max_corner[{i}] - p.center[{i}]" if positive else f"p.center[{i}] - shape.min_corner[{i}]"
            near, far = f"{center} - p.half_extents[{i}]", f"{center} + p.half_extents[{i}]"
            round_parts = bool(found) and found[0].kind in ("hole", "boss", "cylinder")
            modes = [center, near, far] if form.mode == "centers" or round_parts else [near, center, far]
            expression = self._chosen(modes[:1] if form.mode == "surfaces" else modes)
        else:
            point = "shape.center" if place is None else "(0.0, 0.0, 0.0)"
            along_axis = f"abs(p.center[{form.axis}] - {point}[{form.axis}])"
            expression = along_axis if form.axis is not None else f"distance(p.center, {point})"
            if form.axis is None and found and found[0].axis is not None and place is None:
                along = max(range(3), key=lambda i: abs(found[0].axis[i]))  # type: ignore[index]
                planar = [i for i in range(3) if i != along]
                terms = " + ".join(f"(p.center[{i}] - shape.center[{i}]) ** 2" for i in planar)
                expression = self._chosen([f"({terms}) ** 0.5", expression])
        self._lines.append(f"found = [{expression} for p in {parts}]")
        if form.reduce is Reduce.LARGEST:
            return "max(found)"
        if form.reduce is Reduce.SMALLEST:
            return "min(found)"
        return "found[0] if len(different(found, 1e-05)) == 1 else found"

    def _chosen(self, modes: Sequence[str]) -> str:
        if self._option >= len(modes):
            raise Unwritable
        self._grades.append("own" if self._option == 0 else "derived")
        return modes[self._option]


def _density(form: Get) -> float:
    """The stated density in kg/m3. Raises Unwritable where none is: a STEP file holds none."""
    if form.density is None:
        raise Unwritable
    return form.density


def _of_shape(expression: str) -> bool:
    """Does the guest's `shape` have what is read of it?"""
    known = ("center", "extents", "half_extents", "volume", "area", "thickness", "name", "width", "depth", "height")
    names = [piece.split("[")[0].split(")")[0].split(" ")[0].split(",")[0] for piece in expression.split("shape.")[1:]]
    return all(name in known for name in names)


def _call(query: PartQuery, sense: int) -> str:
    """The argument of find_parts: the query as a dictionary, without what is empty."""
    implied = {"words", "known"} if query.known and query.words == tuple(query.noun.split()) else set()
    fields = query.model_dump(mode="json", exclude_defaults=True, exclude=implied) | ({"sense": sense} if sense else {})
    text = json.dumps(fields, ensure_ascii=False)
    return text.replace(": true", ": True").replace(": false", ": False").replace(": null", ": None")
