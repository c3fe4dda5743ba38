"""A gantry plate that rolls on a V-slot profile: wheel holes, lead-screw nut mount, belt slots, tapped accessory holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, RectangleRounded, chamfer, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, circle, drill, grid, rod, slot

MODEL = Model("V-slot gantry plate", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate lies in xy about the origin, its underside is z = 0."""

    size: tuple[float, float] = (120, 90)
    thickness: float = 6
    corner: float = 8
    bevel: float = 0.5  # outer edges of both faces, 45 degrees
    wheels: tuple[float, float] = (80, 64.6)  # between wheel axles: x, y
    fixed: float = 5.1  # upper row, +y
    eccentric: float = 7.2  # lower row, -y
    sink: float = 10  # counterbore of the fixed row, from above
    sink_depth: float = 3
    nut: float = 10.2  # for the lead-screw nut, in the middle
    nut_holes: int = 4
    nut_hole: float = 3.4
    nut_circle: float = 16
    taps: tuple[int, int] = (2, 3)  # columns, rows
    tap: float = 4.2  # core hole of M5, through
    tap_pitch: tuple[float, float] = (48, 20)
    belt: tuple[float, float] = (14, 3)  # slots, length over all along y
    belt_x: float = 52  # of their middles, left and right
    stop: float = 3.3  # core hole of M4 in the lower edge
    stop_depth: float = 15
    stop_pitch: float = 50
    adjust: tuple[float, float] = (30, 5.5)  # slot along x near the upper edge
    adjust_y: float = 36


def build(p: P) -> Part:
    """Bevels the blank, then drills."""
    body = extrude(RectangleRounded(*p.size, p.corner), amount=p.thickness)
    rims = [e for e in body.edges() if abs(e.center().Z) < 1e-6 or abs(e.center().Z - p.thickness) < 1e-6]
    body = chamfer(rims, p.bevel)
    for side in (-1, 1):
        x, y = side * p.wheels[0] / 2, p.wheels[1] / 2
        body -= rod(p.fixed, p.thickness, (x, y, 0))
        body -= rod(p.sink, p.sink_depth, (x, y, p.thickness - p.sink_depth))
        body -= rod(p.eccentric, p.thickness, (x, -y, 0))
        body -= slot(p.belt[0], p.belt[1], p.thickness, (side * p.belt_x, 0, p.thickness), rotation=90)
        body -= drill(p.stop, p.stop_depth, (side * p.stop_pitch / 2, -p.size[1] / 2, p.thickness / 2), BACK)
    body -= rod(p.nut, p.thickness)
    for x, y in circle(p.nut_holes, p.nut_circle, 45):
        body -= rod(p.nut_hole, p.thickness, (x, y, 0))
    for x, y in grid(*p.taps, *p.tap_pitch):
        body -= rod(p.tap, p.thickness, (x, y, 0))
    body -= slot(p.adjust[0], p.adjust[1], p.thickness, (0, p.adjust_y, p.thickness))
    return body
