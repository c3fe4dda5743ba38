"""Directions: the angles that parts enclose, and the sides that they lie towards."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import AnswerType, Part, PartKind, PartQuery, Side
from querycad_contracts.vectors import coordinate_axis, dot, sub
from querycad_language.forms import Facing, Reduce, Target, Towards

from .builder import Builder, Unwritable
from .circles import on_one_circle, write_middle
from .distances import pairwise, turned
from .planes import kinds, side_axis

_PARALLEL = 0.9999
"""Cosine of what is still parallel: 0.8 degrees."""
_TOWARDS = 0.5
"""Of a direction, or of the way from the middle to the end, that counts as towards that end."""
SLANT, ASIDE = 0.01, 1e-4
"""Radians and metres by which parts on one line may be off it."""


def directions(build: Builder, first: PartQuery, second: Target, reduce: Reduce) -> str:
    """Angles between axes or normals; of flat parts also what they enclose. Raises Unwritable: some have neither."""
    parts = build.all_of(first, second)
    return pairwise(build, first, second, build.chosen(_between(parts, reduce), kinds(parts)), reduce)


def _between(parts: Sequence[Part], reduce: Reduce) -> dict[str, str]:
    """What the angle of 'a' and 'b' can mean."""
    if any(part.axis is None and part.normal is None for part in parts):
        return {}
    meanings = {"between": "a.angle_to(b)"}
    if len({part.axis is None or "plate" in part.tags for part in parts}) > 1:  # what an axis and a plane enclose
        meanings = {"inclined": "1.5707963267948966 - a.angle_to(b)"} | meanings
    if reduce is Reduce.ONE and all(part.axis is None for part in parts):
        enclosed = {"enclosed": "3.141592653589793 - a.angle_to(b)"}
        return enclosed | meanings if len(parts) == 2 and _is_obtuse(*parts) else meanings | enclosed
    return meanings


def _is_obtuse(one: Part, other: Part) -> bool:
    """Do two walls, such as the legs of an angle, enclose more than a right angle, as seen from where they meet?

    With unit normals n1, n2, they run away from their line of intersection to the side of each other that their middles
    lie on: the cosine has the sign of -s1 s2 (n1 n2), s1 and s2 being how far the middles lie off the other's plane.
    """
    if one.kind is not PartKind.WALL or other.kind is not PartKind.WALL or not (one.normal and other.normal):
        return False
    apart = sub(one.center, other.center)
    return dot(other.normal, apart) * dot(one.normal, apart) * dot(one.normal, other.normal) < 0


def facing(build: Builder, form: Facing) -> str:
    """Do parts look to the same side, or to opposite ones; do two lie across the middle of the model?

    Cuts look to the sides that they open to. Raises Unwritable: fewer than two, or no direction.
    """
    found = build.all_of(form.first, form.second)
    queries = [query for query in (form.first, form.second) if query is not None]
    build.lines.append(f"found = {' + '.join(f'list({build.parts(query)})' for query in queries)}")
    if len(found) < 2 or (form.how == "across" and len(found) > 2):
        raise Unwritable
    if form.how == "across":  # their middle is that of the model, but for the way along which they are alike
        build.lines += [
            "a, b = found",
            "off = [abs((x + y) / 2 - m) for x, y, m in zip(a.center, b.center, shape.center)]",
        ]
        beside = f"abs(a.center[k] - b.center[k]) < {ASIDE} and sum(off) - off[k] < {ASIDE}"
        return f"any({beside} for k in range(3))"
    same = form.how == "same"
    if all(part.kind.cuts_in for part in found):
        return f"{'' if same else 'not '}any(all(s in p.sides for p in found) for s in found[0].sides)"
    if any(part.normal is None for part in found):
        raise Unwritable
    cosine = "sum(x * y for x, y in zip(p.normal, q.normal))"
    return f"{'all' if same else 'any'}({cosine} {'> ' if same else '< -'}{_TOWARDS} for p in found for q in found)"


def in_line(build: Builder, first: PartQuery, second: Target, row: bool) -> str:
    """Do parallel parts lie on one line: along the axis of the first, or as a `row` of three or more beside each other?

    Raises Unwritable: fewer than two, or no axis.
    """
    parts = build.all_of(first, second)
    if len(parts) < 2 or any(part.axis is None for part in parts):
        raise Unwritable
    names = " + ".join(f"list({build.parts(query)})" for query in (first, second) if query is not None)
    build.lines += [
        f"found = {names}",
        "line = found[0]",
        "apart = [[p.center[i] - line.center[i] for i in range(3)] for p in found]",
        "far = max(apart, key=lambda d: sum(x * x for x in d))",
        "length = max(1e-9, sum(x * x for x in far) ** 0.5)",
        f"ways = [line.axis, [x / length for x in far]][: {1 + (row and len(parts) > 2)}]",
        "along = [[sum(a * b for a, b in zip(d, way)) for d in apart] for way in ways]",
        "aside = [max(abs(d[i] - s * way[i]) for d, s in zip(apart, own) for i in range(3))"
        " for way, own in zip(ways, along)]",
    ]
    return f"min(aside) < {ASIDE} and all(p.angle_to(line) < {SLANT} for p in found[1:])"


def at_both_ends(build: Builder, target: PartQuery) -> str:
    """Do parts open, or where they have no mouth lie, towards opposite ends of the model?"""
    name = build.parts(target)
    build.lines += [
        f"ways = [o.normal for p in {name} for o in getattr(p, 'openings', None) or ()]",
        f"shares = [[(p.center[i] - shape.center[i]) / shape.half_extents[i] for i in range(3)] for p in {name}]",
        "ways = ways or shares",
    ]
    return f"any(a[i] > {_TOWARDS} and b[i] < -{_TOWARDS} for a in ways for b in ways for i in range(3))"


def angle_between(build: Builder, first: PartQuery, second: Target) -> str:
    """Between directions, or about an axis: the pitch of a bolt circle, a keyway and the cross hole opposite."""
    parts = build.all_of(first, second)
    if len(parts) < 2:
        raise Unwritable
    if second is None and len({part.id.split(".")[0] for part in parts if part.kind is PartKind.TOOTH}) == 1:
        return f"6.283185307179586 / len({build.parts(first)})"  # the teeth of one gear divide its turn
    axes = [part.axis for part in parts if part.axis is not None]
    cosines = (sum(a * b for a, b in zip(axes[0], axis, strict=True)) for axis in axes)
    parallel = len(axes) == len(parts) and all(abs(cosine) > _PARALLEL for cosine in cosines)
    if parallel and second is None and len(parts) > 2:
        return _about(build, first, None, None, flat=coordinate_axis(axes[0]))
    meanings = _between(parts, Reduce.ONE)
    if (along := turned(build.whole)) is not None:  # the angle of parallel axes is none
        meanings = {"about": ""} | meanings if parallel else meanings | {"about": ""}
    chosen = build.chosen(meanings, kinds(parts))
    return pairwise(build, first, second, chosen, Reduce.ONE) if chosen else _about(build, first, second, along)


def _about(build: Builder, first: PartQuery, second: Target, along: int | None, flat: int | None = None) -> str:
    """The least angle between the arms to two parts, from their middle or from the axis of a round model.

    Their middle is that of the circle that they lie on, else of their centres.

    `flat`: the axis that all of them run along, and arms do not: circles of holes in two flanges lie behind each other.
    """
    names = [build.parts(query) for query in (first, second) if query is not None]
    middle = f"[sum(p.center[i] for p in {names[0]}) / len({names[0]}) for i in range(3)]"
    point = "p.center" if along is None else "(p.opening or p.center)"
    corners = on_one_circle(build.of(first)) if along is None else None
    if corners is not None:
        write_middle(build, names[0], corners)
    else:
        build.lines += ["import math", f"middle = {middle if along is None else 'shape.center'}"]
    for index, name in enumerate(names):
        arm = f"[{point}[i] - middle[i] for i in {[i for i in range(3) if i not in (along, flat)]}]"
        build.lines.append(f"arms{index} = [{arm} for p in {name}]")
    pairs = "for a in arms0 for b in arms1" if second else "for i, a in enumerate(arms0) for b in arms0[i + 1 :]"
    if flat is not None:  # each circle for itself
        build.lines.append(f"levels = [p.center[{flat}] for p in {names[0]}]")
        pairs = "for i, a in enumerate(arms0) for j, b in enumerate(arms0[:i])"
    level = "" if flat is None else f" and abs(levels[i] - levels[j]) < {ASIDE}"
    build.lines.append(f"pairs = [(a, b) {pairs} if math.hypot(*a) * math.hypot(*b) > 0{level}]")
    cosine = "sum(u * v for u, v in zip(a, b)) / (math.hypot(*a) * math.hypot(*b))"
    build.lines.append(f"angles = [math.acos(max(-1.0, min(1.0, {cosine}))) for a, b in pairs]")
    return f"min([angle for angle in angles if angle > {SLANT}] or angles)"


_LOOKING = frozenset((PartKind.HOLE, PartKind.COUNTERBORE, PartKind.COUNTERSINK, PartKind.SPOTFACE, PartKind.FACE))
"""Kinds that plainly open, or look, to one side."""


def _axis_of(side: Side) -> str:
    """The axis that a side looks along: '+x'."""
    i, sign = side_axis(side)
    return f"{'-' if '-' in sign else '+'}{'xyz'[i]}"


def _gathered(parts: Sequence[Part], whole: Part) -> bool:
    """May they be one thing that lies somewhere: are no two of them towards opposite ends of the model?"""
    shares = [[2 * (part.center[i] - whole.center[i]) / whole.extents[i] for part in parts] for i in range(3)]
    return not any(min(share) < -_TOWARDS and max(share) > _TOWARDS for share in shares)


def towards(build: Builder, form: Towards) -> tuple[str, AnswerType]:
    """The side that the parts' openings, or else their centres, are nearest to, by shares of the extents.

    Holes are on the side that they open to, faces on that which they look to; other parts may be, or point there.

    Or the side that 'most' of them are seen from, those that 'none' is, or how many are from 'each'.
    """
    parts, sides = build.of(form.target), [side.value for side in form.sides]
    if not parts or not (form.target.plural or form.seen or _gathered(parts, build.whole)):
        raise Unwritable
    name = build.parts(form.target)
    if form.seen:
        build.lines.append(f"seen = {{side: sum(side in p.sides for p in {name}) for side in {sides}}}")
    if form.seen == "each":
        return "[f'{side}: {seen[side]}' for side in seen if seen[side]]", AnswerType.TEXTS
    if form.seen == "none":
        return "[side for side in seen if not seen[side]]", AnswerType.TEXTS
    if form.seen == "most":  # all of as many
        most = "', '.join(side for side in seen if seen[side] == max(seen.values()))"
        return f"{most} if any(seen.values()) else 'none'", AnswerType.TEXT
    point = "opening" if all(part.opening is not None for part in parts) else "center"
    share = f"(p.{point}[{{0}}] - shape.center[{{0}}]) / shape.half_extents[{{0}}]"
    meanings = {"lies": share}
    if all(part.normal is not None for part in parts):
        looking = all(part.kind in _LOOKING for part in parts)
        meanings = {"looks": f"{share} + p.normal[{{0}}]"} if looking else meanings | {"points": "p.normal[{0}]"}
    meaning = build.chosen(meanings, kinds(parts), "side")
    for side in form.sides:
        i, sign = side_axis(side)
        build.lines.append(f"{side.value} = {sign.strip('+')}sum({meaning.format(i)} for p in {name})")
    found = ", ".join(f'({side.value}, "{_axis_of(side) if form.axes else side.value}")' for side in form.sides)
    return f"max({found})[1]", AnswerType.TEXT
