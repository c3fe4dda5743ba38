"""A CF40 flange for welding to a tube: knife edge, gasket recess, leak check grooves, bolt holes, weld socket with lip."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Rot

from benchmark.kit import Model
from benchmark.shapes import DOWN, block, circle, cone, rod

MODEL = Model("CF flange", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the back (tube side) is z = 0, the sealing side is on top."""

    outside: float = 70
    thickness: float = 13
    bevel: float = 1  # 45 degrees, rim of the back
    bore: float = 35  # right through
    socket: float = 38.3  # for the tube, from the back
    socket_depth: float = 6
    relief_inner: float = 41.3  # weld relief groove in the back
    relief_outer: float = 46.3
    relief_depth: float = 3.5
    recess: float = 48.3  # seat of the copper gasket, in the sealing side
    recess_depth: float = 2.4
    knife: float = 41.9  # diameter of the knife edge's tip
    knife_height: float = 1.4  # above the recess's floor
    knife_slope: float = 20  # degrees between the knife's outer flank and the axis
    bolt: float = 6.7
    bolts: int = 6
    bolt_circle: float = 58.7
    leak: float = 3  # width of the leak check grooves
    leak_depth: float = 2
    leaks: int = 2
    leak_start: float = 30  # degrees from x


def build(p: P) -> Part:
    """Turns the disc with its knife edge, drills, mills the grooves."""
    t = p.thickness
    b = p.bevel
    body = cone(p.outside - 2 * b, p.outside, b) + rod(p.outside, t - b, (0, 0, b))
    floor = t - p.recess_depth
    body -= rod(p.recess, p.recess_depth, (0, 0, floor))
    foot = p.knife + 2 * p.knife_height * math.tan(math.radians(p.knife_slope))
    body += cone(foot, p.knife, p.knife_height, (0, 0, floor)) - rod(p.knife, p.knife_height, (0, 0, floor))
    body -= rod(p.bore, t)
    body -= rod(p.socket, p.socket_depth)
    body -= rod(p.relief_outer, p.relief_depth) - rod(p.relief_inner, p.relief_depth)
    for x, y in circle(p.bolts, p.bolt_circle):
        body -= rod(p.bolt, t, (x, y, t), DOWN)
    inner, outer = p.recess / 2 - 1, p.outside / 2 + 1
    for index in range(p.leaks):
        tool = block((outer - inner, p.leak, p.leak_depth), ((inner + outer) / 2, 0, t - p.leak_depth))
        body -= Rot(0, 0, p.leak_start + 360 * index / p.leaks) * tool
    return body
