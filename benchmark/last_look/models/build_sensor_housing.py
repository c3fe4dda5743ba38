"""A moulded housing of a proximity sensor: drafted tray, screw bosses, ribs, window in the floor, gland boss, two ears."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Pos, RectangleRounded, SlotOverall, extrude

from benchmark.kit import Model
from benchmark.shapes import DOWN, LEFT, block, grid, rod

MODEL = Model("Sensor housing", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the floor's outside is z = 0, the tray opens upwards; the gland looks to +x."""

    size: tuple[float, float] = (92, 62)  # outside, at the bottom
    height: float = 34
    corner: float = 9  # outside radius at the bottom
    wall: float = 2.5  # horizontally
    floor: float = 3
    draft: float = 1.5  # degrees, outside and inside; the tray widens upwards
    boss: float = 8
    boss_bore: float = 3.3
    boss_depth: float = 20
    boss_top: float = 31  # above the underside
    bosses: tuple[float, float] = (70, 40)
    rib: float = 1.8  # thickness
    rib_top: float = 12  # above the underside
    ribs: float = 34  # middle to middle, along x
    post: float = 6  # standoffs of the circuit board
    post_bore: float = 2.2
    post_top: float = 10  # above the underside
    posts: float = 36  # apart, along y
    window: float = 16  # through the floor
    gland: float = 25  # boss on the right wall
    gland_out: float = 53  # its face from the middle
    gland_bore: float = 16.5
    gland_z: float = 17
    ear: float = 20  # width of the rounded ears, front and back
    ear_thick: float = 4
    ear_hole: float = 5.5
    ears: float = 80  # apart, along y


def build(p: P) -> Part:
    """Moulds the tray and its inside."""
    t = math.tan(math.radians(p.draft))
    x, y = p.size
    body = extrude(RectangleRounded(x, y, p.corner), amount=p.height, taper=-p.draft)
    ears = SlotOverall(p.ears + p.ear, p.ear, rotation=90)
    body += extrude(ears, amount=p.ear_thick)
    shift = p.floor * t
    body += rod(p.gland, p.gland_out - x / 4, (p.gland_out, 0, p.gland_z), LEFT)
    inner = RectangleRounded(x + 2 * shift - 2 * p.wall, y + 2 * shift - 2 * p.wall, p.corner + shift - p.wall)
    cavity = extrude(Pos(0, 0, p.floor) * inner, amount=p.height - p.floor, taper=-p.draft)
    body -= cavity
    body -= rod(p.gland_bore, p.gland_out, (p.gland_out, 0, p.gland_z), LEFT)
    inside = block((p.rib, y, p.rib_top - p.floor), (0, 0, p.floor))
    for side in (-1, 1):
        body += (Pos(side * p.ribs / 2, 0, 0) * inside) & cavity
        body += rod(p.post, p.post_top - p.floor, (0, side * p.posts / 2, p.floor))
        body -= rod(p.post_bore, p.post_top - p.floor, (0, side * p.posts / 2, p.post_top), DOWN)
        body -= rod(p.ear_hole, p.ear_thick, (0, side * p.ears / 2, 0))
    for bx, by in grid(2, 2, *p.bosses):
        body += rod(p.boss, p.boss_top - p.floor, (bx, by, p.floor))
        body -= rod(p.boss_bore, p.boss_depth, (bx, by, p.boss_top), DOWN)
    body -= rod(p.window, p.floor)
    return body
