"""A small die set with two unequal pillars: lower and upper plate, guide pillars, flanged bushes, clamping shank."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, GeomType, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import assembly, block, cone, drill, grid, named, rod

MODEL = Model("Die set", "held_out", bodies=7)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the lower plate stands on z = 0, x = y = 0 is its middle; the pillars lie on the x axis."""

    lower: tuple[float, float, float] = (280, 160, 36)
    upper: tuple[float, float, float] = (280, 125, 30)
    corner: float = 10  # radius of both plates' upright edges
    open: float = 90  # between the plates
    pillar_dx: float = 210
    left: float = 24  # diameter of the left pillar, -x
    right: float = 25  # of the right one
    pillar_length: float = 150
    pillar_lift: float = 4  # of its lower end over the lower plate's underside
    pillar_bevel: float = 2  # 45 degrees, both ends
    play: float = 0.03  # of the pillars in their bushes, on diameter
    bush: float = 36  # outside diameter of the bushes
    bush_flange: float = 44
    bush_flange_thick: float = 6  # below the upper plate
    bush_length: float = 52  # over all
    shank: float = 32  # diameter
    shank_length: float = 55  # above the upper plate
    shank_thread: float = 24  # diameter of the shank's threaded spigot, full plate thickness
    shank_bevel: float = 3
    slug: tuple[float, float] = (70, 50)  # opening through the lower plate
    slug_corner: float = 8
    taps: float = 8.5  # core holes M10 from the lower plate's top
    tap_depth: float = 25
    tap_dx: float = 120
    tap_dy: float = 100
    slots: float = 14  # width of the clamping slots, open at the lower plate's short ends
    slot_depth: float = 22  # from the edge to the slot's round end


def build(p: P) -> Compound:
    """The plates, then what is pressed and screwed into them."""
    z1 = p.lower[2]
    z2 = z1 + p.open
    low = fillet(block(p.lower).edges().filter_by(Axis.Z), p.corner)
    up = fillet(block(p.upper, (0, 0, z2)).edges().filter_by(Axis.Z), p.corner)
    hole = fillet(block((*p.slug, z1)).edges().filter_by(Axis.Z), p.slug_corner)
    low -= hole
    for x, y in grid(2, 2, p.tap_dx, p.tap_dy):
        low -= drill(p.taps, p.tap_depth, (x, y, z1))
    for s in (-1, 1):
        for y in (-p.lower[1] / 2 + 30, p.lower[1] / 2 - 30):
            inner = p.lower[0] / 2 - p.slot_depth + p.slots / 2
            low -= rod(p.slots, z1, (s * inner, y, 0))
            long = p.slot_depth - p.slots / 2
            low -= block((long, p.slots, z1), (s * (p.lower[0] / 2 - long / 2), y, 0))
    parts = []
    for s, d, name in ((-1, p.left, "left"), (1, p.right, "right")):
        x = s * p.pillar_dx / 2
        low -= rod(d, z1, (x, 0, 0))
        pillar = rod(d, p.pillar_length, (x, 0, p.pillar_lift))
        pillar = chamfer(pillar.edges().filter_by(GeomType.CIRCLE), p.pillar_bevel)
        up -= rod(p.bush, p.upper[2], (x, 0, z2))
        start = z2 - p.bush_flange_thick
        bush = rod(p.bush, p.bush_length, (x, 0, start)) + rod(p.bush_flange, p.bush_flange_thick, (x, 0, start))
        bush -= rod(d + p.play, p.bush_length, (x, 0, start))
        parts += [named(pillar, f"pillar_{name}", "silver"), named(bush, f"bush_{name}", "goldenrod")]
    up -= rod(p.shank_thread, p.upper[2], (0, 0, z2))
    top = z2 + p.upper[2]
    b = p.shank_bevel
    shank = rod(p.shank_thread, p.upper[2], (0, 0, z2)) + rod(p.shank, p.shank_length - b, (0, 0, top))
    shank += cone(p.shank, p.shank - 2 * b, b, (0, 0, top + p.shank_length - b))
    return assembly(
        [named(low, "lower_plate", "steelblue"), named(up, "upper_plate", "lightsteelblue"), *parts, named(shank, "shank", "dimgray")]
    )
