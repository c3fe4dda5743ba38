"""What are the walls of one hole to each other? Bore, counterbore, spot face, countersink, chamfer, drill point."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.coaxial_stacks import radius_at, wall_range
from querycad_segworker.features.shared.walls import Axis, Wall
from querycad_segworker.tolerances import Tolerances, exceeds, reaches
from querycad_segworker.vectors import dist, scale

from .hole import Section, SectionKind

CHAMFER_RATIO = 1.5
"""A cone at the mouth this much wider than its bore is a countersink, a narrower one a chamfer: heads of countersunk
screws are about twice as wide as their shank (ISO 10642), edge-breaking chamfers of bores at most some 10 to 30 %."""

TAPER = math.tan(math.radians(25.0))
"""A cone that leans less, and is longer than its narrow end's radius, is a tapered bore: countersinks enclose 60
degrees and more (DIN 74), and lead-in chamfers are short."""

BOWL_RATIO = 3.0
"""A cone more than this many times as wide as its narrow end is a bowl, as of a funnel, and no countersink: what heads
of screws (ISO 10642) and centres (DIN 332) need is some two times as wide as what goes on below."""

COUNTERBORE_RATIO = 1.3
"""A counterbore for a head is at least this many times as wide as its bore, about 1.7 to 2 times in DIN 974-1; narrower
steps are seats, of bearings, seals or lenses."""

SPOTFACE_RATIO = 0.25
"""A counterbore shallower than this share of its diameter only faces the surface: a screw head (ISO 4762) sinks in by
more than half of its diameter, the lowest cylinder heads (DIN 7984) by a third."""

GROOVE_RATIO = 1.3
"""A groove in a bore is less than this many times as wide as the bore: about 1.05 for snap rings (DIN 472), up to 1.3
for O-rings in small bores (ISO 3601-2)."""

THREAD_TURNS = 3
"""So many times must a bore alternate between two radii to be a modelled thread; fewer are grooves for snap rings."""

THREAD_PITCH = 0.4
"""A turn of a thread is shorter than this share of its core: 0.35 for the smallest (ISO 724, M1)."""
THREAD_WIDTH = 1.5
"""The outer diameter of a thread is less than this many times its core: 1.4 for the smallest (ISO 724, M1)."""

_DRAFTED = (SectionKind.BORE, SectionKind.COUNTERBORE)


def sections_of(
    inwards: Sequence[Wall], axis: Axis, high: bool, through: bool, point: Wall | None, tolerances: Tolerances
) -> tuple[Section, ...]:
    """What is each wall? From the opening inwards; `high`: the hole opens at the high end of `axis`."""
    cylinders = [i for i, wall in enumerate(inwards) if wall.kind is SurfaceKind.CYLINDER]
    narrow = min((inwards[i].radius for i in cylinders), default=0.0)
    near = 3 * tolerances.length
    bores = [i for i in cylinders if inwards[i].radius <= narrow + near] or [len(inwards) - 1]
    found = []
    for i, wall in enumerate(inwards):
        from_far = through and i > bores[-1]
        outside = inwards[i + 1 :] if from_far else inwards[:i]
        start_high = high != from_far
        low_end, high_end = wall_range(axis, wall)
        start, end = (high_end, low_end) if start_high else (low_end, high_end)
        radius, end_radius = radius_at(axis, wall, start_high), radius_at(axis, wall, not start_high)
        inside = inwards[i - 1] if from_far else inwards[min(i + 1, len(inwards) - 1)]
        above = i < bores[0] or from_far
        over = inwards[min(i + 1, len(inwards) - 1)] if from_far else inwards[max(i - 1, 0)]
        if wall is point:
            kind = SectionKind.DRILL_POINT
        elif wall.kind is SurfaceKind.CYLINDER:
            stepped = above and all(w.radius > wall.radius - near for w in outside)
            deeper = [j for j in reversed(cylinders) if j < i] if from_far else [j for j in cylinders if j > i]
            below = inwards[deeper[0]] if deeper else wall
            plain = not stepped or wall.radius <= narrow + near or _tapers_on(inside, wall)
            kind = SectionKind.BORE if plain else SectionKind.COUNTERBORE
            if kind is SectionKind.COUNTERBORE and not reaches(wall.radius, COUNTERBORE_RATIO * below.radius):
                kind = SectionKind.SEAT
            elif kind is SectionKind.COUNTERBORE and _is_spotface(wall, inside, below, outside):
                kind = SectionKind.SPOTFACE
        elif wall.kind is SurfaceKind.CONE and cylinders and radius > end_radius > 0.05 * radius:
            wide = reaches(radius, CHAMFER_RATIO * end_radius)
            kind = SectionKind.COUNTERSINK if wide else SectionKind.CHAMFER
            within = i > bores[0] and not from_far  # the roof of a chamber or the bottom of a vessel
            slim = radius - end_radius < TAPER * wall.height and wall.height > end_radius
            if slim or (wide and within) or _is_bowl(wall, over):
                floored = above and reaches(end_radius, COUNTERBORE_RATIO * inside.radius)  # drafted, as in a casting
                kind = SectionKind.COUNTERBORE if floored else SectionKind.BORE
        elif through and len(inwards) == 1 and wall.kind is SurfaceKind.CONE and end_radius > 0.05 * radius:
            leans = radius - end_radius > TAPER * wall.height  # a countersink as deep as the sheet is thick
            kind = SectionKind.COUNTERSINK if leans and not _is_bowl(wall, wall) else SectionKind.BORE
        else:
            kind = SectionKind.BORE
        normal = axis.direction if start_high else scale(axis.direction, -1.0)
        is_fillet = wall.kind is SurfaceKind.TORUS
        found.append(Section(kind, axis.at(start), axis.at(end), radius, end_radius, normal, wall.faces, is_fillet))
    return tuple(found)


def over_grooves(inwards: Sequence[Wall], axis: Axis, tolerances: Tolerances) -> list[Wall]:
    """The same walls; those on both sides of a groove turned into them are one, and the groove is none of them.

    Not so where the grooves are turns of a thread.
    """
    near, result, turns = 3 * tolerances.length, list[Wall](), 0
    for wall in inwards:
        before = next((i for i in reversed(range(len(result))) if _alike(result[i], wall, near)), None)
        between = [] if before is None else result[before + 1 :]
        if before is not None and between and _is_groove(between, wall, axis):
            first = result[before]
            ends = (*wall_range(axis, first), *wall_range(axis, wall))
            faces = tuple(sorted({*first.faces, *wall.faces}))
            result[before:] = [replace(first, axis=axis, low=min(ends), high=max(ends), faces=faces)]
            turns += 1
        else:
            result.append(wall)
    return result if turns <= THREAD_TURNS - 1 else list(inwards)


def _alike(one: Wall, other: Wall, near: float) -> bool:
    return one.kind is SurfaceKind.CYLINDER is other.kind and abs(one.radius - other.radius) <= near


def _is_groove(between: Sequence[Wall], beside: Wall, axis: Axis) -> bool:
    """Is it wider than the walls beside it, by little, and no longer than it is wide: for a ring or a seal?"""
    ends = [end for wall in between for end in wall_range(axis, wall)]
    wide = max(wall.radius for wall in between)
    wider = all(wall.radius > beside.radius for wall in between) and not reaches(wide, GROOVE_RATIO * beside.radius)
    return wider and not reaches(max(ends) - min(ends), beside.radius)


def _tapers_on(inside: Wall, wall: Wall) -> bool:
    """Is the next wall inwards a tapered bore or a bowl that goes on from this one, and no floor of a step?"""
    narrow = min(inside.radius_low, inside.radius_high)
    gentle = inside.radius - narrow < TAPER * inside.height and inside.height > narrow
    on = inside.kind is SurfaceKind.CONE and abs(inside.radius - wall.radius) < 0.01 * wall.radius
    return on and (gentle or _is_bowl(inside, wall))


def _is_spotface(wall: Wall, inside: Wall, bore: Wall, outside: Sequence[Wall]) -> bool:
    """The shallow wide first step that only faces the surface around the bore, no deeper than it is wide there."""
    first = all(w.kind is not SurfaceKind.CYLINDER for w in outside)
    most = min(SPOTFACE_RATIO * 2 * wall.radius, wall.radius - bore.radius)
    return first and inside.radius < wall.radius and not reaches(wall.height, most)


def is_shallow(section: Section) -> bool:
    """Does it only face the surface around a bore, or ease its mouth, so that the bore has no step?"""
    eased = section.kind is SectionKind.SEAT and not reaches(
        dist(section.start, section.end), SPOTFACE_RATIO * 2 * section.radius
    )
    return eased or section.kind is SectionKind.SPOTFACE


def _is_bowl(wall: Wall, over: Wall) -> bool:
    """Is it a cone that widens as the bowl of a funnel does? `over`: the wall above it, or itself.

    Below a cylinder that is longer than it, it is the end that a drill left.
    """
    if wall.kind is not SurfaceKind.CONE or not exceeds(
        wall.radius, BOWL_RATIO * min(wall.radius_low, wall.radius_high)
    ):
        return False
    return over.kind is not SurfaceKind.CYLINDER or not exceeds(over.height, wall.height)


def is_fine(cylinders: Sequence[Wall], axis: Axis) -> bool:
    """Do the rings in a bore follow each other as closely as the turns of a thread do?"""
    core = min((wall.radius for wall in cylinders), default=0.0)
    rings = [sum(wall_range(axis, w)) / 2 for w in cylinders if core < w.radius < THREAD_WIDTH * core]
    turns = len(rings) - 1
    return turns > 0 and max(rings) - min(rings) < THREAD_PITCH * 2 * core * turns


def without_ring_thread(steps: Sequence[float], tolerances: Tolerances) -> tuple[float, ...] | None:
    """Which steps are left when those of a thread modelled by rings are one bore? None when there is no such thread.

    Below any counterbore, the bore alternates between two radii that are near each other.
    """
    near = 3 * tolerances.length
    small = min(steps, default=0.0)
    rings = [r for r in steps if r < THREAD_WIDTH * small]
    large = max(rings, default=0.0)
    two_radii = all(abs(r - small) <= near or abs(r - large) <= near for r in rings)
    if not two_radii or len(rings) <= 2 * THREAD_TURNS:
        return None
    return (*(r for r in steps if r >= THREAD_WIDTH * small), small)


def different_radii(radii: Sequence[float], tolerances: Tolerances) -> tuple[float, ...]:
    """Which radii follow each other, neighbours of one radius counted once?"""
    steps: list[float] = []
    for radius in radii:
        if not steps or abs(steps[-1] - radius) > 3 * tolerances.length:
            steps.append(radius)
    return tuple(steps)


def tags_of(sections: Sequence[Section], steps: Sequence[float]) -> tuple[str, ...]:
    """Which canonical attributes of the lexicon follow from the order and shape of the walls?"""
    kinds = {section.kind for section in sections}
    tags = ["circular"]
    if all(section.radius != section.end_radius for section in sections):
        tags.append("conical")
    elif any(
        section.kind in _DRAFTED and section.radius != section.end_radius and not section.is_fillet
        for section in sections
    ):
        tags.append("tapered")
    if len(steps) > 1 or SectionKind.COUNTERBORE in kinds:
        tags.extend(("stepped", "counterbored") if SectionKind.COUNTERBORE in kinds else ("stepped",))
    if SectionKind.COUNTERSINK in kinds:
        tags.extend(("countersunk", "beveled"))
    if SectionKind.CHAMFER in kinds:
        tags.extend(("chamfered", "beveled"))
    if SectionKind.SPOTFACE in kinds:
        tags.append("spotfaced")
    return tuple(dict.fromkeys(tags))
