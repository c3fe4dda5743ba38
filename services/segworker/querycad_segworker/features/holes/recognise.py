"""Holes: bores with whatever lies on their axis, from the mouth's chamfer to the drill point, each counted once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from querycad_contracts import Bottom, SurfaceKind
from querycad_segworker.features.depressions.windows import recognise_windows
from querycad_segworker.features.shared.clearance import IsClear
from querycad_segworker.features.shared.coaxial_stacks import End, Stack, radius_at, stacks, wall_range
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.walls import Wall, is_waist
from querycad_segworker.tolerances import Tolerances, reaches
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import scale

from .ends import (
    CORE_RATIO,
    Bores,
    ball_below,
    bottom_of,
    closed_by_balls,
    closing_faces,
    core_of,
    drill_point,
    flats_of,
    is_floor,
    is_pointed,
    level_mouth,
    mouth_rounding,
    oblique_mouth,
    opens_high,
    round_mouth,
)
from .hole import RIM, Hole, Section, SectionKind
from .inline_bores import united_through_walls
from .sections import (
    THREAD_WIDTH,
    different_radii,
    is_fine,
    is_shallow,
    over_grooves,
    sections_of,
    tags_of,
    without_ring_thread,
)

RECESS_RATIO = 0.25
"""Shallower than this share of its diameter, a blind round recess by itself is a pocket; drilled and bored holes are
deeper."""
QUARTER_RAD = math.radians(100.0)
"""A concave cylinder over less than this is a rounded corner, and nobody takes it for a hole."""


def recognise_holes(
    brep: Brep, walls: Sequence[Wall], tolerances: Tolerances, is_clear: IsClear | None = None
) -> list[Hole]:
    """Which holes does the model have? Sorted by their lowest face id.

    A hole is a stack of concave coaxial walls that enclose their axis, of which one at least is a cylinder or cone,
    and which is open at one end at least. With `is_clear`, bores through the two walls of a fork become one hole.
    """
    found = []
    bores = Bores(brep, walls)
    windows = recognise_windows(brep, tolerances)
    hubs = [wall for wall in walls if wall.kind is SurfaceKind.CYLINDER and wall.outward > 0 and wall.encloses]
    keyholes = {face for window in windows if window.outline == "keyhole" for face in window.faces}
    for stack in stacks(brep, walls, tolerances, lambda wall: _widens(brep, wall), over_roundings=True):
        if keyholes.issuperset(stack.faces):
            refuse("hole", stack.faces, "it is the wide end of a keyhole")
            continue
        if all(wall.kind is SurfaceKind.TORUS for wall in stack.walls):
            refuse("hole", stack.faces, "a hollow torus alone has no straight wall")
            continue
        if stack.low_end is End.CLOSED and stack.high_end is End.CLOSED:
            refuse("hole", stack.faces, "both of its ends are closed")
            continue
        hole = _hole(brep, closed_by_balls(brep, stack), bores, tolerances)
        if stack.open_both and _is_around_hub(stack, hubs, tolerances):
            hole = replace(hole, tags=(*hole.tags, RIM))
        if _is_recess(hole):
            refuse("hole", hole.faces, "it is shallow against its width: a round pocket")
            continue
        found.append(hole)
    for wall in walls:
        if wall.kind is SurfaceKind.CYLINDER and wall.outward < 0 and not wall.encloses and wall.sweep > QUARTER_RAD:
            refuse("hole", wall.faces, f"its wall covers {math.degrees(wall.sweep):.0f} of 360 degrees")
    if is_clear is not None:
        found = united_through_walls(found, tolerances, is_clear)
    return sorted(found, key=lambda hole: hole.faces[0])


def _widens(brep: Brep, wall: Wall) -> bool:
    """Is it a wall of a bore? A hollow torus that narrows is the fillet at the foot of what stands in the bore."""
    narrows = wall.kind is SurfaceKind.TORUS and is_waist(brep.faces[wall.faces[0]])
    return wall.outward < 0 and wall.encloses and not narrows


def _is_recess(hole: Hole) -> bool:
    """Is it a shallow round pocket with a flat floor, and nothing else on its axis but the fillet of that floor?"""
    stages = [section for section in hole.sections if not section.is_fillet]
    alone = len(stages) == 1 and hole.sections[0].kind is SectionKind.BORE and not hole.is_ring
    return alone and hole.bottom is Bottom.FLAT and not reaches(hole.depth, RECESS_RATIO * 2 * hole.radius)


def _is_around_hub(stack: Stack, hubs: Sequence[Wall], tolerances: Tolerances) -> bool:
    """Does one of the outer cylinders stand in it, for most of its length, as in a wheel with spokes?"""
    narrowest = min(own.radius for own in stack.walls)
    for hub in hubs:
        narrow = hub.body == stack.walls[0].body and hub.radius < narrowest
        if narrow and hub.axis.same_line(stack.axis, tolerances):
            low, high = wall_range(stack.axis, hub)
            if min(high, stack.high) - max(low, stack.low) > CORE_RATIO * (stack.high - stack.low):
                return True
    return False


def _hole(brep: Brep, stack: Stack, bores: Bores, tolerances: Tolerances) -> Hole:
    axis = stack.axis
    open_both = stack.open_both
    inside_low, inside_high = (bores.ends_in(stack, high) for high in (False, True))
    if open_both and inside_low != inside_high:
        high = inside_low
    else:
        high = opens_high(stack) if open_both else stack.high_end is End.OPEN
    inwards = sorted(stack.walls, key=lambda w: wall_range(axis, w), reverse=high)
    point = drill_point(stack, high)
    form = _form(inwards, stack, high, point, tolerances)
    mouth = mouth_rounding(brep, stack, high)
    far = mouth_rounding(brep, stack, not high) if open_both else None
    top, end = _ends(brep, stack, high, open_both, [w for w in inwards if w is not point] or inwards)
    pierced = bores.pierced(stack, not high) if (inside_low if high else inside_high) else None
    if pierced is not None:
        end = pierced
    if mouth is not None:
        top = (max if high else min)(top, mouth[1])
    if far is not None:
        end = (min if high else max)(end, far[1])
    floor = () if open_both else closing_faces(brep, stack, not high)
    ball = ball_below(brep, stack, not high) if not open_both else None
    if ball is not None:
        floor, end = (ball.face,), ball.end
    flats = flats_of(brep, stack)
    faces = {*stack.faces, *stack.shoulders, *flats}
    faces |= {face for rounding in (mouth, far) if rounding is not None for face in rounding[0]}
    faces |= {f for f in floor if is_floor(brep, f, axis, inwards[-1].radius if form.cylinders else form.bore)}
    if not open_both and not floor and is_pointed(stack, not high):
        floor = inwards[-1].faces
    core = None if open_both else core_of(brep, floor, axis, end, abs(top - end))
    faces.update(core[1] if core is not None else ())
    crosses = (inside_low if high else inside_high) or (inside_low and inside_high)
    bottom = bottom_of(brep, floor, point) if not open_both else Bottom.BORE if crosses else Bottom.THROUGH
    said = {
        "threaded": form.threaded,
        "rounded": mouth is not None,
        "oblique": oblique_mouth(brep, stack, high) is not None,
        "d_shaped": bool(flats),
        "double_d": len(flats) == 2,
    }
    return Hole(
        opening=axis.at(top),
        far_opening=axis.at(end) if open_both else None,
        normal=axis.direction if high else scale(axis.direction, -1.0),
        center=axis.at((top + end) / 2),
        radius=form.bore,
        opening_radius=mouth[2] if mouth else radius_at(axis, inwards[0], high),
        steps=form.steps,
        depth=abs(top - end),
        bottom=bottom,
        tags=(
            {Bottom.THROUGH: "through", Bottom.BORE: "cross"}.get(bottom, "blind"),
            *tags_of(form.sections, form.steps),
            *(tag for tag, is_so in said.items() if is_so),
        ),
        faces=tuple(sorted(faces)),
        body=stack.walls[0].body,
        sections=form.sections,
        pitch=form.pitch,
        core_radius=core[0] if core is not None else None,
    )


@dataclass(frozen=True, slots=True)
class _Form:
    """What the walls of a hole make along its axis. Metres."""

    cylinders: list[Wall]
    sections: tuple[Section, ...]
    steps: tuple[float, ...]
    bore: float
    """The radius of the narrowest cylinder, or cone end."""
    threaded: bool
    pitch: float | None


def _form(inwards: Sequence[Wall], stack: Stack, high: bool, point: Wall | None, tolerances: Tolerances) -> _Form:
    """Sections and steps from the opening inwards, those of a thread as one bore; `high`: it opens at the high end."""
    stretches = over_grooves(inwards, stack.axis, tolerances)
    sections = sections_of(stretches, stack.axis, high, stack.open_both, point, tolerances)
    shallow = {f for s in sections if is_shallow(s) for f in s.faces}
    cylinders = [w for w in stretches if w.kind is SurfaceKind.CYLINDER]
    steps = different_radii([w.radius for w in cylinders if shallow.isdisjoint(w.faces)], tolerances)
    pitch = next((w.pitch for w in stack.walls if w.pitch is not None), None)
    bare = without_ring_thread(steps, tolerances) if is_fine(cylinders, stack.axis) else None
    if bare is not None:
        sections = tuple(s for s in sections if s.radius >= THREAD_WIDTH * min(bare))
    ends = [min(w.radius_low, w.radius_high) or w.radius for w in inwards]
    bore = min((w.radius for w in cylinders), default=min(ends))
    threaded = bare is not None or pitch is not None
    return _Form(cylinders, sections, steps if bare is None else bare, bore, threaded, pitch)


def _ends(brep: Brep, stack: Stack, high: bool, open_both: bool, inwards: Sequence[Wall]) -> tuple[float, float]:
    """Where along the axis are opening and end? Of oblique and round mouths, where the axis pierces the face.

    Of one that grazes a fillet, where the plane beside it is.
    """
    ends = [p for w in inwards for p in wall_range(stack.axis, w)]
    top, end = (stack.high, min(ends)) if high else (stack.low, max(ends))
    mouth, far = (
        next(
            (at for find in (oblique_mouth, round_mouth, level_mouth) if (at := find(brep, stack, h)) is not None), None
        )
        for h in (high, not high)
    )
    return top if mouth is None else mouth, end if far is None or not open_both else far
