"""A three-groove V-belt sheave with a plain bore, made to inch dimensions."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, revolve

from benchmark.kit import INCH, Model
from benchmark.shapes import DOWN, block, circle, rod

MODEL = Model("V-belt sheave", "held_out", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Inches and degrees; the axis is z, the rim stands on z = 0, the hub sticks out at the top."""

    outer_d: float = 9
    face: float = 2.5  # width of the rim
    grooves: int = 3
    pitch: float = 0.75  # between neighbouring grooves
    groove_angle: float = 38  # between the groove's flanks
    groove_top: float = 0.65  # width at the rim's outside
    groove_depth: float = 0.6
    rim_id: float = 7
    web: float = 0.625
    web_z: float = 0.875  # underside of the web
    hub_d: float = 3.5
    hub_top: float = 3.25
    bore: float = 1.625
    key_w: float = 0.375
    key_t: float = 1.8125  # over bore and keyway
    holes: int = 5
    hole_d: float = 1.125
    hole_pcd: float = 5.25
    screw_d: float = 0.3125  # two holes for set screws, one over the keyway, one a quarter turn on
    screw_z: float = 2.875
    balance_d: float = 0.25  # a blind hole in the rim's upper face
    balance_depth: float = 0.375
    balance_r: float = 3.7


def build(p: P) -> Part:
    """Turned, broached and drilled; in millimetres, as the kernel has it."""
    i = INCH
    body = (rod(p.outer_d * i, p.face * i) - rod(p.rim_id * i, p.face * i)) + rod(
        (p.rim_id + p.hub_d) / 2 * i, p.web * i, (0, 0, p.web_z * i)
    )
    body += rod((p.rim_id + 0.1) * i, p.web * i, (0, 0, p.web_z * i))
    body += rod(p.hub_d * i, p.hub_top * i)
    ground = p.groove_top - 2 * p.groove_depth * math.tan(math.radians(p.groove_angle / 2))
    r = p.outer_d / 2
    slope = math.tan(math.radians(p.groove_angle / 2))
    extra = 0.1
    for index in range(p.grooves):
        z = p.face / 2 + (index - (p.grooves - 1) / 2) * p.pitch
        top = p.groove_top / 2 + extra * slope
        points = [
            (r + extra, z - top),
            (r + extra, z + top),
            (r - p.groove_depth, z + ground / 2),
            (r - p.groove_depth, z - ground / 2),
        ]
        body -= revolve(Plane.XZ * Polygon(*[(a * i, b * i) for a, b in points], align=None), Axis.Z)
    body -= rod(p.bore * i, p.hub_top * i)
    reach = (p.key_t - p.bore / 2) * i
    body -= block((p.key_w * i, reach, p.hub_top * i), (0, reach / 2, 0))
    for x, y in circle(p.holes, p.hole_pcd * i, start=90 + 180 / p.holes):
        body -= rod(p.hole_d * i, p.web * i, (x, y, p.web_z * i))
    for along in ((0, 1, 0), (1, 0, 0)):
        body -= rod(p.screw_d * i, p.hub_d / 2 * i, (0, 0, p.screw_z * i), along)
    body -= rod(p.balance_d * i, p.balance_depth * i, (-p.balance_r * i, 0, p.face * i), DOWN)
    return body
