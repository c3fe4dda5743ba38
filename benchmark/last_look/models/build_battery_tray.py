"""A folded battery tray: ears outward on the short sides, returns inward on the long ones, open corners, vents, holes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Plane, Polygon, Sketch, Vector, extrude, fillet

from benchmark.kit import Model
from benchmark.last_look.models.sheet_strip import strip
from benchmark.shapes import BACK, RIGHT, grid, rod, slot

MODEL = Model("Battery tray", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the floor's underside is z = 0, x = y = 0 its middle."""

    sheet: float = 2
    bend: float = 2  # inside radius, all bends
    length: float = 320  # over the short walls, outside
    width: float = 180  # over the long walls, outside
    end: float = 40  # height of the short walls with their ears, over all
    ear: float = 30  # the ears reach that far beyond the short walls' outside
    side: float = 60  # height of the long walls, over all
    lip: float = 15  # the returns reach that far inward from the long walls' outside
    relief: float = 6  # each wall ends that far from the tray's outer corner
    hole: float = 9  # in the ears
    hole_dy: float = 120
    hole_dx: float = 350
    vents: tuple[int, int] = (8, 5)
    vent: float = 6
    vent_pitch: float = 20
    drain: float = 14  # corner drains of the floor
    drain_dx: float = 270
    drain_dy: float = 130
    strap: tuple[float, float] = (30, 5)  # strap slots in the long walls, two each
    strap_dx: float = 180
    strap_z: float = 38
    cable: float = 22  # in the short wall on +x
    cable_z: float = 20


def build(p: P) -> Part:
    """Folds both directions and joins them at the floor, then punches."""
    t, a, b = p.sheet, p.length / 2, p.width / 2
    ends = [(-a - p.ear, p.end - t), (-a, p.end - t), (-a, 0), (a, 0), (a, p.end - t), (a + p.ear, p.end - t)]
    body = extrude(Plane.XZ * strip(ends, t, p.bend), amount=b - p.relief, both=True)
    sides = [(-b + p.lip, p.side), (-b, p.side), (-b, 0), (b, 0), (b, p.side), (b - p.lip, p.side)]
    body += extrude(Plane.YZ * strip(sides, t, p.bend), amount=a - p.relief, both=True)
    for x, y in grid(2, 2, p.hole_dx, p.hole_dy):
        body -= rod(p.hole, t, (x, y, p.end - t))
    for x, y in grid(*p.vents, p.vent_pitch, p.vent_pitch):
        body -= rod(p.vent, t, (x, y, 0))
    for x, y in grid(2, 2, p.drain_dx, p.drain_dy):
        body -= rod(p.drain, t, (x, y, 0))
    for s in (-1, 1):
        body -= slot(*p.strap, p.width + 2, (s * p.strap_dx / 2, -b - 1, p.strap_z), BACK)
    body -= rod(p.cable, 2 * t, (a - 1.5 * t, 0, p.cable_z), RIGHT)
    return body
