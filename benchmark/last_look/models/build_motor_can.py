"""The deep-drawn can of a small d.c. motor: two flats, bearing hub, windows, crimping tabs and a locating notch."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Box, Part, Pos, fillet

from benchmark.kit import Model
from benchmark.shapes import ON_BASE, block, circle, rod

MODEL = Model("Motor can", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; axis z, the bottom's outside at z = 0, the hub below it, the mouth on top; flats look to +-y."""

    sheet: float = 1.2
    diameter: float = 38  # outside
    flats: float = 31  # outside, across
    height: float = 52  # bottom to rim, without tabs and hub
    corner: float = 3  # outside radius at the bottom
    hub: float = 14  # outside
    hub_height: float = 5
    bearing: float = 10  # bore of the hub, through
    screws: float = 26  # between the two, along x
    screw: float = 2.5
    vents: int = 4
    vent: float = 2.8
    vent_circle: float = 20
    windows: tuple[float, float] = (9, 14)  # width along y and height, one at each round side
    window_z: float = 20  # lower edge
    tab: tuple[float, float] = (5, 2.6)  # width and height of the crimping tabs
    tab_y: float = 18  # between the two tabs of a side, middles
    notch: tuple[float, float] = (4, 6)  # width and depth, in the rim of the front flat (low y)


def build(p: P) -> Part:
    """Draws the can, pierces it."""
    full = p.height + p.tab[1]
    outer = rod(p.diameter, full) & block((p.diameter, p.flats, full))
    outer = fillet(outer.edges().group_by(Axis.Z)[0], p.corner)
    t = p.sheet
    inner = rod(p.diameter - 2 * t, full, (0, 0, t)) & block((p.diameter, p.flats - 2 * t, full), (0, 0, t))
    inner = fillet(inner.edges().group_by(Axis.Z)[0], p.corner - t)
    body = outer - inner
    rim = block((p.diameter, p.diameter, p.tab[1] + 1), (0, 0, p.height))
    for side in (-1, 1):
        for up in (-1, 1):
            rim -= block(
                (p.diameter / 2, p.tab[0], p.tab[1] + 1), (side * p.diameter / 4, up * p.tab_y / 2, p.height)
            )
    body -= rim
    body += rod(p.hub, p.hub_height + t, (0, 0, -p.hub_height))
    body -= rod(p.bearing, p.hub_height + 2 * t, (0, 0, -p.hub_height))
    for side in (-1, 1):
        body -= rod(p.screw, t, (side * p.screws / 2, 0, 0))
        wide = p.diameter / 2
        body -= block((wide, *p.windows), (side * wide / 2, 0, p.window_z))
    for x, y in circle(p.vents, p.vent_circle, 45):
        body -= rod(p.vent, t, (x, y, 0))
    body -= Pos(0, -p.flats / 2, p.height - p.notch[1]) * Box(p.notch[0], 4 * t, p.notch[1], align=ON_BASE)
    return body
