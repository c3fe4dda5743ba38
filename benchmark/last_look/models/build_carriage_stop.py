"""A milled carriage stop for a lathe bed: vee below, split bore for a micrometer head, clamp screws."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, RIGHT, UP, block, drill, prism, rod

MODEL = Model("Carriage stop", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the block stands on z = 0, its middle is x = y = 0; bed, vee and bore run along x."""

    size: tuple[float, float, float] = (60, 90, 48)
    bevel: float = 2  # of the four upright edges
    vee: float = 26  # width of its mouth, 90 degrees
    vee_y: float = 14
    relief: float = 3  # width of the slot at the vee's apex
    relief_depth: float = 3  # below the apex of the vee
    bore: float = 12  # for the micrometer head
    bore_y: float = -30
    bore_z: float = 32
    slit: float = 2  # from the bore to the top
    pinch: float = 5.5  # clearance of the M5 pinch screw, from -y to the slit
    pinch_tap: float = 4.2  # beyond the slit
    pinch_tap_depth: float = 12  # measured from the slit's far wall
    pinch_head: float = 10
    pinch_head_depth: float = 4
    pinch_z: float = 42.5
    clamp: float = 9  # through holes for M8 from above, at +y
    clamp_head: float = 15
    clamp_head_depth: float = 8.5
    clamps_x: float = 36  # between the two
    clamp_y: float = 36
    rebate: float = 6  # depth of the step in the underside at -y
    rebate_width: float = 34


def build(p: P) -> Part:
    """Mills the block, vee and step, then bores and slits it."""
    x, y, z = p.size
    body = block(p.size)
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel)
    body -= prism(p.vee / 2**0.5, x, (-x / 2, p.vee_y, 0), RIGHT, sides=4)
    body -= block((x, p.relief, p.vee / 2 + p.relief_depth), (0, p.vee_y, 0))
    body -= block((x, p.rebate_width, p.rebate), (0, -y / 2 + p.rebate_width / 2, 0))
    body -= rod(p.bore, x, (-x / 2, p.bore_y, p.bore_z), RIGHT)
    body -= block((x, p.slit, z - p.bore_z), (0, p.bore_y, p.bore_z))
    body -= rod(p.pinch, p.bore_y + y / 2, (0, -y / 2, p.pinch_z), BACK)
    body -= rod(p.pinch_head, p.pinch_head_depth, (0, -y / 2, p.pinch_z), BACK)
    body -= drill(p.pinch_tap, p.pinch_tap_depth + p.slit / 2, (0, p.bore_y, p.pinch_z), BACK)
    for side in (-1, 1):
        at = (side * p.clamps_x / 2, p.clamp_y)
        body -= rod(p.clamp, z, (*at, 0), UP)
        body -= rod(p.clamp_head, p.clamp_head_depth, (*at, z), DOWN)
    return body
