"""Rigid frames and what is seen from them. Metres; rotations are right-handed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import cast

from querycad_contracts import Vector
from querycad_contracts.parameters import Axis, Matrix, Pose, Row
from querycad_contracts.vectors import ORIGIN, cross, dot, norm, scale, sub, unit

SQUARE = 1e-6
"""Sine of an angle below which two directions are one."""


@dataclass(frozen=True, slots=True)
class Rigid:
    """A frame: its origin in metres, and its axes as unit vectors, all in the file's coordinates."""

    origin: Vector
    x: Vector
    y: Vector
    z: Vector

    @classmethod
    def along(cls, origin: Vector, z: Vector, x: Vector | None = None) -> Rigid:
        """The frame with that z axis; its x axis is as near to `x` as it can be, else to an axis of the file."""
        z = unit(z)
        for wanted in (x, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)):
            if wanted is not None and norm(across := sub(wanted, scale(z, dot(wanted, z)))) > SQUARE:
                x_axis = unit(across)
                return cls(origin, x_axis, cross(z, x_axis), z)
        raise AssertionError("one of two axes is not along z")

    @classmethod
    def of_matrix(cls, matrix: Matrix, metres: float) -> Rigid:
        """The frame of a pose whose translation is in units of so many metres."""
        x, y, z, origin = (cast("Vector", tuple(row[column] for row in matrix[:3])) for column in range(4))
        return cls(scale(origin, metres), x, y, z)

    def direction(self, way: Vector) -> Vector:
        """The direction as seen from here."""
        return (dot(way, self.x), dot(way, self.y), dot(way, self.z))

    def point(self, place: Vector) -> Vector:
        """The place as seen from here."""
        return self.direction(sub(place, self.origin))

    def seen(self, other: Rigid) -> Rigid:
        """The other frame as seen from here."""
        axes = (self.direction(axis) for axis in (other.x, other.y, other.z))
        return Rigid(self.point(other.origin), *axes)

    def pose(self, metres: float) -> Pose:
        """As it is told, in units of so many metres."""
        place = told(self.origin, metres)
        rows = tuple((self.x[i], self.y[i], self.z[i], place[i]) for i in range(3))
        matrix = cast("Matrix", (*(tuple(map(_clean, row)) for row in rows), (0.0, 0.0, 0.0, 1.0)))
        return Pose(position=place, quaternion=self._quaternion(), matrix=matrix)

    def _quaternion(self) -> Row:
        """x, y, z, w, with w >= 0 (Shepperd's method: the largest component first, so that no root is near zero)."""
        (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = self.x, self.y, self.z
        squares = (1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz)
        largest = max(range(4), key=squares.__getitem__)
        twice = math.sqrt(squares[largest])
        sums = (yz - zy, zx - xz, xy - yx)  # 4 w times x, y, z
        if largest == 3:
            found = [*(each / (2 * twice) for each in sums), twice / 2]
        else:
            pairs = {(0, 1): xy + yx, (0, 2): zx + xz, (1, 2): yz + zy}
            found = [pairs.get((min(i, largest), max(i, largest)), 0.0) / (2 * twice) for i in range(3)]
            found[largest] = twice / 2
            found.append(sums[largest] / (2 * twice))
        sign = -1.0 if found[3] < 0 else 1.0
        return cast("Row", tuple(_clean(sign * each) for each in found))


MODEL = Rigid(ORIGIN, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def told_length(length: float, metres: float) -> float:
    """A length in units of so many metres; an area, in units of so many square metres."""
    return _clean(length / metres)


def told(place: Vector, metres: float) -> Vector:
    """A place in units of so many metres."""
    return (_clean(place[0] / metres), _clean(place[1] / metres), _clean(place[2] / metres))


def axis(place: Vector, way: Vector, frame: Rigid, metres: float) -> Axis:
    """A place and a way from it, as seen from the frame, in units of so many metres."""
    return Axis(point=told(frame.point(place), metres), direction=told(frame.direction(way), 1.0))


def _clean(value: float) -> float:
    """To nine digits behind the point, and never -0.0: what is less is how it was computed."""
    return round(value, 9) + 0.0
