"""A folded panel for pressure gauges: foot with slots, inclined front with cut-outs, lip on top."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Plane, Polygon, Pos, RectangleRounded, Circle, SlotOverall, extrude, fillet, Axis

from benchmark.kit import Model
from benchmark.shapes import circle

MODEL = Model("Gauge panel", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; width along x from the middle; the foot's underside is z = 0, the front leans back to +y.

    The outer line of the sheet: foot from y = foot (behind) to y = 0, then up the front, then the lip back."""

    sheet: float = 2
    width: float = 330
    foot: float = 70  # depth of the foot, to the outer intersection with the front
    front: float = 210  # length of the front between the outer intersections
    lean: float = 15  # degrees from the vertical
    lip: float = 25  # along the top, horizontal, from the outer intersection
    radius: float = 3  # inside of both bends
    gauges: int = 3
    gauge: float = 63.5
    gauge_pitch: float = 100
    gauge_up: float = 138  # along the front from the lower intersection
    screws: int = 3  # round each gauge
    screw: float = 4.2
    screws_on: float = 75
    window: float = 92  # cut-out of the counter
    window_height: float = 45
    window_corner: float = 2
    window_at: tuple[float, float] = (-95, 58)  # x, along the front
    switch: float = 22.5
    switches_x: tuple[float, ...] = (10, 65, 120)
    switch_up: float = 58
    slot: float = 20  # over all, along y
    slot_width: float = 9
    slots_x: float = 270  # between the two
    slot_y: float = 42  # of their middles


def front_plane(p: P) -> Plane:
    """The outer (front) face; x along x, y up the slope."""
    a = math.radians(p.lean)
    return Plane(origin=(0, 0, 0), x_dir=(1, 0, 0), z_dir=(0, -math.cos(a), math.sin(a)))


def build(p: P) -> Part:
    """Folds it, then cuts."""
    a = math.radians(p.lean)
    t = p.sheet
    top = (p.front * math.sin(a), p.front * math.cos(a))
    # outer line (y, z); inner line is offset by t inwards (up from the foot, behind the front, below the lip)
    low_in = ((t * math.sin(a) + t) / math.cos(a), t)
    # front inner face: points with distance t behind the outer line
    high_in_z = top[1] - t
    high_in = (high_in_z * math.tan(a) + t / math.cos(a), high_in_z)
    pts = [(p.foot, 0), (0, 0), top, (top[0] + p.lip, top[1]), (top[0] + p.lip, high_in_z), high_in, low_in, (p.foot, t)]
    body = extrude(Plane.YZ * Polygon(*pts, align=None), amount=p.width / 2, both=True)

    def near(y: float, z: float):
        return [e for e in body.edges().filter_by(Axis.X) if abs(e.center().Y - y) < 0.01 and abs(e.center().Z - z) < 0.01]

    body = fillet(near(*low_in) + near(*high_in), p.radius)
    body = fillet(near(0, 0) + near(*top), p.radius + t)
    plane = front_plane(p)

    def cut(sketch, x: float, up: float):
        return extrude(Plane(origin=plane.from_local_coords((x, up, 0)), x_dir=plane.x_dir, z_dir=plane.z_dir) * sketch, amount=10, both=True)

    for i in range(p.gauges):
        x = (i - (p.gauges - 1) / 2) * p.gauge_pitch
        body -= cut(Circle(p.gauge / 2), x, p.gauge_up)
        for dx, dy in circle(p.screws, p.screws_on, 90):
            body -= cut(Circle(p.screw / 2), x + dx, p.gauge_up + dy)
    body -= cut(RectangleRounded(p.window, p.window_height, p.window_corner), *p.window_at)
    for x in p.switches_x:
        body -= cut(Circle(p.switch / 2), x, p.switch_up)
    for side in (-1, 1):
        body -= extrude(Plane.XY.offset(-1) * Pos(side * p.slots_x / 2, p.slot_y) * SlotOverall(p.slot, p.slot_width, rotation=90), amount=t + 2)
    return body
