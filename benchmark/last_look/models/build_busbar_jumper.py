"""A copper jumper between two battery modules: bent strip, one foot low, one foot high, a sensing tab at the side."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, FilletPolyline, Part, Plane, Pos, chamfer, extrude, fillet, trace

from benchmark.kit import Model
from benchmark.shapes import block, rod, slot

MODEL = Model("Busbar jumper", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the strip runs along x, its width is y (middle y = 0), the low foot lies on z = 0."""

    sheet: float = 3
    width: float = 26
    bend: float = 4  # inner radius
    riser_x: float = 38  # outer (low x) face of the upright from the low foot's free end at x = 0
    bridge_z: float = 42  # underside of the bridge
    bridge_end: float = 92  # x where the bridge's and the ramp's mid-planes meet
    ramp: float = 45  # degrees, downwards
    foot_z: float = 18  # underside of the high foot
    length: float = 160  # over all, along x
    low_hole: float = 8.5
    low_hole_x: float = 15
    cut: float = 6  # corner chamfers of the low foot
    slot: tuple[float, float] = (15, 8.5)  # in the high foot, long along x
    slot_from_end: float = 16  # middle of the slot from the free end
    round_end: float = 8  # corner radii of the high foot
    taps: tuple[float, float] = (54, 78)  # x of two holes in the bridge
    tap: float = 4.2
    tab: tuple[float, float] = (6.3, 9)  # width along x and length it stands out at the back (high y)
    tab_x: float = 66  # its middle
    tab_hole: float = 1.7
    tab_hole_out: float = 5  # from the strip's edge


def build(p: P) -> Part:
    """Bends the strip, punches it."""
    half = p.sheet / 2
    top = p.bridge_z + half
    low = p.foot_z + half
    down = (top - low) / math.tan(math.radians(p.ramp))
    line = FilletPolyline(
        (0, half),
        (p.riser_x + half, half),
        (p.riser_x + half, top),
        (p.bridge_end, top),
        (p.bridge_end + down, low),
        (p.length, low),
        radius=p.bend + half,
    )
    side = trace(line, p.sheet)
    body = extrude(Plane.XZ.offset(-p.width / 2) * side, amount=p.width)
    body -= rod(p.low_hole, p.sheet, (p.low_hole_x, 0, 0))
    body -= slot(*p.slot, p.sheet, (p.length - p.slot_from_end, 0, p.foot_z + p.sheet))
    for x in p.taps:
        body -= rod(p.tap, p.sheet, (x, 0, p.bridge_z))
    body += Pos(p.tab_x, p.width / 2 + p.tab[1] / 2 - 1, p.bridge_z) * block((p.tab[0], p.tab[1] + 2, p.sheet))
    body -= rod(p.tab_hole, p.sheet, (p.tab_x, p.width / 2 + p.tab_hole_out, p.bridge_z))
    upright = body.edges().filter_by(Axis.Z)
    body = chamfer([e for e in upright if abs(e.center().X) < 1e-6], p.cut)
    upright = body.edges().filter_by(Axis.Z)
    return fillet([e for e in upright if abs(e.center().X - p.length) < 1e-6], p.round_end)
