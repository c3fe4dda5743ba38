"""Bosses: cylindrical and conical steps that stand out of the material, from a flat disc to a long shaft."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import parallel, scale

from .holes import Hole
from .stacks import End, Stack, radius_at, stacks, wall_range
from .walls import Axis, Wall

SLENDER = 1.0
"""Longer than its diameter: a shaft, pin or rod rather than a boss or disc."""
FLAT = 0.5
"""Shorter than this share of its diameter: a disc, as washers, flanges and plates are."""


@dataclass(frozen=True, slots=True)
class Boss:
    """One step that stands out. Metres, frame of the file.

    `normal` points from `base` to `tip` along the axis. `radius` is the widest, `tip_radius` that at the tip.
    `hole` is the index of the coaxial hole in its tip, of a standoff or ring; `step_of` counts the steps of its stack.
    """

    base: Vector
    tip: Vector
    normal: Vector
    radius: float
    tip_radius: float
    height: float
    tags: tuple[str, ...]
    faces: tuple[int, ...]
    body: int
    hole: int | None
    step_of: int


def recognise_bosses(brep: Brep, walls: Sequence[Wall], holes: Sequence[Hole], tolerances: Tolerances) -> list[Boss]:
    """Which round protrusions does the model have? One record a step, sorted by lowest face id.

    A step is a convex cylinder or cone that encloses its axis; roundings and chamfers at its ends belong to it.
    """
    found: list[Boss] = []
    for stack in stacks(brep, walls, tolerances, lambda wall: wall.outward > 0 and wall.encloses):
        steps = [wall for wall in stack.walls if _is_step(wall, stack) and not is_neck(wall, stack)]
        found.extend(_boss(brep, stack, steps, wall, holes, tolerances) for wall in steps)
    return sorted(found, key=lambda boss: boss.faces[0])


def _is_step(wall: Wall, stack: Stack) -> bool:
    """A cylinder is; a cone is unless it merely breaks the edge of a cylinder next to it."""
    if wall.kind is SurfaceKind.CYLINDER:
        return True
    cylinders = [w for w in stack.walls if w.kind is SurfaceKind.CYLINDER]
    return wall.kind is SurfaceKind.CONE and all(wall.height > 0.5 * c.radius for c in cylinders)


def is_neck(wall: Wall, stack: Stack) -> bool:
    """Is it the bottom of a groove turned into a shaft: shorter than its diameter, between two wider walls?"""
    low, high = wall_range(stack.axis, wall)
    if wall.height >= 2 * wall.radius:
        return False
    below = [w for w in stack.walls if w is not wall and wall_range(stack.axis, w)[1] <= low + 0.01 * wall.height]
    above = [w for w in stack.walls if w is not wall and wall_range(stack.axis, w)[0] >= high - 0.01 * wall.height]
    return all(any(w.radius > 1.001 * wall.radius for w in side[-1:]) for side in (below, above[:1]))


def _boss(
    brep: Brep, stack: Stack, steps: Sequence[Wall], wall: Wall, holes: Sequence[Hole], tolerances: Tolerances
) -> Boss:
    axis = stack.axis
    tip_high = _tip_is_high(stack, wall)
    low, high = wall_range(axis, wall)
    faces = set(wall.faces)
    # Edge breaks next to the wall lengthen it to the shoulder or end face that they run into.
    for other in stack.walls:
        if other not in steps:
            a, b = wall_range(axis, other)
            near = 3 * tolerances.length
            if abs(a - high) <= near:
                high = b
                faces.update(other.faces)
            elif abs(b - low) <= near:
                low = a
                faces.update(other.faces)
    tip, base = (axis.at(high), axis.at(low)) if tip_high else (axis.at(low), axis.at(high))
    normal = axis.direction if tip_high else scale(axis.direction, -1.0)
    free = stack.low_end is End.OPEN and stack.high_end is End.OPEN
    for end in (tip, base) if free else (tip,):
        end_face = _end_face(brep, axis, wall, axis.position(end), stack)
        if end_face is not None:
            faces.add(end_face)
    hole = _hole_in(holes, axis, wall, tip, base)
    tags = ["cylindrical" if wall.kind is SurfaceKind.CYLINDER else "conical", "circular"]
    diameter, height = 2 * wall.radius, high - low
    if height > SLENDER * diameter:
        tags.append("slender")
    if height < FLAT * diameter:
        tags.append("flat")
    if hole is not None:
        tags.append("hollow")
    if free:
        tags.append("free")
    if len(steps) > 1:
        tags.append("stepped")
    return Boss(
        base=base,
        tip=tip,
        normal=normal,
        radius=wall.radius,
        tip_radius=radius_at(axis, wall, tip_high),
        height=height,
        tags=tuple(tags),
        faces=tuple(sorted(faces)),
        body=wall.body,
        hole=hole,
        step_of=len(steps),
    )


def _tip_is_high(stack: Stack, wall: Wall) -> bool:
    """Which end is free?

    The open one; with both open, the one away from the widest wall; else the end facing top, then front, then right.
    """
    if (stack.low_end is End.OPEN) != (stack.high_end is End.OPEN):
        return stack.high_end is End.OPEN
    widest = max(stack.walls, key=lambda w: w.radius)
    if widest is not wall and widest.radius > 1.001 * wall.radius:
        return sum(wall_range(stack.axis, wall)) > sum(wall_range(stack.axis, widest))
    x, y, z = stack.axis.direction
    return next((c > 0 for c in (z, -y, x) if abs(c) > 0.05), True)


def _end_face(brep: Brep, axis: Axis, wall: Wall, position: float, stack: Stack) -> int | None:
    """The plane that closes an end, where it is not wider than the step."""
    for face_id in {*stack.low_faces, *stack.high_faces, *stack.shoulders}:
        face = brep.faces[face_id]
        if face.kind is not SurfaceKind.PLANE or not parallel(face.axis, axis.direction, 1e-2):
            continue
        (x0, y0, z0), (x1, y1, z1) = face.box
        reach = max(axis.radius_of((x, y, z)) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1))
        near = abs(axis.position(face.point) - position) <= 0.02 * max(wall.height, wall.radius)
        if near and reach <= 1.5 * wall.radius:
            return face_id
    return None


def _hole_in(holes: Sequence[Hole], axis: Axis, wall: Wall, tip: Vector, base: Vector) -> int | None:
    """The coaxial hole that opens in the tip or runs through the step."""
    for index, hole in enumerate(holes):
        if hole.body != wall.body or hole.is_ring or not parallel(hole.normal, axis.direction, 1e-2):
            continue
        if axis.radius_of(hole.opening) > 0.02 * wall.radius or hole.radius >= wall.radius:
            continue
        ends = [axis.position(hole.opening), axis.position(hole.center) * 2 - axis.position(hole.opening)]
        a, b = sorted((axis.position(tip), axis.position(base)))
        if min(b, max(ends)) - max(a, min(ends)) > 0.25 * (b - a):
            return index
    return None
