"""Three-dimensional vectors as plain tuples: for single vectors several times faster than arrays."""

from __future__ import annotations

import math

from .geometry import Vector

ORIGIN: Vector = (0.0, 0.0, 0.0)


def add(a: Vector, b: Vector) -> Vector:
    """What is a + b?"""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vector, b: Vector) -> Vector:
    """What is a - b?"""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a: Vector, s: float) -> Vector:
    """What is a times the number s?"""
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a: Vector, b: Vector) -> float:
    """What is the scalar product?"""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """What is the vector product?"""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a: Vector) -> float:
    """How long is the vector?"""
    return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


def unit(a: Vector) -> Vector:
    """Which unit vector points the same way? The zero vector stays zero."""
    length = norm(a)
    return scale(a, 1.0 / length) if length > 0.0 else ORIGIN


ALONG = math.cos(math.radians(0.1))
"""Directions that are nearer to each other are one: converted files carry errors of some 1e-4 rad."""


def coordinate_axis(direction: Vector) -> int | None:
    """Which of x, y, z (0, 1, 2) does a unit vector run along, either way? None where it runs aslant."""
    return next((i for i in range(3) if abs(direction[i]) > ALONG), None)
