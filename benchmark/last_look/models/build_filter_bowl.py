"""The moulded bowl of an air filter: tapered wall, flat bottom, collar with bayonet lugs, drain boss, vanes inside."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Rot

from benchmark.kit import Model
from benchmark.shapes import block, cone, rod

MODEL = Model("Filter bowl", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the bowl opens upwards; the rim is z = 0, the drain boss points down."""

    mouth: float = 58  # outside diameter of the wall at the rim
    wall: float = 3.2  # radially, in the taper
    depth: float = 96  # inside, from the rim to the flat ground
    ground: float = 4  # thickness of the ground
    draft: float = 1.5  # degrees, outside and inside
    collar: float = 66  # diameter
    collar_height: float = 10
    lugs: int = 3
    lug_width: float = 12
    lug_height: float = 4  # from the rim down
    lug_reach: float = 37.5  # radius to its outside
    groove: float = 62  # ground of the O-ring groove in the collar
    groove_width: float = 2.4
    groove_z: float = -7  # its middle
    boss: float = 18  # drain boss diameter
    boss_length: float = 14
    drain: float = 8.8  # bore
    vanes: int = 4
    vane: float = 2  # thickness
    vane_height: float = 22  # from the ground
    vane_reach: float = 9  # inwards, from the ground's inner radius


def radius(p: P, z: float) -> float:
    """The wall's outside radius at the height z (negative)."""
    return p.mouth / 2 + z * math.tan(math.radians(p.draft))


def build(p: P) -> Part:
    """Moulds it."""
    low = -p.depth - p.ground
    body = cone(2 * radius(p, low), p.mouth, -low, (0, 0, low))
    body += rod(p.collar, p.collar_height, (0, 0, -p.collar_height))
    for i in range(p.lugs):
        half = block((p.lug_reach, p.lug_width, p.lug_height), (p.lug_reach / 2, 0, -p.lug_height)) & rod(2 * p.lug_reach, p.lug_height, (0, 0, -p.lug_height))
        body += Rot(0, 0, 360 / p.lugs * i) * half
    body += rod(p.boss, p.boss_length, (0, 0, low - p.boss_length))
    body -= cone(2 * (radius(p, -p.depth) - p.wall), p.mouth - 2 * p.wall, p.depth, (0, 0, -p.depth))
    inner = radius(p, -p.depth) - p.wall
    for i in range(p.vanes):
        fin = block((p.vane_reach + 1.5, p.vane, p.vane_height), (inner - p.vane_reach + (p.vane_reach + 1.5) / 2, 0, -p.depth))
        body += Rot(0, 0, 360 / p.vanes * i) * fin
    z = p.groove_z - p.groove_width / 2
    body -= rod(p.collar + 20, p.groove_width, (0, 0, z)) - rod(p.groove, p.groove_width, (0, 0, z))
    body -= rod(p.drain, p.boss_length + p.ground, (0, 0, low - p.boss_length))
    return body
