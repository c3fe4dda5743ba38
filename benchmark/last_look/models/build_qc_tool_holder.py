"""A turning tool holder for a quick change post, dimensioned in inches: tool slot in front, dovetail behind."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polyline, chamfer, extrude, make_face

from benchmark.kit import INCH, Model
from benchmark.shapes import DOWN, RIGHT, block, drill, prism, rod

MODEL = Model("Quick change tool holder", "held_out")  # dimensioned in inches, the geometry and the file are in millimetres


@dataclass(frozen=True, slots=True)
class P:
    """Inches; stands on z = 0, middle x = y = 0; tool slot opens to -y and runs along x, dovetail opens to +y."""

    length: float = 3.0  # x
    depth: float = 1.75  # y
    height: float = 1.5  # z
    bevel: float = 0.06  # of the four upright corners
    slot: float = 0.5625  # height of the tool slot
    slot_depth: float = 0.6875
    slot_z: float = 0.375  # of its floor
    vee: float = 0.25  # mouth of the vee groove in the slot's floor, 90 degrees
    vee_y: float = -0.5
    screws: int = 4
    screw: float = 0.257  # tap drill 5/16-18
    pitch: float = 0.75
    screw_y: float = -0.5  # of the set screws
    tail_mouth: float = 1.125  # width of the dovetail at the back face
    tail: float = 60  # degrees between flank and ground
    tail_depth: float = 0.4375
    height_screw: float = 0.332  # tap drill 3/8-24, for the height stud
    height_depth: float = 0.875
    height_x: float = 1.1875
    height_y: float = 0.4375


def build(p: P) -> Part:
    s = INCH
    body = block((p.length * s, p.depth * s, p.height * s))
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel * s)
    front = -p.depth / 2
    body -= block(
        (p.length * s, p.slot_depth * s, p.slot * s), (0, (front + p.slot_depth / 2) * s, p.slot_z * s)
    )
    body -= prism(
        p.vee / math.sqrt(2) * s, p.length * s, (-p.length / 2 * s, p.vee_y * s, p.slot_z * s), RIGHT, sides=4
    )
    for index in range(p.screws):
        x = (index - (p.screws - 1) / 2) * p.pitch
        above = p.height - p.slot_z - p.slot
        body -= rod(p.screw * s, (above + 0.05) * s, (x * s, p.screw_y * s, p.height * s), DOWN)
    back = p.depth / 2
    half = p.tail_mouth / 2
    wide = half + p.tail_depth / math.tan(math.radians(p.tail))
    face = make_face(
        Plane.XY
        * Polyline(
            (-half * s, back * s),
            (half * s, back * s),
            (wide * s, (back - p.tail_depth) * s),
            (-wide * s, (back - p.tail_depth) * s),
            close=True,
        )
    )
    body -= extrude(face, amount=p.height * s)
    body -= drill(
        p.height_screw * s, p.height_depth * s, (p.height_x * s, p.height_y * s, p.height * s), DOWN
    )
    return body
