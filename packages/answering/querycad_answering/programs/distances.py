"""Distances: the lines that measure how far apart two anchors are, or every two of several parts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, product
from math import dist

from querycad_contracts import DRAWING_M, AnswerType, Part, PartKind, PartQuery, Side
from querycad_contracts.vectors import coordinate_axis, cross, norm
from querycad_language import forms
from querycad_language.forms import (
    HORIZONTAL,
    LONGEST,
    SHORTER,
    VERTICAL,
    Anchor,
    Boundary,
    Distance,
    MassCentre,
    Origin,
    Plane,
    Reduce,
)

from .builder import Builder, Read, Unwritable
from .meanings import along_axis
from .planes import (
    REDUCED,
    SLACK,
    beyond_both,
    ends_of,
    from_plane,
    is_oblique,
    kinds,
    of_each,
    outermost,
    reach,
    side_axis,
    side_behind,
)
from .rows import rows_apart

FEW = 60
"""Every two of so many are measured in a run's 2,000 calls; of more only the nearest neighbours, for the least."""
CALLS = 2000
"""Of a run; a program that is sure to make more is not written where each takes the kernel."""
MEASURED = 100
"""So many pairs have their surfaces measured, hundredths of a second each; of more those whose boxes are nearest."""
_FLAT = frozenset((PartKind.BODY, PartKind.PRISM, PartKind.RIB, PartKind.PROTRUSION, PartKind.WALL, PartKind.FACE))
"""Kinds that are as good as flat where they have no diameter: two of them have a gap between surfaces."""
_PARALLEL = 0.0017
"""Radians within which axes are parallel, as recognition has it: 0.1 degrees."""
CORNERS = 4
"""Of a rectangle: of fewer or more parts there are no two sides."""


def distance(build: Builder, form: Distance) -> tuple[str, AnswerType]:
    """How far apart the two ends of a distance are, as an expression and its type."""
    axis = _axis(build, form)
    form = replace(form, axis=axis, reduce=_reduce(build, form))
    first, second = form.first, form.second
    if form.mode == "overlap":
        return f"sum(a.overlap_with(b) for a, b in {overlapping(build, form)})", AnswerType.VOLUME
    if isinstance(first, MassCentre) or isinstance(second, MassCentre):
        return _from_mass(build, second if isinstance(first, MassCentre) else first, axis), AnswerType.LENGTH
    if isinstance(second, Plane) and not isinstance(first, Plane):
        first, second = second, first
    if isinstance(first, Plane):
        both = form.mode == "beyond both" and isinstance(second, Plane)
        from_it = beyond_both(build, first, second) if both else from_plane(build, first, second, form.mode)
        return from_it, AnswerType.LENGTH
    if isinstance(second, PartQuery) and not isinstance(first, PartQuery):
        first, second = second, first
    if not isinstance(first, PartQuery):
        raise Unwritable
    kind = AnswerType.LENGTHS if form.reduce in (Reduce.DIFFERENT, Reduce.SIDES) else AnswerType.LENGTH
    if isinstance(second, forms.Behind):
        second = Boundary(side_behind(build.of(first)))
        form = replace(form, mode="surfaces")
    if isinstance(second, Boundary | Origin) or second is None:
        return _to_place(build, first, second, form), kind
    if form.mode == "outsides":
        return _over(build, form, first), kind
    one = build.of(first) if second == "each other" and form.mode == "centers" and form.axis is None else []
    if len(one) == 1 and one[0].center_length:  # of a lever's arm
        return of_each(build, first, {"between": "p.center_length"}, form.reduce), kind
    if isinstance(second, PartQuery) and (fit := _FITS.get(form.mode)) is not None:
        return fit(build, form, first, second), kind
    other = second if isinstance(second, PartQuery) else None
    rows = rows_apart(build, first, other, axis) if form.mode in ("usual", "centers") else None
    return rows or pairwise(build, first, other, _between(build, form, other is not None), form.reduce), kind


def along_each(build: Builder, several: Sequence[Distance]) -> list[Distance]:
    """Several distances of the same parts from each other, each along another axis along which they lie apart.

    'Across' is then the other direction of the pattern, and 'up and down' is along y where the parts lie on one level:
    as on a drawing, which is a plan.
    """
    said = [_axis(build, one) for one in several]
    spread = _spread(build.all_of(*(one.first for one in several if isinstance(one.first, PartQuery))))
    apart = [i for i, size in enumerate(spread) if size > SLACK]
    if len(apart) != len(said) or {*apart} == {*said}:
        return [replace(one, axis=axis) for one, axis in zip(several, said, strict=True)]
    vague = [one.axis in (LONGEST, SHORTER, HORIZONTAL, VERTICAL) for one in several]
    found: dict[int, int] = {}
    for index in sorted(range(len(said)), key=lambda i: (vague[i], i)):
        if (axis := said[index]) is not None and axis in apart:
            apart.remove(axis)
            found[index] = axis
    return [replace(one, axis=found[i] if i in found else apart.pop(0)) for i, one in enumerate(several)]


def _reduce(build: Builder, form: Distance) -> Reduce:
    """What becomes of the distances: of 'the two end holes', or those 'at the two ends', the largest is meant."""
    first, parts = form.first, build.all_of(form.first)
    if form.reduce is not Reduce.ONE or form.second != "each other" or not isinstance(first, PartQuery):
        return form.reduce
    ends = [one.what for one in first.places if one.what is not None and one.what.noun.split()[-1:] == ["end"]]
    apart = sorted((dist(a.center, b.center) for a, b in combinations(parts, 2)), reverse=True)
    alone = len(apart) > 1 and apart[0] - apart[1] > DRAWING_M
    return Reduce.LARGEST if alone and any(2 in (first.count, one.count) for one in ends) else form.reduce


def _axis(build: Builder, form: Distance) -> int | None:
    """Which of x, y, z: where the words say so one of the longer sides along which the parts lie apart."""
    if isinstance(form.axis, PartQuery):
        if not (named := build.of(form.axis)):
            raise Unwritable
        turns = along_axis(named[0])
        return turns if turns is not None else max(range(3), key=named[0].extents.__getitem__)
    if form.axis in (HORIZONTAL, VERTICAL):
        spread = _spread(build.all_of(*(one for one in (form.first, form.second) if isinstance(one, PartQuery))))
        level = spread[2] <= SLACK
        if form.axis == VERTICAL:
            return 1 if level else 2
        return 0 if level and spread[0] > SLACK else int(spread[1] > spread[0])
    if form.axis not in (LONGEST, SHORTER):
        return form.axis
    order = sorted(range(3), key=lambda i: build.whole.extents[i], reverse=True)
    spread = _spread(build.all_of(form.first)) if form.second == "each other" else (0.0, 0.0, 0.0)
    apart = [i for i in order if spread[i] > SLACK]
    return (apart if len(apart) > 1 else order)[form.axis - LONGEST]


def _apart(parts: Sequence[Part]) -> list[int]:
    """Along which of x, y, z do the middles of parts lie apart, where they lie along an axis that all of them have?"""
    apart = [i for i, size in enumerate(_spread(parts)) if size > SLACK]
    return apart if all(along_axis(part) in apart for part in parts) else []


def _spread(parts: Sequence[Part]) -> Sequence[float]:
    """How far the middles of parts lie apart along x, y, z."""
    centers = [[part.center[i] for part in parts] for i in range(3)]
    return [max(found, default=0.0) - min(found, default=0.0) for found in centers]


# Between parts


def pairwise(build: Builder, first: PartQuery, second: forms.Target, expression: str, reduce: Reduce) -> str:
    """The expression of 'a' and 'b' for every two parts."""
    parts, least = build.parts(first), reduce in (Reduce.ONE, Reduce.SMALLEST)
    own, others = len(build.of(first)), "" if second is None else f", {build.parts(second)}"
    pairs = own * (own - 1) // 2 if second is None else own * len(build.of(second))
    if second is None and (own < 2 or (reduce is Reduce.SIDES and own != CORNERS)):
        raise Unwritable
    if expression == "a.distance_to(b)" and pairs > (MEASURED if least else CALLS):
        if not least:
            raise Unwritable
        build.lines.append(f"a, b = closest({parts}{others})")
        return expression
    loop = f"for i, a in enumerate({parts}) for b in {parts}[i + 1 :]"
    likes = reduce is Reduce.ONE and _has_likes(build.of(first))
    if second is not None:
        loop = f"for a in {parts} for b in {build.parts(second)} if a.id != b.id"
    elif own > FEW and least and expression == "a.center_distance(b)":
        alike = f"[p for p in {parts} if abs(p.diameter - size) < 1e-05]"
        sizes = f"for size in different([p.diameter for p in {parts}], 1e-05)"
        loop = f"{sizes} for a, b in nearest({alike})" if likes else f"for a, b in nearest({parts})"
    elif likes:
        loop += " if abs(a.diameter - b.diameter) < 1e-05"
    build.lines.append(f"found = [{expression} {loop}]")
    if "center[" in expression and reduce not in (Reduce.LARGEST, Reduce.EACH):  # along an axis: in a row, or apart
        aside = [i for i in range(3) if f"center[{i}]" not in expression]
        row = f"all(abs(a.center[i] - b.center[i]) < 1e-04 for i in {aside})"
        if second is None:
            build.lines[-1] = f"found = [{expression} {loop} if {row}] or [{expression} {loop}]"
        build.lines.append(f"found = [d for d in found if d > {SLACK:g}] or found")
    reduced = {Reduce.EACH: "found", Reduce.DIFFERENT: "different(found)", **REDUCED}
    return reduced.get(reduce, "found[0] if len(different(found, 1e-05)) == 1 else min(found)")


def _has_likes(parts: Sequence[Part]) -> bool:
    """Have half of several round parts or more, not all, one of their diameter? Distances are asked of like ones."""
    sizes = Counter(round(part.diameter or 0.0, 5) for part in parts)
    alike = sum(number for number in sizes.values() if number > 1)
    return len(sizes) > 1 and 2 * alike >= len(parts) and all(sizes)


def _between(build: Builder, form: Distance, two: bool) -> str:
    """The distance of 'a' and 'b': of round or like parts between centres, else from surface to surface."""
    parts = build.all_of(form.first, form.second)
    if not parts:
        raise Unwritable
    flat = all(part.kind in _FLAT and part.diameter is None for part in parts)
    alike = len({part.kind for part in parts}) == 1
    usual = alike or all(part.axis is not None for part in parts)
    behind = all(part.kind.stands_out and turned(part) is not None for part in parts) and len(_apart(parts)) == 1
    own = ("center", "near") if usual and not (flat and two) and not behind else ("near", "center")
    names = {"centers": ("center", "axis"), "surfaces": ("near",)}.get(form.mode, (*own, "axis"))
    modes = {"center": _center_distance(build, form), "near": _surface_distance(build, form)}
    if form.axis is not None:
        apart = f"abs(a.center[{form.axis}] - b.center[{form.axis}])"
        ends = f"a.half_extents[{form.axis}] - b.half_extents[{form.axis}]"
        modes = {"center": apart, "near": f"max(0.0, {apart} - {ends})"}
    elif (form.mode == "centers" or (two and not alike)) and _are_crossed(parts):
        modes["axis"] = "offset(a, b)"
    elif two and (not alike or form.mode == "centers"):
        first, last = turned(parts[0]), turned(parts[-1])
        beside = {last, first if parts[0].axis is not None or last is None else None} - {None}
        if beside and ".normal" not in modes["center"]:  # from an axis
            planar = (f"(a.center[{i}] - b.center[{i}]) ** 2" for i in range(3) if i not in beside)
            modes["axis"] = f"({' + '.join(planar)}) ** 0.5"
    return build.chosen({name: modes[name] for name in names if name in modes}, kinds(parts))


def _surface_distance(build: Builder, form: Distance) -> str:
    """Between the surfaces of 'a' and 'b'; of two that follow each other on one axis along it: a shoulder, a groove."""
    first, second = (build.of(one) if isinstance(one, PartQuery) else () for one in (form.first, form.second))
    axes = {None if part.axis is None else coordinate_axis(part.axis) for part in (*first, *second)}
    along = axes.pop() if len(axes) == 1 and second else None
    if along is None:
        return "a.distance_to(b)"
    for a, b in product(first, second):
        apart = [abs(x - y) for x, y in zip(a.center, b.center, strict=True)]
        if (
            max(apart[along - 1], apart[along - 2]) > DRAWING_M
            or apart[along] < (a.extents[along] + b.extents[along]) / 2
        ):
            return "a.distance_to(b)"
    return f"abs(a.center[{along}] - b.center[{along}]) - a.half_extents[{along}] - b.half_extents[{along}]"


def _are_crossed(parts: Sequence[Part]) -> bool:
    """Have all of them an axis, and not all one direction?"""
    axes = [part.axis for part in parts if part.axis is not None]
    return len(axes) == len(parts) and any(norm(cross(axes[0], axis)) > _PARALLEL for axis in axes)


def _center_distance(build: Builder, form: Distance) -> str:
    """Between the middles of 'a' and 'b'; of a plane and what is none along the normal of the plane."""
    ends = {x: build.of(q) for x, q in (("a", form.first), ("b", form.second)) if isinstance(q, PartQuery)}
    flat = [x for x, parts in ends.items() if all(part.kind is PartKind.FACE and part.normal for part in parts)]
    if len(ends) < 2 or len(flat) != 1:
        return "a.center_distance(b)"
    return f"abs(sum((x - y) * n for x, y, n in zip(a.center, b.center, {flat[0]}.normal)))"


def turned(part: Part) -> int | None:
    """Along which of x, y, z is the axis of what is round: its own, or the one square to two equal extents?"""
    if (along := along_axis(part)) is not None:
        return along
    equal = [i for i in range(3) if abs(part.extents[i - 1] - part.extents[i - 2]) < SLACK]
    return equal[0] if len(equal) == 1 else None


def _over(build: Builder, form: Distance, first: PartQuery) -> str:
    """Over the outsides of several parts, along an axis or the one along which they lie furthest apart."""
    queries = [query for query in (first, form.second) if isinstance(query, PartQuery)]
    found = build.all_of(*queries)
    if len(found) < 2 or not all(map(build.of, queries)):
        raise Unwritable
    spread = _spread(found)
    if len(queries) > 1 and (normal := found[0].normal) is not None:  # from a keyway's floor across the bore
        spread = [abs(x) for x in normal]
    i = form.axis if form.axis is not None else max(range(3), key=spread.__getitem__)
    build.lines.append(f"found = {' + '.join(f'list({build.parts(query)})' for query in queries)}")
    build.reads.append(Read("distance", kinds(found), "outsides", "own"))
    lower = f"min(p.center[{i}] - p.half_extents[{i}] for p in found)"
    return f"max(p.center[{i}] + p.half_extents[{i}] for p in found) - {lower}"


def _clearance(build: Builder, form: Distance, first: PartQuery, second: PartQuery) -> str:
    """The least difference of the diameters, or radii, of two coaxial cylinders of which one runs in the other."""
    if not (build.of(first) and build.of(second)):
        raise Unwritable
    pairs = f"for p in {build.parts(first)} for q in {build.parts(second)}"
    own = "for a in p.faces for b in q.faces"
    bodies = " ".join(f'for {x} in faces(kind="cylinder", body={y}.faces[0].body)' for x, y in ("ap", "bq"))
    round_ones = 'a.kind == b.kind == "cylinder" and {a.convexity, b.convexity} == {"convex", "concave"}'
    alongside = "sum(abs(x - y) * abs(z) for x, y, z in zip(a.center, b.center, a.axis)) < (a.length + b.length) / 2"
    bore = '(1 if a.convexity == "concave" else -1) * (a.radius - b.radius)'
    fit = f"if {round_ones} and coaxial(a, b) and {alongside}"
    build.lines.append(f"found = [{bore} {pairs} {own} {fit}]")
    build.lines.append(f"found = found or [{bore} {pairs} {bodies} {fit} and a.body != b.body]")
    build.reads.append(Read("distance", kinds(build.all_of(first, second)), form.mode, "own"))
    return f"{'' if form.mode == 'on radius' else '2 * '}min(d for d in found if d > -{SLACK:g})"


def _within(build: Builder, form: Distance, first: PartQuery, second: PartQuery) -> str:
    """How far the parts reach into the others: along their axis, or where they do not lie within them altogether.

    Raises Unwritable where the axis lies along none of x, y and z.
    """
    parts, others = build.of(first), build.of(second)
    if is_oblique(parts):
        raise Unwritable
    ends = ends_of(parts, others)
    along, _ = side_axis(ends[0])
    if along_axis(parts[0]) is None:
        crosses = {side_axis(side)[0] for side in Side if reach(parts[0], side) > max(reach(o, side) for o in others)}
        along = next(iter(crosses), along)
    low, high = (outermost(build, second, along, sign) for sign in "-+")
    middle, half = f"p.center[{along}]", f"p.half_extents[{along}]"
    shared = f"min({middle} + {half}, high) - max({middle} - {half}, low)"
    found = f"[max(0.0, {shared}) for p in {build.parts(first)}]"
    build.lines += [f"low, high = {low}, {high}", f"found = {found}"]
    build.reads.append(Read("distance", kinds([*parts, *others]), form.mode, "own"))
    return "found[0] if len(different(found, 1e-05)) == 1 else found"


def _across(build: Builder, form: Distance, first: PartQuery, second: PartQuery) -> str:
    """From the flat floor of what is cut into something round, past its axis, to the opposite side."""
    if not (build.of(first) and any(part.radius for part in build.of(second))):
        raise Unwritable
    floors = 'f.kind == "plane" and abs(sum(x * y for x, y in zip(f.normal, p.normal))) > 0.99'
    beside = "sum((x - y) * z for x, y, z in zip(f.center, q.center, f.normal))"
    pairs = f"for p in {build.parts(first)} for q in {build.parts(second)} for f in p.faces"
    build.lines.append(f"found = [abs({beside}) + q.radius {pairs} if {floors}]")
    build.reads.append(Read("distance", kinds(build.all_of(first, second)), form.mode, "own"))
    return "found[0] if len(different(found, 1e-05)) == 1 else found"


def _amid(build: Builder, form: Distance, first: PartQuery, second: PartQuery) -> str:
    """From the middle of all the others, whose ids differ; of one that is round from its axis."""
    parts, others = build.of(first), [part for part in build.of(second) if part not in build.of(first)]
    if not (parts and others):
        raise Unwritable
    along = turned(parts[0]) if form.axis is None else None
    axes = [form.axis] if form.axis is not None else [i for i in range(3) if i != along]
    build.lines += [
        f"rest = [q for q in {build.parts(second)} if q.id not in [p.id for p in {build.parts(first)}]]",
        f"middle = [sum(q.center[i] for q in rest) / len(rest) for i in {axes}]",
        f"found = [sum((p.center[i] - m) ** 2 for i, m in zip({axes}, middle)) ** 0.5 for p in {build.parts(first)}]",
    ]
    build.reads.append(Read("distance", kinds([*parts, *others]), form.mode, "own"))
    return "found[0] if len(different(found, 1e-05)) == 1 else found"


_FITS = {"amid": _amid, "within": _within, "across": _across, "on diameter": _clearance, "on radius": _clearance}


def overlapping(build: Builder, form: Distance) -> str:
    """The pairs of bodies that take the same room, as an expression."""
    if any(part.kind != "body" for part in build.all_of(form.first, form.second)):
        raise Unwritable
    names = [build.parts(query) for query in (form.first, form.second) if isinstance(query, PartQuery)]
    return f"overlaps({', '.join(names)})"


# To places


def _from_mass(build: Builder, other: Anchor | str, axis: int | None) -> str:
    """From the centre of mass: to the axis of what is round, to a plane, to the middle of a part or of the model."""
    mass, across = "shape.center_of_mass", list(range(3)) if axis is None else [axis]
    match other:
        case Boundary(Side() as side) if not (other.of or other.axis):
            i, sign = side_axis(side)
            return f"abs(shape.{'max' if sign == '+' else 'min'}_corner[{i}] - {mass}[{i}])"
        case Plane(Side() as side, of):
            i, sign = side_axis(side)
            return f"abs({outermost(build, of, i, sign)} - {mass}[{i}])"
        case PartQuery() if build.of(other):
            along = along_axis(build.of(other)[0]) if axis is None else None
            across, point = [i for i in across if i != along], f"{build.parts(other)}[0].center"
        case Origin():
            point = "(0.0, 0.0, 0.0)"
        case None:
            point = "shape.center"
        case _:
            raise Unwritable
    return f"sum(({mass}[i] - {point}[i]) ** 2 for i in {across}) ** 0.5"


def _both_ends(build: Builder, of: PartQuery | None, along: int) -> tuple[int, str, str]:
    """Which axis is along the longer side of a part, or across it, and from where to where the part reaches there."""
    base = [build.whole] if of is None else build.of(of)
    if not base:
        raise Unwritable
    i = sorted(range(3), key=lambda k: base[0].extents[k], reverse=True)[along - LONGEST]
    if of is None:
        return i, f"shape.min_corner[{i}]", f"shape.max_corner[{i}]"
    name = f"{build.parts(of)}[0]"
    return i, f"({name}.center[{i}] - {name}.half_extents[{i}])", f"({name}.center[{i}] + {name}.half_extents[{i}])"


def _to_place(build: Builder, first: PartQuery, place: Boundary | Origin | None, form: Distance) -> str:
    """To an edge, to the outside of the model on one side, to its middle or to the origin."""
    found = build.of(first)
    match place:
        case Boundary(None, of, int() as longest):
            x, low, high = _both_ends(build, of, longest)
            middle = f"min(p.center[{x}] - {low}, {high} - p.center[{x}])"
            modes = {"center": middle, "near": f"{middle} - p.half_extents[{x}]"}
            round_parts = bool(found) and found[0].axis is not None
            names = ("center", "near") if form.mode == "centers" or round_parts else ("near", "center")
            modes = {name: modes[name] for name in names if form.mode != "surfaces" or name == "near"}
        case Boundary(None):
            modes = {"near": "p.edge_distance()"}
            if form.mode != "surfaces" and found and found[0].radius is not None:
                center = {"center": "p.edge_distance() + p.radius"}
                modes = center | modes if form.mode == "centers" else modes | center
        case Boundary(Side() as side):
            i, sign = side_axis(side)
            middle = (
                f"shape.max_corner[{i}] - p.center[{i}]" if sign == "+" else f"p.center[{i}] - shape.min_corner[{i}]"
            )
            center, near = {"center": middle}, {"near": f"{middle} - p.half_extents[{i}]"}
            ends = near | {"far": f"{middle} + p.half_extents[{i}]"}
            round_parts = bool(found) and found[0].kind in (PartKind.HOLE, PartKind.BOSS, PartKind.CYLINDER)
            modes = center | ends if form.mode == "centers" or round_parts else ends | center
            modes = near if form.mode == "surfaces" else modes
        case _:
            point = "shape.center" if place is None else "(0.0, 0.0, 0.0)"
            modes = {"center": f"distance(p.center, {point})"}
            if form.axis is not None:
                modes = {"center": f"abs(p.center[{form.axis}] - {point}[{form.axis}])"}
            elif found and (along := along_axis(found[0])) is not None:
                planar = (f"(p.center[{i}] - {point}[{i}]) ** 2" for i in range(3) if i != along)
                axis = {"axis": f"({' + '.join(planar)}) ** 0.5"}
                modes = axis | modes if place is None else modes | axis
    return of_each(build, first, modes, form.reduce)
