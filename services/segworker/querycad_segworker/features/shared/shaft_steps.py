"""What is one step of a turned part beside its neighbours: a collar, or the end of what goes on beyond one?"""

from __future__ import annotations

from collections.abc import Sequence, Set

from querycad_contracts import SurfaceKind
from querycad_segworker.tolerances import reaches
from querycad_segworker.topology import Brep, EdgeConvexity
from querycad_segworker.vectors import dot, mean, parallel

from .walls import Axis, Wall

ALIKE = 1.001
"""Lengths and radii that differ by less than this factor are equal on a drawing."""
FLAT = 0.5
"""Shorter than this share of its diameter: a disc, as washers, flanges and plates are."""
FLANGE_RATIO = 1.2
"""A flat step this much wider than its neighbours is a flange: it needs room for fasteners beside them."""
CENTRED = 0.02
"""What lies around an axis has its middle nearer to it than this share of the radius."""


def is_collar(steps: Sequence[tuple[Wall, ...]], place: int, *, hollow: bool, undercut: bool) -> bool:
    """Is it a ring around a shaft, with narrower steps on both sides; else a low hollow step next to a wider one?

    `undercut`: it ends at the body that the steps stand on, so that next to a wider one it is the neck between both.
    """
    around = [_is_around(steps, i) for i in range(len(steps))]
    if any(around):
        return around[place]
    beside = [steps[i][0].radius for i in (place - 1, place + 1) if 0 <= i < len(steps)]
    return hollow and not undercut and any(other > ALIKE * steps[place][0].radius for other in beside)


def _is_around(steps: Sequence[tuple[Wall, ...]], place: int) -> bool:
    """Is it lower than wide, and wider than the steps on both sides of it?"""
    if not 0 < place < len(steps) - 1:
        return False
    radius, height = steps[place][0].radius, sum(wall.height for wall in steps[place])
    wider = all(radius > ALIKE * steps[i][0].radius for i in (place - 1, place + 1))
    return wider and not reaches(height, FLAT * 2 * radius)


def goes_on(steps: Sequence[tuple[Wall, ...]], place: int) -> bool:
    """Is it one end of a longer step of the same radius, with a collar between the two?"""
    radius = steps[place][0].radius
    for way in (steps[place + 1 :], steps[:place][::-1]):
        beyond = next((i for i, step in enumerate(way) if step[0].radius <= ALIKE * radius), 0)
        if beyond > 0 and way[beyond][0].radius * ALIKE >= radius:
            if reaches(sum(wall.height for wall in way[beyond]), FLAT * 2 * radius):
                return True
    return False


def is_clasped(brep: Brep, axis: Axis, faces: Set[int]) -> bool:
    """Are these walls those of a disc with something around its axis that stands on either end face?"""
    ends = set()
    for face in {other for wall in faces for _, other in brep.neighbours(wall)}:
        end = brep.faces[face]
        if end.kind is not SurfaceKind.PLANE or not parallel(end.axis, axis.direction, 1e-2):
            continue
        for loop in end.loops:
            edges = [brep.edges[e] for e in loop.edges]
            concave = all(edge.convexity is EdgeConvexity.CONCAVE for edge in edges)
            outside = any(not faces.isdisjoint(edge.faces) for edge in edges)
            if concave and not outside and not loop.outer:
                middle = mean([edge.center if edge.closed and edge.center else edge.mid for edge in edges])
                if axis.radius_of(middle) < CENTRED * max(brep.faces[wall].radius for wall in faces):
                    ends.add(dot(end.axis, axis.direction) > 0)
    return len(ends) == 2
