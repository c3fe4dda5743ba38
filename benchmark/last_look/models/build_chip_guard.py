"""A bent chip guard for a lathe: foot flange, wall with a screwed window, hood folded over by less than a right angle."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Plane, Polygon, Pos, RectangleRounded, SlotOverall, chamfer, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import FRONT, UP, grid, rod, slot

MODEL = Model("Chip guard", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the wall's outside is y = 0, foot and hood point to -y, the foot lies on z = 0."""

    sheet: float = 1.5
    width: float = 320  # along x
    foot: float = 42  # over all, from the wall's outside
    wall: float = 190  # to the sharp outer corner with the hood
    hood: float = 70  # from that corner to its edge, on the outside
    bend: float = 2  # inside radius of both
    fold: float = 50  # degrees through which the hood is bent out of the wall's plane
    corner: float = 18  # radius of the hood's two free corners
    cut: float = 12  # 45 degree corner cut of the foot's two free corners
    window: tuple[float, float] = (150, 80)
    window_r: float = 10
    window_z: float = 100
    rivet: float = 4.2  # round the window
    rivets: tuple[float, float] = (170, 100)
    foot_slot: tuple[float, float] = (16, 7)  # over all; along x
    foot_slots: int = 3
    foot_pitch: float = 125
    foot_slot_y: float = -24
    vent: tuple[float, float] = (36, 5)  # over all; along the hood's slope
    vents: int = 7
    vent_pitch: float = 34
    vent_out: float = 37  # of their middles from the sharp outer corner, on the outside


def build(p: P) -> Part:
    """Folds the profile, then cuts the holes."""
    a = math.radians(p.fold)
    t = p.sheet
    d = (-math.sin(a), math.cos(a))  # hood's direction in (y, z)
    n = (-math.cos(a), -math.sin(a))  # from the hood's outside to its inside
    end = (p.hood * d[0], p.wall + p.hood * d[1])
    k = t * math.tan(a / 2)
    outline = Polygon(
        (-p.foot, 0), (0, 0), (0, p.wall), end, (end[0] + t * n[0], end[1] + t * n[1]), (-t, p.wall - k), (-t, t),
        (-p.foot, t), align=None,
    )  # fmt: skip
    outline = fillet(_at(outline, (-t, p.wall - k), (-t, t)), p.bend)
    outline = fillet(_at(outline, (0, 0), (0, p.wall)), p.bend + t)
    profile = Plane((-p.width / 2, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0))
    body = extrude(profile * outline, amount=p.width)
    tips = body.edges().filter_by(lambda e: abs(e.length - t) < 1e-6)
    body = chamfer([e for e in tips if e.center().Z < t], p.cut)
    tips = body.edges().filter_by(lambda e: abs(e.length - t) < 1e-6)
    body = fillet([e for e in tips if e.center().Z > p.wall], p.corner)
    wall = Plane((0, 1, 0), x_dir=(1, 0, 0), z_dir=(0, -1, 0))
    body -= extrude(wall * Pos(0, p.window_z) * RectangleRounded(*p.window, p.window_r), amount=4)
    for x, z in grid(2, 2, *p.rivets, center=(0, p.window_z)):
        body -= rod(p.rivet, 4, (x, 1, z), FRONT)
    for index in range(p.foot_slots):
        x = (index - (p.foot_slots - 1) / 2) * p.foot_pitch
        body -= slot(*p.foot_slot, 4, (x, p.foot_slot_y, -1), UP)
    hood = Plane((0, p.vent_out * d[0] - n[0], p.wall + p.vent_out * d[1] - n[1]), x_dir=(1, 0, 0), z_dir=(0, *n))
    for index in range(p.vents):
        x = (index - (p.vents - 1) / 2) * p.vent_pitch
        body -= extrude(hood * Pos(x, 0) * SlotOverall(*p.vent, rotation=90), amount=4)
    return body


def _at(outline, *places: tuple[float, float]):
    return [v for v in outline.vertices() if any(math.hypot(v.X - x, v.Y - y) < 1e-6 for x, y in places)]
