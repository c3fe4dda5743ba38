"""What recognition does with vectors, lines and boxes, beside the algebra of `querycad_contracts.vectors`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from querycad_contracts import Vector
from querycad_contracts.vectors import ORIGIN, add, coordinate_axis, cross, dot, norm, scale, sub, unit

__all__ = ["ORIGIN", "add", "coordinate_axis", "cross", "dot", "norm", "scale", "sub", "unit"]
"""What is told here as well, for those who need both."""

AXES: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""Of the file."""


def dist(a: Vector, b: Vector) -> float:
    """How far apart are two points?"""
    return math.dist(a, b)


def mid(a: Vector, b: Vector) -> Vector:
    """Which point is half-way between two points?"""
    return ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2)


def mean(points: Sequence[Vector]) -> Vector:
    """What is the centroid of the points? At least one is needed."""
    n = len(points)
    return (sum(p[0] for p in points) / n, sum(p[1] for p in points) / n, sum(p[2] for p in points) / n)


def perpendicular(a: Vector) -> Vector:
    """Which unit vector stands at right angles to the unit vector `a`? Any one, the same for the same input."""
    helper: Vector = (1.0, 0.0, 0.0) if abs(a[0]) < 0.7 else (0.0, 1.0, 0.0)
    return unit(cross(a, helper))


def across(direction: Vector) -> tuple[Vector, Vector]:
    """Which two unit vectors stand at right angles to a unit vector, and to each other? The same for the same input."""
    x = perpendicular(direction)
    return x, cross(direction, x)


def around(center: Vector, axis: Vector, radius: float, count: int) -> list[Vector]:
    """Which points lie at equal angles on a circle?"""
    x, y = across(axis)
    angles = [2 * math.pi * i / count for i in range(count)]
    offsets = (add(scale(x, radius * math.cos(a)), scale(y, radius * math.sin(a))) for a in angles)
    return [add(center, offset) for offset in offsets]


def line_distance(point: Vector, origin: Vector, direction: Vector) -> float:
    """How far is a point from the line through `origin` along the unit vector `direction`?"""
    return norm(cross(sub(point, origin), direction))


def foot(point: Vector, origin: Vector, direction: Vector) -> Vector:
    """Which point of the line is nearest to `point`?"""
    return add(origin, scale(direction, dot(sub(point, origin), direction)))


def parallel(a: Vector, b: Vector, tolerance_rad: float) -> bool:
    """Are two unit vectors parallel or antiparallel, within a small angle?"""
    return norm(cross(a, b)) <= tolerance_rad


def points_up(direction: Vector) -> bool:
    """Of the two ways along a line, is it the one to the top, else to the front, else to the right?"""
    x, y, z = direction
    return next((c > 0 for c in (z, -y, x) if abs(c) > 0.05), True)


def upwards(direction: Vector) -> Vector:
    """Which of the two ways along a line points up, as `points_up` has it?"""
    return direction if points_up(direction) else scale(direction, -1.0)


def span(points: Iterable[Vector], direction: Vector) -> tuple[float, float]:
    """From where to where do points reach along a direction? (0, 0) without points."""
    x, y, z = direction
    along = [p[0] * x + p[1] * y + p[2] * z for p in points]
    return min(along, default=0.0), max(along, default=0.0)


OFF_ROUND = 1.0003717
"""Drawings have round numbers, and halves of them: without this factor those would lie on the borders between bins,
where the kernel's noise decides."""


def binned(value: float, digits: int = 3) -> str:
    """Which bin of so many significant digits holds the value? Equal values of round numbers share one."""
    return f"{value * OFF_ROUND:.{digits}g}"


def line_key(direction: Vector) -> Vector:
    """Which key do all unit vectors along one line share, whichever way they point? To a hundredth."""
    x, y, z = (round(c * OFF_ROUND, 2) + 0.0 for c in direction)
    return max((x, y, z), (0.0 - x, 0.0 - y, 0.0 - z))


Box = tuple[Vector, Vector]
"""Lower and upper corner of an axis-aligned box."""


def wrapped(angle: float) -> float:
    """Which angle from -pi to pi is the same?"""
    return (angle + math.pi) % (2 * math.pi) - math.pi


def angle_covered(ranges: Iterable[tuple[float, float]]) -> float:
    """Which angle do these ranges cover together, in radians? Each ends no more than 2 pi after its start."""
    parts: list[tuple[float, float]] = []
    for start, end in ranges:
        start, end = start % (2 * math.pi), start % (2 * math.pi) + (end - start)
        parts.append((start, min(end, 2 * math.pi)))
        if end > 2 * math.pi:
            parts.append((0.0, end - 2 * math.pi))
    total, reach = 0.0, 0.0
    for start, end in sorted(parts):
        total += max(0.0, end - max(start, reach))
        reach = max(reach, end)
    return total


def box_of(points: Iterable[Vector]) -> Box | None:
    """Which axis-aligned box do the points span? None without points."""
    columns = list(zip(*points, strict=True))
    if not columns:
        return None
    x, y, z = columns
    return (min(x), min(y), min(z)), (max(x), max(y), max(z))


def box_union(boxes: Iterable[Box]) -> Box | None:
    """Which box holds all boxes? None without boxes."""
    return box_of(corner for box in boxes for corner in box)


def box_center(box: Box) -> Vector:
    """Where is the middle of the box?"""
    return mid(box[0], box[1])


def box_extents(box: Box) -> Vector:
    """How large is the box, full lengths along x, y, z?"""
    return sub(box[1], box[0])
