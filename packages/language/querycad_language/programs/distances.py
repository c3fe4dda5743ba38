"""Distances, angles and sides: the lines that measure them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import AnswerType, Part, PartQuery, Side
from querycad_language.forms import (
    LONGEST,
    SHORTER,
    Behind,
    Boundary,
    Distance,
    Origin,
    Plane,
    Reduce,
    Target,
    Touching,
)

from .draft import Draft, Read, Unwritable

SLACK = 1e-6
"""Metres within which two lengths are one."""
FEW = 60
"""Every two of so many are measured in a run's 2,000 calls; of more only the nearest neighbours, for the least."""
CALLS = 2000
"""Of a run; a program that is sure to make more is not written where each takes the kernel."""
MEASURED = 100
"""So many pairs have their surfaces measured, hundredths of a second each; of more those whose boxes are nearest."""
_FASTENERS = ["screw", "nut", "washer"]
"""Tags of bodies that hold others."""
_PARALLEL = 0.9999
"""Cosine of what is still parallel: 0.8 degrees."""


def pairwise(draft: Draft, first: PartQuery, second: Target, expression: str, reduce: Reduce) -> str:
    """The expression of 'a' and 'b' for every two parts."""
    parts, least = draft.parts(first), reduce in (Reduce.ONE, Reduce.SMALLEST)
    own, others = len(draft.of(first)), "" if second is None else f", {draft.parts(second)}"
    pairs = own * (own - 1) // 2 if second is None else own * len(draft.of(second))
    if second is None and own < 2:
        raise Unwritable
    if expression == "a.distance_to(b)" and pairs > (MEASURED if least else CALLS):
        if not least:
            raise Unwritable
        draft.lines.append(f"a, b = closest({parts}{others})")
        return expression
    if second is not None:
        loop = f"for a in {parts} for b in {draft.parts(second)} if a.id != b.id"
    elif own > FEW and least and expression == "a.center_distance(b)":
        loop = f"for a, b in nearest({parts})"
    else:
        loop = f"for i, a in enumerate({parts}) for b in {parts}[i + 1 :]"
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
    return pairwise(draft, first, second, draft.chosen(_between_directions(parts, reduce), _kind(parts)), reduce)


def _between_directions(parts: Sequence[Part], reduce: Reduce) -> dict[str, str]:
    """What the angle of 'a' and 'b' can mean."""
    if any(part.axis is None and part.normal is None for part in parts):
        return {}
    meanings = {"between": "a.angle_to(b)"}
    if len({part.axis is None or "plate" in part.tags for part in parts}) > 1:  # what an axis and a plane enclose
        meanings = {"inclined": "1.5707963267948966 - a.angle_to(b)"} | meanings
    if reduce is Reduce.ONE and all(part.axis is None for part in parts):
        meanings["enclosed"] = "3.141592653589793 - a.angle_to(b)"
    return meanings


def angle_between(draft: Draft, first: PartQuery, second: Target) -> str:
    """Between directions, or about an axis: the pitch of a bolt circle, a keyway and the cross hole opposite."""
    parts = [*draft.of(first), *(draft.of(second) if second is not None else ())]
    if len(parts) < 2:
        raise Unwritable
    axes = [part.axis for part in parts if part.axis is not None]
    parallel = len(axes) == len(parts) and all(abs(_dot(axes[0], axis)) > _PARALLEL for axis in axes)
    if parallel and second is None and len(parts) > 2:
        return _about(draft, first, None, None)
    meanings = _between_directions(parts, Reduce.ONE)
    if (along := _turned(draft.whole)) is not None:  # the angle of parallel axes is none
        meanings = {"about": ""} | meanings if parallel else meanings | {"about": ""}
    chosen = draft.chosen(meanings, _kind(parts))
    return pairwise(draft, first, second, chosen, Reduce.ONE) if chosen else _about(draft, first, second, along)


def _turned(part: Part) -> int | None:
    """Along which of x, y, z is the axis of what is round: its own, or the one square to two equal extents?"""
    if part.axis is not None:
        return max(range(3), key=[abs(x) for x in part.axis].__getitem__)
    extents = part.extents
    equal = [i for i in range(3) if abs(extents[i - 1] - extents[i - 2]) < SLACK]
    return equal[0] if len(equal) == 1 else None


def _about(draft: Draft, first: PartQuery, second: Target, along: int | None) -> str:
    """The least angle between the arms to two parts, from their common middle or from the axis of a round model."""
    names = [draft.parts(query) for query in (first, second) if query is not None]
    middle = f"[sum(p.center[i] for p in {names[0]}) / len({names[0]}) for i in range(3)]"
    point = "p.center" if along is None else "(p.opening or p.center)"
    draft.lines += ["import math", f"middle = {middle if along is None else 'shape.center'}"]
    for index, name in enumerate(names):
        arm = f"[{point}[i] - middle[i] for i in {[i for i in range(3) if i != along]}]"
        draft.lines.append(f"arms{index} = [{arm} for p in {name}]")
    pairs = "for a in arms0 for b in arms1" if second else "for i, a in enumerate(arms0) for b in arms0[i + 1 :]"
    draft.lines.append(f"pairs = [(a, b) {pairs} if math.hypot(*a) * math.hypot(*b) > 0]")
    cosine = "sum(u * v for u, v in zip(a, b)) / (math.hypot(*a) * math.hypot(*b))"
    return f"min([math.acos(max(-1.0, min(1.0, {cosine}))) for a, b in pairs])"


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def _axis(draft: Draft, form: Distance) -> int | None:
    """Which of x, y, z: where the words say so one of the longer sides along which the parts lie apart."""
    if form.axis not in (LONGEST, SHORTER):
        return form.axis
    order = sorted(range(3), key=lambda i: draft.whole.extents[i], reverse=True)
    parts = draft.of(form.first) if isinstance(form.first, PartQuery) and form.second == "each other" else ()
    apart = [
        i for i in order if len(parts) > 1 and max(p.center[i] for p in parts) - min(p.center[i] for p in parts) > SLACK
    ]
    return (apart if len(apart) > 1 else order)[form.axis - LONGEST]


def distance(draft: Draft, form: Distance) -> tuple[str, AnswerType]:
    """How far apart the two ends of a distance are, as an expression and its type."""
    form = replace(form, axis=_axis(draft, form))
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
    if form.mode == "outsides":
        return _over(draft, form, first), kind
    other = second if isinstance(second, PartQuery) else None
    parts = [*draft.of(first), *(draft.of(other) if other is not None else ())]
    between = _between(draft, form, parts, other is not None)
    reduce = form.reduce
    return pairwise(draft, first, other, between, reduce), kind


def _over(draft: Draft, form: Distance, first: PartQuery) -> str:
    """Over the outsides of several parts, along an axis or the one along which they lie furthest apart."""
    queries = [query for query in (first, form.second) if isinstance(query, PartQuery)]
    found = [part for query in queries for part in draft.of(query)]
    if len(found) < 2 or not all(map(draft.of, queries)):
        raise Unwritable
    spread = [max(p.center[i] for p in found) - min(p.center[i] for p in found) for i in range(3)]
    if len(queries) > 1 and (normal := found[0].normal) is not None:  # from a keyway's floor across the bore
        spread = [abs(x) for x in normal]
    i = form.axis if form.axis is not None else max(range(3), key=spread.__getitem__)
    parts = " + ".join(f"list({draft.parts(query)})" for query in queries)
    draft.lines.append(f"found = {parts}")
    draft.reads.append(Read("distance", _kind(found), "outsides", "own"))
    lower = f"min(p.center[{i}] - p.half_extents[{i}] for p in found)"
    return f"max(p.center[{i}] + p.half_extents[{i}] for p in found) - {lower}"


def overlapping(draft: Draft, form: Distance) -> str:
    """The pairs of bodies that take the same room, as an expression."""
    queries = [query for query in (form.first, form.second) if isinstance(query, PartQuery)]
    if any(part.kind != "body" for query in queries for part in draft.of(query)):
        raise Unwritable
    names = [draft.parts(query) for query in queries]
    return f"overlaps({', '.join(names)})"


def touching(draft: Draft, form: Touching) -> str:
    """The bodies that touch others, as an expression; those whose boxes are apart are not measured.

    Fasteners hold what they touch, and what other fasteners do that they touch: a nut by its screw and a washer.
    """
    if any(part.kind != "body" for query in (form.target, form.other) for part in draft.of(query)):
        raise Unwritable
    found, others = draft.parts(form.target), draft.parts(form.other)
    room = "abs(p.center[i] - q.center[i]) <= p.half_extents[i] + q.half_extents[i] + 1e-06"
    meets = f"any(all({room} for i in range(3)) and p.distance_to(q) <= 1e-06 for q in taken)"
    draft.lines.append(f"taken = [q for q in {others}]")
    if not form.held:
        return f"[p for p in {found} if p.id not in [q.id for q in taken] and {meets}]"
    fastens = f"any(tag in p.tags for tag in {_FASTENERS})"
    draft.lines += [
        f'fasteners = [p for p in find_parts({{"noun": "body", "plural": True}}) if {fastens}]',
        "for _ in range(2):",
        f"    taken += [p for p in fasteners if p.id not in [q.id for q in taken] and {meets}]",
    ]
    return f"[p for p in {found} if not {fastens} and p.id not in [q.id for q in taken] and {meets}]"


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
    if isinstance(first, Plane) and isinstance(second, Plane):
        first, second = _sided(draft, first, second)
    plane, other = (first, second) if isinstance(first, Plane) else (second, first)
    assert isinstance(plane, Plane)
    if plane.side is None:
        if not isinstance(other, PartQuery):
            raise Unwritable
        plane = replace(plane, side=_nearest_end(draft.of(plane.of), draft.of(other)))
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


def _sided(draft: Draft, first: Plane, second: Plane) -> tuple[Plane, Plane]:
    """Two planes with their sides: one that reaches beyond another, or 'from the top of the head to the end'."""
    named = first.side or second.side
    if named is not None:
        return replace(first, side=first.side or named.opposite), replace(second, side=second.side or named.opposite)
    if draft.of(first.of) == draft.of(second.of):
        raise Unwritable
    side = _beyond(draft.of(first.of), draft.of(second.of))
    return replace(first, side=side), replace(second, side=side)


def _beyond(parts: Sequence[Part], others: Sequence[Part]) -> Side:
    """The end of a part, along its axis or its longest side, that reaches furthest beyond other parts."""
    if not parts or not others:
        raise Unwritable
    part, along = parts[0], _length(parts[0])

    def reach(side: Side) -> float:
        sign = side.outward[along]
        far = [sign * one.center[along] + one.extents[along] / 2 for one in others]
        return sign * part.center[along] + part.extents[along] / 2 - max(far)

    return max((side for side in Side if side.outward[along]), key=reach)


def _nearest_end(parts: Sequence[Part], others: Sequence[Part]) -> Side:
    """The end of a part, along its axis or its longest side, that is nearest to the middle of another one."""
    if not parts or not others:
        raise Unwritable
    part, along = parts[0], _length(parts[0])

    def apart(side: Side) -> float:
        return abs(part.center[along] + side.outward[along] * part.extents[along] / 2 - others[0].center[along])

    return min((side for side in Side if side.outward[along]), key=apart)


def _length(part: Part) -> int:
    """Along which of x, y, z a part has its ends: its axis or its longest side."""
    axis = part.axis
    return max(range(3), key=lambda i: abs(axis[i]) if axis is not None else part.extents[i])


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
    names = {"centers": ("center", "axis"), "surfaces": ("near",)}.get(form.mode, (*own, "axis"))
    modes = {"center": "a.center_distance(b)", "near": "a.distance_to(b)"}
    if two and not alike and (along := _turned(parts[-1])) is not None:  # how far from the axis of the second part
        planar = [i for i in range(3) if i != along]
        modes["axis"] = f"({' + '.join(f'(a.center[{i}] - b.center[{i}]) ** 2' for i in planar)}) ** 0.5"
    if form.axis is not None:
        apart = f"abs(a.center[{form.axis}] - b.center[{form.axis}])"
        ends = f"a.half_extents[{form.axis}] - b.half_extents[{form.axis}]"
        modes = {"center": apart, "near": f"max(0.0, {apart} - {ends})"}
    return draft.chosen({name: modes[name] for name in names if name in modes}, _kind(parts))


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


def none_seen(draft: Draft, target: PartQuery, sides: Sequence[Side]) -> str:
    """The sides that none of the parts is seen from."""
    return f"[side for side in {_names(sides)} if not any(side in p.sides for p in {draft.parts(target)})]"


def _names(sides: Sequence[Side]) -> list[str]:
    return [side.value for side in sides]


def most_seen(draft: Draft, target: PartQuery, sides: Sequence[Side]) -> str:
    """The side that most of the parts are seen from; all of as many."""
    name = draft.parts(target)
    draft.lines.append(f"seen = {{side: sum(side in p.sides for p in {name}) for side in {_names(sides)}}}")
    return "', '.join(side for side in seen if seen[side] == max(seen.values()))"


def way_from(draft: Draft, target: PartQuery) -> str:
    """The sides from which tools or screws come in, each once."""
    if any(not part.approach for part in draft.of(target)) or not draft.of(target):
        raise Unwritable
    outward = ", ".join(f'("{side.value}", {side.outward})' for side in Side)
    draft.lines.append(f"ways = [p.approach[0] for p in {draft.parts(target)}]")
    draft.lines.append(f"sides = [{outward}]")
    along = "sum(a * b for a, b in zip(way, side[1]))"
    return f"sorted(set(min(sides, key=lambda side: {along})[0] for way in ways))"
