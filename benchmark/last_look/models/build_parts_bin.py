"""A moulded storage bin for small parts: drafted walls, a rim, a low front, divider ribs, stacking feet, hanging holes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Pos, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, block, grid, rod

MODEL = Model("Parts bin", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the bin's ground is z = 0 (the feet reach below), the middle is x = y = 0, the low front at -y."""

    ground: tuple[float, float] = (90, 150)  # outside of the walls at z = 0
    corner: float = 10  # radius of the outer corners at z = 0
    height: float = 75
    draft: float = 3  # of the walls in degrees
    wall: float = 2  # square to the wall
    floor: float = 2.5
    rim: tuple[float, float] = (6, 2.5)  # outward, thickness
    opening: tuple[float, float] = (64, 40)  # of the low front: width, height of its sill above z = 0
    rib: float = 1.5  # thickness of the divider ribs
    rib_reach: float = 4  # into the bin at the floor
    rib_gap: float = 2.4  # clear, for the divider
    rib_height: float = 45  # above the floor
    dividers: tuple[float, ...] = (-20, 25)  # y of the slots
    foot: float = 12
    foot_height: float = 3
    feet: tuple[float, float] = (60, 120)  # between their middles
    hang: float = 6  # holes in the rear wall
    hang_x: float = 50
    hang_z: float = 60


def build(p: P) -> Part:
    """Moulds the bin."""
    t = math.tan(math.radians(p.draft))
    wall = p.wall / math.cos(math.radians(p.draft))
    x, y = p.ground
    body = extrude(RectangleRounded(x, y, p.corner), amount=p.height, taper=-p.draft)
    out = p.height * t + p.rim[0]
    body += extrude(
        Pos(0, 0, p.height - p.rim[1]) * RectangleRounded(x + 2 * out, y + 2 * out, p.corner + out), amount=p.rim[1]
    )
    less = wall - p.floor * t
    inside = extrude(
        Pos(0, 0, p.floor) * RectangleRounded(x - 2 * less, y - 2 * less, p.corner - less),
        amount=p.height - p.floor,
        taper=-p.draft,
    )
    body -= inside
    ribs = None
    reach = x / 2 - less - p.rib_reach
    for place in p.dividers:
        for side in (-1, 1):
            offset = side * (p.rib_gap + p.rib) / 2
            bar = block((x + 20, p.rib, p.rib_height), (0, place + offset, p.floor))
            bar -= block((2 * reach, p.rib, p.rib_height), (0, place + offset, p.floor))
            bar &= inside
            ribs = bar if ribs is None else ribs + bar
    body += ribs
    body -= block((p.opening[0], 60, p.height), (0, -y / 2 - 10, p.opening[1]))
    for at in grid(2, 2, *p.feet):
        body += rod(p.foot, p.foot_height, (*at, -p.foot_height))
    for side in (-1, 1):
        body -= rod(p.hang, 40, (side * p.hang_x / 2, y / 2 - 15, p.hang_z), BACK)
    return body
