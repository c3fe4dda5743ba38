"""From a form and the parts that it was grounded on to a Python program over the guest API."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import AnswerType, Measure, Part, PartKind, PartQuery, Relation
from querycad_language import forms
from querycad_language.forms import Count, Distance, Form, Get, Reduce
from querycad_language.lexicon import lexicon
from querycad_language.measures import SCALARS, answer_type, of_several
from querycad_language.phrases import bare_of

from .builder import Builder, Compared, Grounds, Read, Unwritable, Written
from .circles import on_one_circle, write_middle
from .distances import along_each, distance, overlapping
from .openings import count_openings
from .planes import SLACK, side_axis
from .rows import count_rows, in_each, row_word
from .sides import angle_between, at_both_ends, directions, facing, in_line, towards

_OF_SHAPE = {
    "width", "depth", "height", "center_of_mass", "center", "extents", "min_corner", "max_corner", "half_extents",
    "volume", "area", "thickness", "name",
}  # fmt: skip
"""What the guest's `shape` has; the rest is read of the part that stands for the model."""
_SIZES = ({Measure.LENGTH, Measure.WIDTH, Measure.HEIGHT}, {Measure.WIDTH, Measure.DEPTH, Measure.HEIGHT})
"""Three measures of the whole that are its extents."""
_DENSE = {Measure.MASS: "{0}.volume", Measure.INERTIA: "[{0}.inertia[i][i] for i in range(3)]"}
"""Measures that take a density, and what it is multiplied with of the whole."""
_SURFACES = {"cylindrical face": "cylinder", "conical face": "cone", "spherical face": "sphere"}
"""Faces that are counted as a viewer does, parts of features or not."""
FULL = 0.999
"""Share of the volume of the whole model from which on a body is the model."""
_ENDS = {Reduce.LARGEST: "max", Reduce.SMALLEST: "min"}
_STEPPED = (Measure.RADIUS, Measure.DIAMETER)
_OF_STEPS = (Reduce.DIFFERENT, Reduce.LARGEST, Reduce.SMALLEST, Reduce.RANGE)
"""Of stepped parts all steps have these measures, where several values are wanted."""
_COMBINED = {
    "minus": "{0} - ({1})", "plus": "{0} + {1}", "apart": "abs({0} - ({1}))", "ratio": "({0}) / ({1})",
    "share": "100 * ({0}) / ({1})",
}  # fmt: skip
_COMPARED = {
    Relation.LESS: f"v < {{low}} - {SLACK:g}", Relation.AT_MOST: f"v <= {{low}} + {SLACK:g}",
    Relation.MORE: f"v > {{low}} + {SLACK:g}", Relation.AT_LEAST: f"v >= {{low}} - {SLACK:g}",
    Relation.BETWEEN: f"{{low}} - {SLACK:g} <= v <= {{high}} + {SLACK:g}",
    Relation.EQUAL: "abs(v - {low}) <= {slack}", Relation.UNEQUAL: "abs(v - {low}) > {slack}",
    Relation.ABOUT: "abs(v - {low}) <= 0.1 * {low}",
}  # fmt: skip


def write(form: Form, grounds: Grounds, whole: Part, option: int = 0) -> Written:
    """The program for a form. `option`: which meaning of the measure for these parts. Raises Unwritable."""
    measured = getattr(form, "left", form)
    build = Builder(grounds, whole, option, overall=isinstance(measured, Get) and measured.overall)
    result, kind = _form(build, form)
    code = "\n".join([*build.lines, f"solution = {result}"])
    return Written(code, kind, tuple(build.reads), option, tuple(build.compared))


def _form(build: Builder, form: Form) -> tuple[str, AnswerType]:  # noqa: PLR0911 - one case a form
    match form:
        case Get():
            return _of_whole(build, form) if form.target is None else _of_parts(build, form, form.target)
        case Count():
            return _count(build, form.target, form.measure), AnswerType.COUNT
        case Distance():
            return distance(build, form)
        case forms.Several(several):
            for index, one in enumerate(along_each(build, several)):
                build.lines.append(f"value{index} = {distance(build, one)[0]}")
            return f"[{', '.join(f'value{index}' for index in range(len(several)))}]", AnswerType.LENGTHS
        case forms.Angle(first, second):
            return angle_between(build, first, second), AnswerType.ANGLE
        case forms.Combine():
            return _combine(build, form)
        case forms.Parts(target):
            return build.parts(target), AnswerType.PARTS
        case forms.Which() | forms.Either():
            return _which(build, form) if isinstance(form, forms.Which) else _either(build, form), AnswerType.TEXT
        case forms.Towards():
            return towards(build, form)
    return _decided(build, form), AnswerType.BOOLEAN


def _decided(build: Builder, form: Form) -> str:
    """Yes or no; what is said of a part that is not there is neither."""
    counted = isinstance(form, forms.Exists | forms.Every) or isinstance(getattr(form, "left", None), Count)
    if not counted and not all(map(build.of, forms.queries(form))):
        raise Unwritable
    match form:
        case forms.Check():
            return _check(build, form)
        case forms.Exists(target):
            return f"len({build.parts(target)}) > 0"
        case forms.Every(target, among):
            return _every(build, target, among)
        case forms.AtBothEnds(target):
            return at_both_ends(build, target)
        case forms.Uniform(get) if get.target is not None:
            different = f"different({_values(build, get.measures[0], get.target)}, 5e-05)"
            build.compared.append(Compared(get, different, answer_type(get.measures[0])))
            return f"len({different}) == 1"
        case forms.Facing():
            return facing(build, form)
        case forms.Parallel(first, second, in_line=line) if line:
            return in_line(build, first, second, row=line == "row")
        case forms.Parallel(first, second, square):
            limit = "abs(angle - 1.5707963267948966)" if square else "angle"
            angles = directions(build, first, second, Reduce.EACH)
            build.compared.append(Compared(None, angles, AnswerType.ANGLE))
            return f"all({limit} < 0.01 for angle in {angles})"
    raise Unwritable


def _every(build: Builder, target: PartQuery, among: PartQuery) -> str:
    """Are all parts among others; is the whole one of them, if it is asked what it is?"""
    if bare_of(target, "object"):
        if not any(part.kind.is_whole and _fills(part, build.whole) for part in build.of(among)):
            raise Unwritable  # that it is not called so does not say that it is none
        return f"any(p.volume > {FULL} * shape.volume for p in {build.parts(among)})"
    found, kept = build.parts(target), build.parts(among)
    return f"0 < len({found}) and all(p.id in [q.id for q in {kept}] for p in {found})"


def _fills(part: Part, whole: Part) -> bool:
    """Is it all that the file holds?"""
    return part.kind == whole.kind or (part.volume or 0.0) > FULL * (whole.volume or math.inf)


def _count(build: Builder, target: PartQuery, measure: Measure | None) -> str:
    if measure in (Measure.FACE_COUNT, Measure.EDGE_COUNT):
        return f"shape.{measure}"
    plain = PartQuery(noun=target.noun, words=target.words, plural=target.plural, definite=target.definite)
    if (kind := _SURFACES.get(target.noun.replace("surface", "face"))) and measure is None and target == plain:
        build.parts(target)
        return f"len(faces(kind={kind!r}))"
    if measure is None:
        special = count_rows(build, target) or count_openings(build, target)
        return special or f"len({build.parts(target)})"
    if measure is Measure.MIRROR_PLANES:
        if any("axisymmetric" in part.tags for part in build.of(target)):  # they are more than can be counted
            raise Unwritable
        return f"sum(len(p.mirror_planes) for p in {build.parts(target)})"
    apart = ", 1e-10" if measure is Measure.VOLUME else ""  # m³; as metres, bodies of a mm³ more or less were alike
    return f"len(different({_values(build, measure, target, steps=measure in _STEPPED)}{apart}))"


def _values(build: Builder, measure: Measure, target: PartQuery, steps: bool = False) -> str:
    """The numbers that parts have; with the radii or diameters of all `steps`, where parts have several."""
    expression = build.read(measure, build.of(target), scalar=True)
    return _listed(build, expression, target, steps)


def _listed(build: Builder, expression: str, target: PartQuery, steps: bool = False) -> str:
    stepped = any(len(part.radii) > 1 for part in build.of(target))
    if steps and stepped and expression in ("{0}.radius", "{0}.diameter"):
        scale = "2 * " if expression == "{0}.diameter" else ""
        radii = "(p.radii if hasattr(p, 'radii') else [p.radius])"
        return f"[{scale}r for p in {build.parts(target)} for r in {radii}]"
    return f"[{expression.format('p')} for p in {build.parts(target)}]"


def _of_parts(build: Builder, form: Get, target: PartQuery) -> tuple[str, AnswerType]:
    parts, name = build.of(target), build.parts(target)
    if not parts:
        raise Unwritable
    if len(form.measures) > 1:
        return _rows(build, form.measures, parts, name)
    measure = form.measures[0]
    if measure is Measure.COLOR:
        build.lines.append(f"names = [p.name for p in {name}]")
        return "[body.color for body in shape.bodies if body.name in names]", AnswerType.TEXTS
    if measure is Measure.POSITION and target.noun.split()[-1:] == ["end"] and all(part.tip for part in parts):
        measure = Measure.TIP  # a shaft ends at its tip
    if _is_circle(target) and (circle := _circle(build, target, measure)) is not None:
        return circle
    expression = build.read(measure, parts)
    if expression == "{0}.tip" and sum(len(part.tips) for part in parts) > 1:
        return f"[tip for p in {name} for tip in p.tips]", AnswerType.POINTS
    if measure in _DENSE:
        expression = _dense(form, expression)
    if expression == "{0}.opening" and len(sides := (*target.sides, *target.ends)) == 1:  # its mouth on that side
        axis, sign = side_axis(sides[0])
        facing = f"o.center for o in {{0}}.openings if {sign}o.normal[{axis}] > 0.5"
        expression = f"next(({facing}), {{0}}.opening)"
    if expression == "{0}.extents" and form.reduce in _ENDS:  # 'the largest dimension'
        return f"{_ENDS[form.reduce]}(x for p in {name} for x in p.extents)", AnswerType.LENGTH
    if expression.startswith("[*"):
        if len(parts) > 1:
            raise Unwritable
        return f"{_listed(build, expression, target)}[0]", AnswerType.LENGTHS
    steps = measure in _STEPPED and form.reduce in _OF_STEPS
    return _reduced(build, _listed(build, expression, target, steps), form.reduce, _type(measure, expression))


def _is_circle(query: PartQuery) -> bool:
    noun = lexicon().nouns.get(query.noun)
    return noun is not None and noun.name == "bolt circle"


def _circle(build: Builder, target: PartQuery, measure: Measure) -> tuple[str, AnswerType] | None:
    """Of the circle that holes, or curved slots, are on; None where the parts are others, such as patterns."""
    parts = build.of(target)
    if measure in (*_STEPPED, Measure.SIZE) and all("curved" in part.tags for part in parts):
        return _along_centers(build, target, 1 if measure is Measure.RADIUS else 2)
    if any(part.kind is not PartKind.HOLE for part in parts):
        return None
    build.read(measure, parts)
    return _through_centers(build, build.parts(target), parts, measure)


def _through_centers(build: Builder, name: str, parts: Sequence[Part], measure: Measure) -> tuple[str, AnswerType]:
    """Diameter or radius of the circle through two centres, which are opposite, or through all of more.

    Others at equal angles are a pattern, which has a diameter of its own. Raises Unwritable.
    """
    share, corners = "" if measure is Measure.DIAMETER else " / 2", on_one_circle(parts)
    if measure not in _STEPPED or (len(parts) != 2 and corners is None):
        raise Unwritable
    if corners is None:
        build.lines += ["import math", f"centers = [p.center for p in {name}]"]
        return f"math.dist(*centers){share}", AnswerType.LENGTH
    write_middle(build, name, corners)
    return f"2 * math.dist(middle, corners[0]){share}", AnswerType.LENGTH


def _along_centers(build: Builder, target: PartQuery, times: int) -> tuple[str, AnswerType]:
    """So many times the radius of the circle that curved slots run along with their middles. Raises Unwritable."""
    if build.option or any(part.angle is None or part.center_length is None for part in build.of(target)):
        raise Unwritable
    radius = "{0}.center_length / {0}.angle"
    build.reads.append(Read(Measure.CENTRELINE_RADIUS, str(build.of(target)[0].kind), radius, "own"))
    return _reduced(build, _listed(build, f"{times} * {radius}", target), Reduce.ONE, AnswerType.LENGTH)


def _type(measure: Measure, expression: str) -> AnswerType:
    """The type of a value of a measure, as it is read."""
    if measure in (Measure.SIZE, Measure.MAGNITUDE):
        return AnswerType.SIZE if expression.endswith(".extents") else AnswerType.LENGTH
    return answer_type(measure)


def _dense(form: Get, expression: str) -> str:
    """Times the stated density in kg/m3. Raises Unwritable where none is stated: a file holds none."""
    if form.density is None:
        raise Unwritable
    density = f" * {form.density:g}"
    return expression.replace("[i][i]", f"[i][i]{density}") if "[i][i]" in expression else expression + density


def _rows(build: Builder, measures: Sequence[Measure], parts: Sequence[Part], name: str) -> tuple[str, AnswerType]:
    """Several measures of each part; of one, or where they are the same, once."""
    listed = [build.beside(measure, measures, parts).format("p") for measure in measures]
    if any(value.startswith("[*") for value in listed):
        raise Unwritable
    kinds = {answer_type(measure) for measure in measures}
    if kinds <= SCALARS and "p.extents" not in listed:  # what differs in the last digit is one value
        listed = [f"round({value}, 9)" for value in listed]
    build.lines.append(f"values = [({', '.join(listed)}) for p in {name}]")
    kind = answer_type(measures[0], True) if len(kinds) == 1 else AnswerType.NUMBERS
    return "[v for row in values for v in row] if len(set(values)) != 1 else list(values[0])", kind


def _reduced(build: Builder, values: str, reduce: Reduce, kind: AnswerType) -> tuple[str, AnswerType]:
    scalar, many = kind in SCALARS, of_several(kind)
    if reduce is Reduce.EACH:
        return values, many
    if reduce is Reduce.DIFFERENT:
        return (f"different({values})" if scalar else f"sorted(set({values}))"), many
    at_once = {Reduce.TOTAL: "sum", Reduce.LARGEST: "max", Reduce.SMALLEST: "min"}
    if scalar and reduce in at_once:
        return f"{at_once[reduce]}({values})", kind
    build.lines.append(f"values = {values}")
    if scalar and reduce is Reduce.MEAN:
        return "sum(values) / len(values)", kind
    if scalar and reduce is Reduce.RANGE:
        return "[min(values), max(values)]", many
    same = "len(different(values, 1e-05)) == 1" if scalar else "len(values) == 1"
    if kind is AnswerType.TEXTS:
        same = "all(v == values[0] for v in values)"
    if kind is AnswerType.DIRECTION and "approach" not in values:  # one way each
        same = "all(abs(a - b) < 1e-06 for v in values for a, b in zip(v, values[0]))"
    return f"values[0] if {same} else values", kind


def _of_whole(build: Builder, form: Get) -> tuple[str, AnswerType]:
    measure, *others = form.measures
    if measure in _DENSE:
        return _of_model(build, _dense(form, _DENSE[measure])), answer_type(measure)
    if measure in (Measure.NAME, Measure.COLOR):
        return f"[body.{measure.value} for body in shape.bodies]", AnswerType.TEXTS
    if set(form.measures) in _SIZES:
        return "shape.extents", AnswerType.SIZE
    values = [build.beside(one, form.measures, [build.whole]) for one in form.measures]
    known = [_of_model(build, value) for value in values]
    if others:
        return f"[{', '.join(known)}]", answer_type(measure, True)
    if known[0] == "shape.extents" and form.reduce in _ENDS:  # 'the largest dimension'
        return f"{_ENDS[form.reduce]}(shape.extents)", AnswerType.LENGTH
    return known[0], _type(measure, known[0])


def _of_model(build: Builder, expression: str) -> str:
    """What is read of `shape`; of the part that stands for the model where the shape does not have it."""
    if _OF_SHAPE.issuperset(re.findall(r"\{0\}\.(\w+)", expression)):
        return expression.format("shape")
    line = 'model = find_parts({"noun": "object"})[0]'
    if line not in build.lines:
        build.lines.append(line)
    return expression.format("model")


def _scalar(build: Builder, get: Get | Count | forms.Combine) -> str:
    """One number of the whole, or of parts: of several the largest."""
    if isinstance(get, forms.Combine):
        return _combine(build, get)[0]
    if isinstance(get, Count):
        return f"len({build.parts(get.target)})"
    if get.target is not None:
        expression = build.read(get.measures[0], build.of(get.target), scalar=True)
        pick = "min" if get.reduce is Reduce.SMALLEST else "max"
        return f"{pick}({expression.format('p')} for p in {build.parts(get.target)})"
    if get.measures[0] in (Measure.MAGNITUDE, Measure.SIZE, Measure.POSITION):
        raise Unwritable
    return _of_whole(build, get)[0]


def _compared(build: Builder, form: Get | Count | Distance) -> str:
    """One number that another value is compared with."""
    if not isinstance(form, Distance):
        return _scalar(build, form)
    apart = distance(build, replace(form, reduce=Reduce.SMALLEST))[0]
    build.lines.append(f"other = {apart}")
    return "other"


def _kind(form: Get | Count | Distance | forms.Angle | forms.Combine) -> AnswerType:
    if isinstance(form, forms.Combine):
        return AnswerType.NUMBER if form.operation in ("ratio", "share") else _kind(form.left)
    if isinstance(form, Count | forms.Angle):
        return AnswerType.COUNT if isinstance(form, Count) else AnswerType.ANGLE
    return answer_type(Measure.LENGTH if isinstance(form, Distance) else form.measures[0])


def _combine(build: Builder, form: forms.Combine) -> tuple[str, AnswerType]:
    left, kind = form.left, _kind(form.left)
    if form.operation == "per" and isinstance(left, Count) and isinstance(form.right, Count):
        parts, others = build.of(left.target), build.of(form.right.target)
        if (word := row_word(form.right.target)) and (each := in_each(build, left.target, word)):
            return each, kind
        if not others or len(parts) % len(others):
            raise Unwritable  # some have more
        return f"len({build.parts(left.target)}) // len({build.parts(form.right.target)})", kind
    if form.operation == "minus" and isinstance(left, Get) and left.target is not None and left.target.plural:
        value = build.read(left.measures[0], build.of(left.target)).format("p")
        return f"[{value} - {_scalar(build, form.right)} for p in {build.parts(left.target)}]", of_several(kind)
    result = _COMBINED[form.operation].format(_scalar(build, left), _scalar(build, form.right))
    return result, _kind(form)


def _which(build: Builder, form: forms.Which) -> str:
    """What the parts with more, or less, are called; both where they are alike."""
    if isinstance(form.left, Get) and not all(map(build.of, forms.queries(form))):
        raise Unwritable
    for name, get in zip("ab", (form.left, form.right), strict=True):
        build.lines.append(f"{name} = {_scalar(build, get)}")
        build.compared.append(Compared(get, name, _kind(get)))
    least = "a - b" if form.relation is Relation.MORE else "b - a"
    first, second = form.words
    both = f"{first} and {second} alike"
    return f"{both!r} if abs(a - b) < {SLACK:g} else {first!r} if {least} > 0 else {second!r}"


def _either(build: Builder, form: forms.Either) -> str:
    """The words that are true of any of the parts."""
    if not build.of(form.target) or not any(map(build.of, form.options)):
        raise Unwritable
    parts, named = build.parts(form.target), zip(form.words, map(build.parts, form.options), strict=True)
    build.lines.append(f"named = [{', '.join(f'({word!r}, {those})' for word, those in named)}]")
    return f"', '.join(word for word, those in named if any(p.id in [q.id for q in those] for p in {parts}))"


def _check(build: Builder, form: forms.Check) -> str:
    match form.left:
        case Count(target):
            values = f"[len({build.parts(target)})]"
        case Distance(mode="overlap"):
            return f"len({overlapping(build, form.left)}) > 0"
        case Distance():
            apart = distance(build, replace(form.left, reduce=Reduce.SMALLEST))[0]
            values = "found" if apart.startswith("found") else apart if apart.startswith("[") else f"[{apart}]"
        case forms.Angle(first, second):
            values = f"[{angle_between(build, first, second)}]"
        case Get(measures, PartQuery() as target):
            values = _values(build, measures[0], target)
            if measures[0] is Measure.MASS:
                values = f"[{_dense(form.left, 'v')} for v in {values}]"
        case _:
            values = f"[{_scalar(build, form.left)}]"
    build.lines.append(f"values = {values}")
    low = repr(form.low) if isinstance(form.low, float) else _compared(build, form.low)
    kind = _kind(form.left)
    build.compared.append(Compared(form.left, "values[0]" if kind is AnswerType.COUNT else "values", kind))
    if not isinstance(form.low, float):
        build.compared.append(Compared(form.low, low, _kind(form.low)))
    share = abs(form.low) * 1e-3 + 1e-12 if isinstance(form.low, float) else 1e-9
    length = kind in (AnswerType.COUNT, AnswerType.LENGTH)
    compared = _COMPARED[form.relation].format(low=low, high=repr(form.high), slack="5e-05" if length else f"{share:g}")
    return f"all({compared} for v in values)"
