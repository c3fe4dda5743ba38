"""A three-step V-belt pulley for a bench drill, cast iron, turned all over."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Polyline, Plane, Axis, make_face, revolve

from benchmark.kit import Model
from benchmark.shapes import LEFT, block, rod

MODEL = Model("Step pulley", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the largest step lies on z = 0, the hub points up."""

    steps: tuple[float, ...] = (160, 120, 80)  # outer diameters
    step_width: float = 32  # of each
    groove: float = 13  # width of a V groove at its mouth
    groove_depth: float = 11
    groove_angle: float = 34  # included
    hub: float = 50
    hub_length: float = 22  # beyond the smallest step
    bore: float = 24
    key: float = 8
    key_height: float = 27.3  # from the bore's far side to the keyway's bottom
    screw: float = 6.8  # core hole M8, radial, in the hub, opposite to the keyway
    screw_z: float = 10  # below the hub's end
    recess: float = 110  # outer diameter of the annular recess in the large face
    core: float = 56  # its inner diameter
    recess_depth: float = 24
    balance: float = 8  # hole drilled for balance in the large face
    balance_depth: float = 10
    balance_r: float = 65


def build(p: P) -> Part:
    """Turns the steps with their grooves, bores, broaches."""
    inset = p.groove_depth * math.tan(math.radians(p.groove_angle / 2))
    points: list[tuple[float, float]] = [(0, 0)]
    z = 0.0
    for d in p.steps:
        r, mid = d / 2, z + p.step_width / 2
        low = p.groove / 2
        points += [(r, z), (r, mid - low), (r - p.groove_depth, mid - low + inset)]
        points += [(r - p.groove_depth, mid + low - inset), (r, mid + low), (r, z + p.step_width)]
        z += p.step_width
    top = z + p.hub_length
    points += [(p.hub / 2, z), (p.hub / 2, top), (0, top)]
    face = Plane.XZ * make_face(Polyline(*points, close=True))
    body = revolve(face, Axis.Z)
    body -= rod(p.bore, top)
    body -= rod(p.recess, p.recess_depth) - rod(p.core, p.recess_depth)
    far = p.key_height - p.bore / 2
    body -= block((far, p.key, top), (far / 2, 0, 0))
    body -= rod(p.screw, p.hub / 2, (0, 0, top - p.screw_z), LEFT)
    body -= rod(p.balance, p.balance_depth, (0, p.balance_r, 0))
    return body
