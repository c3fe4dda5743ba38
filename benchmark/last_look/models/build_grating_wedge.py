"""A wedge that holds a square grating at its Littrow angle: foot with slots for the optical table, pocket in the slope."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Plane, Polyline, Pos, Rot, extrude, make_face

from benchmark.kit import Model
from benchmark.shapes import DOWN, FRONT, LEFT, block, drill, grid, rod, slot

MODEL = Model("Grating wedge", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot stands on z = 0, its middle is x = y = 0; the slope rises towards +x."""

    foot: tuple[float, float, float] = (100, 50, 10)
    wedge: float = 46  # length along x
    width: float = 40  # of the wedge along y
    toe: float = 4  # height of the wedge's low end above the foot
    tilt: float = 32  # degrees between slope and table
    pocket: float = 25.8  # square, in the slope's middle
    pocket_depth: float = 6  # square to the slope
    relief: float = 3  # diameter of the round reliefs in the pocket's corners
    grub: float = 3.3  # core hole of M4 from the side on +y into the pocket
    tap: float = 5  # core hole of M6 in the wedge's upright back
    tap_depth: float = 14
    tap_z: float = 19
    slot_length: float = 22  # along y
    slot_width: float = 6.6
    slots: float = 75  # between the two
    pin: float = 4  # through the foot, at two opposite corners
    pins: tuple[float, float] = (56, 40)  # between the two along x and y
    hollow: tuple[float, float, float] = (36, 28, 8)  # pocket in the underside


def build(p: P) -> Part:
    """Mills the foot and the slope, then the pocket square to the slope."""
    t = p.foot[2]
    a = math.radians(p.tilt)
    half = p.wedge / 2
    low = t + p.toe
    high = low + p.wedge * math.tan(a)
    outline = Polyline((-half, t), (half, t), (half, high), (-half, low), close=True)
    body = block(p.foot) + extrude(Plane.XZ * make_face(outline), amount=p.width / 2, both=True)
    middle = Pos(0, 0, (low + high) / 2) * Rot(0, -p.tilt, 0)
    body -= middle * block((p.pocket, p.pocket, p.pocket_depth), (0, 0, -p.pocket_depth))
    for x, y in grid(2, 2, p.pocket, p.pocket):
        body -= middle * rod(p.relief, p.pocket_depth, (x, y, 0), DOWN)
    body -= middle * rod(p.grub, p.width / 2, (0, p.width / 2, -p.pocket_depth / 2), FRONT)
    body -= drill(p.tap, p.tap_depth, (half, 0, p.tap_z), LEFT)
    for side in (-1, 1):
        body -= slot(p.slot_length, p.slot_width, t, (side * p.slots / 2, 0, t), DOWN, 90)
        body -= rod(p.pin, t, (side * p.pins[0] / 2, -side * p.pins[1] / 2, 0))
    return body - block(p.hollow)
