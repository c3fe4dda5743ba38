"""A bent sheet bracket for a stepper motor: upright face with pilot and screw holes, foot with slots, cable tie holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, block, grid, rod, slot

MODEL = Model("Sheet motor bracket", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot's underside is z = 0, the face's outer side y = 0, the foot runs towards +y, x across."""

    width: float = 76
    height: float = 82  # outside
    foot: float = 64  # outside
    sheet: float = 3
    bend: float = 4  # inner radius
    pilot: float = 39
    axis: float = 46  # of the motor over the underside
    motor: float = 47.14  # square of the motor's screws
    screw: float = 5.2
    bevel: float = 12  # upper corners of the face, 45 degrees
    round: float = 6  # free corners of the foot
    slots: int = 4
    slot: tuple[float, float] = (14, 6.5)  # length over all along y, width
    slot_span: tuple[float, float] = (52, 26)
    slot_y: float = 39  # of the pattern's middle
    window: float = 16  # round hole in the foot's middle
    ties: tuple[float, float] = (5, 2.5)  # two, upright in the face: height over all, width
    tie_span: float = 14
    tie_z: float = 77.5


def build(p: P) -> Part:
    """Bends the strip, then stamps it."""
    t, r = p.sheet, p.bend
    upright = block((p.width, t, p.height - r - t), (0, t / 2, r + t))
    flat = block((p.width, p.foot - r - t, t), (0, (p.foot + r + t) / 2, 0))
    start = (-p.width / 2, r + t, r + t)
    knee = rod(2 * (r + t), p.width, start, (1, 0, 0)) - rod(2 * r, p.width, start, (1, 0, 0))
    knee &= block((p.width, r + t, r + t), (0, (r + t) / 2, 0))
    body = upright + flat + knee
    upper = body.edges().filter_by(Axis.Y).group_by(Axis.Z)[-1]
    body = chamfer(upper, p.bevel)
    free = body.edges().filter_by(Axis.Z).group_by(Axis.Y)[-1]
    body = fillet(free, p.round)
    body -= rod(p.pilot, t, (0, 0, p.axis), BACK)
    for x, z in grid(2, 2, p.motor, p.motor, (0, p.axis)):
        body -= rod(p.screw, t, (x, 0, z), BACK)
    for x, y in grid(2, 2, *p.slot_span, (0, p.slot_y)):
        body -= slot(*p.slot, t, (x, y, t), rotation=90)
    body -= rod(p.window, t, (0, p.slot_y, 0))
    for x in (-p.tie_span / 2, p.tie_span / 2):
        body -= slot(*p.ties, t, (x, 0, p.tie_z), BACK, 90)
    return body
