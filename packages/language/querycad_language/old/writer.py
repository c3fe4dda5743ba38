"""From meaning to Python: the short program over the guest API that an engineer would write."""

from __future__ import annotations

from dataclasses import replace

from querycad_contracts import AnswerType

from .errors import NotUnderstood
from .expressions import FOUND, answer_type, compared, literal, many, of_part, of_shape
from .meaning import (
    Aligned,
    Angle,
    Boundary,
    Calculate,
    Compare,
    Count,
    Distance,
    Every,
    Exists,
    Filter,
    Get,
    Measure,
    NounClass,
    Operation,
    Overhang,
    Parts,
    Place,
    Plane,
    Query,
    Reduce,
    Relation,
    Scalar,
    Selection,
    Span,
    Uniform,
    Whole,
)
from .selecting import Chosen, Selecting

_STEPPED = {Measure.RADIUS: "r", Measure.DIAMETER: "2 * r"}
"""Among all radii and diameters of parts, those of every step count."""
_COUNTS = {
    Relation.LESS: "<",
    Relation.AT_MOST: "<=",
    Relation.MORE: ">",
    Relation.AT_LEAST: ">=",
    Relation.UNEQUAL: "!=",
}
_LONG = 40
"""Longer expressions of a measure are written once, not for one part and for several."""
_OVERHANG = """def overhang(p: Part, q: Part) -> float:
    reach = []
    for i in range(3):
        for sign in (1, -1):
            end = sign * p.center[i] + p.half_extents[i]
            rim = sign * shape.center[i] + shape.half_extents[i]
            reach.append((rim - end > 1e-06, sign * q.center[i] + q.half_extents[i] - end))
    return max(0.0, -min(reach)[1])

"""
"""Ends that lie in the model's outline come first; of them the one that is farthest out of the other part."""
_SIDES = '["top", "bottom", "left", "right", "front", "back"]'


def write(query: Query) -> tuple[str, AnswerType]:
    """Which program answers a question, and with which type? Raises NotUnderstood for what no measure gives."""
    writer = _Writer()
    expression, kind = writer.query(query)
    return "\n".join([*writer.select.lines, f"solution = {expression}"]) + "\n", kind


class _Writer:
    """Writes the value of one query; the lines that select its parts go into `select`."""

    def __init__(self) -> None:
        self.select = Selecting()

    def query(self, query: Query) -> tuple[str, AnswerType]:  # noqa: C901, PLR0911 - one case a kind of meaning
        match query:
            case Get():
                return self._get(query)
            case Distance():
                return self._distance(query)
            case Overhang(target, holder):
                return self._overhang(target, holder)
            case Span(target):
                return self._span(target), AnswerType.LENGTH
            case Count():
                return self._count(query), AnswerType.COUNT
            case Exists(target):
                return f"len({self.select.every(target).name}) > 0", AnswerType.BOOLEAN
            case Parts(target):
                return self.select.choose(target).listed, AnswerType.PARTS
            case Calculate():
                return self._calculate(query)
            case Compare():
                return self._compare(query), AnswerType.BOOLEAN
            case Every(target, filters):
                return self._every(target, filters), AnswerType.BOOLEAN
            case Uniform(measure, target):
                values = f"[{of_part(measure, 'p')} for p in {self.select.every(target).name}]"
                return f"len(different({values})) == 1", AnswerType.BOOLEAN
            case Angle(first, seen=True):
                return self._seen_angle(first), AnswerType.ANGLE
            case Angle(first, second):
                angles = self._angles(first, second)
                return f"{angles}[0] if len({angles}) == 1 else {angles}", AnswerType.ANGLE
            case Aligned(first, second, angle):
                angles = self._angles(first, second)
                is_so = f"all(close(a, {literal(angle)}, 0.001) for a in {angles})"
                return f"len({angles}) > 0 and {is_so}", AnswerType.BOOLEAN

    # Values of parts and of the whole

    def _get(self, query: Get) -> tuple[str, AnswerType]:
        if isinstance(query.target, Whole):
            return self._whole(query.measures)
        if query.measures == (Measure.SIDES,):
            parts = self.select.every(query.target).name
            return f"[side for side in {_SIDES} if any(side in p.sides for p in {parts})]", AnswerType.TEXTS
        if query.measures == (Measure.COLOR,):
            names = f"[p.name for p in {self.select.every(query.target).name}]"
            return f"[body.color for body in shape.bodies if body.name in {names}]", AnswerType.TEXTS
        if query.reduce is not Reduce.EACH:
            return self._reduced(query)
        if len(query.measures) > 1:
            return self._several(query)
        if query.measures == (Measure.TIP,):
            return self._tips(query.target)
        return self._each(of_part(query.measures[0], "{0}"), query.target, answer_type(query.measures[0], False))

    def _each(self, template: str, target: Selection, kind: AnswerType) -> tuple[str, AnswerType]:
        """One value a part; of 'the hole' a single value when there is one such part. '{0}' stands for the part."""
        chosen = self.select.choose(target)
        if chosen.single:
            return template.format(chosen.name), kind
        listed = f"[{template.format('p')} for p in {chosen.name}]"
        if chosen.plural:
            return listed, many(kind)
        if len(template) > _LONG or kind is AnswerType.LENGTH:  # like parts share one value
            name = self.select.name("values")
            self.select.lines.append(f"{name} = {listed}")
            one = f"len(different({name})) == 1" if kind is AnswerType.LENGTH else f"len({name}) == 1"
            return f"{name}[0] if {one} else {name}", kind
        return f"{template.format(chosen.first)} if len({chosen.name}) == 1 else {listed}", kind

    def _tips(self, target: Selection) -> tuple[str, AnswerType]:
        """All free ends: a rod whose ends are both free has two, though it is one part."""
        chosen = self.select.choose(target)
        ends = f"[tip for p in {chosen.listed} for tip in p.tips]"
        if chosen.plural:
            return ends, many(AnswerType.POINT)
        name = self.select.name("tips")
        self.select.lines.append(f"{name} = {ends}")
        return f"{name}[0] if len({name}) == 1 else {name}", AnswerType.POINT

    def _several(self, query: Get) -> tuple[str, AnswerType]:
        """Several measures: one after the other, part by part."""
        assert isinstance(query.target, Selection)
        kind = _kind(query.measures)
        chosen = self.select.choose(query.target)
        if chosen.single:
            return _listed([of_part(measure, chosen.name) for measure in query.measures]), kind
        values = ", ".join(of_part(measure, "p") for measure in query.measures)
        return f"[value for p in {chosen.name} for value in ({values})]", kind

    def _whole(self, measures: tuple[Measure, ...]) -> tuple[str, AnswerType]:
        values = [self._of_shape(measure) for measure in measures]
        return _listed(values), AnswerType.TEXTS if measures == (Measure.COLOR,) else _kind(measures)

    def _of_shape(self, measure: Measure) -> str:
        expression = of_shape(measure)
        if expression is None:
            name = measure.value.replace("_", " ")
            raise NotUnderstood(f"The whole model has no {name}; name the part that is meant.")
        if "{round}" not in expression:
            return expression
        name = self.select.name("round_extents")
        pairs = "[(width, depth), (width, height), (depth, height)]"
        self.select.lines.append("width, depth, height = shape.extents")
        self.select.lines.append(f"{name} = [a for a, b in {pairs} if close(a, b)]")
        return expression.replace("{round}", name)

    def _reduced(self, query: Get) -> tuple[str, AnswerType]:
        assert isinstance(query.target, Selection)
        if len(query.measures) > 1:
            raise NotUnderstood("Ask for one measure at a time to be compared or summed up.")
        single = query.target.single
        chosen = self.select.choose(query.target) if single else self.select.every(query.target)
        measure = query.measures[0]
        values = f"{of_part(measure, 'p')} for p in {chosen.listed}"
        if measure in _STEPPED and query.reduce in (Reduce.LARGEST, Reduce.SMALLEST):
            values = f"{_STEPPED[measure]} for p in {chosen.listed} for r in p.radii"
        kind = answer_type(measure, False)
        match query.reduce:
            case Reduce.DIFFERENT:
                return self._different(measure, chosen), many(kind)
            case Reduce.ONE:
                slack = ", 1e-12" if kind in (AnswerType.AREA, AnswerType.VOLUME) else ""
                name = self.select.name("values")
                self.select.lines.append(f"{name} = different([{values}]{slack})")
                return f"{name}[0] if len({name}) == 1 else {name}", kind
            case Reduce.TOTAL:
                return f"sum({values})", kind
            case Reduce.MEAN:
                return f"sum({values}) / len({chosen.listed})", kind
            case reduce if query.nth > 1:
                index = -query.nth if reduce is Reduce.LARGEST else query.nth - 1
                return f"different([{values}])[{index}]", kind
            case reduce:
                return f"{'max' if reduce is Reduce.LARGEST else 'min'}({values})", kind

    def _different(self, measure: Measure, chosen: Chosen) -> str:
        """The different values; of radii and diameters, those of every step."""
        if measure in _STEPPED:
            return f"different([{_STEPPED[measure]} for p in {chosen.listed} for r in p.radii])"
        values = f"{of_part(measure, 'p')} for p in {chosen.listed}"
        match answer_type(measure, False):
            case AnswerType.LENGTH:
                return f"different([{values}])"
            case AnswerType.AREA | AnswerType.VOLUME:
                return f"different([{values}], 1e-12)"
            case _:
                return f"sorted(set([{values}]))"

    def _count(self, query: Count) -> str:
        phrase = query.target.phrases[0]
        plain = len(query.target.phrases) == 1 and not (phrase.sides or phrase.filters or phrase.ranks)
        if plain and query.measure is None and phrase.description in ("face", "surface"):
            return "shape.face_count"
        chosen = self.select.every(query.target)
        return f"len({chosen.name if query.measure is None else self._different(query.measure, chosen)})"

    def _overhang(self, target: Selection, holder: Selection) -> tuple[str, AnswerType]:
        other = self.select.choose(holder).first
        self.select.lines.insert(0, _OVERHANG)
        return self._each(f"(overhang({{0}}, {other}) or {{0}}.height)", target, AnswerType.LENGTH)

    def _span(self, target: Selection) -> str:
        """From the outermost end of the first to that of the last, along the axis on which they lie farthest apart."""
        parts = self.select.every(target).name
        apart, axis = self.select.name("apart"), self.select.name("axis")
        reach = f"max(p.center[i] for p in {parts}) - min(p.center[i] for p in {parts})"
        self.select.lines.append(f"{apart} = [{reach} for i in range(3)]")
        self.select.lines.append(f"{axis} = {apart}.index(max({apart}))")
        most = f"max(p.center[{axis}] + p.half_extents[{axis}] for p in {parts})"
        return f"{most} - min(p.center[{axis}] - p.half_extents[{axis}] for p in {parts})"

    # Two values

    def _scalar(self, value: Scalar, relation: Relation | None = None, right: bool = False) -> str:
        """One number; of several parts the one that decides the comparison, else the largest."""
        if isinstance(value, float):
            return literal(value)
        if isinstance(value, Count):
            return self._count(value)
        if isinstance(value, Distance):
            each = value.reduce is Reduce.EACH
            return self._distance(replace(value, reduce=Reduce.SMALLEST) if each else value)[0]
        if isinstance(value.target, Whole):
            return self._whole(value.measures)[0]
        if value.reduce is not Reduce.EACH:
            return self._reduced(value)[0]
        chosen = self.select.choose(value.target)
        if chosen.single or not chosen.plural:
            return of_part(value.measures[0], chosen.first)
        upwards = relation in (Relation.MORE, Relation.AT_LEAST)
        pick = "min" if relation is not None and upwards != right else "max"
        return f"{pick}({of_part(value.measures[0], 'p')} for p in {chosen.name})"

    def _calculate(self, query: Calculate) -> tuple[str, AnswerType]:
        if query.operation is Operation.WITHOUT and isinstance(query.left, Get) and isinstance(query.right, Get):
            if isinstance(query.left.target, Selection) and query.left.target.plural:
                return self._each_without(query.left, query.right)
        left, right = self._term(query.left, query.operation), self._term(query.right, query.operation)
        kind = AnswerType.NUMBER if isinstance(query.left, Count) else AnswerType.LENGTH
        if isinstance(query.left, Get):
            kind = answer_type(query.left.measures[0], False)
        match query.operation:
            case Operation.RATIO:
                return f"{_grouped(left)} / {_grouped(right)}", AnswerType.NUMBER
            case Operation.PLUS:
                return f"{left} + {right}", kind
            case Operation.APART:
                return f"abs({left} - {_grouped(right)})", kind
            case Operation.MINUS:
                return f"{left} - {_grouped(right)}", kind
            case Operation.WITHOUT:
                assert isinstance(query.left, Get)
                assert isinstance(query.left.target, Selection)
                holder = self.select.choose(query.left.target).first
                return f'{left} - ({right} if {holder}.kind in ("body", "model") else 0.0)', kind

    def _each_without(self, left: Get, right: Get) -> tuple[str, AnswerType]:
        """Of each of several bodies what remains without the part of it: the screws without their heads."""
        assert isinstance(left.target, Selection)
        assert isinstance(right.target, Selection)
        parts, others = self.select.choose(left.target).listed, self.select.every(right.target).name
        whole, taken = of_part(left.measures[0], "p"), of_part(right.measures[0], "q")
        kind = answer_type(left.measures[0], True)
        off = f'(max({taken} for q in {others} if q.is_in(p)) if p.kind in ("body", "model") else 0.0)'
        return f"[{whole} - {off} for p in {parts}]", kind

    def _term(self, value: Scalar, operation: Operation) -> str:
        """One number of a calculation; in a sum, all parts count."""
        several = isinstance(value, Get) and isinstance(value.target, Selection) and value.target.plural
        if isinstance(value, Get) and several and value.reduce is Reduce.EACH and operation is Operation.PLUS:
            value = replace(value, reduce=Reduce.TOTAL)
        return self._scalar(value)

    def _compare(self, query: Compare) -> str:
        left = self._scalar(query.left, query.relation)
        if isinstance(query.left, Count):
            right = self._scalar(query.right).removesuffix(".0")
            return f"{left} {_COUNTS.get(query.relation, '==')} {right}"
        measure = query.left.measures[0] if isinstance(query.left, Get) else Measure.LENGTH
        if isinstance(query.right, float):
            return self.select.bound(left, measure, query.relation, query.right, None)
        slack = FOUND if answer_type(measure, False) is AnswerType.LENGTH else 1e-12
        return compared(left, query.relation, self._scalar(query.right, query.relation, right=True), None, slack)

    def _every(self, target: Selection, filters: tuple[Filter, ...]) -> str:
        chosen = self.select.every(target)
        conditions = [self.select.condition(condition, target.noun_class) for condition in filters]
        matching = self.select.name("matching")
        self.select.lines.append(f"{matching} = [p for p in {chosen.name} if {' and '.join(conditions)}]")
        return f"0 < len({matching}) == len({chosen.name})"

    # Pairs of parts

    def _angles(self, first: Selection, second: Selection | None) -> str:
        pairs = self._pairs(first, second)
        name = self.select.name("angles")
        self.select.lines.append(f"{name} = [a.angle_to(b) {pairs}]")
        return name

    def _seen_angle(self, around: Selection) -> str:
        """The smallest angle at the middle of parts in a circle: twice the arc sine of half a chord over the radius."""
        parts = self.select.every(around).name
        self.select.lines.insert(0, "import math\n")
        middle, angles = self.select.name("middle"), self.select.name("angles")
        self.select.lines.append(
            f"{middle} = tuple(sum(p.center[i] for p in {parts}) / len({parts}) for i in range(3))"
        )
        chord = f"distance(a.center, b.center) / (distance(a.center, {middle}) + distance(b.center, {middle}))"
        pairs = f"for i, a in enumerate({parts}) for b in {parts}[i + 1 :]"
        self.select.lines.append(f"{angles} = [2 * math.asin(min(1.0, {chord})) {pairs}]")
        return f"min({angles})"

    def _pairs(self, first: Selection, second: Selection | None) -> str:
        """The loop over 'a' and 'b': every two of one selection, or each of one with each of the other."""
        if second is None:
            parts = self.select.every(first).name
            return f"for i, a in enumerate({parts}) for b in {parts}[i + 1 :]"
        parts, others = self.select.choose(first).listed, self.select.choose(second).listed
        return f"for a in {parts} for b in {others}"

    def _distance(self, query: Distance) -> tuple[str, AnswerType]:
        first, second = query.first, query.second
        if isinstance(first, Plane) or isinstance(second, Plane):
            return self._from_plane(query)
        if not isinstance(first, Selection) and second is not None:
            first, second = second, first
        if not isinstance(first, Selection):
            raise NotUnderstood("A distance needs a part; name what it is measured from.")
        if second is not None and not isinstance(second, Selection):
            return self._to_place(first, second, query)
        if isinstance(second, Selection) and first.single and second.single:
            a, b = self.select.choose(first).first, self.select.choose(second).first
            return _apart(query.centers, query.axis, a, b), AnswerType.LENGTH
        return self._of_pairs(first, second, query)

    def _of_pairs(self, first: Selection, second: Selection | None, query: Distance) -> tuple[str, AnswerType]:
        """The distances of all pairs of parts, or what becomes of them."""
        pairs = self._pairs(first, second)
        name = self.select.name("distances")
        alike = query.alike and second is None and first.noun_class is NounClass.HOLE
        like = " if close(a.diameter, b.diameter)" if alike else ""
        self.select.lines.append(f"{name} = [{_apart(query.centers, query.axis)} {pairs}{like}]")
        if alike:
            self.select.lines.append(f"{name} = {name} or [{_apart(query.centers, query.axis)} {pairs}]")
        if query.axis is not None and second is None and query.reduce in (Reduce.SMALLEST, Reduce.EACH):
            each = query.reduce is Reduce.EACH  # 'the distance between the holes along x': of those that lie apart
            apart = f"[d for d in {name} if d > {FOUND:g}]"
            self.select.lines.append(f"{name} = {f'different({apart})' if each else apart} or {name}")
        match query.reduce:
            case Reduce.EACH if second is None:
                return f"{name}[0] if len({name}) == 1 else {name}", AnswerType.LENGTH
            case Reduce.DIFFERENT:
                return f"different({name})", AnswerType.LENGTHS
            case Reduce.TOTAL:
                return f"sum({name})", AnswerType.LENGTH
            case Reduce.MEAN:
                return f"sum({name}) / len({name})", AnswerType.LENGTH
            case Reduce.LARGEST:
                return f"max({name})", AnswerType.LENGTH
            case _:
                return f"min({name})", AnswerType.LENGTH

    def _from_plane(self, query: Distance) -> tuple[str, AnswerType]:
        """Along one axis, from a plane of parts to what lies at the other end; one value for each of several parts."""
        first, second, axis = query.first, query.second, query.axis or 0
        assert second is not None
        if isinstance(first, Plane) and isinstance(second, Plane):
            return f"abs({self._coordinate(first, axis)} - ({self._coordinate(second, axis)}))", AnswerType.LENGTH
        many = [place for place in (first, second) if isinstance(place, Selection)]
        many = many or [place.of for place in (first, second) if isinstance(place, Plane)]
        others = [self._coordinate(place, axis) for place in (first, second) if getattr(place, "of", place) != many[0]]
        own = next(place for place in (first, second) if getattr(place, "of", place) == many[0])
        gap = isinstance(own, Selection) and not query.centers
        template = f"abs({_plane(own, axis)} - ({others[0]}))"
        template = f"max(0.0, {template} - {{0}}.half_extents[{axis}])" if gap else template
        return self._each(template, many[0], AnswerType.LENGTH)

    def _coordinate(self, place: Place, axis: int) -> str:
        """Where a plane, or the first of some parts, lies along an axis."""
        if isinstance(place, Boundary):
            return f"shape.{'max' if place.side.outward[axis] > 0 else 'min'}_corner[{axis}]"
        of = place.of if isinstance(place, Plane) else place
        assert isinstance(of, Selection)
        chosen = self.select.choose(of)
        if isinstance(place, Plane) and chosen.plural:  # the outermost of 'the undersides of the feet'
            pick = "max" if place.side.outward[axis] > 0 else "min"
            return f"{pick}({_plane(place, axis).format('q')} for q in {chosen.listed})"
        return _plane(place, axis).format(chosen.first)

    def _to_place(self, parts: Selection, place: Place, query: Distance) -> tuple[str, AnswerType]:
        """From parts to a point or an outer plane of the whole model."""
        template = _from_place(place, query.axis, query.centers)
        if query.reduce is Reduce.EACH:
            return self._each(template, parts, AnswerType.LENGTH)
        pick = "max" if query.reduce is Reduce.LARGEST else "min"
        return f"{pick}({template.format('p')} for p in {self.select.every(parts).name})", AnswerType.LENGTH


def _plane(place: Place, axis: int) -> str:
    """Where a part '{0}', or its plane on a side, lies along an axis."""
    if not isinstance(place, Plane):
        return f"{{0}}.center[{axis}]"
    return f"{{0}}.center[{axis}] {'+' if place.side.outward[axis] > 0 else '-'} {{0}}.half_extents[{axis}]"


def _apart(centers: bool, axis: int | None, a: str = "a", b: str = "b") -> str:
    """How far apart the parts `a` and `b` are."""
    if axis is None:
        return f"{a}.center_distance({b})" if centers else f"{a}.distance_to({b})"
    between = f"abs({a}.center[{axis}] - {b}.center[{axis}])"
    return between if centers else f"max(0.0, {between} - {a}.half_extents[{axis}] - {b}.half_extents[{axis}])"


def _from_place(place: Place, axis: int | None, centers: bool) -> str:
    """How far a part '{0}' is from a place of the whole model."""
    if isinstance(place, Boundary):
        outward = place.side.outward
        i = next(i for i, value in enumerate(outward) if value)
        surface = "" if centers else f" - {{0}}.half_extents[{i}]"
        if outward[i] > 0:
            return f"shape.max_corner[{i}] - {{0}}.center[{i}]{surface}"
        return f"{{0}}.center[{i}] - shape.min_corner[{i}]{surface}"
    point = "shape.center" if isinstance(place, Whole) else "(0.0, 0.0, 0.0)"
    if axis is None:
        return f"distance({{0}}.center, {point})"
    return f"abs({{0}}.center[{axis}] - {point}[{axis}])"


def _kind(measures: tuple[Measure, ...]) -> AnswerType:
    """The type of the values of measures asked for together."""
    kinds = {answer_type(measure, len(measures) > 1) for measure in measures}
    if len(kinds) > 1:
        raise NotUnderstood("Ask for measures of different kinds in separate questions.")
    return kinds.pop()


def _listed(values: list[str]) -> str:
    return values[0] if len(values) == 1 else f"[{', '.join(values)}]"


def _grouped(expression: str) -> str:
    return f"({expression})" if " + " in expression or " - " in expression else expression
