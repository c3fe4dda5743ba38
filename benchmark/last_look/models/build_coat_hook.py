"""A cast coat hook: a rounded wall plate with two countersunk holes, a slanted peg with a knob, a straight short peg."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, block, cone, rod

MODEL = Model("Coat hook", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate's back lies on y = 0, its lower edge on z = 0, its middle on x = 0."""

    plate: tuple[float, float, float] = (54, 7, 125)
    corner: float = 14
    hole: float = 5.5
    sink: float = 11  # of 90 degrees
    holes_z: tuple[float, float] = (14, 108)
    peg: float = 14  # upper one
    peg_length: float = 64  # along its axis, from the plate's front to the knob
    peg_z: float = 74  # where its axis leaves the plate
    slant: float = 30  # degrees above the horizontal
    knob: float = 28
    knob_height: float = 9
    lower: float = 11  # lower peg
    lower_length: float = 32  # to the end disc
    lower_z: float = 40
    disc: float = 19
    disc_height: float = 5
    pocket: tuple[float, float, float] = (30, 2.5, 60)  # in the back
    pocket_z: float = 28  # its lower edge

    @property
    def reach(self) -> float:
        """How far the knob's end stands off the wall."""
        a = radians(self.slant)
        return self.plate[1] + (self.peg_length + self.knob_height) * cos(a) + self.knob / 2 * sin(a)

    @property
    def top(self) -> float:
        """Height of the knob's highest point."""
        a = radians(self.slant)
        return self.peg_z + (self.peg_length + self.knob_height) * sin(a) + self.knob / 2 * cos(a)


def build(p: P) -> Part:
    """Plate, pegs, then all holes."""
    w, t, h = p.plate
    plate = block(p.plate, (0, -t / 2, 0))
    body = fillet(plate.edges().filter_by(Axis.Y), p.corner)
    a = radians(p.slant)
    along = (0, -cos(a), sin(a))

    def on(s: float) -> tuple[float, float, float]:
        return (0, -t + s * along[1], p.peg_z + s * along[2])

    body += rod(p.peg, p.peg_length + 10, on(-10), along)
    body += rod(p.knob, p.knob_height, on(p.peg_length), along)
    body += rod(p.lower, p.lower_length + 1, (0, -t + 1, p.lower_z), FRONT)
    body += rod(p.disc, p.disc_height, (0, -t - p.lower_length, p.lower_z), FRONT)
    body -= block((w, 40, h), (0, 20, 0))
    for z in p.holes_z:
        body -= rod(p.hole, t, (0, -t, z), BACK)
        body -= cone(p.sink, p.hole, (p.sink - p.hole) / 2, (0, -t, z), BACK)
    return body - block(p.pocket, (0, -p.pocket[1] / 2, p.pocket_z))
