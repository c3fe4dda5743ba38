"""Distances: the lines that measure how far apart two anchors are, or every two of several parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import AnswerType, Bottom, Part, PartKind, PartQuery, Side
from querycad_language import forms
from querycad_language.forms import LONGEST, SHORTER, Anchor, Boundary, Distance, MassCentre, Origin, Plane, Reduce
from querycad_language.measures import WHOLE

from .builder import Builder, Read, Unwritable
from .meanings import CUT, along_axis

SLACK = 1e-6
"""Metres within which two lengths are one."""
FEW = 60
"""Every two of so many are measured in a run's 2,000 calls; of more only the nearest neighbours, for the least."""
CALLS = 2000
"""Of a run; a program that is sure to make more is not written where each takes the kernel."""
MEASURED = 100
"""So many pairs have their surfaces measured, hundredths of a second each; of more those whose boxes are nearest."""
BREAK = 0.1
"""What breaks the edge of an end is less than this share of the radius there, and of the length of the section."""
_FLAT = frozenset((PartKind.BODY, PartKind.PRISM, PartKind.RIB, PartKind.PROTRUSION, PartKind.WALL, PartKind.FACE))
"""Kinds that are as good as flat where they have no diameter: two of them have a gap between surfaces."""
_PLAY = "sum(found) if len(found) > 1 else 2 * min(found)"  # on both sides
_CORNERS = 4
"""Of a rectangle: of fewer or more parts there are no two sides."""
_SIDES = "[d for d in different(found, 1e-05) if d < max(found) - 1e-05]"
"""Of the three distances between corners of a rectangle the longest is its diagonal."""
_REDUCED = {Reduce.SIDES: _SIDES, Reduce.LARGEST: "max(found)", Reduce.SMALLEST: "min(found)", Reduce.TOTAL: _PLAY}


def distance(build: Builder, form: Distance) -> tuple[str, AnswerType]:
    """How far apart the two ends of a distance are, as an expression and its type."""
    form = replace(form, axis=_axis(build, form))
    first, second = form.first, form.second
    if form.mode == "overlap":
        return f"sum(a.overlap_with(b) for a, b in {overlapping(build, form)})", AnswerType.VOLUME
    if isinstance(first, MassCentre) or isinstance(second, MassCentre):
        return _from_mass(build, second if isinstance(first, MassCentre) else first, form.axis), AnswerType.LENGTH
    if isinstance(second, Plane) and not isinstance(first, Plane):
        first, second = second, first
    if isinstance(first, Plane):
        both = form.mode == "beyond both" and isinstance(second, Plane)
        from_it = _beyond_both(build, first, second) if both else _from_plane(build, first, second, form.mode)
        return from_it, AnswerType.LENGTH
    if isinstance(second, PartQuery) and not isinstance(first, PartQuery):
        first, second = second, first
    if not isinstance(first, PartQuery):
        raise Unwritable
    kind = AnswerType.LENGTHS if form.reduce in (Reduce.DIFFERENT, Reduce.SIDES) else AnswerType.LENGTH
    if isinstance(second, forms.Behind):
        second = Boundary(_behind(build.of(first)))
        form = replace(form, mode="surfaces")
    if isinstance(second, Boundary | Origin) or second is None:
        return _to_place(build, first, second, form), kind
    if form.mode == "outsides":
        return _over(build, form, first), kind
    if isinstance(second, PartQuery) and (fit := _FITS.get(form.mode)) is not None:
        return fit(build, form, first, second), kind
    other = second if isinstance(second, PartQuery) else None
    return pairwise(build, first, other, _between(build, form, other is not None), form.reduce), kind


def _axis(build: Builder, form: Distance) -> int | None:
    """Which of x, y, z: where the words say so one of the longer sides along which the parts lie apart."""
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
    if second is None and (own < 2 or (reduce is Reduce.SIDES and own != _CORNERS)):
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
    reduced = {Reduce.EACH: "found", Reduce.DIFFERENT: "different(found)", **_REDUCED}
    return reduced.get(reduce, "found[0] if len(different(found, 1e-05)) == 1 else min(found)")


def _has_likes(parts: Sequence[Part]) -> bool:
    """Are some of several round parts of one diameter, and others not? How far apart they are is asked of like ones."""
    sizes = [round(part.diameter or 0.0, 5) for part in parts]
    return 1 < len(set(sizes)) < len(sizes) and all(sizes)


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
    modes = {"center": "a.center_distance(b)", "near": "a.distance_to(b)"}
    if form.axis is not None:
        apart = f"abs(a.center[{form.axis}] - b.center[{form.axis}])"
        ends = f"a.half_extents[{form.axis}] - b.half_extents[{form.axis}]"
        modes = {"center": apart, "near": f"max(0.0, {apart} - {ends})"}
    elif two and (not alike or form.mode == "centers"):
        first, last = turned(parts[0]), turned(parts[-1])
        beside = {last, first if parts[0].axis is not None or last is None else None} - {None}
        if beside:  # from an axis; of two that cross the third way
            planar = (f"(a.center[{i}] - b.center[{i}]) ** 2" for i in range(3) if i not in beside)
            modes["axis"] = f"({' + '.join(planar)}) ** 0.5"
    return build.chosen({name: modes[name] for name in names if name in modes}, kinds(parts))


def turned(part: Part) -> int | None:
    """Along which of x, y, z is the axis of what is round: its own, or the one square to two equal extents?"""
    if (along := along_axis(part)) is not None:
        return along
    equal = [i for i in range(3) if abs(part.extents[i - 1] - part.extents[i - 2]) < SLACK]
    return equal[0] if len(equal) == 1 else None


def kinds(parts: Sequence[Part]) -> str:
    """What a distance is measured from: the kind of the parts, or both."""
    return "+".join(sorted({part.kind for part in parts})[:2])


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
    """How far the parts reach into the others: along their axis, or where they do not lie within them altogether."""
    parts, others = build.of(first), build.of(second)
    ends = _ends(parts, others)
    along, _ = side_axis(ends[0])
    if along_axis(parts[0]) is None:
        crosses = {side_axis(side)[0] for side in Side if _reach(parts[0], side) > max(_reach(o, side) for o in others)}
        along = next(iter(crosses), along)
    low, high = (_outermost(build, second, along, sign) for sign in "-+")
    middle, half = f"p.center[{along}]", f"p.half_extents[{along}]"
    reach = f"min({middle} + {half}, high) - max({middle} - {half}, low)"
    found = f"[max(0.0, {reach}) for p in {build.parts(first)}]"
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


_FITS = {"within": _within, "across": _across, "on diameter": _clearance, "on radius": _clearance}


def overlapping(build: Builder, form: Distance) -> str:
    """The pairs of bodies that take the same room, as an expression."""
    if any(part.kind != "body" for part in build.all_of(form.first, form.second)):
        raise Unwritable
    names = [build.parts(query) for query in (form.first, form.second) if isinstance(query, PartQuery)]
    return f"overlaps({', '.join(names)})"


# From planes


def side_axis(side: Side) -> tuple[int, str]:
    """Which of x, y, z a side looks along, and whether to '+' or to '-'."""
    axis = next(i for i, value in enumerate(side.outward) if value)
    return axis, "+" if side.outward[axis] > 0 else "-"


def _from_plane(build: Builder, plane: Plane, other: Anchor | str, mode: str) -> str:
    """Along the normal of a part's outer plane, to another plane, to a boundary of the model, or to parts."""
    plane, other = _floor(build, plane), _floor(build, other) if isinstance(other, Plane) else other
    side, other_side = _sides(build, plane, other, mode)
    axis, sign = side_axis(side)
    at = _outermost(build, plane.of, axis, sign)
    match other:
        case Plane(_, of) if other_side is not None:
            beyond = "+" if other_side.outward[axis] > 0 else "-"
            level = f"({_outermost(build, of, axis, beyond)})"
            return _each_of(build, plane.of, at, sign, axis, level, signed=mode == "beyond")
        case Boundary(Side() as bound) if bound.outward[axis]:
            corner = "max" if bound.outward[axis] > 0 else "min"
            return _each_of(build, plane.of, at, sign, axis, f"shape.{corner}_corner[{axis}]")
        case Origin():
            return f"abs({at})"
        case PartQuery():
            ends = ", ".join(f"abs(p.center[{axis}] {sign} p.half_extents[{axis}] - ({at}))" for sign in "+-")
            modes = {"center": f"abs(p.center[{axis}] - ({at}))", "far": f"max({ends})", "near": f"min({ends})"}
            round_parts = any(part.axis is not None for part in build.of(other))
            usual = ("center", "far", "near") if round_parts else ("near", "far", "center")
            names = {"centers": ("center",), "surfaces": ("near", "far")}.get(mode, usual)
            return _of_each(build, other, {name: modes[name] for name in names})
    raise Unwritable


def _beyond_both(build: Builder, first: Plane, second: Anchor | str) -> str:
    """How far a part reaches beyond another on that one of its two ends where it is less."""
    assert isinstance(second, Plane)
    out = []
    for side in _ends(build.of(first.of), build.of(second.of)):
        axis, sign = side_axis(side)
        ends = (_outermost(build, plane.of, axis, sign) for plane in (first, second))
        out.append(f"{sign}1 * ({next(ends)} - {next(ends)})")
    return f"min({', '.join(out)})"


def _floor(build: Builder, plane: Plane) -> Plane:
    """The bottom of what is cut in is its floor, wherever it opens: of a bore from below, above; and a bore's end."""
    floors = {Side.BOTTOM: CUT, None: (PartKind.HOLE,)}.get(plane.side, ())
    cut = [p for p in build.of(plane.of) if p.kind in floors and p.normal]
    if blind := [p for p in cut if p.bottom is not Bottom.THROUGH]:
        return replace(plane, side=_behind(blind))
    slot = next((p for p in cut if "open" in p.tags), None)
    return replace(plane, side=_end_of_slot(build, slot)) if slot is not None else plane


def _end_of_slot(build: Builder, slot: Part) -> Side:
    """The side on which a slot through a plate ends: not the one where it runs out at the edge."""
    sides = [side for side in Side if abs(slot.extents[side_axis(side)[0]] - (slot.depth or 0.0)) < SLACK]
    return max(sides, key=lambda side: _reach(build.whole, side) - _reach(slot, side), default=Side.BOTTOM)


def _of_each(build: Builder, query: PartQuery, modes: dict[str, str], reduce: Reduce = Reduce.ONE) -> str:
    """The distance of each part 'p', or what becomes of them."""
    parts = build.parts(query)
    build.lines.append(f"found = [{build.chosen(modes, kinds(build.of(query)))} for p in {parts}]")
    one = "found" if query.plural else "found[0] if len(different(found, 1e-05)) == 1 else found"
    return _REDUCED.get(reduce, one)


def _each_of(build: Builder, query: PartQuery, at: str, sign: str, axis: int, level: str, signed: bool = False) -> str:
    """How far the plane, or that of each of several parts, lies from a level; `signed`: beyond it."""
    far = f"{sign}1 * " if signed else "abs"
    if not query.plural or at.startswith("shape."):
        return f"{far}({at} - {level})"
    return f"[{far}(p.center[{axis}] {sign} p.half_extents[{axis}] - {level}) for p in {build.parts(query)}]"


def _outermost(build: Builder, query: PartQuery, axis: int, sign: str) -> str:
    """How far parts reach along an axis, to '+' or to '-'."""
    parts = build.of(query)
    if not parts:
        raise Unwritable
    pick = "max" if sign == "+" else "min"
    side = next(side for side in Side if side_axis(side) == (axis, sign))
    if all(_is_broken(build.whole, part, side) for part in parts):  # a shaft ends where the chamfer of its end does
        return f"shape.{pick}_corner[{axis}]"
    return f"{pick}(q.center[{axis}] {sign} q.half_extents[{axis}] for q in {build.parts(query)})"


def _is_broken(whole: Part, part: Part, side: Side) -> bool:
    """Does a section of a shaft end a little before the shaft does, with a broken edge?"""
    left = _reach(whole, side) - _reach(part, side)
    along = side_axis(side)[0]
    section = part.kind not in CUT and along_axis(part) == along == along_axis(whole)
    return section and SLACK < left < BREAK * min(part.radius or 0.0, part.extents[along])


def _sides(build: Builder, plane: Plane, other: Anchor | str, mode: str) -> tuple[Side, Side | None]:
    """The sides of two planes: where one reaches beyond the other, by the shorter way, or 'from the head to the end'.

    Of a single plane without one: the end of the part that is free, as that of a shank is, which is no head's or
    fork's; of two free ends, or none, the one that is nearest to the middle of the other part.
    """
    if isinstance(other, Plane):
        if plane.side is not None:
            return plane.side, other.side or plane.side.opposite
        if other.side is not None:
            return other.side.opposite, other.side
        parts, others = build.of(plane.of), build.of(other.of)
        if parts == others or not parts or not others:
            raise Unwritable
        beyond = {side: _reach(parts[0], side) - max(_reach(one, side) for one in others) for side in Side}
        along = {side: beyond[side] for side in _ends(parts, others)}
        if mode == "outsides":  # by as much on the opposite side
            beyond = {side: out for side, out in beyond.items() if out > 0 and abs(out - beyond[side.opposite]) < SLACK}
        elif parts[0].axis or max(along.values()) > SLACK:  # a logo lies within the other part along its own length
            beyond = along
        if not beyond:
            raise Unwritable
        out = [side for side in beyond if beyond[side] > SLACK]
        side = min(out, key=beyond.__getitem__) if out else max(beyond, key=beyond.__getitem__)
        return side, side
    if plane.side is not None:
        return plane.side, None
    if not isinstance(other, PartQuery):
        raise Unwritable
    part, others = build.of(plane.of), build.of(other)
    ends = _ends(part, others)
    free = [side for side in ends if _reach(part[0], side) > _reach(build.whole, side) - SLACK]
    ends = free if len(free) == 1 and part[0].kind not in WHOLE else ends
    return min(ends, key=lambda side: abs(_reach(part[0], side) - _reach(others[0], side, 0.0))), None


def _ends(parts: Sequence[Part], others: Sequence[Part]) -> list[Side]:
    """The two sides on which a part ends, along its axis or its longest side. Raises Unwritable: there is none."""
    if not parts or not others:
        raise Unwritable
    along = along_axis(parts[0])
    along = max(range(3), key=parts[0].extents.__getitem__) if along is None else along
    return [side for side in Side if side.outward[along]]


def _reach(part: Part, side: Side, share: float = 0.5) -> float:
    """How far a part reaches towards a side; its middle, where a share of its extent of 0 is asked for."""
    axis, _ = side_axis(side)
    return side.outward[axis] * part.center[axis] + share * part.extents[axis]


def _behind(parts: Sequence[Part]) -> Side:
    """The side that the openings of these parts look away from; the bottom where they have none."""
    normal = next((part.normal for part in parts if part.normal is not None), None)
    if normal is None:
        return Side.BOTTOM
    return max(Side, key=lambda side: -sum(a * b for a, b in zip(side.outward, normal, strict=True)))


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
            return f"abs({_outermost(build, of, i, sign)} - {mass}[{i}])"
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
    return _of_each(build, first, modes, form.reduce)
