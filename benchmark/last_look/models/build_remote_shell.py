"""The upper shell of a remote control: holes for keys, a ring for the pad, rocker slots, a window, screw bosses inside."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import UP, block, grid, rod, slot

MODEL = Model("Remote control upper shell", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; open below at z = 0, the middle is x = y = 0, the infrared window is at the back."""

    shell: tuple[float, float, float] = (52, 172, 19)
    corner: float = 14
    edge: float = 3  # rounding of the upper rim
    wall: float = 2
    key: float = 8.5
    columns: int = 3
    rows: int = 4
    key_x: float = 14
    key_y: float = 15
    keys_center: float = -34
    pad: float = 27
    pad_y: float = 26
    rocker: tuple[float, float] = (15, 6)  # along x
    rocker_x: float = 26  # between them
    rocker_y: float = 51
    power: float = 6
    power_y: float = 72
    window: tuple[float, float] = (18, 7)  # along x and z
    window_z: float = 8  # its middle
    boss: float = 7
    boss_hole: float = 2.4
    boss_depth: float = 9
    boss_z: float = 4  # the bosses' free ends
    bosses_x: float = 34
    bosses_y: float = 140

    @property
    def ceiling(self) -> float:
        """Inside of the top."""
        return self.shell[2] - self.wall


def build(p: P) -> Part:
    """Shell, bosses, then openings."""
    x, y, z = p.shell
    body = fillet(block(p.shell).edges().filter_by(Axis.Z), p.corner)
    body = fillet(body.edges().group_by(Axis.Z)[-1], p.edge)
    inner = block((x - 2 * p.wall, y - 2 * p.wall, p.ceiling))
    body -= fillet(inner.edges().filter_by(Axis.Z), p.corner - p.wall)
    for bx, by in grid(2, 2, p.bosses_x, p.bosses_y):
        body += rod(p.boss, p.ceiling - p.boss_z, (bx, by, p.boss_z))
        body -= rod(p.boss_hole, p.boss_depth, (bx, by, p.boss_z), UP)
    for kx, ky in grid(p.columns, p.rows, p.key_x, p.key_y, (0, p.keys_center)):
        body -= rod(p.key, p.wall, (kx, ky, p.ceiling))
    body -= rod(p.pad, p.wall, (0, p.pad_y, p.ceiling))
    for rx in (-p.rocker_x / 2, p.rocker_x / 2):
        body -= slot(*p.rocker, p.wall, (rx, p.rocker_y, z))
    body -= rod(p.power, p.wall, (0, p.power_y, p.ceiling))
    return body - block(
        (p.window[0], 2 * p.wall, p.window[1]), (0, y / 2, p.window_z - p.window[1] / 2)
    )
