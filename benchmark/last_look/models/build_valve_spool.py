"""The spool of a directional valve: four lands, three undercuts, pressure balancing grooves, metering notches, axial drain."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, block, circle, cone, drill, rod

MODEL = Model("Valve spool", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the left end face is x = 0."""

    length: float = 118  # over all
    land: float = 16  # diameter of the lands
    neck: float = 9.5  # diameter at the bottom of the three undercuts
    stub: float = 11  # diameter of the spring spigot on the left end
    stub_length: float = 9
    tail: float = 10  # diameter of the right end spigot
    tail_length: float = 12
    undercuts: tuple[tuple[float, float], ...] = ((29, 13), (52, 17), (78, 11))  # start in x, width
    groove: float = 0.8  # width of the balancing grooves
    groove_depth: float = 0.5
    left_grooves: tuple[float, ...] = (13, 17, 21)  # x of their middles
    right_grooves: tuple[float, ...] = (94, 98, 102)
    notches: int = 4  # metering notches in the second land, opening into the middle undercut
    notch_width: float = 2.4
    notch_length: float = 3.2  # along the axis
    notch_depth: float = 1.8  # from the land's surface
    drain: float = 4  # axial hole from the right end
    drain_depth: float = 82
    tap: float = 5  # core hole of M6 in the right end
    tap_depth: float = 15
    cross: float = 2.5  # cross hole in the first undercut, right through
    bevel: float = 0.6  # 45 degrees, on the rim of both ends


def build(p: P) -> Part:
    """Turns the outside, mills the notches, drills the ends."""
    x0, x1 = p.stub_length, p.length - p.tail_length
    body = rod(p.land, x1 - x0, (x0, 0, 0), RIGHT)
    b = p.bevel
    body += rod(p.stub, x0 - b, (b, 0, 0), RIGHT) + cone(p.stub - 2 * b, p.stub, b, (0, 0, 0), RIGHT)
    body += rod(p.tail, p.tail_length - b, (x1, 0, 0), RIGHT)
    body += cone(p.tail, p.tail - 2 * b, b, (p.length - b, 0, 0), RIGHT)
    for start, width in p.undercuts:
        body -= rod(p.land + 2, width, (start, 0, 0), RIGHT) - rod(p.neck, width, (start, 0, 0), RIGHT)
    for x in p.left_grooves + p.right_grooves:
        ring = rod(p.land + 2, p.groove, (x - p.groove / 2, 0, 0), RIGHT)
        body -= ring - rod(p.land - 2 * p.groove_depth, p.groove, (x - p.groove / 2, 0, 0), RIGHT)
    edge = p.undercuts[1][0]
    r = p.land / 2
    for y, z in circle(p.notches, 1, 0):
        y, z = 2 * y, 2 * z
        mid = r - p.notch_depth / 2 + 0.5
        size = (p.notch_length, p.notch_width if abs(y) < 0.5 else p.notch_depth + 1, p.notch_width if abs(z) < 0.5 else p.notch_depth + 1)
        body -= block(size, (edge - p.notch_length / 2, y * mid, z * mid - size[2] / 2))
    body -= drill(p.drain, p.drain_depth, (p.length, 0, 0), LEFT)
    body -= rod(p.tap, p.tap_depth, (p.length, 0, 0), LEFT)
    start, width = p.undercuts[0]
    body -= rod(p.cross, 2 * p.land, (start + width / 2, 0, -p.land))
    return body
