"""A spacer kit: tray with five pockets, three round spacers, a hex standoff and a flanged bush."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part, Pos, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import UP, assembly, drill, named, prism, rod, slot

MODEL = Model("Spacer kit", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the tray's underside is z = 0, the pockets lie in a row along x."""

    tray: tuple[float, float, float] = (104, 28, 9)
    tray_corner: float = 4
    pitch: float = 19  # between the pockets
    pocket: float = 9  # diameter of four of them
    bush_pocket: float = 14.5  # of the last, +x
    pocket_depth: float = 5
    finger: tuple[float, float, float] = (96, 4, 2)  # groove along the row: length over all, width, depth
    tray_hole: float = 3.5  # two, through, in opposite corners
    tray_inset: float = 5.5  # of them, from both edges
    outside: float = 7  # of the round spacers
    inside: float = 3.3
    lengths: tuple[float, float, float] = (10, 15, 20)
    flats: float = 5.5  # across, of the standoff
    standoff: float = 25
    tap: float = 2.5  # core hole of M3, both ends
    tap_depth: float = 8
    flange: float = 14
    flange_height: float = 2
    neck: float = 8
    bush: float = 12  # length over all
    bush_bore: float = 5.1


def build(p: P) -> Compound:
    """Sets the pieces upright into the tray's pockets."""
    tray: Part = extrude(RectangleRounded(p.tray[0], p.tray[1], p.tray_corner), amount=p.tray[2])
    floor = p.tray[2] - p.pocket_depth
    xs = [(index - 2) * p.pitch for index in range(5)]
    for index, x in enumerate(xs):
        tray -= rod(p.bush_pocket if index == 4 else p.pocket, p.pocket_depth, (x, 0, floor))
    tray -= slot(p.finger[0], p.finger[1], p.finger[2], (0, 0, p.tray[2]))
    for side in (-1, 1):
        spot = (side * (p.tray[0] / 2 - p.tray_inset), side * (p.tray[1] / 2 - p.tray_inset), 0)
        tray -= rod(p.tray_hole, p.tray[2], spot)
    bodies = [named(tray, "tray", "dimgray")]
    for x, long in zip(xs[:3], p.lengths, strict=True):
        spacer = rod(p.outside, long) - rod(p.inside, long)
        bodies.append(named(spacer, f"spacer {long:g}", "white", Pos(x, 0, floor)))
    hexagon = prism(p.flats, p.standoff)
    hexagon -= drill(p.tap, p.tap_depth, (0, 0, p.standoff))
    hexagon -= drill(p.tap, p.tap_depth, (0, 0, 0), UP)
    bodies.append(named(hexagon, "hex standoff", "goldenrod", Pos(xs[3], 0, floor)))
    bush = rod(p.flange, p.flange_height) + rod(p.neck, p.bush) - rod(p.bush_bore, p.bush)
    bodies.append(named(bush, "flanged bush", "black", Pos(xs[4], 0, floor)))
    return assembly(bodies)
