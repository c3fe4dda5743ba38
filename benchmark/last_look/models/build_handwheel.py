"""A cast dished handwheel: rounded rim, five sloping spokes, drafted hub with keyway and set screw, boss for the handle."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Plane, Pos, RectangleRounded, Rot, revolve

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, block, cone, rod

MODEL = Model("Handwheel", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the hub stands on z = 0, the rim lies above it."""

    wheel: float = 200  # outside diameter
    rim: float = 22  # radial width of the rim
    rim_height: float = 26
    rim_r: float = 9  # rounding of all its edges
    rim_z: float = 50  # of its middle plane
    hub: float = 50  # diameter at the bottom
    hub_height: float = 44
    draft: float = 3  # degrees; the hub narrows upwards
    bore: float = 20
    key: float = 6  # width of the keyway, through the hub, on +y
    key_top: float = 22.8  # from the bore's far side to the keyway's ground
    spokes: int = 5  # the first on +x
    spoke: float = 15
    spoke_z: float = 27  # of its axis where it meets the wheel's axis line at spoke_r
    spoke_r: float = 17
    screw: float = 6.8  # core of M8 set screw, from +y into the keyway
    screw_z: float = 9
    boss: float = 20  # for the handle, on the rim, in the first spoke's direction
    boss_top: float = 72
    handle: float = 10.2  # core of M12
    handle_depth: float = 26


def build(p: P) -> Part:
    """Casts hub, spokes, rim and boss; bores the hub and the boss."""
    ring = (p.wheel - p.rim) / 2
    top = p.hub - 2 * p.hub_height * math.tan(math.radians(p.draft))
    body = cone(p.hub, top, p.hub_height)
    for index in range(p.spokes):
        a = 2 * math.pi * index / p.spokes
        start = (p.spoke_r * math.cos(a), p.spoke_r * math.sin(a), p.spoke_z)
        run = (ring - p.spoke_r, p.rim_z - p.spoke_z)
        reach = math.hypot(*run)
        along = (run[0] / reach * math.cos(a), run[0] / reach * math.sin(a), run[1] / reach)
        body += rod(p.spoke, reach, start, along)
    section = Plane.XZ * Pos(ring, p.rim_z) * RectangleRounded(p.rim, p.rim_height, p.rim_r)
    body += Rot(0, 0, 180 / p.spokes) * revolve(section, Axis.Z)  # the seam lies between two spokes
    body += rod(p.boss, p.boss_top - p.rim_z, (ring, 0, p.rim_z))
    body -= rod(p.handle, p.handle_depth, (ring, 0, p.boss_top), DOWN)
    body -= rod(p.bore, p.hub_height)
    ground = p.key_top - p.bore / 2
    body -= block((p.key, ground, p.hub_height), (0, ground / 2, 0))
    body -= rod(p.screw, p.hub, (0, 0, p.screw_z), BACK)
    return body
