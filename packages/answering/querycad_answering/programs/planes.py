"""Distances from outer planes: from a face, an end or a side of a part, along its normal, to another or to parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import Bottom, Part, PartKind, PartQuery, Side
from querycad_language.forms import Anchor, Boundary, Origin, Plane, Reduce
from querycad_language.measures import WHOLE

from .builder import Builder, Unwritable
from .meanings import CUT, along_axis

SLACK = 1e-6
"""Metres within which two lengths are one."""
BREAK = 0.1
"""What breaks the edge of an end is less than this share of the radius there, and of the length of the section."""
LEVEL = 0.9999
"""Cosine of what lies along an axis: 0.8 degrees."""
THIN = 1 / 3
"""What is at most that thick for its width is a plate or a wall, from which others stand out."""
_PLAY = "sum(found) if len(found) > 1 else 2 * min(found)"  # on both sides
_SIDES = "[d for d in different(found, 1e-05) if d < max(found) - 1e-05]"
"""Of the three distances between corners of a rectangle the longest is its diagonal."""
REDUCED = {Reduce.SIDES: _SIDES, Reduce.LARGEST: "max(found)", Reduce.SMALLEST: "min(found)", Reduce.TOTAL: _PLAY}


def kinds(parts: Sequence[Part]) -> str:
    """What a distance is measured from: the kind of the parts, or both."""
    return "+".join(sorted({part.kind for part in parts})[:2])


def side_axis(side: Side) -> tuple[int, str]:
    """Which of x, y, z a side looks along, and whether to '+' or to '-'."""
    axis = next(i for i, value in enumerate(side.outward) if value)
    return axis, "+" if side.outward[axis] > 0 else "-"


def from_plane(build: Builder, plane: Plane, other: Anchor | str, mode: str) -> str:
    """Along the normal of a part's outer plane, to another plane, to a boundary of the model, or to parts."""
    plane, other = _floor(build, plane), _floor(build, other) if isinstance(other, Plane) else other
    if isinstance(other, PartQuery) and (ends := _flat_ends(build, plane)):
        usual = [next(iter(_to_parts(build, plane.of, side, other, mode).values())) for side in ends]
        said = _to_parts(build, plane.of, _sides(build, plane, other, mode)[0], other, mode)
        return of_each(build, other, {**dict(zip(("end", "other end"), usual, strict=True)), **said})
    side, other_side = _sides(build, plane, other, mode)
    axis, sign = side_axis(side)
    match other:
        case Plane(over, of) if other_side is not None:
            upright = _upright(build, plane.of, of) if plane.side is over is None and mode != "outsides" else None
            if plane.side is over is None and is_oblique(build.of(plane.of)):  # along x, y or z is not along it
                if upright is None:
                    raise Unwritable
                side = other_side = upright
            if upright in (None, side):
                return _levels_apart(build, plane.of, of, side, other_side, mode)
            sides = {"lengthwise": side, "upright": upright}
            modes = {name: _levels_apart(build, plane.of, of, one, one, mode) for name, one in sides.items()}
            return build.chosen(modes, kinds(build.all_of(plane.of, of)))
        case Boundary(Side() as bound) if bound.outward[axis]:
            corner = "max" if bound.outward[axis] > 0 else "min"
            at = outermost(build, plane.of, axis, sign)
            return _each_of(build, plane.of, at, sign, axis, f"shape.{corner}_corner[{axis}]")
        case Origin():
            return f"abs({outermost(build, plane.of, axis, sign)})"
        case PartQuery():
            return of_each(build, other, _to_parts(build, plane.of, side, other, mode))
    raise Unwritable


def _to_parts(build: Builder, of: PartQuery, side: Side, other: PartQuery, mode: str) -> dict[str, str]:
    """From the outer plane of parts on a side to each part 'p': what may be meant."""
    axis, sign = side_axis(side)
    at = outermost(build, of, axis, sign)
    ends = ", ".join(f"abs(p.center[{axis}] {sign} p.half_extents[{axis}] - ({at}))" for sign in "+-")
    modes = {"center": f"abs(p.center[{axis}] - ({at}))", "far": f"max({ends})", "near": f"min({ends})"}
    round_parts = any(part.axis is not None for part in build.of(other))
    usual = ("center", "far", "near") if round_parts else ("near", "far", "center")
    names = {"centers": ("center",), "surfaces": ("near", "far")}.get(mode, usual)
    return {name: modes[name] for name in names}


def _levels_apart(build: Builder, of: PartQuery, base: PartQuery, side: Side, other: Side, mode: str) -> str:
    """How far the outer planes of two parts lie apart, each on its side of one axis."""
    (axis, sign), (_, beyond) = side_axis(side), side_axis(other)
    at, level = outermost(build, of, axis, sign), f"({outermost(build, base, axis, beyond)})"
    return _each_of(build, of, at, sign, axis, level, signed=mode == "beyond")


def _flat_ends(build: Builder, plane: Plane) -> list[Side]:
    """The two ends of what is round, where the side is none of its ends: 'the back of the flange' that lies.

    First the one that is free; of two that are, the lower one for what is called the back.
    """
    parts = build.of(plane.of)
    along = {along_axis(part) if part.kind is PartKind.BOSS or part.kind in WHOLE else None for part in parts}
    axis = along.pop() if len(along) == 1 else None
    if axis is None or plane.side in (None, Side.TOP, Side.BOTTOM) or plane.side.outward[axis]:
        return []
    ends = sorted((side for side in Side if side.outward[axis]), key=lambda side: side.outward[axis])
    ends = ends if plane.side in (Side.BACK, Side.LEFT) else ends[::-1]
    return sorted(ends, key=lambda side: round(reach(build.whole, side) - reach(parts[0], side), 6) > SLACK)


def _upright(build: Builder, first: PartQuery, base: PartQuery) -> Side | None:
    """On which side does a part stand out of a flat one: along the normal of a face, or the thickness of a plate?"""
    parts, others = build.of(first), build.of(base)
    if not parts or not others or others[0].kind in WHOLE:
        return None
    thickness, middle, _ = sorted(others[0].extents)
    if thickness > THIN * middle:
        return None
    along = others[0].extents.index(thickness)
    beyond = {side: reach(parts[0], side) - max(reach(one, side) for one in others) for side in Side}
    side = max((side for side in Side if side.outward[along]), key=beyond.__getitem__)
    return side if beyond[side] > SLACK else None


def beyond_both(build: Builder, first: Plane, second: Anchor | str) -> str:
    """How far a part reaches beyond another on that one of its two ends where it is less."""
    assert isinstance(second, Plane)
    out = []
    for side in ends_of(build.of(first.of), build.of(second.of)):
        axis, sign = side_axis(side)
        ends = (outermost(build, plane.of, axis, sign) for plane in (first, second))
        out.append(f"{sign}1 * ({next(ends)} - {next(ends)})")
    return f"min({', '.join(out)})"


def _floor(build: Builder, plane: Plane) -> Plane:
    """The bottom of what is cut in is its floor, wherever it opens: of a bore from below, above; and a bore's end."""
    floors = {Side.BOTTOM: CUT, None: (PartKind.HOLE,)}.get(plane.side, ())
    cut = [p for p in build.of(plane.of) if p.kind in floors and p.normal]
    if blind := [p for p in cut if p.bottom is not Bottom.THROUGH]:
        return replace(plane, side=side_behind(blind))
    slot = next((p for p in cut if "open" in p.tags), None)
    return replace(plane, side=_end_of_slot(build, slot)) if slot is not None else plane


def _end_of_slot(build: Builder, slot: Part) -> Side:
    """The side on which a slot through a plate ends: not the one where it runs out at the edge."""
    sides = [side for side in Side if abs(slot.extents[side_axis(side)[0]] - (slot.depth or 0.0)) < SLACK]
    return max(sides, key=lambda side: reach(build.whole, side) - reach(slot, side), default=Side.BOTTOM)


def of_each(build: Builder, query: PartQuery, modes: dict[str, str], reduce: Reduce = Reduce.ONE) -> str:
    """The distance of each part 'p', or what becomes of them."""
    parts = build.parts(query)
    build.lines.append(f"found = [{build.chosen(modes, kinds(build.of(query)))} for p in {parts}]")
    one = "found" if query.plural else "found[0] if len(different(found, 1e-05)) == 1 else found"
    return REDUCED.get(reduce, one)


def _each_of(build: Builder, query: PartQuery, at: str, sign: str, axis: int, level: str, signed: bool = False) -> str:
    """How far the plane, or that of each of several parts, lies from a level; `signed`: beyond it."""
    far = f"{sign}1 * " if signed else "abs"
    if not query.plural or at.startswith("shape."):
        return f"{far}({at} - {level})"
    return f"[{far}(p.center[{axis}] {sign} p.half_extents[{axis}] - {level}) for p in {build.parts(query)}]"


def outermost(build: Builder, query: PartQuery, axis: int, sign: str) -> str:
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
    left = reach(whole, side) - reach(part, side)
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
        beyond = {side: reach(parts[0], side) - max(reach(one, side) for one in others) for side in Side}
        along = {side: beyond[side] for side in ends_of(parts, others)}
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
    ends = ends_of(part, others)
    free = [side for side in ends if reach(part[0], side) > reach(build.whole, side) - SLACK]
    ends = free if len(free) == 1 and part[0].kind not in WHOLE else ends
    return min(ends, key=lambda side: abs(reach(part[0], side) - reach(others[0], side, 0.0))), None


def is_oblique(parts: Sequence[Part]) -> bool:
    """Does the axis of the first part lie along none of x, y and z?"""
    return bool(parts) and parts[0].axis is not None and max(map(abs, parts[0].axis)) < LEVEL


def ends_of(parts: Sequence[Part], others: Sequence[Part]) -> list[Side]:
    """The two sides on which a part ends, along its axis or its longest side. Raises Unwritable: there is none."""
    if not parts or not others:
        raise Unwritable
    along = along_axis(parts[0])
    along = max(range(3), key=parts[0].extents.__getitem__) if along is None else along
    return [side for side in Side if side.outward[along]]


def reach(part: Part, side: Side, share: float = 0.5) -> float:
    """How far a part reaches towards a side; its middle, where a share of its extent of 0 is asked for."""
    axis, _ = side_axis(side)
    return side.outward[axis] * part.center[axis] + share * part.extents[axis]


def side_behind(parts: Sequence[Part]) -> Side:
    """The side that the openings of these parts look away from; the bottom where they have none."""
    normal = next((part.normal for part in parts if part.normal is not None), None)
    if normal is None:
        return Side.BOTTOM
    return max(Side, key=lambda side: -sum(a * b for a, b in zip(side.outward, normal, strict=True)))
