"""A bent photocell bracket: slotted foot, upright with sensor hole and curved adjusting slot, hood bent over the lens."""

from __future__ import annotations

import math
from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import BACK, UP, rod, slot
from build123d import FilletPolyline, Part, Plane, Side, extrude, fillet, make_face, offset

MODEL = Model("Photocell bracket", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot lies on z = 0 and runs to +y, the upright's outside is y = 0, the hood leans to +y."""

    width: float = 64  # x
    sheet: float = 2.5
    foot: float = 46  # over all, y
    height: float = 96  # outside, to where the hood's outer face would meet the upright's
    hood: float = 28  # along its outer face, from that line
    lean: float = 50  # degrees the hood is bent from the upright
    bend: float = 3  # inside radius of both bends
    corner: float = 6  # free corners of the foot and of the hood
    slot: tuple[float, float] = (22, 6.6)  # foot: along y over all, width
    slot_x: float = 38  # between the two
    slot_y: float = 29  # of their middles
    sensor: float = 18.5
    sensor_z: float = 66
    pilot: float = 4.2  # two holes beside the sensor
    pilot_span: float = 44
    cable: tuple[float, float] = (20, 8)  # obround below, x, z
    cable_z: float = 30
    spare: float = 3.3  # M4 in the foot's middle
    spare_y: float = 36


def build(p: P) -> Part:
    """Draws the profile in the y-z plane, offsets it by the sheet and extrudes along x."""
    lean = math.radians(p.lean)
    end = (p.hood * math.sin(lean), p.height + p.hood * math.cos(lean))
    plane = Plane(origin=(-p.width / 2, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0))
    line = FilletPolyline((p.foot, 0), (0, 0), (0, p.height), end, radius=p.bend + p.sheet)
    wire = offset(line, amount=p.sheet, side=Side.RIGHT)
    body = extrude(plane * make_face(wire), amount=p.width)
    short = [e for e in body.edges() if abs(e.length - p.sheet) < 1e-6]
    body = fillet(short, p.corner)
    for x in (-p.slot_x / 2, p.slot_x / 2):
        body -= slot(*p.slot, p.sheet, (x, p.slot_y, p.sheet), rotation=90)
    body -= rod(p.sensor, p.sheet, (0, 0, p.sensor_z), BACK)
    for x in (-p.pilot_span / 2, p.pilot_span / 2):
        body -= rod(p.pilot, p.sheet, (x, 0, p.sensor_z), BACK)
    body -= slot(*p.cable, p.sheet, (0, 0, p.cable_z), BACK)
    body -= rod(p.spare, p.sheet, (0, p.spare_y, 0), UP)
    return body
