"""A shaft support with a clamping slit: counterbored foot holes, a clamping screw across the ears, dowel holes below; B-splines."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Form, Model
from benchmark.shapes import BACK, LEFT, RIGHT, UP, block, rod

MODEL = Model("Shaft support", "held_out", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot stands on z = 0, its middle is x = y = 0; the shaft's axis runs along y."""

    foot: tuple[float, float, float] = (90, 32, 14)
    tower: float = 50  # width
    height: float = 66
    root: float = 6  # fillet between foot and tower
    axis: float = 38
    bore: float = 30
    slit: float = 3
    bolt: float = 9
    bolt_head: float = 15
    bolt_head_depth: float = 5
    bolts_x: float = 70
    screw: float = 6.6  # clearance in the left ear
    screw_head: float = 11
    screw_head_depth: float = 7
    thread: float = 5  # core hole of M6 in the right ear, through
    screw_z: float = 59
    dowel: float = 6
    dowel_depth: float = 9
    dowels_x: float = 36


def build(p: P) -> Part:
    """Extrudes the profile, bores, slits and drills."""
    depth = p.foot[1]
    body = block(p.foot) + block((p.tower, depth, p.height))
    roots = [
        e
        for e in body.edges().filter_by(Axis.Y)
        if abs(abs(e.center().X) - p.tower / 2) < 1e-6 and abs(e.center().Z - p.foot[2]) < 1e-6
    ]
    body = fillet(roots, p.root)
    body -= rod(p.bore, depth, (0, -depth / 2, p.axis), BACK)
    body -= block((p.slit, depth, p.height - p.axis), (0, 0, p.axis))
    left = -p.tower / 2
    body -= rod(p.screw, p.tower / 2, (left, 0, p.screw_z), RIGHT)
    body -= rod(p.screw_head, p.screw_head_depth, (left, 0, p.screw_z), RIGHT)
    body -= rod(p.thread, p.tower / 2, (-left, 0, p.screw_z), LEFT)
    for side in (-1, 1):
        x = side * p.bolts_x / 2
        body -= rod(p.bolt, p.foot[2], (x, 0, 0))
        body -= rod(p.bolt_head, p.bolt_head_depth + p.root, (x, 0, p.foot[2] - p.bolt_head_depth))
        body -= rod(p.dowel, p.dowel_depth, (side * p.dowels_x / 2, 0, 0), UP)
    return body
