"""A moulded seed tray: tapered cells with drain holes, a deck, a skirt with two thumb notches."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Plane, Pos, RectangleRounded, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import RIGHT, block, grid, rod

MODEL = Model("Seed tray", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the deck's upper face is z = 0, the middle is x = y = 0, the cells hang down."""

    columns: int = 5  # along x
    rows: int = 3
    pitch: float = 42
    mouth: float = 38  # of a cell, square
    mouth_corner: float = 6  # radius
    depth: float = 48  # of a cell inside
    draft: float = 6  # of a cell's walls
    floor: float = 1.5
    wall: float = 1.2  # of a cell, measured level
    deck: float = 1.6
    drain: float = 9
    margin: float = 9  # of the deck beyond the outer mouths
    skirt: float = 14  # height of the skirt with the deck
    skirt_wall: float = 1.6
    corner: float = 12  # outer radius of the skirt
    notch: float = 24  # diameter of the thumb notches in the short sides

    @property
    def size(self) -> tuple[float, float]:
        x, y = (((n - 1) * self.pitch + self.mouth + 2 * self.margin) for n in (self.columns, self.rows))
        return (x, y)

    @property
    def bottom(self) -> float:
        """Inside width of a cell at its floor."""
        return self.mouth - 2 * self.depth * math.tan(math.radians(self.draft))


def _cell(p: P, grow: float, depth: float) -> Part:
    mouth = RectangleRounded(p.mouth + 2 * grow, p.mouth + 2 * grow, p.mouth_corner + grow)
    return extrude(Plane.XY * mouth, amount=-depth, dir=(0, 0, 1), taper=p.draft)


def build(p: P) -> Part:
    """Moulds deck and skirt, hangs the cells in, then opens them."""
    x, y = p.size
    body = fillet(block((x, y, p.skirt), (0, 0, -p.skirt)).edges().filter_by(Axis.Z), p.corner)
    hollow = block((x - 2 * p.skirt_wall, y - 2 * p.skirt_wall, p.skirt - p.deck), (0, 0, -p.skirt))
    body -= fillet(hollow.edges().filter_by(Axis.Z), p.corner - p.skirt_wall)
    places = grid(p.columns, p.rows, p.pitch, p.pitch)
    outer, inner = _cell(p, p.wall, p.depth + p.floor), _cell(p, 0, p.depth)
    for at in places:
        body += Pos(*at) * outer
    for at in places:
        body -= Pos(*at) * inner
        body -= rod(p.drain, p.floor, (*at, -p.depth - p.floor))
    for side in (-1, 1):
        start = (-x / 2, 0, -p.skirt) if side < 0 else (x / 2 - p.skirt_wall, 0, -p.skirt)
        body -= rod(p.notch, p.skirt_wall, start, RIGHT)
    return body
