"""A banjo bolt for a brake line: hexagon with collar, shank with an annular groove, blind bore and cross bores."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, RIGHT, UP, cone, drill, prism, rod

MODEL = Model("Banjo bolt", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; axis z; the collar's seat at z = 0, the shank goes down."""

    flats: float = 22
    head: float = 11  # height of the hexagon above the collar
    collar: float = 27
    collar_height: float = 2.5
    shank: float = 16
    shank_length: float = 38  # below the seat
    tip: float = 1.5  # chamfer of the shank's end
    neck: float = 13.4  # undercut below the seat
    neck_length: float = 2.2
    groove: float = 11.5  # diameter in the ground of the annular groove
    groove_width: float = 9
    groove_z: float = 12  # its middle, below the seat
    bore: float = 7  # from the tip
    bore_depth: float = 30  # cylinder
    cross: float = 4.5  # two crossing bores through the groove
    recess: float = 15  # weight saving recess in the head
    recess_depth: float = 4
    wire: float = 1.8  # locking wire hole across a corner
    wire_z: float = 8  # above the seat
    wire_x: float = 9.4  # from the bolt's axis


def build(p: P) -> Part:
    top = p.collar_height + p.head
    body = rod(p.collar, p.collar_height)
    hexagon = prism(p.flats, p.head, (0, 0, p.collar_height))
    corner = p.flats * 2 / 3**0.5
    high = (corner + 6 - p.flats + 0.8) / 2 * 0.57735  # a cone of 30 degrees takes the corners off
    hexagon &= cone(corner + 6, p.flats - 0.8, high, (0, 0, top - high)) + rod(
        corner + 6, p.head - high, (0, 0, p.collar_height)
    )
    body += hexagon
    shank = rod(p.shank, p.shank_length, (0, 0, 0), DOWN)
    shank = chamfer(shank.edges().sort_by(Axis.Z)[:1], p.tip)
    shank -= rod(p.shank + 5, p.neck_length, (0, 0, 0), DOWN) - rod(p.neck, p.neck_length, (0, 0, 0), DOWN)
    start = -p.groove_z + p.groove_width / 2
    shank -= rod(p.shank + 5, p.groove_width, (0, 0, start), DOWN) - rod(
        p.groove, p.groove_width, (0, 0, start), DOWN
    )
    body += shank
    body -= drill(p.bore, p.bore_depth, (0, 0, -p.shank_length), UP)
    body -= rod(p.cross, p.shank, (-p.shank / 2, 0, -p.groove_z), RIGHT)
    body -= rod(p.cross, p.shank, (0, -p.shank / 2, -p.groove_z), BACK)
    body -= rod(p.recess, p.recess_depth, (0, 0, top), DOWN)
    body -= rod(p.wire, 40, (p.wire_x, -20, p.wire_z), BACK)
    return body
