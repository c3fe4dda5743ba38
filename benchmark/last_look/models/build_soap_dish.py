"""A soap dish: a rounded tray on four round feet, drain slots and ribs on its floor, a notch in the rim, a hanging hole."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import RIGHT, block, grid, rod, slot

MODEL = Model("Soap dish", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the feet stand on z = 0, the middle is x = y = 0."""

    tray: tuple[float, float, float] = (132, 92, 24)  # without the feet
    corner: float = 22
    wall: float = 3
    floor: float = 2.5
    foot: float = 12
    foot_height: float = 4
    feet_x: float = 92
    feet_y: float = 60
    slots: int = 5
    slot: tuple[float, float] = (48, 5)
    pitch: float = 17
    rib: tuple[float, float, float] = (2.4, 54, 5)
    notch: tuple[float, float] = (22, 9)  # width along y, depth from the rim; right wall
    hanging: float = 7  # left wall
    hanging_z: float = 20  # above the table

    @property
    def ribs(self) -> int:
        """One between each two slots."""
        return self.slots - 1


def build(p: P) -> Part:
    """Hollows the tray and cuts the slots."""
    x, y, z = p.tray
    base = p.foot_height
    body = fillet(block(p.tray, (0, 0, base)).edges().filter_by(Axis.Z), p.corner)
    inner = block((x - 2 * p.wall, y - 2 * p.wall, z), (0, 0, base + p.floor))
    body -= fillet(inner.edges().filter_by(Axis.Z), p.corner - p.wall)
    for fx, fy in grid(2, 2, p.feet_x, p.feet_y):
        body += rod(p.foot, p.foot_height, (fx, fy, 0))
    for sx, _ in grid(p.slots, 1, p.pitch, 0):
        body -= slot(*p.slot, p.floor, (sx, 0, base + p.floor), rotation=90)
    for rx, _ in grid(p.ribs, 1, p.pitch, 0):
        body += block(p.rib, (rx, 0, base + p.floor))
    body -= block((p.wall * 2, p.notch[0], p.notch[1]), (x / 2, 0, base + z - p.notch[1]))
    return body - rod(p.hanging, p.wall * 2, (-x / 2 - p.wall / 2, 0, p.hanging_z), RIGHT)
