"""Where round steps end whose wall goes on beyond their end face, in jaws, or is cut off obliquely."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.coaxial_stacks import winding
from querycad_segworker.features.shared.shaft_steps import FLAT
from querycad_segworker.features.shared.walls import Axis, Wall
from querycad_segworker.tolerances import Tolerances, reaches
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import dot, sub

SQUARE = 1 - 1e-4
"""Cosine of the angle, under a degree, within which an end face is square to the axis."""
STEEP = 0.2
"""Cosine of the angle, some 78 degrees, within which a plane cuts a step off; what leans more is a flat along it."""
WHOLE_TURN = math.radians(350.0)
"""So much of the rim lies in a plane that cuts a step off."""


def before_jaws(
    brep: Brep, axis: Axis, step: Sequence[Wall], between: tuple[float, float], tolerances: Tolerances
) -> tuple[float, float]:
    """From where to where along its axis does a disc reach, without the jaws that stand on its end level with its rim?

    `step`: its walls in order along `axis`; `between`: its ends with all that is of its wall. An end face that more
    than half of its rim lies in is where it ends. Slots that leave more than half of the rim are cut into it, and a
    shaft, longer than `FLAT` of its diameter, goes to the end of its tang.
    """
    low, high = between
    tops, feet = _levels(brep, axis, step[-1], up=True), _levels(brep, axis, step[0], up=False)
    near = 3 * tolerances.length
    top = next((at for at, turn in tops.items() if turn > math.pi and low + near < at < high - near), high)
    foot = next((at for at, turn in feet.items() if turn > math.pi and low + near < at < high - near), low)
    return between if foot >= top or reaches(top - foot, FLAT * 2 * step[0].radius) else (foot, top)


def _levels(brep: Brep, axis: Axis, wall: Wall, *, up: bool) -> dict[float, float]:
    """Positions of the planes, square to the axis, that a wall ends at on one side: how far around, radians."""
    turns: dict[float, float] = defaultdict(float)
    for plane, turn in _end_planes(brep, axis, wall):
        slope = dot(plane.axis, axis.direction)
        if (slope if up else -slope) > SQUARE:
            at = axis.position(plane.point)
            turns[next((known for known in turns if abs(known - at) < 1e-3 * wall.radius), at)] += turn
    return turns


def oblique_ends(brep: Brep, axis: Axis, step: Sequence[Wall]) -> tuple[float, float, float] | None:
    """Where does the axis pierce two parallel planes that cut a step off obliquely, and how far apart are they, square?

    None where they are not parallel: then it has no one length. Metres.
    """
    if len(step) != 1:
        return None
    ends = {
        plane.id: (plane, dot(plane.axis, axis.direction))
        for plane, turn in _end_planes(brep, axis, step[0])
        if turn > WHOLE_TURN
    }
    planes = sorted(ends.values(), key=lambda end: end[1])
    if len(planes) != 2 or not all(STEEP < abs(slope) < SQUARE for _, slope in planes):
        return None
    (below, low), (above, high) = planes
    if dot(below.axis, above.axis) > -SQUARE:
        return None
    at = [dot(sub(plane.point, axis.origin), plane.axis) / slope for plane, slope in planes]
    return (at[0], at[1], (at[1] - at[0]) * high) if low < 0 < high and at[0] < at[1] else None


def _end_planes(brep: Brep, axis: Axis, wall: Wall) -> Iterator[tuple[FaceRecord, float]]:
    """The planes that a wall meets in convex edges around its axis, and how far around each edge goes, radians."""
    for face in wall.faces:
        for edge, other in brep.neighbours(face):
            if edge.convexity is EdgeConvexity.CONVEX and brep.faces[other].kind is SurfaceKind.PLANE:
                yield brep.faces[other], winding(axis, edge)
