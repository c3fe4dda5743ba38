"""Pieces of turned parts: heads, shanks, necks, tips, eyes and bars across, by how the steps on one axis follow."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import combinations

from querycad_contracts import Part, PartKind, Vector
from querycad_segworker.features.shared.part_measures import faces_area, faces_box, geometry, millimetres
from querycad_segworker.tolerances import FACING, significant
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import add, box_extents, cross, dist, dot, line_distance, mid, norm, scale, sub, unit

HEAD_RATIO = (1.15, 4.0)
"""A head is wider than its shank by these factors: little on headed pins (ISO 2341), up to 4 on studs and caps."""
NECK_LENGTH = 1.0
"""A neck, undercut or fillet between head and shank is no longer than this many diameters of the shank."""
TUBE_RATIO = 0.5
"""What is bored out to more than half its diameter is a tube with a flange rather than a shank with a head."""
SHORT = 1.0
"""A spigot is no longer than this many of its diameters."""
NARROWER = 0.999
"""Steps that differ by less are one."""
NEAR = 0.05
"""Steps whose axes lie apart by less than this share of the radius are on one axis."""
SQUARE = 0.1
"""Sine of the angle by which a bar across, or the shank of an eye, may lean."""


def turned_pieces(parts: Sequence[Part], brep: Brep) -> dict[str, tuple[str, ...]]:
    """What is each step to the turned part that it belongs to? Tags by id of the part.

    'head': the wider end, lower than the shank is long; 'shank': the longest step, not wider than half of its length;
    'end_step', 'middle_step': at an end of its axis, or between others; 'neck': narrower than what is on both sides of
    it; 'spigot': a short narrower end; 'tip': a cone at the free end; 'eye': a ring with a shank that runs towards its
    middle; 'headed': a body with head and shank.
    """
    found: dict[str, list[str]] = defaultdict(list)
    bodies = {part.faces: part.id for part in parts if part.kind == "body"}
    for body, members in _by_body(parts, brep).items():
        for chain in _chains(members):
            for part_id, tag in _roles(chain):
                found[part_id].append(tag)
                if tag == "head":
                    found[bodies.get(brep.bodies[body].faces, "")].append("headed")
        for part_id, tag in _eyes(members):
            found[part_id].append(tag)
    found.pop("", None)
    return {part_id: tuple(dict.fromkeys(tags)) for part_id, tags in found.items()}


def crossbars(parts: Sequence[Part], brep: Brep) -> list[Part]:
    """Which bars go right across a thicker one, as the handle of a T? One part from tip to tip, with both ends."""
    found = []
    for members in _by_body(parts, brep).values():
        ends = [part for part in members if part.kind == "boss" and part.tip is not None and "free" not in part.tags]
        for a, b in combinations(ends, 2):
            if _are_one_bar(a, b) and any(_goes_through(other, a, b) for other in members):
                found.append((a, b))
    return [_crossbar(brep, a, b, number) for number, (a, b) in enumerate(found, start=1)]


def _by_body(parts: Sequence[Part], brep: Brep) -> dict[int, list[Part]]:
    own: dict[int, list[Part]] = defaultdict(list)
    for part in parts:
        turned = part.kind == "groove" and "turned" in part.tags
        if part.kind is PartKind.PRISM and "hub" in part.tags:
            continue  # it is made of steps
        if (part.kind in (PartKind.BOSS, PartKind.PRISM) or turned or part.tube_diameter) and part.axis is not None:
            own[brep.faces[part.faces[0]].body].append(part)
    for ball in parts:
        if ball.kind == "sphere" and "outer" in ball.tags:
            body = own[brep.faces[ball.faces[0]].body]
            if not any(set(ball.faces) & set(part.faces) for part in body):  # no cap of a step
                body.append(ball)
    return own


def _span(part: Part, axis: Vector) -> tuple[float, float]:
    """From where to where does it reach along the axis?"""
    middle, half = dot(part.center, axis), (part.height or part.width or part.diameter or 0.0) / 2
    return middle - half, middle + half


def _chains(members: Sequence[Part]) -> Iterator[list[Part]]:
    """Steps on one axis, in order along it, each with its own place."""
    left = [part for part in members if part.kind in (PartKind.BOSS, PartKind.PRISM, PartKind.GROOVE, PartKind.SPHERE)]
    while left:
        lead = max(left, key=_rank)
        if lead.kind != "boss" or not lead.radius or lead.axis is None:
            return
        axis, near = lead.axis, NEAR * lead.radius
        chain = [
            part
            for part in left
            if (part.kind == "sphere" or (part.axis is not None and norm(cross(part.axis, axis)) < NEAR))
            and line_distance(part.center, lead.center, axis) < near
        ]
        left = [part for part in left if part not in chain]
        yield sorted(chain, key=lambda part: _span(part, axis))


def _rank(part: Part) -> tuple[bool, float, float]:
    """The longest step is a turned part's main one; of two as long, the wider one."""
    return part.kind == "boss", significant(part.height or 0.0), significant(part.diameter or 0.0)


def _roles(chain: Sequence[Part]) -> Iterator[tuple[str, str]]:
    steps = [part for part in chain if part.kind != "groove"]
    shank = max(steps, key=_rank)
    if len(steps) < 2 or shank.axis is None:
        return
    axis = shank.axis
    yield steps[0].id, "end_step"
    yield steps[-1].id, "end_step"
    for i in range(1, len(steps) - 1):
        around = (steps[i - 1], steps[i + 1])
        yield steps[i].id, "middle_step"
        if all(_width(steps[i]) < NARROWER * _width(beside) for beside in around):
            yield steps[i].id, "neck"
    for end, beside in ((steps[0], steps[1]), (steps[-1], steps[-2])):
        narrower = _width(end) < NARROWER * _width(beside)
        if narrower and "cylindrical" in end.tags and (end.height or 0.0) <= SHORT * (end.diameter or 0.0):
            yield end.id, "spigot"
    if not _is_shank(shank):
        return
    heads = [step for step in (steps[0], steps[-1]) if step is not shank and _is_head(step, shank, axis)]
    if len(heads) != 1:
        return
    head = heads[0]
    yield head.id, "head"
    yield shank.id, "shank"
    between = sorted((dot(head.center, axis), dot(shank.center, axis)))
    for part in chain:
        if part.kind == "groove" and between[0] < dot(part.center, axis) < between[1]:
            yield part.id, "neck"
    last = steps[-1] if head is steps[0] else steps[0]
    if last is not shank and "conical" in last.tags:
        yield last.id, "tip"


def _width(part: Part) -> float:
    return part.width or part.diameter or 0.0


def _is_shank(part: Part) -> bool:
    hollow = part.inner_diameter is not None and part.inner_diameter > TUBE_RATIO * (part.diameter or 0.0)
    return {"cylindrical", "slender"} <= set(part.tags) and not hollow


def _is_head(head: Part, shank: Part, axis: Vector) -> bool:
    """Is it wider than the shank, lower than that is long, with no more than a neck between the two?"""
    low, high = HEAD_RATIO
    width, diameter = _width(head), shank.diameter or 0.0
    if not low * diameter <= width <= high * diameter or (head.height or 0.0) >= (shank.height or 0.0):
        return False
    (a, b), (c, d) = _span(head, axis), _span(shank, axis)
    return max(a, c) - min(b, d) <= NECK_LENGTH * diameter


def _eyes(members: Sequence[Part]) -> Iterator[tuple[str, str]]:
    rings = [
        p for p in members if p.tube_diameter or (p.kind == "boss" and p.inner_diameter and "slender" not in p.tags)
    ]
    shanks = [p for p in members if p.kind == "boss" and {"cylindrical", "slender"} <= set(p.tags)]
    for ring in rings:
        reach = (ring.outer_diameter or 0.0) / 2
        for shank in shanks:
            if shank is ring or shank.axis is None or ring.axis is None or not shank.height:
                continue
            square = abs(dot(shank.axis, ring.axis)) < SQUARE
            central = line_distance(ring.center, shank.center, shank.axis) < SQUARE * reach
            joined = dist(ring.center, shank.center) <= reach + 0.55 * shank.height
            if square and central and joined and (shank.diameter or 0.0) < reach:
                yield ring.id, "eye"
                yield shank.id, "shank"


def _are_one_bar(a: Part, b: Part) -> bool:
    """Do two ends of one radius point away from each other along one line?"""
    if a.radius is None or b.radius is None or a.normal is None or b.normal is None or a.tip is None or b.tip is None:
        return False
    alike = abs(a.radius - b.radius) <= 1e-3 * a.radius and dot(a.normal, b.normal) < -FACING.parallel
    between = sub(b.center, a.center)
    apart = dot(between, b.normal) - ((a.height or 0.0) + (b.height or 0.0)) / 2
    return alike and apart > 0 and line_distance(b.center, a.center, a.normal) < NEAR * a.radius


def _goes_through(other: Part, a: Part, b: Part) -> bool:
    """Is this the thicker part that lies between both ends of a bar, across it?"""
    if other is a or other is b or other.axis is None or a.normal is None or other.kind != "boss":
        return False
    wide = (other.radius or 0.0) > 1.01 * (a.radius or 0.0)
    middle = mid(a.center, b.center)
    square = abs(dot(other.axis, a.normal)) < SQUARE
    gap = dist(a.center, b.center) - ((a.height or 0.0) + (b.height or 0.0)) / 2
    around = line_distance(middle, other.center, other.axis) < NEAR * (other.radius or 0.0)
    low, high = _span(other, other.axis)
    within = low < dot(middle, other.axis) < high
    return wide and square and around and within and gap <= 2.0 * (other.radius or 0.0) * 1.01


def _crossbar(brep: Brep, a: Part, b: Part, number: int) -> Part:
    assert a.tip is not None
    assert b.tip is not None
    assert a.radius is not None
    length = dist(a.tip, b.tip)
    faces = tuple(sorted({*a.faces, *b.faces}))
    axis = unit(sub(b.tip, a.tip))
    return Part(
        id=f"crossbar-{number}",
        kind="crossbar",
        tags=("cylindrical", "circular", "slender", "rod"),
        label=f"bar across, diameter {millimetres(2 * a.radius)}, length {millimetres(length)}",
        faces=faces,
        center=add(a.tip, scale(axis, length / 2)),
        extents=box_extents(faces_box(brep, faces)),
        axis=axis,
        radius=a.radius,
        diameter=2 * a.radius,
        outer_diameter=2 * a.radius,
        width=2 * a.radius,
        length=length,
        height=length,
        tip=b.tip,
        tips=(b.tip, a.tip),
        radii=(a.radius,),
        area=faces_area(brep, faces),
        children=(a.id, b.id),
        evidence=geometry("two round ends of one radius on one line, on both sides of what they go through"),
    )
