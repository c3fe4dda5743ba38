"""A small screw jack: a cast stand, a bronze nut, a spindle with a head, a tommy bar through it, a loose saddle."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Model
from benchmark.shapes import DOWN, RIGHT, assembly, block, circle, cone, named, rod

MODEL = Model("Screw jack", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the stand rests on z = 0, the tommy bar lies along x."""

    foot: float = 180  # diameter of the stand's foot
    foot_height: float = 14
    holes: int = 4
    hole: float = 11
    hole_circle: float = 156
    neck: tuple[float, float] = (128, 84)  # diameters of the stand's cone, low and high
    height: float = 160  # of the stand
    cavity: tuple[float, float] = (104, 62)  # diameters of its hollow, low and high
    cavity_height: float = 105
    nut: float = 50  # body of the nut, in the stand's bore
    nut_length: float = 60  # below its collar; ends at z = 100
    collar: float = 70
    collar_height: float = 10
    spindle: float = 32
    spindle_end: float = 30  # z of its lower end
    head: float = 54
    head_height: float = 40
    head_z: float = 205  # of its underside
    cross: float = 16  # bore for the bar
    pin: float = 20  # on top of the head, for the saddle
    pin_height: float = 15
    bar: float = 15
    bar_length: float = 260
    bar_shift: float = 40  # of its middle from the axis, to +x
    saddle: float = 66
    saddle_height: float = 24
    saddle_bore: float = 20.4
    saddle_depth: float = 16
    groove: tuple[float, float] = (6, 3)  # width, depth of the crossed grooves on the saddle


def build(p: P) -> Compound:
    """Puts the five parts together."""
    stand = rod(p.foot, p.foot_height) + cone(*p.neck, p.height - p.foot_height, (0, 0, p.foot_height))
    stand -= cone(*p.cavity, p.cavity_height) + rod(p.nut, p.height)
    for at in circle(p.holes, p.hole_circle, 45):
        stand -= rod(p.hole, p.foot_height, (*at, 0))
    nut = rod(p.nut, p.nut_length, (0, 0, p.height), DOWN) + rod(p.collar, p.collar_height, (0, 0, p.height))
    nut -= rod(p.spindle, p.nut_length + p.collar_height, (0, 0, p.height - p.nut_length))
    spindle = rod(p.spindle, p.head_z - p.spindle_end, (0, 0, p.spindle_end))
    spindle += rod(p.head, p.head_height, (0, 0, p.head_z))
    top = p.head_z + p.head_height
    spindle += rod(p.pin, p.pin_height, (0, 0, top))
    middle = p.head_z + p.head_height / 2
    spindle -= rod(p.cross, p.head, (-p.head / 2, 0, middle), RIGHT)
    bar = rod(p.bar, p.bar_length, (p.bar_shift - p.bar_length / 2, 0, middle), RIGHT)
    saddle = rod(p.saddle, p.saddle_height, (0, 0, top)) - rod(p.saddle_bore, p.saddle_depth, (0, 0, top))
    ground = top + p.saddle_height - p.groove[1]
    saddle -= block((p.saddle, *p.groove), (0, 0, ground)) + block((p.groove[0], p.saddle, p.groove[1]), (0, 0, ground))
    return assembly(
        [
            named(stand, "stand", "seagreen"),
            named(nut, "nut", "goldenrod"),
            named(spindle, "spindle", "lightsteelblue"),
            named(bar, "tommy bar", "gray"),
            named(saddle, "saddle", "firebrick"),
        ]
    )
