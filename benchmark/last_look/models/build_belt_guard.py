"""A belt guard folded from sheet: a hat section with vents, a window, a shaft hole and slotted lips."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, Pos, RectangleRounded, chamfer, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, grid, rod, slot

MODEL = Model("Belt guard", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the front is y = 0 and looks to -y, the lips end at y = depth; x runs along the guard."""

    length: float = 520
    height: float = 240  # outside, over the two folded walls
    depth: float = 85  # outside, from the front to the lips' back
    sheet: float = 2
    bend: float = 3  # inner radius of every bend
    lip: float = 26  # from the wall's outside to the lip's free edge
    lip_cut: float = 10  # bevel of the lips' corners
    lip_slot: tuple[float, float] = (16, 9)
    lip_slots: int = 3  # per lip
    lip_pitch: float = 210
    lip_slot_edge: float = 13  # from the slot's middle to the lip's free edge
    vents: int = 12
    vent: tuple[float, float] = (70, 6)  # upright
    vent_pitch: float = 14
    vent_x: float = -20  # of the row's middle
    window: tuple[float, float] = (130, 80)
    window_r: float = 10
    window_x: float = 150
    pane: tuple[float, float] = (150, 100)  # between the small holes about the window
    pane_d: float = 4.2
    shaft_d: float = 60
    shaft_x: float = -180
    handle_d: float = 8.5  # two holes in the top
    handle_pitch: float = 120
    handle_y: float = 45
    drain_d: float = 12  # one hole in the bottom
    drain_y: float = 68


def build(p: P) -> Part:
    """Folds the section and cuts it."""
    t, h, d = p.sheet, p.height / 2, p.depth
    e = h + p.lip
    right = [(0, h), (d - t, h), (d - t, e), (d, e), (d, h - t), (t, h - t)]
    left = [(y, -z) for y, z in reversed(right)]
    section = Polygon(*right, *left, align=None)
    inner, outer = [], []
    for v in section.vertices():
        y, z = v.X, abs(v.Y)
        if (round(y, 6), round(z, 6)) in ((round(d - t, 6), round(h, 6)), (round(t, 6), round(h - t, 6))):
            inner.append(v)
        elif (round(y, 6), round(z, 6)) in ((0, round(h, 6)), (round(d, 6), round(h - t, 6))):
            outer.append(v)
    section = fillet(inner, p.bend)
    outer = [
        v for v in section.vertices() if any(abs(v.X - o.X) < 1e-6 and abs(v.Y - o.Y) < 1e-6 for o in outer)
    ]
    section = fillet(outer, p.bend + t)
    body = extrude(Plane.YZ * section, amount=p.length / 2, both=True)
    corners = [
        edge
        for edge in body.edges().filter_by(Axis.Y)
        if abs(abs(edge.center().Z) - e) < 1e-6 and abs(abs(edge.center().X) - p.length / 2) < 1e-6
    ]
    body = chamfer(corners, p.lip_cut)
    for index in range(p.vents):
        x = p.vent_x + (index - (p.vents - 1) / 2) * p.vent_pitch
        body -= slot(*p.vent, 2 * t, (x, -t / 2, 0), BACK, 90)
    body -= extrude(
        Plane(origin=(p.window_x, -t / 2, 0), x_dir=(1, 0, 0), z_dir=(0, 1, 0)) * RectangleRounded(*p.window, p.window_r),
        amount=2 * t,
    )
    for x, z in grid(2, 2, *p.pane, center=(p.window_x, 0)):
        body -= rod(p.pane_d, 2 * t, (x, -t / 2, z), BACK)
    body -= rod(p.shaft_d, 2 * t, (p.shaft_x, -t / 2, 0), BACK)
    for x, z in grid(p.lip_slots, 2, p.lip_pitch, 2 * (e - p.lip_slot_edge)):
        body -= slot(*p.lip_slot, 3 * t, (x, d - 2 * t, z), BACK)
    for side in (-1, 1):
        body -= rod(p.handle_d, 3 * t, (side * p.handle_pitch / 2, p.handle_y, h - 2 * t))
    body -= rod(p.drain_d, 3 * t, (0, p.drain_y, -h - t / 2))
    return body
