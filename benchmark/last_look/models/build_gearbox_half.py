"""The lower half of a split gearbox: case with base plate, joint flange, half-round bearing seats, ribs, drain boss, sight hole."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, LEFT, RIGHT, block, grid, rod

MODEL = Model("Gearbox half", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the base plate stands on z = 0, the middle is x = y = 0; both shafts run along y in the joint's plane."""

    case: tuple[float, float] = (180, 110)  # outside
    height: float = 92  # of the joint's plane
    wall: float = 8
    ground: float = 12  # thickness below the cavity
    base: tuple[float, float, float] = (220, 150, 14)
    flange: float = 12  # thickness, of the base plate's outline
    corner: float = 15
    small_x: float = -46
    small: float = 52  # bearing seats
    large_x: float = 40
    large: float = 72
    shell: float = 12  # wall around the bearing seats
    rib: float = 8
    bolt: float = 11
    bolts: tuple[float, float] = (200, 130)
    dowel: float = 8
    dowels: tuple[float, float] = (200, 64)  # on a diagonal
    foundation: float = 14
    foundations: tuple[float, float] = (196, 124)
    drain: float = 16
    drain_z: float = 34
    drain_boss: float = 32
    drain_boss_length: float = 7
    sight: float = 22
    sight_z: float = 50

    def seats(self) -> list[tuple[float, float]]:
        """x and diameter of the bearing seats."""
        return [(self.small_x, self.small), (self.large_x, self.large)]


def build(p: P) -> Part:
    """Casts the case, hollows it, mills the joint, bores and drills."""
    x, y = p.case
    width, depth, base = p.base
    body = block((x, y, p.height))
    for thickness, z in ((base, 0), (p.flange, p.height - p.flange)):
        plate = block((width, depth, thickness), (0, 0, z))
        body += fillet(plate.edges().filter_by(Axis.Z), p.corner)
    for at, diameter in p.seats():
        body += rod(diameter + 2 * p.shell, depth, (at, -depth / 2, p.height), BACK)
        body += block((p.rib, depth, p.height - base), (at, 0, base))
    body += rod(p.drain_boss, x / 2 + p.drain_boss_length, (0, 0, p.drain_z), RIGHT)
    body -= block((width, depth, p.large), (0, 0, p.height))
    body -= block((x - 2 * p.wall, y - 2 * p.wall, p.height), (0, 0, p.ground))
    for at, diameter in p.seats():
        body -= rod(diameter, depth, (at, -depth / 2, p.height), BACK)
    low = p.height - p.flange
    body -= [rod(p.bolt, p.flange, (*at, low)) for at in grid(2, 2, *p.bolts)]
    body -= [rod(p.bolt, p.flange, (s * p.bolts[0] / 2, 0, low)) for s in (-1, 1)]
    body -= [rod(p.dowel, p.flange, (s * p.dowels[0] / 2, -s * p.dowels[1] / 2, low)) for s in (-1, 1)]
    body -= [rod(p.foundation, base, (*at, 0)) for at in grid(2, 2, *p.foundations)]
    body -= rod(p.drain, x / 2 + p.drain_boss_length, (0, 0, p.drain_z), RIGHT)
    return body - rod(p.sight, x / 2, (0, 0, p.sight_z), LEFT)
