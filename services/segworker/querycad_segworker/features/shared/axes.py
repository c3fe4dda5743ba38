"""What axes and walls are: directed lines, and surfaces of revolution about them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import TypeVar

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import FaceRecord
from querycad_segworker.vectors import Box, across, add, dot, line_distance, parallel, scale, sub, unit

SWEEP = unit((0.8317, 0.4561, 0.3163))
"""Lines are sorted by where their foot lies along this direction and compared with near ones only. No common
feature axis is at right angles to it, so that different lines get different keys."""
ENCLOSES_RAD = math.radians(200.0)
"""What goes around an axis for so much, clearly more than half of the circle, holds a cylinder that is put into it."""
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Axis:
    """A directed line in space: positions along it are `dot(p - origin, direction)`."""

    origin: Vector
    direction: Vector

    @classmethod
    def of(cls, face: FaceRecord) -> Axis:
        """Which axis does a face turn about?"""
        return cls(face.origin, face.axis)

    def position(self, point: Vector) -> float:
        """Where along the axis is the foot of `point`, in metres from the origin?"""
        return dot(sub(point, self.origin), self.direction)

    def at(self, position: float) -> Vector:
        """Which point lies at this position?"""
        return add(self.origin, scale(self.direction, position))

    def foot(self, point: Vector) -> Vector:
        """Which point of the axis is nearest to `point`?"""
        return self.at(self.position(point))

    def out_to(self, point: Vector) -> Vector:
        """Which unit vector points from the axis straight to `point`?"""
        return unit(sub(point, self.foot(point)))

    def radius_of(self, point: Vector) -> float:
        """How far is `point` from the axis?"""
        return line_distance(point, self.origin, self.direction)

    def reach(self, box: Box) -> float:
        """How far from the axis do the corners of a box lie at most?"""
        (x0, y0, z0), (x1, y1, z1) = box
        return max(self.radius_of((x, y, z)) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1))

    def angle_of(self, point: Vector) -> float:
        """At which angle around the axis is `point`? Radians, -pi to pi, from an arbitrary but fixed zero."""
        x, y = across(self.direction)
        offset = sub(point, self.origin)
        return math.atan2(dot(offset, y), dot(offset, x))

    def same_line(self, other: Axis, tolerances: Tolerances) -> bool:
        """Do both lie on one line, whichever way they point?"""
        return (
            parallel(self.direction, other.direction, tolerances.angle * 3)
            and line_distance(other.origin, self.origin, self.direction) <= 3 * tolerances.length
        )


@dataclass(frozen=True, slots=True)
class Wall:
    """One surface of revolution about an axis, made of one or more faces.

    `low` and `high` are its ends along the axis; `radius_low` and `radius_high` its radii there (equal for a cylinder).
    `sweep` is the angle that its faces cover; `outward` as in `FaceRecord`.
    """

    kind: SurfaceKind
    axis: Axis
    radius_low: float
    radius_high: float
    low: float
    high: float
    sweep: float
    outward: int
    faces: tuple[int, ...]
    body: int
    pitch: float | None = None
    """Of a modelled thread on it."""

    @property
    def radius(self) -> float:
        """How large is the radius? A cone's is its larger one."""
        return max(self.radius_low, self.radius_high)

    @property
    def height(self) -> float:
        """How long is it along its axis?"""
        return self.high - self.low

    @property
    def encloses(self) -> bool:
        """Does it hold a cylinder put into it?"""
        return self.sweep > ENCLOSES_RAD


def by_line(
    items: Sequence[T], line: Callable[[T], Axis], fixed: Vector, reach: float, alike: Callable[[T, T], bool]
) -> list[list[T]]:
    """Those on one line together: each item that is none of those before, with all after it that are like it.

    The foot of one `fixed` point on the line is much the same for all of them, to within `reach` metres: sorted by it,
    only few need comparing.
    """
    feet = (line(item).foot(fixed) for item in items)
    order = sorted((dot(foot, SWEEP), i) for i, foot in enumerate(feet))
    groups, taken = [], set[int]()
    for rank, (key, i) in enumerate(order):
        if i in taken:
            continue
        group = [items[i]]
        for other, j in islice(order, rank + 1, None):
            if other - key > reach:
                break
            if j not in taken and alike(items[i], items[j]):
                taken.add(j)
                group.append(items[j])
        groups.append(group)
    return groups
