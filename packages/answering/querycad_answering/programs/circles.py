"""The circle through the centres of parts that are no pattern: a bolt circle that lacks a hole, ports on an arc."""

from __future__ import annotations

import math
from collections.abc import Sequence

from querycad_contracts import DRAWING_M, Part, Vector
from querycad_contracts.vectors import cross, dot, norm, sub

from .builder import Builder

Corners = tuple[int, int, int]
"""Indices of three parts."""


def on_one_circle(parts: Sequence[Part]) -> Corners | None:
    """Which three, far apart, span the circle that runs through the centres of all, to drawing accuracy?

    None where there is no such circle: too few, in a row, or some of them off it.
    """
    points = [part.center for part in parts]
    if len(points) < 3:
        return None
    reach = [math.dist(points[0], point) for point in points]
    second = reach.index(max(reach))
    away = [min(own, math.dist(points[second], point)) for own, point in zip(reach, points, strict=True)]
    third = away.index(max(away))
    corners = [points[i] for i in (0, second, third)]
    square = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]))
    size = norm(square)
    if size <= DRAWING_M * reach[second]:  # the third is on the line through the other two
        return None
    middle = _middle(corners)
    radius = math.dist(middle, corners[0])
    aside = [abs(dot(sub(point, middle), square)) / size for point in points]
    off = [abs(math.dist(middle, point) - radius) for point in points]
    return (0, second, third) if max(*aside, *off) <= DRAWING_M else None


def write_middle(build: Builder, name: str, corners: Corners) -> None:
    """Writes `middle`, the centre of the circle through the `corners` of the list `name`, which stay in `corners`.

    By barycentric weights: of each corner the square of the opposite side times what the other two squares exceed it.
    """
    build.lines += [
        "import math",
        f"corners = [{name}[i].center for i in {corners}]",
        "squares = [math.dist(corners[i - 1], corners[i - 2]) ** 2 for i in range(3)]",
        "weights = [square * (sum(squares) - 2 * square) for square in squares]",
        "middle = [sum(w * p[i] for w, p in zip(weights, corners)) / sum(weights) for i in range(3)]",
    ]


def _middle(corners: Sequence[Vector]) -> Vector:
    squares = [math.dist(corners[i - 1], corners[i - 2]) ** 2 for i in range(3)]
    weights = [square * (sum(squares) - 2 * square) for square in squares]
    x, y, z = (sum(w * p[i] for w, p in zip(weights, corners, strict=True)) / sum(weights) for i in range(3))
    return (x, y, z)
