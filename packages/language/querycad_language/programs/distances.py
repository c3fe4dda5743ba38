"""Distances, angles and sides: the lines that measure them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import AnswerType, Part, PartQuery, Side
from querycad_language.forms import LONGEST, SHORTER, Behind, Boundary, Distance, Origin, Plane, Reduce, Target

from .draft import Draft, Unwritable

SLACK = 1e-6
"""Metres within which two lengths are one."""
FEW = 60
"""Every two of so many are measured in a run's 2,000 calls; of more only the nearest neighbours, for the least."""
_PARALLEL = 0.9999
"""Cosine of what is still parallel: 0.8 degrees."""


def pairwise(draft: Draft, first: PartQuery, second: Target, expression: str, reduce: Reduce) -> str:
    """The expression of 'a' and 'b' for every two parts."""
    parts = draft.parts(first)
    if second is None:
        if len(draft.of(first)) < 2:
            raise Unwritable
        one_size = len({part.diameter for part in draft.of(first)}) == 1
        by_centre = expression in ("a.center_distance(b)", *(("a.distance_to(b)",) if one_size else ()))
        few = len(draft.of(first)) <= FEW or not by_centre or reduce not in (Reduce.ONE, Reduce.SMALLEST)
        loop = f"for i, a in enumerate({parts}) for b in {parts}[i + 1 :]" if few else f"for a, b in nearest({parts})"
    else:
        loop = f"for a in {parts} for b in {draft.parts(second)} if a.id != b.id"
    draft.lines.append(f"found = [{expression} {loop}]")
    if "center[" in expression and reduce not in (
        Reduce.LARGEST,
        Reduce.EACH,
    ):  # along an axis, of those that lie apart
        draft.lines.append(f"found = [d for d in found if d > {SLACK:g}] or found")
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


def directions(draft: Draft, first: PartQuery, second: Target, reduce: Reduce) -> str:
    """Angles between axes or normals; of flat parts also what they enclose. Raises Unwritable: some have neither."""
    parts = [*draft.of(first), *(draft.of(second) if second is not None else ())]
    if any(part.axis is None and part.normal is None for part in parts):
        raise Unwritable
    meanings = {"between": "a.angle_to(b)"}
    if len({part.axis is None or "plate" in part.tags for part in parts}) > 1:  # what an axis and a plane enclose
        meanings = {"inclined": "1.5707963267948966 - a.angle_to(b)"} | meanings
    if reduce is Reduce.ONE and all(part.axis is None for part in parts):
        meanings["enclosed"] = "3.141592653589793 - a.angle_to(b)"
    return pairwise(draft, first, second, draft.chosen(meanings, _kind(parts)), reduce)


def angle_between(draft: Draft, first: PartQuery, second: Target) -> str:
    """Between axes; of several parts with parallel axes about their common middle: the pitch of a bolt circle."""
    axes = [part.axis for part in draft.of(first) if part.axis is not None]
    parallel = all(abs(sum(a * b for a, b in zip(axes[0], axis, strict=True))) > _PARALLEL for axis in axes)
    if second is not None or len(axes) < 3 or len(axes) < len(draft.of(first)) or not parallel:
        return directions(draft, first, second, Reduce.ONE)
    name = draft.parts(first)
    draft.lines.append("import math")
    draft.lines.append(f"middle = [sum(p.center[i] for p in {name}) / len({name}) for i in range(3)]")
    draft.lines.append(f"arms = [[p.center[i] - middle[i] for i in range(3)] for p in {name}]")
    cosine = "sum(u * v for u, v in zip(a, b)) / (math.hypot(*a) * math.hypot(*b))"
    draft.lines.append(
        f"found = [math.acos(max(-1.0, min(1.0, {cosine}))) for i, a in enumerate(arms) for b in arms[i + 1 :]]"
    )
    return "min(found)"


def _axis(draft: Draft, axis: int | None) -> int | None:
    """Which of x, y, z: the sides of the model by their length where the words say so."""
    if axis not in (LONGEST, SHORTER):
        return axis
    order = sorted(range(3), key=lambda i: draft.whole.extents[i], reverse=True)
    return order[axis - LONGEST]


def distance(draft: Draft, form: Distance) -> tuple[str, AnswerType]:
    """How far apart the two ends of a distance are, as an expression and its type."""
    form = replace(form, axis=_axis(draft, form.axis))
    first, second = form.first, form.second
    if form.mode == "overlap":
        return f"sum(a.overlap_with(b) for a, b in {overlapping(draft, form)})", AnswerType.VOLUME
    if isinstance(first, Plane) or isinstance(second, Plane):
        return _from_plane(draft, first, second, form.mode), AnswerType.LENGTH
    if not isinstance(first, PartQuery):
        first, second = second, first  # type: ignore[assignment]
    if not isinstance(first, PartQuery):
        raise Unwritable
    kind = AnswerType.LENGTHS if form.reduce is Reduce.DIFFERENT else AnswerType.LENGTH
    if isinstance(second, Behind):
        second = Boundary(_behind(draft.of(first)))
        form = replace(form, mode="surfaces")
    if isinstance(second, Boundary | Origin) or second is None:
        return _to_place(draft, first, second, form), kind
    other = second if isinstance(second, PartQuery) else None
    parts = [*draft.of(first), *(draft.of(other) if other is not None else ())]
    between = _between(draft, form, parts, other is not None)
    reduce = form.reduce
    return pairwise(draft, first, other, between, reduce), kind


def overlapping(draft: Draft, form: Distance) -> str:
    """The pairs of bodies that take the same room, as an expression."""
    queries = [query for query in (form.first, form.second) if isinstance(query, PartQuery)]
    if any(part.kind != "body" for query in queries for part in draft.of(query)):
        raise Unwritable
    names = [draft.parts(query) for query in queries]
    return f"overlaps({', '.join(names)})"


def several(draft: Draft, forms: Sequence[Distance]) -> str:
    """One value each of several distances."""
    names = []
    for index, form in enumerate(forms):
        value, _ = distance(draft, form)
        draft.lines.append(f"value{index} = {value}")
        names.append(f"value{index}")
    return f"[{', '.join(names)}]"


def _behind(parts: Sequence[Part]) -> Side:
    """The side that the openings of these parts look away from; the bottom where they have none."""
    normal = next((part.normal for part in parts if part.normal is not None), None)
    if normal is None:
        return Side.BOTTOM
    return max(Side, key=lambda side: -sum(a * b for a, b in zip(side.outward, normal, strict=True)))


def _from_plane(draft: Draft, first: object, second: object, mode: str) -> str:
    """Along the normal of a part's outer plane, to another plane, to a boundary of the model, or to parts."""
    if isinstance(first, Plane) and isinstance(second, Plane) and first.side is None:
        side = _beyond(draft.of(first.of), draft.of(second.of))
        first, second = replace(first, side=side), replace(second, side=side)
    plane, other = (first, second) if isinstance(first, Plane) else (second, first)
    assert isinstance(plane, Plane)
    assert plane.side is not None
    axis = next(i for i, value in enumerate(plane.side.outward) if value)
    at = _plane_at(draft, plane, axis)
    if isinstance(other, Plane):
        return _each_of(draft, plane, axis, f"({_plane_at(draft, other, axis)})")
    if isinstance(other, Boundary):
        if other.side is None or not other.side.outward[axis]:
            raise Unwritable
        corner = "max" if other.side.outward[axis] > 0 else "min"
        return _each_of(draft, plane, axis, f"shape.{corner}_corner[{axis}]")
    if isinstance(other, Origin):
        return f"abs({at})"
    if not isinstance(other, PartQuery):
        raise Unwritable
    parts = draft.parts(other)
    center = f"abs(p.center[{axis}] - ({at}))"
    ends = [f"abs(p.center[{axis}] {sign} p.half_extents[{axis}] - ({at}))" for sign in "+-"]
    round_parts = any(part.axis is not None for part in draft.of(other))
    modes = {"center": center, "far": f"max({', '.join(ends)})", "near": f"min({', '.join(ends)})"}
    usual = ("center", "far", "near") if round_parts else ("near", "far", "center")
    names = {"centers": ("center",), "surfaces": ("near", "far")}.get(mode, usual)
    expression = draft.chosen({name: modes[name] for name in names}, _kind(draft.of(other)))
    draft.lines.append(f"found = [{expression} for p in {parts}]")
    return "found" if other.plural else "found[0] if len(different(found, 1e-05)) == 1 else found"


def _beyond(parts: Sequence[Part], others: Sequence[Part]) -> Side:
    """The end of a part, along its axis or its longest side, that reaches furthest beyond other parts."""
    if not parts or not others:
        raise Unwritable
    part = parts[0]
    along = max(range(3), key=lambda i: abs(part.axis[i]) if part.axis is not None else part.extents[i])

    def reach(side: Side) -> float:
        sign = side.outward[along]
        far = [sign * one.center[along] + one.extents[along] / 2 for one in others]
        return sign * part.center[along] + part.extents[along] / 2 - max(far)

    return max((side for side in Side if side.outward[along]), key=reach)


def _each_of(draft: Draft, plane: Plane, axis: int, level: str) -> str:
    """How far the plane, or that of each of several parts, lies from a level."""
    if not plane.of.plural:
        return f"abs({_plane_at(draft, plane, axis)} - {level})"
    assert plane.side is not None
    sign = "+" if plane.side.outward[axis] > 0 else "-"
    return f"[abs(p.center[{axis}] {sign} p.half_extents[{axis}] - {level}) for p in {draft.parts(plane.of)}]"


def _plane_at(draft: Draft, plane: Plane, axis: int) -> str:
    assert plane.side is not None
    sign, pick = ("+", "max") if plane.side.outward[axis] > 0 else ("-", "min")
    if not draft.of(plane.of):
        raise Unwritable
    return f"{pick}(q.center[{axis}] {sign} q.half_extents[{axis}] for q in {draft.parts(plane.of)})"


def _between(draft: Draft, form: Distance, parts: Sequence[Part], two: bool) -> str:
    """The distance of 'a' and 'b': of round or like parts between centres, else from surface to surface."""
    if not parts:
        raise Unwritable
    flat = all(
        part.kind in ("body", "prism", "rib", "protrusion", "wall", "face") and part.diameter is None for part in parts
    )
    alike = len({part.kind for part in parts}) == 1
    usual = alike or all(part.axis is not None for part in parts)
    own = ("center", "near") if usual and not (flat and two) else ("near", "center")
    names = {"centers": ("center",), "surfaces": ("near",)}.get(form.mode, own)
    modes = {"center": "a.center_distance(b)", "near": "a.distance_to(b)"}
    if form.axis is not None:
        apart = f"abs(a.center[{form.axis}] - b.center[{form.axis}])"
        ends = f"a.half_extents[{form.axis}] - b.half_extents[{form.axis}]"
        modes = {"center": apart, "near": f"max(0.0, {apart} - {ends})"}
    return draft.chosen({name: modes[name] for name in names}, _kind(parts))


def _kind(parts: Sequence[Part]) -> str:
    """What a distance is measured from: the kind of the parts, or both."""
    return "+".join(sorted({part.kind for part in parts})[:2])


def _to_place(draft: Draft, first: PartQuery, place: Boundary | Origin | None, form: Distance) -> str:
    parts = draft.parts(first)
    found = draft.of(first)
    if isinstance(place, Boundary) and place.side is None:
        modes = {"near": "p.edge_distance()"}
        if form.mode != "surfaces" and found and found[0].radius is not None:
            center = {"center": "p.edge_distance() + p.radius"}
            modes = center | modes if form.mode == "centers" else modes | center
    elif isinstance(place, Boundary):
        assert place.side is not None
        i = next(i for i, value in enumerate(place.side.outward) if value)
        positive = place.side.outward[i] > 0
        middle = f"shape.max_corner[{i}] - p.center[{i}]" if positive else f"p.center[{i}] - shape.min_corner[{i}]"
        ends = {"near": f"{middle} - p.half_extents[{i}]", "far": f"{middle} + p.half_extents[{i}]"}
        round_parts = bool(found) and found[0].kind in ("hole", "boss", "cylinder")
        modes = {"center": middle} | ends if form.mode == "centers" or round_parts else ends | {"center": middle}
        modes = {"near": ends["near"]} if form.mode == "surfaces" else modes
    else:
        point = "shape.center" if place is None else "(0.0, 0.0, 0.0)"
        along_axis = f"abs(p.center[{form.axis}] - {point}[{form.axis}])"
        modes = {"center": along_axis if form.axis is not None else f"distance(p.center, {point})"}
        if form.axis is None and found and found[0].axis is not None and place is None:
            along = max(range(3), key=lambda i: abs(found[0].axis[i]))  # type: ignore[index]
            planar = [i for i in range(3) if i != along]
            terms = " + ".join(f"(p.center[{i}] - shape.center[{i}]) ** 2" for i in planar)
            modes = {"axis": f"({terms}) ** 0.5"} | modes
    expression = draft.chosen(modes, _kind(found))
    draft.lines.append(f"found = [{expression} for p in {parts}]")
    if form.reduce is Reduce.LARGEST:
        return "max(found)"
    if form.reduce is Reduce.SMALLEST:
        return "min(found)"
    return "found" if first.plural else "found[0] if len(different(found, 1e-05)) == 1 else found"


def towards(draft: Draft, target: PartQuery, sides: Sequence[Side]) -> str:
    """The side that the parts' openings, or else their centres, are nearest to, by shares of the extents."""
    if not draft.of(target):
        raise Unwritable
    point = "opening" if all(part.opening is not None for part in draft.of(target)) else "center"
    name = draft.parts(target)
    for side in sides:
        i = next(i for i, value in enumerate(side.outward) if value)
        sign = "" if side.outward[i] > 0 else "-"
        share = f"(p.{point}[{i}] - shape.center[{i}]) / shape.half_extents[{i}]"
        draft.lines.append(f"{side.value} = {sign}sum({share} for p in {name})")
    found = ", ".join(f'({side.value}, "{side.value}")' for side in sides)
    return f"max({found})[1]"
