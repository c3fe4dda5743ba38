"""An antenna bracket of sheet: foot flange, web with a round opening, sloping top flange with clipped corners."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, Sketch, Vector, chamfer, extrude, fillet

from benchmark.kit import Model
from benchmark.last_look.models.sheet_strip import strip
from benchmark.shapes import LEFT, cone, grid, rod, slot

MODEL = Model("Antenna bracket", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot's underside is z = 0, the web's back face x = 0, the foot lies towards +x, y = 0 is the middle."""

    sheet: float = 3
    bend: float = 4  # inside radius, both bends
    width: float = 140
    foot: float = 80  # from the web's back face to the foot's edge
    web: float = 110  # from the foot's underside to the upper corner line on the web's back
    top: float = 55  # length of the sloping flange's outer face up to that corner line
    slope: float = 30  # degrees, the top flange rises from the horizontal towards -x
    foot_corner: float = 12  # radius of the foot's corners
    clip: float = 15  # 45 degrees, the top flange's corners
    slots: int = 2
    slot_length: float = 20
    slot_width: float = 9
    slot_x: float = 50
    slot_dy: float = 96
    sinks: int = 4  # countersunk from above in the foot
    sink: float = 5.5
    sink_head: float = 11  # 90 degrees
    sink_dx: float = 36
    sink_dy: float = 50
    sink_x: float = 42  # middle of the pattern
    opening: float = 60
    opening_z: float = 60
    ubolt: float = 8.5  # two in the web, beside the opening
    ubolt_dy: float = 104
    ubolt_z: float = 60
    mast: float = 26  # hole in the top flange, square to it
    mast_along: float = 30  # from the upper corner line along the slope


def build(p: P) -> Part:
    """Folds, trims the corners, punches and countersinks."""
    t, a = p.sheet, math.radians(p.slope)
    end = (-p.top * math.cos(a), p.web + p.top * math.sin(a))
    line = [end, (0, p.web), (0, 0), (p.foot, 0)]
    body = extrude(Plane.XZ * strip(line, t, p.bend), amount=p.width / 2, both=True)
    foot = [e for e in body.edges().filter_by(Axis.Z) if abs(e.center().X - p.foot) < 1e-3]
    body = fillet(foot, p.foot_corner)
    normal = (math.sin(a), 0, math.cos(a))
    clipped = [
        e
        for e in body.edges().filter_by(Axis((0, 0, 0), normal))
        if e.center().X < end[0] + 2 * t and abs(e.length - t) < 1e-3
    ]
    body = chamfer(clipped, p.clip)
    for s in (-1, 1):
        body -= slot(p.slot_length, p.slot_width, t, (p.slot_x, s * p.slot_dy / 2, t))
        body -= rod(p.ubolt, 3 * t, (2 * t, s * p.ubolt_dy / 2, p.ubolt_z), LEFT)
    for x, y in grid(2, 2, p.sink_dx, p.sink_dy, (p.sink_x, 0)):
        body -= rod(p.sink, t, (x, y, 0))
        body -= cone(p.sink_head, 0, p.sink_head / 2, (x, y, t), (0, 0, -1))
    body -= rod(p.opening, 3 * t, (2 * t, 0, p.opening_z), LEFT)
    at = (-p.mast_along * math.cos(a), 0, p.web + p.mast_along * math.sin(a))
    start = (at[0] - 4 * t * normal[0], 0, at[2] - 4 * t * normal[2])
    body -= rod(p.mast, 8 * t, start, normal)
    return body
