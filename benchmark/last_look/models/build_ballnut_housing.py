"""A ball nut housing: block with feet, stepped bore with a lubrication groove, screw patterns on both ends, dowels."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, UP, block, circle, drill, rod

MODEL = Model("Ball nut housing", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the bore runs along x, z = 0 is the underside, x = y = 0 the middle of the base."""

    length: float = 60  # along x
    width: float = 94  # over the feet
    foot: float = 24  # height of the feet
    block: float = 58  # width above the feet
    height: float = 56
    corner: float = 1  # radius between foot and block
    centre: float = 30  # height of the bore's axis
    bore: float = 36
    seal: float = 42  # counterbore on the -x end
    seal_depth: float = 10
    groove: float = 39  # diameter of the lubrication groove
    groove_width: float = 6
    groove_x: float = -8  # of its middle
    port: float = 5  # core hole of M6, from the top into the groove
    port_face: float = 12  # spot face
    port_face_depth: float = 1
    nut_taps: int = 6
    nut_tap: float = 4.2  # core hole of M5, +x end
    nut_depth: float = 12
    nut_circle: float = 47
    cover_taps: int = 4
    cover_tap: float = 3.3  # core hole of M4, -x end
    cover_depth: float = 10
    cover_circle: float = 50
    hole: float = 9  # in the feet
    cbore: float = 15
    cbore_depth: float = 9
    hole_dx: float = 40
    hole_dy: float = 76
    dowel: float = 8  # reamed, from below, blind
    dowel_depth: float = 14
    relief: float = 40  # width of the channel in the underside, along x
    relief_depth: float = 1


def build(p: P) -> Part:
    """Mills the tee shape, bores, drills."""
    body = block((p.length, p.width, p.foot)) + block((p.length, p.block, p.height))
    inner = [
        e
        for e in body.edges().filter_by(Axis.X)
        if abs(e.center().Z - p.foot) < 1e-3 and abs(abs(e.center().Y) - p.block / 2) < 1e-3
    ]
    body = fillet(inner, p.corner)
    body -= block((p.length, p.relief, p.relief_depth))
    left, right = -p.length / 2, p.length / 2
    body -= rod(p.bore, p.length, (left, 0, p.centre), RIGHT)
    body -= rod(p.seal, p.seal_depth, (left, 0, p.centre), RIGHT)
    body -= rod(p.groove, p.groove_width, (p.groove_x - p.groove_width / 2, 0, p.centre), RIGHT)
    body -= rod(p.port, p.height - p.centre, (p.groove_x, 0, p.centre))
    body -= rod(p.port_face, p.port_face_depth, (p.groove_x, 0, p.height - p.port_face_depth))
    for y, z in circle(p.nut_taps, p.nut_circle):
        body -= drill(p.nut_tap, p.nut_depth, (right, y, p.centre + z), LEFT)
    for y, z in circle(p.cover_taps, p.cover_circle, 45):
        body -= drill(p.cover_tap, p.cover_depth, (left, y, p.centre + z), RIGHT)
    for sy in (-1, 1):
        y = sy * p.hole_dy / 2
        for sx in (-1, 1):
            x = sx * p.hole_dx / 2
            body -= rod(p.hole, p.foot, (x, y, 0))
            body -= rod(p.cbore, p.cbore_depth, (x, y, p.foot - p.cbore_depth))
        body -= drill(p.dowel, p.dowel_depth, (0, y, 0), UP)
    return body
