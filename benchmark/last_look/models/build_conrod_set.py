"""A connecting rod with its cap, bolted: forged I-shank, parted big end, bushed small end."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, Plane, Polygon, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, UP, assembly, block, named, prism, rod

MODEL = Model("Connecting rod", "held_out", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; bores along y, the big end's axis at x = z = 0, parted at z = 0, the small end up (high z)."""

    centres: float = 150  # big to small bore
    big_bore: float = 50
    big: float = 70  # outside of the big end
    big_width: float = 26  # along y
    shoulder: tuple[float, float] = (96, 44)  # bolt shoulders: along x, and along z over both halves
    small: float = 38  # outside of the small end
    small_bore: float = 26  # takes the bushing
    small_width: float = 22
    bushing: float = 22  # its bore
    shank: tuple[float, float] = (32, 24)  # width along x at the big end and at the small end
    shank_thick: float = 16  # along y
    web: float = 6  # thickness left between the two flutes
    rail: float = 5  # flange of the I, along x
    flute: tuple[float, float] = (46, 118)  # z from, to
    screws: float = 76  # between the axes
    screw: float = 9
    screw_length: float = 42  # below the head
    head: float = 14
    head_height: float = 9
    key: float = 7  # hexagon socket
    key_depth: float = 5
    oil: float = 4  # hole from the small end's top into the bushing


def build(p: P) -> Compound:
    """Forges the rod, parts the cap, puts bushing and screws in."""
    def ring(diameter: float, width: float, z: float) -> Part:
        return rod(diameter, width, (0, -width / 2, z), BACK)

    end = ring(p.big, p.big_width, 0)
    sx, sz = p.shoulder
    ears = block((sx, p.big_width, sz), (0, 0, -sz / 2))
    ears = fillet(ears.edges().filter_by(Axis.Y), 4)
    end += ears
    half = 200
    upper = block((half, half, half), (0, 0, 0))
    lower = block((half, half, half), (0, 0, -half))
    body = end & upper
    a, b = p.shank
    side = Plane.XZ.offset(-p.shank_thick / 2) * Polygon(
        (-a / 2, 10), (a / 2, 10), (b / 2, p.centres), (-b / 2, p.centres), align=None
    )
    body += extrude(side, amount=p.shank_thick)
    body += ring(p.small, p.small_width, p.centres)
    lo, hi = p.flute

    def wide(z: float) -> float:
        return (a + (b - a) * (z - 10) / (p.centres - 10)) / 2 - p.rail

    flute = Polygon((-wide(lo), lo), (wide(lo), lo), (wide(hi), hi), (-wide(hi), hi), align=None)
    deep = (p.shank_thick - p.web) / 2
    pocket = extrude(Plane.XZ.offset(p.web / 2) * flute, amount=deep)
    pocket = fillet(pocket.edges().filter_by(Axis.Y), 3)
    body -= pocket
    pocket = extrude(Plane.XZ.offset(-p.shank_thick / 2) * flute, amount=deep)
    pocket = fillet(pocket.edges().filter_by(Axis.Y), 3)
    body -= pocket
    body -= ring(p.big_bore, p.big_width, 0)
    body -= ring(p.small_bore, p.small_width, p.centres)
    body -= rod(p.oil, p.small, (0, 0, p.centres))
    cap = end & lower
    cap -= ring(p.big_bore, p.big_width, 0)
    bush = ring(p.small_bore, p.small_width, p.centres) - ring(p.bushing, p.small_width, p.centres)
    bush -= rod(p.oil, p.small, (0, 0, p.centres))
    screws = []
    for s, word in ((-1, "left"), (1, "right")):
        at = s * p.screws / 2
        body -= rod(p.screw, sz / 2, (at, 0, 0))
        cap -= rod(p.screw, sz, (at, 0, 0), DOWN)
        bolt = rod(p.screw, p.screw_length, (at, 0, -sz / 2))
        bolt += rod(p.head, p.head_height, (at, 0, -sz / 2), DOWN)
        bolt -= prism(p.key, p.key_depth, (at, 0, -sz / 2 - p.head_height), UP)
        screws.append(named(bolt, f"screw {word}", "dimgray"))
    return assembly(
        [named(body, "rod", "silver"), named(cap, "cap", "lightsteelblue"), named(bush, "bushing", "goldenrod"), *screws]
    )
