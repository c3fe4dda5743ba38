"""Which solids are the models made of, and where do patterns place them? Millimetres."""

from __future__ import annotations

import math
from collections.abc import Sequence

from build123d import (
    Align,
    Box,
    Color,
    Compound,
    Cone,
    Cylinder,
    Location,
    Part,
    Plane,
    Pos,
    RegularPolygon,
    SlotOverall,
    extrude,
)

Vector = tuple[float, float, float]
UP: Vector = (0, 0, 1)
DOWN: Vector = (0, 0, -1)
RIGHT: Vector = (1, 0, 0)
LEFT: Vector = (-1, 0, 0)
FRONT: Vector = (0, -1, 0)
BACK: Vector = (0, 1, 0)
DRILL_ANGLE = 118  # point angle of a twist drill in degrees (DIN 1412, for steel and cast iron)
ON_BASE = (Align.CENTER, Align.CENTER, Align.MIN)


def grid(
    columns: int, rows: int, dx: float, dy: float, center: tuple[float, float] = (0, 0)
) -> list[tuple[float, float]]:
    """Where are the points of a rectangular pattern about `center`? `dx`, `dy` lie between neighbours."""
    return [
        (center[0] + (column - (columns - 1) / 2) * dx, center[1] + (row - (rows - 1) / 2) * dy)
        for column in range(columns)
        for row in range(rows)
    ]


def circle(
    number: int, diameter: float, start: float = 0, center: tuple[float, float] = (0, 0)
) -> list[tuple[float, float]]:
    """Where are the points of a bolt circle? `start` in degrees from x."""
    angles = [math.radians(start + 360 * index / number) for index in range(number)]
    return [(center[0] + diameter / 2 * math.cos(a), center[1] + diameter / 2 * math.sin(a)) for a in angles]


def block(size: Vector, base: Vector = (0, 0, 0)) -> Part:
    """A box whose underside is centred on `base`."""
    return Pos(*base) * Box(*size, align=ON_BASE)


def rod(diameter: float, length: float, start: Vector = (0, 0, 0), along: Vector = UP) -> Part:
    """A cylinder from `start` on."""
    return _plane(start, along) * Cylinder(diameter / 2, length, align=ON_BASE)


def cone(
    start_diameter: float, end_diameter: float, length: float, start: Vector = (0, 0, 0), along: Vector = UP
) -> Part:
    """A cone, or its frustum, from `start` on."""
    return _plane(start, along) * Cone(start_diameter / 2, end_diameter / 2, length, align=ON_BASE)


def drill(diameter: float, depth: float, mouth: Vector, into: Vector = DOWN) -> Part:
    """What a twist drill takes away: `depth` is the cylinder's, the point comes below."""
    bottom = (mouth[0] + into[0] * depth, mouth[1] + into[1] * depth, mouth[2] + into[2] * depth)
    tip = diameter / 2 / math.tan(math.radians(DRILL_ANGLE / 2))
    return rod(diameter, depth, mouth, into) + cone(diameter, 0, tip, bottom, into)


def prism(
    across_flats: float,
    height: float,
    start: Vector = (0, 0, 0),
    along: Vector = UP,
    sides: int = 6,
    rotation: float = 0,
) -> Part:
    """A regular prism from `start` on, given across flats; a corner points to x, or `rotation` degrees from it."""
    polygon = RegularPolygon(across_flats / 2, sides, major_radius=False, rotation=rotation)
    return extrude(_plane(start, along) * polygon, amount=height, dir=along)


def slot(length: float, width: float, height: float, start: Vector, along: Vector = DOWN, rotation: float = 0) -> Part:
    """An obround prism from `start` on, `length` over all, turned by `rotation` degrees about its axis from x."""
    return extrude(_plane(start, along) * SlotOverall(length, width, rotation=rotation), amount=height, dir=along)


def named(shape: Part, label: str, color: str, place: Location | None = None) -> Part:
    """The body at its place with its name and its colour, a name of the CSS palette."""
    placed = place * shape if place else shape
    placed.label = label
    placed.color = Color(color)
    return placed


def assembly(bodies: Sequence[Part]) -> Compound:
    """The bodies as one product with its components."""
    return Compound(children=list(bodies))


def _plane(origin: Vector, along: Vector) -> Plane:
    x_dir = (1, 0, 0) if abs(along[0]) < 0.5 else (0, 1, 0)
    return Plane(origin=origin, x_dir=x_dir, z_dir=along)
