"""A welded bulk hopper over a bowl feeder: two bent side walls, front and back wall, outlet collar, mounting bar."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Compound, FilletPolyline, Plane, Polygon, extrude, trace

from benchmark.kit import Model
from benchmark.shapes import BACK, RIGHT, assembly, block, named, rod, slot

MODEL = Model("Feeder hopper", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the outlet's lower edge at z = 0, opening up; middle at x = y = 0; side walls at +-x."""

    sheet: float = 3
    mouth: float = 320  # inside, along x
    outlet: float = 80  # inside, along x
    depth: float = 140  # inside, along y
    collar_height: float = 45  # outlet collar, below the sloping walls
    collar_sheet: float = 4
    slope_height: float = 210
    lip_height: float = 60  # upright part of the side walls
    bend: float = 3  # inner radius of the bend between slope and lip
    window: tuple[float, float] = (120, 24)  # slot in the front wall, upright
    window_z: float = 190  # its middle
    sensor: float = 30.5  # hole in the back wall
    sensor_z: float = 120
    sensor_x: float = 0
    collar_holes: float = 6.5  # through the collar's left and right side
    collar_pitch: float = 90  # along y
    collar_hole_z: float = 15
    bar: tuple[float, float, float] = (380, 10, 50)  # flat at the back
    bar_z: float = 235  # its lower edge
    bar_hole: float = 13
    bar_pitch: float = 340
    drains: int = 5  # holes in each sloping wall
    drain: float = 5
    drain_pitch: float = 24  # along y


def build(p: P) -> Compound:
    """Cuts, bends and sets the sheets."""
    t = p.sheet
    top = p.collar_height + p.slope_height + p.lip_height
    knee = p.collar_height + p.slope_height
    run = (p.mouth - p.outlet) / 2
    a = math.atan2(p.slope_height, run)
    # mid-plane of the wall whose inner face runs outlet edge -> knee -> rim; the sheet's lower end stands on the collar
    shift = t / 2
    nx, nz = math.sin(a), -math.cos(a)
    start = (p.outlet / 2 + shift / nx, p.collar_height)
    kx = p.mouth / 2 + shift
    kz = p.collar_height + (kx - start[0]) * math.tan(a)
    low = (start[0] - 10 / math.tan(a), start[1] - 10)
    line = FilletPolyline(low, (kx, kz), (kx, top), radius=p.bend + shift)
    profile = trace(line, t)
    wall = extrude(Plane.XZ.offset(-p.depth / 2) * profile, amount=p.depth)
    wall &= block((1000, p.depth, top - p.collar_height), (0, 0, p.collar_height))
    mid = (p.outlet / 2 + run / 2, knee - p.slope_height / 2)
    for i in range(p.drains):
        y = (i - (p.drains - 1) / 2) * p.drain_pitch
        wall -= rod(p.drain, 40, (mid[0] - 20 * nx, y, mid[1] - 20 * nz), (nx, 0, nz))
    right = wall
    left = right.mirror(Plane.YZ)
    over = t / nx
    o, m = p.outlet / 2 + over, p.mouth / 2 + t
    kz_out = p.collar_height + (m - o) * math.tan(a)
    shape = Polygon(
        (-o, p.collar_height), (o, p.collar_height), (m, kz_out), (m, top), (-m, top), (-m, kz_out), align=None
    )
    front = extrude(Plane.XZ.offset(p.depth / 2) * shape, amount=t)
    back = extrude(Plane.XZ.offset(-p.depth / 2 - t) * shape, amount=t)
    front -= slot(*p.window, 4 * t, (0, -p.depth / 2 - 2 * t, p.window_z), BACK, 90)
    back -= rod(p.sensor, 4 * t, (p.sensor_x, p.depth / 2 - t, p.sensor_z), BACK)
    c = p.collar_sheet
    collar = block((p.outlet + 2 * c, p.depth + 2 * c, p.collar_height))
    collar -= block((p.outlet, p.depth, p.collar_height))
    for s in (-1, 1):
        collar -= rod(p.collar_holes, p.outlet * 2, (-p.outlet, s * p.collar_pitch / 2, p.collar_hole_z), RIGHT)
    bar = block(p.bar, (0, p.depth / 2 + t + p.bar[1] / 2, p.bar_z))
    for s in (-1, 1):
        bar -= rod(p.bar_hole, 40, (s * p.bar_pitch / 2, p.depth / 2, p.bar_z + p.bar[2] / 2), BACK)
    return assembly(
        [
            named(left, "side wall left", "lightgray"),
            named(right, "side wall right", "lightgray"),
            named(front, "front wall", "steelblue"),
            named(back, "back wall", "slategray"),
            named(collar, "outlet collar", "orange"),
            named(bar, "mounting bar", "darkgreen"),
        ]
    )
