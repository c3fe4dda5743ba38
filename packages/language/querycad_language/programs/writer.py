"""From a form and the parts that it was grounded on to a Python program over the guest API."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import AnswerType, Measure, Part, PartQuery, Relation
from querycad_language.forms import (
    Angle,
    Check,
    Combine,
    Count,
    Distance,
    Every,
    Exists,
    Form,
    Get,
    Parallel,
    Parts,
    Reduce,
    Several,
    Touching,
    Towards,
    Uniform,
    Within,
)
from querycad_language.measures import answer_type, is_length, of_several

from .distances import (
    SLACK,
    angle_between,
    directions,
    distance,
    most_seen,
    none_seen,
    overlapping,
    several,
    touching,
    towards,
    way_from,
)
from .draft import Draft, Grounds, Unwritable, Written

_KNOWN = ("width", "depth", "height", "center_of_mass")
_SYMBOLS = {
    Relation.LESS: ("<", "-"),
    Relation.AT_MOST: ("<=", "+"),
    Relation.MORE: (">", "+"),
    Relation.AT_LEAST: (">=", "-"),
}


_SCALARS = frozenset((
    AnswerType.LENGTH, AnswerType.AREA, AnswerType.VOLUME, AnswerType.ANGLE, AnswerType.NUMBER, AnswerType.COUNT,
))  # fmt: skip


def write(form: Form, grounds: Grounds, whole: Part, option: int = 0) -> Written:
    """The program for a form. `option`: which meaning of the measure for these parts. Raises Unwritable."""
    draft = Draft(grounds, whole, option)
    result, kind = _form(draft, form)
    return Written("\n".join([*draft.lines, f"solution = {result}"]), kind, tuple(draft.reads), option)


def _form(draft: Draft, form: Form) -> tuple[str, AnswerType]:  # noqa: C901, PLR0911, PLR0912 - one case a form
    match form:
        case Get():
            draft.overall = form.overall
            return _get(draft, form)
        case Count(target, None):
            return f"len({draft.parts(target)})", AnswerType.COUNT
        case Count(target, Measure.MIRROR_PLANES):
            if any("axisymmetric" in part.tags for part in draft.of(target)):  # they are more than can be counted
                raise Unwritable
            return f"sum(len(p.mirror_planes) for p in {draft.parts(target)})", AnswerType.COUNT
        case Count(_, Measure.FACE_COUNT | Measure.EDGE_COUNT):
            return f"shape.{form.measure}", AnswerType.COUNT
        case Count(target, measure) if measure is not None:
            values = _listed(draft, measure, target)
            steps = _steps(measure, draft.of(target), draft.read(measure, draft.of(target), True), draft.parts(target))
            return f"len(different({steps or values}))", AnswerType.COUNT
        case Exists(target):
            return f"len({draft.parts(target)}) > 0", AnswerType.BOOLEAN
        case Parts(target):
            return draft.parts(target), AnswerType.PARTS
        case Touching():
            return touching(draft, form), AnswerType.PARTS
        case Towards(target, sides, "none"):
            return none_seen(draft, target, sides), AnswerType.TEXTS
        case Towards(target, _, "way"):
            return way_from(draft, target), AnswerType.TEXTS
        case Towards(target, sides, seen):
            return (most_seen if seen else towards)(draft, target, sides), AnswerType.TEXT
        case Within(target, box):
            found = "[shape]" if target is None else draft.parts(target)
            fits = f"all(a <= b + {SLACK:g} for a, b in zip(sorted(p.extents), {sorted(box)!r}))"
            return f"all({fits} for p in {found})", AnswerType.BOOLEAN
        case Distance():
            return distance(draft, form)
        case Several(forms):
            return several(draft, forms), AnswerType.LENGTHS
        case Angle(first, second):
            return angle_between(draft, first, second), AnswerType.ANGLE
        case Combine():
            draft.overall = isinstance(form.left, Get) and form.left.overall
            return _combine(draft, form)
        case Check():
            draft.overall = isinstance(form.left, Get) and form.left.overall
            return _check(draft, form), AnswerType.BOOLEAN
        case Every(target, among):
            found, kept = draft.parts(target), draft.parts(among)
            return f"0 < len({found}) and all(p.id in [q.id for q in {kept}] for p in {found})", AnswerType.BOOLEAN
        case Uniform(get):
            assert get.target is not None
            return f"len(different({_listed(draft, get.measures[0], get.target)}, 5e-05)) == 1", AnswerType.BOOLEAN
        case Parallel(first, second, square):
            angles = directions(draft, first, second, Reduce.EACH)
            limit = "abs(angle - 1.5707963267948966)" if square else "angle"
            return f"all({limit} < 0.01 for angle in {angles})", AnswerType.BOOLEAN
    raise Unwritable


def _listed(draft: Draft, measure: Measure, target: PartQuery) -> str:
    expression = draft.read(measure, draft.of(target), scalar=True)
    return f"[{expression.format('p')} for p in {draft.parts(target)}]"


def _steps(measure: Measure, parts: Sequence[Part], expression: str, name: str) -> str:
    """The radii or diameters of all steps, where parts have several; else nothing."""
    named = measure in (Measure.RADIUS, Measure.DIAMETER) and expression == f"{{0}}.{measure.value}"
    if not named or all(len(part.radii) < 2 for part in parts):
        return ""
    scale = "2 * " if measure is Measure.DIAMETER else ""
    return f"[{scale}r for p in {name} for r in (p.radii if hasattr(p, 'radii') else [p.radius])]"


def _get(draft: Draft, form: Get) -> tuple[str, AnswerType]:
    if form.target is None:
        return _of_whole(draft, form)
    parts = draft.of(form.target)
    if not parts:
        raise Unwritable
    name = draft.parts(form.target)
    if len(form.measures) > 1:
        return _rows(draft, form.measures, parts, name)
    measure = form.measures[0]
    if measure is Measure.COLOR:
        draft.lines.append(f"names = [p.name for p in {name}]")
        return "[body.color for body in shape.bodies if body.name in names]", AnswerType.TEXTS
    if measure is Measure.TIP and draft.read(measure, parts) == "{0}.tip":
        draft.lines.append(f"tips = [tip for p in {name} for tip in p.tips]")
        return "tips[0] if len(tips) == 1 else tips", answer_type(measure, True)
    expression = draft.read(measure, parts) if measure is not Measure.TIP else "{0}.center"
    if measure is Measure.INERTIA:
        expression = expression.replace("[i][i]", f"[i][i] * {_density(form):g}")
    if measure is Measure.MASS:
        expression = f"{expression} * {_density(form):g}"
    kind = answer_type(measure)
    if measure in (Measure.SIZE, Measure.MAGNITUDE):
        kind = (
            AnswerType.SIZE
            if "extents" in expression and "[" not in expression and "(" not in expression
            else AnswerType.LENGTH
        )
    if expression.startswith("[*"):
        if len(parts) > 1:
            raise Unwritable
        return f"[{expression.format('p')} for p in {name}][0]", AnswerType.LENGTHS
    values = f"[{expression.format('p')} for p in {name}]"
    if form.reduce in (Reduce.DIFFERENT, Reduce.LARGEST, Reduce.SMALLEST, Reduce.RANGE):
        values = _steps(measure, parts, expression, name) or values
    return _reduced(draft, values, form.reduce, kind)


def _rows(draft: Draft, measures: Sequence[Measure], parts: Sequence[Part], name: str) -> tuple[str, AnswerType]:
    """Several measures of each part; of one, or where they are the same, once."""
    listed = [draft.beside(measure, measures, parts).format("p") for measure in measures]
    if any(value.startswith("[*") for value in listed):
        raise Unwritable
    kinds = {answer_type(measure) for measure in measures}
    if kinds <= _SCALARS and "p.extents" not in listed:  # what differs in the last digit is one value
        listed = [f"round({value}, 9)" for value in listed]
    values = ", ".join(listed)
    kind = answer_type(measures[0], True) if len(kinds) == 1 else AnswerType.NUMBERS
    draft.lines.append(f"values = [({values}) for p in {name}]")
    return "[v for row in values for v in row] if len(set(values)) != 1 else list(values[0])", kind


def _reduced(draft: Draft, values: str, reduce: Reduce, kind: AnswerType) -> tuple[str, AnswerType]:
    scalar = kind in _SCALARS
    many = of_several(kind)
    match reduce:
        case Reduce.EACH:
            return values, many
        case Reduce.DIFFERENT:
            return (f"different({values})" if scalar else f"sorted(set({values}))"), many
        case Reduce.TOTAL if scalar:
            return f"sum({values})", kind
        case Reduce.MEAN if scalar:
            draft.lines.append(f"values = {values}")
            return "sum(values) / len(values)", kind
        case Reduce.LARGEST if scalar:
            return f"max({values})", kind
        case Reduce.SMALLEST if scalar:
            return f"min({values})", kind
        case Reduce.RANGE if scalar:
            draft.lines.append(f"values = {values}")
            return "[min(values), max(values)]", many
        case _:
            draft.lines.append(f"values = {values}")
            same = "len(different(values, 1e-05)) == 1" if scalar else "len(values) == 1"
            if kind is AnswerType.TEXTS:
                same = "all(v == values[0] for v in values)"
            if kind is AnswerType.DIRECTION and "approach" not in values:  # one way each
                same = "all(abs(a - b) < 1e-06 for v in values for a, b in zip(v, values[0]))"
            return f"values[0] if {same} else values", kind


def _of_whole(draft: Draft, form: Get) -> tuple[str, AnswerType]:
    if form.measures[0] is Measure.INERTIA:
        moments = _of_model(draft, "[{0}.inertia[i][i]")
        return f"{moments} * {_density(form):g} for i in range(3)]", AnswerType.NUMBERS
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
    values = [draft.beside(measure, form.measures, [draft.whole]) for measure in form.measures]
    known = [_of_model(draft, value) for value in values]
    if len(values) == 1:
        measure = form.measures[0]
        kind = answer_type(measure)
        if measure in (Measure.SIZE, Measure.MAGNITUDE):
            kind = AnswerType.SIZE if known[0] == "shape.extents" else AnswerType.LENGTH
        return known[0], kind
    return f"[{', '.join(known)}]", answer_type(form.measures[0], True)


def _of_model(draft: Draft, expression: str) -> str:
    """What is read of `shape`; of the part that stands for the model where the shape does not have it."""
    if _of_shape(expression.format("shape")):
        return expression.format("shape")
    line = 'model = find_parts({"noun": "object"})[0]'
    if line not in draft.lines:
        draft.lines.append(line)
    return expression.format("model")


def _scalar(draft: Draft, get: Get | Count, pick: str = "max") -> str:
    """One number of a part or the whole, or of parts; of several parts the largest."""
    if isinstance(get, Count):
        return f"len({draft.parts(get.target)})"
    if get.target is None:
        if get.measures[0] in (Measure.MAGNITUDE, Measure.SIZE, Measure.POSITION):
            raise Unwritable
        return _of_whole(draft, get)[0]
    expression = draft.read(get.measures[0], draft.of(get.target), scalar=True)
    return f"{pick}({expression.format('p')} for p in {draft.parts(get.target)})"


def _combine(draft: Draft, form: Combine) -> tuple[str, AnswerType]:
    kind = AnswerType.COUNT if isinstance(form.left, Count) else answer_type(form.left.measures[0])
    each = isinstance(form.left, Get) and form.left.target is not None and form.left.target.plural
    if form.operation == "minus" and isinstance(form.left, Get) and form.left.target is not None and each:
        left = draft.read(form.left.measures[0], draft.of(form.left.target)).format("p")
        return f"[{left} - {_scalar(draft, form.right)} for p in {draft.parts(form.left.target)}]", answer_type(
            form.left.measures[0], True
        )
    left, right = _scalar(draft, form.left), _scalar(draft, form.right)
    match form.operation:
        case "ratio":
            return f"({left}) / ({right})", AnswerType.NUMBER
        case "share":
            return f"100 * ({left}) / ({right})", AnswerType.NUMBER
        case "plus":
            return f"{left} + {right}", kind
        case "apart":
            return f"abs({left} - ({right}))", kind
        case _:
            return f"{left} - ({right})", kind


def _check(draft: Draft, form: Check) -> str:
    if isinstance(form.left, Count):
        return f"len({draft.parts(form.left.target)}) == {int(form.low) if isinstance(form.low, float) else 0}"
    measure = Measure.LENGTH if isinstance(form.left, Distance) else form.left.measures[0]
    if isinstance(form.left, Distance) and form.left.mode == "overlap":
        return f"len({overlapping(draft, form.left)}) > 0"
    if isinstance(form.left, Distance):
        apart = distance(draft, replace(form.left, reduce=Reduce.SMALLEST))[0]
        values = apart if apart == "found" or apart.startswith("[") else f"[{apart}]"
    elif form.left.target is None:
        if measure in (Measure.MAGNITUDE, Measure.SIZE, Measure.POSITION):
            raise Unwritable
        values = f"[{_of_whole(draft, form.left)[0]}]"
    else:
        values = _listed(draft, measure, form.left.target)
    low = repr(form.low) if isinstance(form.low, float) else _scalar(draft, form.low)
    draft.lines.append(f"values = {values}")
    slack = (
        "5e-05" if is_length(measure) else f"{abs(form.low) * 1e-3 + 1e-12 if isinstance(form.low, float) else 1e-9:g}"
    )
    match form.relation:
        case Relation.BETWEEN:
            return f"all({low} - {SLACK:g} <= v <= {form.high!r} + {SLACK:g} for v in values)"
        case Relation.EQUAL:
            return f"all(abs(v - {low}) <= {slack} for v in values)"
        case Relation.UNEQUAL:
            return f"all(abs(v - {low}) > {slack} for v in values)"
        case Relation.ABOUT:
            return f"all(abs(v - {low}) <= 0.1 * {low} for v in values)"
        case _:
            symbol, sign = _SYMBOLS[form.relation]
            return f"all(v {symbol} {low} {sign} {SLACK:g} for v in values)"


def _density(form: Get) -> float:
    """The stated density in kg/m3. Raises Unwritable where none is: a STEP file holds none."""
    if form.density is None:
        raise Unwritable
    return form.density


def _of_shape(expression: str) -> bool:
    """Does the guest's `shape` have what is read of it?"""
    known = {*_KNOWN, "center", "extents", "min_corner", "half_extents", "volume", "area", "thickness", "name"}
    names = [piece.split("[")[0].split(")")[0].split(" ")[0].split(",")[0] for piece in expression.split("shape.")[1:]]
    return all(name in known for name in names)
