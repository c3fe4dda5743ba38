"""The bore in a step that stands out: which hole runs through it, how far, and how thick the wall around it is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.holes.hole import Hole, Section, SectionKind
from querycad_segworker.features.shared.coaxial_stacks import radius_at, wall_range
from querycad_segworker.features.shared.walls import Axis, Wall
from querycad_segworker.tolerances import reaches
from querycad_segworker.topology import Brep
from querycad_segworker.vectors import parallel

EVEN = 0.1
"""The wall of a hollow cone is as thick at both ends, but for this share; else it tapers, and has no one thickness."""
WINDOWS_RAD = math.radians(240.0)
"""Windows along more than so much of a turn, two thirds of it, leave spokes between them and no disc."""
_CYLINDRICAL = (SectionKind.BORE, SectionKind.SEAT, SectionKind.COUNTERBORE, SectionKind.SPOTFACE)


def length_bored(hole: Hole, axis: Axis, low: float, high: float) -> float:
    """Along how much of the step between `low` and `high` does the hole run? Metres."""
    reach = [axis.position(end) for section in hole.sections for end in (section.start, section.end)]
    return min(max(reach), high) - max(min(reach), low)


@dataclass(frozen=True, slots=True)
class Bore:
    """A bore where it runs through a step. Metres; `lean` in radians between its wall and its axis."""

    radius: float
    wall: float | None
    lean: float


def bore_in(hole: Hole, axis: Axis, step: Wall, low: float, high: float) -> Bore:
    """What is the hole where most of it runs through the step between `low` and `high`?

    A tapered section counts where it runs through more than half of the step, with its radius at the wide end.
    """
    best, widest = Bore(hole.radius, step.radius - hole.radius, 0.0), 0.0
    for section in hole.sections:
        ends = axis.position(section.start), axis.position(section.end)
        a, b = max(min(ends), low), min(max(ends), high)
        if section.kind not in _CYLINDRICAL or b - a <= widest * 1.001:
            continue
        if section.radius == section.end_radius:
            best, widest = Bore(section.radius, step.radius - section.radius, 0.0), b - a
        elif b - a > 0.5 * (high - low):
            best, widest = _tapered(section, axis, step, (a, b)), b - a
    return best


def _tapered(section: Section, axis: Axis, step: Wall, between: tuple[float, float]) -> Bore:
    """The bore with a conical wall that runs through a step between these two positions on the axis."""
    from_, to = axis.position(section.start), axis.position(section.end)
    slope = (section.end_radius - section.radius) / (to - from_)
    low, high = wall_range(axis, step)
    outer = radius_at(axis, step, False), radius_at(axis, step, True)
    inner = [section.radius + slope * (at - from_) for at in between]
    walls = [
        outer[0] + (outer[1] - outer[0]) * (at - low) / (high - low) - r for at, r in zip(between, inner, strict=True)
    ]
    lean = math.atan(abs(slope))
    even = min(walls) > (1 - EVEN) * max(walls)
    return Bore(max(inner), max(walls) * math.cos(lean) if even else None, lean)


def hole_in(holes: Sequence[Hole], axis: Axis, wall: Wall, tip: Vector, base: Vector) -> int | None:
    """The widest coaxial hole that opens in the tip or runs through the step: inside a rim, not the bore of its hub."""
    found: int | None = None
    for index, hole in enumerate(holes):
        if hole.body != wall.body or hole.is_ring or not parallel(hole.normal, axis.direction, 1e-2):
            continue
        if axis.radius_of(hole.opening) > 0.02 * wall.radius or hole.radius >= wall.radius:
            continue
        ends = [axis.position(hole.opening), axis.position(hole.center) * 2 - axis.position(hole.opening)]
        a, b = sorted((axis.position(tip), axis.position(base)))
        inside = min(b, max(ends)) - max(a, min(ends)) > 0.25 * (b - a)
        if inside and (found is None or hole.radius > holes[found].radius):
            found = index
    return found


def inside_of_rim(brep: Brep, axis: Axis, wall: Wall, low: float, high: float) -> Bore | None:
    """The inside of a step that is a ring on spokes, as those of a grille are; None where it is none.

    The windows between the spokes leave concave walls around its axis, as high as it is, along most of a turn.
    """
    turns: dict[float, float] = {}
    for face in (brep.faces[i] for i in brep.bodies[wall.body].faces):
        if face.kind is not SurfaceKind.CYLINDER or face.outward > 0 or face.radius >= wall.radius:
            continue
        if not parallel(face.axis, axis.direction, 1e-2) or axis.radius_of(face.origin) > 0.02 * wall.radius:
            continue
        ends = [axis.position(p) for edge in brep.face_edges[face.id] for p in brep.edges[edge].points]
        if ends and reaches(min(max(ends), high) - max(min(ends), low), high - low):
            radius = round(face.radius, 6)
            turns[radius] = turns.get(radius, 0.0) + face.sweep
    inside = max(turns, default=0.0)
    return Bore(inside, wall.radius - inside, 0.0) if turns.get(inside, 0.0) > WINDOWS_RAD else None
