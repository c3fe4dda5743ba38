"""The moulded lid of an air filter: drafted walls, rim with a seal groove, intake tube, screw bosses and ribs inside."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import block, grid, rod

MODEL = Model("Air filter lid", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the rim's sealing face at z = 0, the lid rises; middle x = y = 0."""

    rim_x: float = 176
    rim_y: float = 128
    rim_corner: float = 18
    rim_height: float = 4.5
    wall_x: float = 156  # outside of the walls at z = 0
    wall_y: float = 108
    wall_corner: float = 12
    wall: float = 2.4
    top: float = 3
    height: float = 34  # over the roof, without the tube
    draft: float = 2  # degrees
    groove: float = 3.2  # width of the seal groove in the rim's underside
    groove_depth: float = 2
    groove_gap: float = 3  # from the rim's outer edge to the groove
    tube: float = 46  # outside
    tube_bore: float = 41
    tube_height: float = 28  # above the roof
    tube_x: float = -38
    boss: float = 9
    boss_hole: float = 3.6
    boss_dx: float = 120
    boss_dy: float = 74
    boss_gap: float = 1  # the bosses end so far above the sealing face
    boss_deep: float = 16  # blind hole from the boss's end
    ribs: int = 4
    rib: float = 1.6
    rib_depth: float = 8  # below the roof
    rib_pitch: float = 15
    rib_x: float = 6  # of the first


def build(p: P) -> Part:
    body = extrude(RectangleRounded(p.rim_x, p.rim_y, p.rim_corner), amount=p.rim_height)
    body += extrude(RectangleRounded(p.wall_x, p.wall_y, p.wall_corner), amount=p.height, taper=p.draft)
    c = p.wall / math.cos(math.radians(p.draft))
    body -= extrude(
        RectangleRounded(p.wall_x - 2 * c, p.wall_y - 2 * c, p.wall_corner - c),
        amount=p.height - p.top,
        taper=p.draft,
    )
    a, b = p.groove_gap, p.groove_gap + p.groove
    ring = extrude(RectangleRounded(p.rim_x - 2 * a, p.rim_y - 2 * a, p.rim_corner - a), amount=p.groove_depth)
    ring -= extrude(RectangleRounded(p.rim_x - 2 * b, p.rim_y - 2 * b, p.rim_corner - b), amount=p.groove_depth)
    body -= ring
    roof = p.height - p.top
    body += rod(p.tube, p.tube_height + 1, (p.tube_x, 0, p.height - 1))
    body -= rod(p.tube_bore, p.tube_height + p.top + 5, (p.tube_x, 0, roof - 1))
    for x, y in grid(2, 2, p.boss_dx, p.boss_dy):
        body += rod(p.boss, roof + 1 - p.boss_gap, (x, y, p.boss_gap))
        body -= rod(p.boss_hole, p.boss_deep, (x, y, p.boss_gap))
    for index in range(p.ribs):
        x = p.rib_x + index * p.rib_pitch
        long = p.wall_y - 2 * p.wall - 2 * roof * math.tan(math.radians(p.draft)) + 2
        body += block((p.rib, long, p.rib_depth + 1), (x, 0, roof - p.rib_depth))
    return body
