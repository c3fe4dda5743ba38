"""A welded riser for a machining fixture: base, two tapering cheeks, rear web with a window, round tie bar, top plate."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Plane, Polygon, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import DOWN, RIGHT, assembly, block, circle, grid, named, rod, slot

MODEL = Model("Fixture riser", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the base stands on z = 0, the cheeks are parallel to yz, the web is at the back (+y)."""

    base: tuple[float, float, float] = (320, 240, 20)
    base_slot: tuple[float, float] = (40, 14)  # over all; along x
    base_slots: tuple[float, float] = (264, 190)
    pin: float = 12  # two dowel holes in the base, in the middle line along x
    pins: float = 290
    top: tuple[float, float, float] = (270, 160, 25)
    tap: float = 10.2  # core of M12, through
    taps: tuple[int, int] = (5, 3)
    tap_pitch: float = 50
    cheek: float = 16  # thickness
    cheek_low: float = 200  # depth along y at the base
    cheek_high: float = 140  # depth along y under the top
    cheeks: float = 206  # outside to outside
    rise: float = 180  # clear height between base and top
    light: float = 85  # lightening hole of each cheek
    light_z: float = 95  # above the base's underside
    web: float = 12  # thickness of the rear web
    web_y: float = 50  # of its front face
    window: tuple[float, float] = (90, 50)
    window_r: float = 12
    window_z: float = 130
    tie: float = 32  # round bar between the cheeks
    tie_y: float = -70
    tie_z: float = 60


def build(p: P) -> Compound:
    """Cuts the six pieces and puts them where they are welded."""
    low, high = p.base[2], p.base[2] + p.rise
    base = block(p.base)
    for x, y in grid(2, 2, *p.base_slots):
        base -= slot(*p.base_slot, low, (x, y, low), DOWN)
    for x, y in circle(2, p.pins):
        base -= rod(p.pin, low, (x, y, 0))
    top = block(p.top, (0, 0, high))
    for x, y in grid(*p.taps, p.tap_pitch, p.tap_pitch):
        top -= rod(p.tap, p.top[2], (x, y, high))
    outline = Polygon(
        (-p.cheek_low / 2, low), (p.cheek_low / 2, low), (p.cheek_high / 2, high), (-p.cheek_high / 2, high), align=None
    )
    cheeks = []
    for start in (-p.cheeks / 2, p.cheeks / 2 - p.cheek):
        cheek = extrude(Plane((start, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0)) * outline, amount=p.cheek)
        cheeks.append(cheek - rod(p.light, p.cheek, (start, 0, p.light_z), RIGHT))
    clear = p.cheeks - 2 * p.cheek
    web = block((clear, p.web, p.rise), (0, p.web_y + p.web / 2, low))
    opening = RectangleRounded(*p.window, p.window_r)
    web -= extrude(Plane((0, p.web_y, p.window_z), x_dir=(1, 0, 0), z_dir=(0, 1, 0)) * opening, amount=p.web)
    tie = rod(p.tie, clear, (-clear / 2, p.tie_y, p.tie_z), RIGHT)
    return assembly(
        [
            named(base, "Base plate", "slategray"),
            named(cheeks[0], "Left cheek", "steelblue"),
            named(cheeks[1], "Right cheek", "steelblue"),
            named(web, "Rear web", "goldenrod"),
            named(tie, "Tie bar", "firebrick"),
            named(top, "Top plate", "lightgray"),
        ]
    )
