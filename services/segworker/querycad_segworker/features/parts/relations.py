"""What a part is to the whole: central, repeated, deep."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence

from querycad_contracts import Bottom, Part, PartKind, Shape, Vector
from querycad_segworker.features.assemblies.fasteners import fasteners
from querycad_segworker.tolerances import FACING, exceeds, significant
from querycad_segworker.topology import REVOLVED, Brep, EdgeConvexity
from querycad_segworker.vectors import OFF_ROUND, cross, dist, dot, line_distance, line_key, scale, sub, unit

from .hierarchy import carried
from .turned_pieces import turned_pieces

CENTRAL_SHARE = 0.01
"""A part is central when its axis passes the middle of the model nearer than this share of the model's extent."""
MIN_SPOKES = 3
"""Two bars that run out to both sides are arms."""
MIN_FEET = 2
"""One thing on the ground is a base."""
FOOT_SHARE = 0.5
"""A foot takes less than this share of the model's ground plan; more is a base."""
UPRIGHT = FACING.parallel
"""Cosine of the angle to the vertical below which an axis counts as upright."""
ALL_OF_LEG = 0.99
"""A block as long as this share of a foot is the foot itself."""
FILLS = 0.9
"""A pin fills a hole that is as wide as it is thick, give or take a tenth: from a press fit to a loose one."""
DEEP_RATIO = 5.0
"""A hole deeper than five diameters counts as deep in drilling practice."""


def with_relations(parts: Sequence[Part], shape: Shape, brep: Brep) -> list[Part]:
    """The same parts with tags for what they are to the whole, and with what they carry as children.

    'central': its axis passes the model's middle. 'repeated': another hole has its size and direction. 'deep'.
    'grounded': it reaches the model's lowest level. 'foot': it does, as one of several bodies or protrusions that do,
    while others do not: what the rest stands on; 'leg': the long part of such a foot. 'head': the wide end of a screw,
    whose body is a 'screw'; 'nut', likewise. 'bolt_circle', 'row', 'grid', 'rectangle': what lies so. 'ringed': a hole
    with a ring around it. 'vertical', 'horizontal': its axis. 'head', 'shank', 'neck', 'spigot', 'tip', 'eye': what a
    step is to its turned part. 'spoke': a bar that runs out from the model's middle, as others do.
    'ear': a rounded end about a hole, of which the other end is no such one.
    """
    tags: dict[str, list[str]] = {part.id: [*part.tags, *_place_tags(part, shape)] for part in parts}
    fastened = fasteners(parts, brep)
    structural = [part for part in parts if part.id not in fastened]
    held = {part_id: found.tags for part_id, found in fastened.items()}
    pieces = turned_pieces(parts, brep)
    pieces = {part_id: names for part_id, names in pieces.items() if not _is_of_head(part_id, names, parts, held, brep)}
    own = (_repeated(parts, shape), _patterned(parts), _ringed(parts), held, _legs(structural, shape), pieces)
    for found in (*own, _spokes(parts, shape, brep), _ears(parts, brep)):
        for part_id, names in found.items():
            tags[part_id].extend(names)
    carried_by = carried(parts, brep)
    result = []
    for part in parts:
        update: dict[str, object] = dict(fastened[part.id].measures) if part.id in fastened else {}
        if len(tags[part.id]) > len(part.tags):
            update["tags"] = tuple(dict.fromkeys(tags[part.id]))
        if part.id in carried_by:
            update["children"] = tuple(dict.fromkeys((*part.children, *carried_by[part.id])))
        if ways := _ways_in(part.model_copy(update=update)):
            update["approach"] = ways
        result.append(part.model_copy(update=update) if update else part)
    return _with_ways_of_pins(result)


def _with_ways_of_pins(parts: Sequence[Part]) -> list[Part]:
    """The same parts; a round body that fills a hole of another one goes in as the hole is reached, if blind one way.

    One in through holes only goes in from either side. Such a hole is tagged 'filled'.
    """
    holes: dict[Vector, list[Part]] = defaultdict(list)
    for hole in parts:
        if hole.kind == "hole" and hole.axis is not None and hole.approach:
            holes[line_key(hole.axis)].append(hole)
    result, taken = list[Part](), set[str]()
    for part in parts:
        if part.kind == "body" and part.axis is not None and part.radius and part.tips:
            own = set(part.faces)
            filled = [h for h in holes[line_key(part.axis)] if _fills(part, h) and own.isdisjoint(h.faces)]
            taken |= {hole.id for hole in filled}
            ways = part.approach or min((hole.approach for hole in filled), key=len, default=())
            part = part.model_copy(update={"approach": ways}) if ways else part
        result.append(part)
    return [one.model_copy(update={"tags": (*one.tags, "filled")}) if one.id in taken else one for one in result]


def _fills(pin: Part, hole: Part) -> bool:
    """Is it on the hole's axis, as thick as the hole is wide, and in it?"""
    assert pin.axis is not None
    if hole.radius is None or not pin.radius or not FILLS <= pin.radius / hole.radius <= 2 - FILLS:
        return False
    apart = abs(dot(sub(hole.center, pin.center), pin.axis))
    x, y, z = pin.axis
    reach = (dot(pin.extents, (abs(x), abs(y), abs(z))) + (hole.depth or 0.0)) / 2
    return apart < reach and line_distance(hole.center, pin.center, pin.axis) < (1 - FILLS) * hole.radius


def _ways_in(part: Part) -> tuple[Vector, ...]:
    """Along which unit directions is it reached: what is cut in from each of its mouths, a screw from its head?

    Of what stands open at a border, the way that its floor faces is one; others are not told.
    """
    if part.kind == "body" and "screw" in part.tags and part.tip is not None and dist(part.tip, part.center) > 0:
        return (unit(sub(part.tip, part.center)),)
    if not part.kind.cuts_in or part.opening is None or part.normal is None:
        return ()
    into = scale(part.normal, -1.0)
    return (into, part.normal) if part.bottom is Bottom.THROUGH else (into,)


def _place_tags(part: Part, shape: Shape) -> list[str]:
    """What the part is to the whole model by itself."""
    tags = []
    if part.kind == "hole" and part.depth and part.diameter and exceeds(part.depth, DEEP_RATIO * part.diameter):
        tags.append("deep")
    if part.axis is not None and _is_central(part, shape):
        tags.append("central")
    if _is_grounded(part, shape):
        tags.append("grounded")
    if part.axis is not None and abs(part.axis[2]) > UPRIGHT:
        tags.append("vertical")
    elif part.axis is not None and abs(part.axis[2]) < 1 - UPRIGHT:
        tags.append("horizontal")
    return tags


def _repeated(parts: Sequence[Part], shape: Shape) -> dict[str, tuple[str, ...]]:
    """Holes of which another has the size and direction."""
    groups: dict[tuple[object, ...], list[str]] = defaultdict(list)
    for part in parts:
        if part.kind == "hole":
            groups[_size_key(part, shape)].append(part.id)
    return {i: ("repeated",) for members in groups.values() if len(members) > 1 for i in members}


def _patterned(parts: Sequence[Part]) -> dict[str, tuple[str, ...]]:
    """What lies on a bolt circle, in a row or in a grid."""
    return {child: (part.tags[0],) for part in parts if part.kind == "pattern" for child in part.children}


def _ringed(parts: Sequence[Part]) -> dict[str, tuple[str, ...]]:
    """Holes with a ring around them: a low hollow boss on a face, no step of the body's own outline; or a groove."""
    rings = [
        part
        for part in parts
        if part.kind == "boss" and {"raised", "flat", "hollow"} <= set(part.tags) and "free" not in part.tags
    ]
    found: dict[str, tuple[str, ...]] = {}
    found |= {child: ("ringed",) for ring in rings for child in ring.children if child.startswith("hole-")}
    grooves = [part for part in parts if part.kind == "groove" and "annular" in part.tags and "turned" not in part.tags]
    for hole in parts:
        if hole.kind == "hole" and hole.axis is not None:
            axis, near = hole.axis, (1 - FILLS) * (hole.radius or 0.0)
            around = [one for one in grooves if one.axis is not None and line_key(one.axis) == line_key(axis)]
            if any(line_distance(groove.center, hole.center, axis) < near for groove in around):
                found[hole.id] = ("ringed",)
    return found


def _is_of_head(
    part_id: str, names: Sequence[str], parts: Sequence[Part], held: Mapping[str, Sequence[str]], brep: Brep
) -> bool:
    """Is a step taken for a head where the body has a screw's head already: the chamfer of its corners?"""
    if "head" not in names or part_id in held:
        return False
    bodies = {part.id: brep.faces[part.faces[0]].body for part in parts if part.id == part_id or part.id in held}
    return any("head" in tags and bodies[i] == bodies[part_id] for i, tags in held.items())


def _spokes(parts: Sequence[Part], shape: Shape, brep: Brep) -> dict[str, tuple[str, ...]]:
    """Bars of one section, three or more, that run out in different directions from the model's middle or a wheel's.

    Round ones may differ in length, as where one meets a boss on the rim; those that end by themselves are pins.
    """
    bodies = [part for part in parts if part.kind is PartKind.BODY]
    wheels = [body for body in bodies if "circular" in body.tags and body.axis is not None]
    groups: dict[tuple[object, ...], list[Part]] = defaultdict(list)
    for part in parts:
        if part.kind in (PartKind.PRISM, PartKind.BOSS) and part.axis is not None and "plate" not in part.tags:
            off = dist(part.center, shape.center) > (part.height or 0.0) / 2
            if off and (_is_central(part, shape) or any(_crosses(part, wheel) for wheel in wheels)):
                if part.kind is PartKind.PRISM:
                    groups[part.kind, *_sizes(part)].append(part)
                elif not _is_pin(part, bodies, brep):
                    groups[part.kind, significant(part.diameter or 0.0)].append(part)
    rays = [members for members in groups.values() if len(members) >= MIN_SPOKES]
    rays = [members for members in rays if len({line_key(p.axis) for p in members if p.axis is not None}) > 1]
    return {part.id: ("spoke",) for members in rays for part in members}


def _crosses(bar: Part, wheel: Part) -> bool:
    """Does a bar's axis meet the axis of a round body at a right angle?"""
    assert bar.axis is not None
    assert wheel.axis is not None
    beside = dot(sub(bar.center, wheel.center), unit(cross(bar.axis, wheel.axis)))
    return abs(dot(bar.axis, wheel.axis)) < 1 - UPRIGHT and abs(beside) <= CENTRAL_SHARE * max(wheel.extents)


def _is_pin(bar: Part, bodies: Sequence[Part], brep: Brep) -> bool:
    """Has a round bar an end of its own, that of a pin or screw, which is not inside the rim of the body it is on?"""
    if bar.tip is None or all(brep.faces[i].kind in REVOLVED for i in bar.faces):
        return False
    own = (body for body in bodies if set(bar.faces) <= set(body.faces))
    return not any(dist(bar.tip, body.center) < (1 - CENTRAL_SHARE) * sorted(body.extents)[1] / 2 for body in own)


def _ears(parts: Sequence[Part], brep: Brep) -> dict[str, tuple[str, ...]]:
    """Rounded ends with a hole on their axis; not the two ends of one link, which share a side."""
    holes: dict[Vector, list[Part]] = defaultdict(list)
    for part in parts:
        if part.kind == "hole" and part.axis is not None:
            holes[line_key(part.axis)].append(part)
    sides: dict[int, list[str]] = defaultdict(list)
    for arc in parts:
        if arc.kind is not PartKind.ARC or arc.axis is None or not {"outer", "semicircular"} <= set(arc.tags):
            continue
        near = CENTRAL_SHARE * (arc.radius or 0.0)
        if any(line_distance(hole.center, arc.center, arc.axis) < near for hole in holes[line_key(arc.axis)]):
            for side in {i for face in arc.faces for i in brep.beside(face, EdgeConvexity.SMOOTH)}:
                sides[side].append(arc.id)
    links = {arc for own in sides.values() if len(own) > 1 for arc in own}
    return {arc: ("ear",) for own in sides.values() for arc in own if arc not in links}


def _sizes(part: Part) -> tuple[float, ...]:
    """Its sizes as they compare, to a thousandth of its largest one."""
    sizes = [size or 0.0 for size in (part.diameter, part.width, part.length, part.height)]
    return tuple(round(OFF_ROUND * size / max(sizes), 3) for size in sizes) if max(sizes) > 0 else ()


def _legs(parts: Sequence[Part], shape: Shape) -> dict[str, tuple[str, ...]]:
    """The tags of feet and legs.

    Feet are the solid bodies that reach the ground while others do not, else the protrusions that do. Where a
    protrusion is made of several blocks, as a leg on its foot plate, the longest block is the leg.
    """
    found: dict[str, tuple[str, ...]] = {}
    for foot in _feet(parts, shape):
        own = frozenset(foot.faces)
        steps = [p for p in parts if p.kind in (PartKind.PRISM, PartKind.BOSS)]
        inside = [p for p in steps if p.id != foot.id and own > frozenset(p.faces)]
        inside = [p for p in inside if p.axis is not None and abs(p.axis[2]) > UPRIGHT and "plate" not in p.tags]
        longest = max(inside, key=lambda part: part.extents[2], default=foot)
        # A block that is nearly all of the protrusion is the protrusion itself.
        leg = foot if longest.extents[2] > ALL_OF_LEG * foot.extents[2] or foot.kind == "body" else longest
        found[leg.id] = ("leg",)
        found[foot.id] = (*found.get(foot.id, ()), "foot")
    return found


def _feet(parts: Sequence[Part], shape: Shape) -> list[Part]:
    """Several solid bodies that reach the ground while others do not; else several protrusions that do."""
    top = shape.center[2] + shape.extents[2] / 2
    for kinds in ((PartKind.BODY,), (PartKind.BOSS, PartKind.PRISM, PartKind.PROTRUSION)):
        candidates = [p for p in parts if p.kind in kinds and (p.kind is not PartKind.BOSS or _is_upright(p))]
        candidates = _outermost([part for part in candidates if "spoke" not in part.tags])
        grounded = [part for part in candidates if _is_grounded(part, shape)]
        slim = [part for part in grounded if max(part.extents[:2]) < FOOT_SHARE * max(shape.extents[:2])]
        if PartKind.BODY not in kinds:  # something of the one body stands on them
            slim = [p for p in slim if p.center[2] + p.extents[2] / 2 < top - CENTRAL_SHARE * shape.extents[2]]
        if len(slim) >= MIN_FEET and (PartKind.BODY not in kinds or len(slim) < len(candidates)):
            return slim
    return []


def _is_upright(boss: Part) -> bool:
    """Does it stand? What is lying, as the collars of a shaft, is no foot."""
    return boss.axis is not None and abs(boss.axis[2]) > UPRIGHT


def _outermost(parts: Sequence[Part]) -> list[Part]:
    """Those whose faces are not all faces of another one."""
    faces = [frozenset(part.faces) for part in parts]
    return [
        part
        for i, part in enumerate(parts)
        if not any(faces[i] < other or (faces[i] == other and j < i) for j, other in enumerate(faces) if j != i)
    ]


def _is_grounded(part: Part, shape: Shape) -> bool:
    lowest = shape.center[2] - shape.extents[2] / 2
    return part.center[2] - part.extents[2] / 2 - lowest <= CENTRAL_SHARE * shape.extents[2]


def _is_central(part: Part, shape: Shape) -> bool:
    assert part.axis is not None
    return line_distance(shape.center, part.center, part.axis) <= CENTRAL_SHARE * max(shape.extents)


def _size_key(part: Part, shape: Shape) -> tuple[object, ...]:
    """Same radius to a thousandth of the model, same direction along either way."""
    assert part.axis is not None
    assert part.radius is not None
    step = 1e-4 * max(shape.extents)
    return round(part.radius * OFF_ROUND / step), line_key(part.axis)
