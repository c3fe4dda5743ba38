"""A slide of an injection mould: guide lugs below, a locking heel behind, a two slanted holes for angle pins, a core in front."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polyline, Pos, Rot, chamfer, extrude, make_face

from benchmark.kit import Model
from benchmark.shapes import DOWN, FRONT, UP, block, cone, drill, rod

MODEL = Model("Mould slide", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; stands on z = 0, middle x = 0, the core looks to -y; the front face lies at y = 0."""

    width: float = 70  # of the body without lugs
    length: float = 110  # of the body along y, without the core
    height: float = 58
    lug: float = 9  # each guide lug stands out so far
    lug_height: float = 14
    heel: float = 20  # degrees of the heel face from the vertical
    heel_z: float = 20  # here the heel face starts at the back
    pin: float = 16.5  # two holes for the angle pins
    pin_dx: float = 40  # between their axes
    pin_angle: float = 18  # degrees from the vertical
    pin_y: float = 46  # its axis at the top face
    core: float = 32  # diameter of the round core
    core_length: float = 24
    core_z: float = 36
    core_bevel: float = 1.5  # chamfer of its front edge
    cool: float = 8  # cooling bore in the core axis, from the back
    cool_rest: float = 10  # remains between the ground of the bore's cylinder and the core's front
    dimple: float = 8  # mouth of the detent dimples, 90 degrees
    stroke: float = 28  # between the two dimples
    dimple_y: float = 70  # of the first
    wear_tap: float = 4.2  # core hole M5 in the top face, for the stripper plate
    wear_depth: float = 11
    wear_dx: float = 50
    wear_y: float = 12


def build(p: P) -> Part:
    body = block((p.width, p.length, p.height), (0, p.length / 2, 0))
    body += block((p.width + 2 * p.lug, p.length, p.lug_height), (0, p.length / 2, 0))
    run = (p.height - p.heel_z) * math.tan(math.radians(p.heel))
    wedge = make_face(
        Plane.YZ
        * Polyline((p.length, p.heel_z), (p.length, p.height), (p.length - run, p.height), close=True)
    )
    body -= extrude(wedge, amount=p.width, both=True)
    core = rod(p.core, p.core_length, (0, 0, p.core_z), FRONT)
    front = core.edges().sort_by(Axis.Y)[0]
    body += chamfer(front, p.core_bevel)
    # the top of the pin leans to the front: its axis goes down and to the back
    for x in (-1, 1):
        place = Pos(x * p.pin_dx / 2, p.pin_y, p.height) * Rot(p.pin_angle, 0, 0)
        body -= place * rod(p.pin, 300, (0, 0, -150))
    depth = p.length + p.core_length - p.cool_rest
    body -= drill(p.cool, depth, (0, p.length, p.core_z), FRONT)
    for y in (p.dimple_y, p.dimple_y + p.stroke):
        body -= cone(p.dimple, 0, p.dimple / 2, (0, y, 0), UP)
    for x in (-1, 1):
        body -= drill(p.wear_tap, p.wear_depth, (x * p.wear_dx / 2, p.wear_y, p.height), DOWN)
        body -= drill(p.wear_tap, p.wear_depth, (x * p.wear_dx / 2, p.wear_y + 60, p.height), DOWN)
    return body
