"""A burner nozzle turned from hexagon bar: threaded shank with undercut, O-ring groove, cone nose, blind bore and jet."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Model
from benchmark.shapes import circle, cone, drill, prism, rod

MODEL = Model("Burner nozzle", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the rear end face z = 0, the nose points up."""

    thread: float = 20  # outside diameter of the shank, M20 x 1.5
    shank: float = 18  # its length with the undercut
    bevel: float = 1.5  # 45 degrees, rear end
    undercut: float = 17.5  # diameter
    undercut_width: float = 3  # next to the hexagon
    hexagon: float = 30  # across flats
    hexagon_length: float = 14
    hexagon_face: float = 29  # diameter to which its corners are turned at both faces, 30 degrees
    body: float = 24
    body_length: float = 24
    groove: float = 19.6  # diameter at the bottom of the O-ring groove
    groove_width: float = 3.6
    groove_z: float = 39  # of its middle
    nose: float = 14  # length of the cone
    tip: float = 12  # diameter of the nose's flat end
    socket: float = 11.8  # core hole of G 1/4, rear
    socket_depth: float = 12
    bore: float = 10
    bore_depth: float = 50  # from the rear end, cylinder only; drill point beyond
    jet: float = 3
    flare: float = 6  # mouth of the 90 degree countersink of the jet
    air: float = 2  # radial holes
    airs: int = 6
    air_z: float = 47

    @property
    def length(self) -> float:
        """Over all."""
        return self.shank + self.hexagon_length + self.body_length + self.nose


def build(p: P) -> Part:
    """Turns the outside from the rear, then drills."""
    b, z1 = p.bevel, p.shank
    z2 = z1 + p.hexagon_length
    z3 = z2 + p.body_length
    part = cone(p.thread - 2 * b, p.thread, b) + rod(p.thread, z1 - p.undercut_width - b, (0, 0, b))
    part += rod(p.undercut, p.undercut_width, (0, 0, z1 - p.undercut_width))
    wide = p.hexagon / math.cos(math.radians(30)) + 2
    rise = (wide - p.hexagon_face) / 2 * math.tan(math.radians(30))
    turned = cone(p.hexagon_face, wide, rise, (0, 0, z1))
    turned += rod(wide, p.hexagon_length - 2 * rise, (0, 0, z1 + rise))
    turned += cone(wide, p.hexagon_face, rise, (0, 0, z2 - rise))
    part += prism(p.hexagon, p.hexagon_length, (0, 0, z1)) & turned
    part += rod(p.body, p.body_length, (0, 0, z2)) + cone(p.body, p.tip, p.nose, (0, 0, z3))
    start = (0, 0, p.groove_z - p.groove_width / 2)
    part -= rod(p.body + 2, p.groove_width, start) - rod(p.groove, p.groove_width, start)
    part -= drill(p.bore, p.bore_depth, (0, 0, 0), (0, 0, 1))
    part -= rod(p.socket, p.socket_depth)
    part -= rod(p.jet, p.length - p.bore_depth, (0, 0, p.bore_depth))
    part -= cone(0, p.flare, p.flare / 2, (0, 0, p.length - p.flare / 2))
    for x, y in circle(p.airs, 2):
        part -= rod(p.air, p.body, (0, 0, p.air_z), (x, y, 0))
    return part
