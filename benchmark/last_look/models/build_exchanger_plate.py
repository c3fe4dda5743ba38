"""A plate of a plate heat exchanger: four ports, two of them with sealing rims, chevron ribs, hanger notches, pips."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Polygon, Pos, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import UP, block, grid, rod, slot

MODEL = Model("Heat exchanger plate", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate lies on z = 0, its middle is x = y = 0, its length runs along y."""

    plate: tuple[float, float, float] = (120, 300, 1.5)
    corner: float = 15
    port: float = 32
    ports: tuple[float, float] = (76, 236)  # pattern
    rim: float = 42  # outer diameter of the sealing rims, on the left ports
    rim_bore: float = 36
    rim_height: float = 2
    ribs: int = 7
    rib: float = 4  # thickness along y
    rib_height: float = 2.5
    rib_half: float = 40  # from the middle to the tip along x
    rib_angle: float = 120  # between a chevron's arms
    rib_pitch: float = 20
    rib_first: float = -50  # y of the lower edge's apex
    notch: float = 14  # width
    notch_depth: float = 18
    pip: float = 6
    pip_height: float = 3
    pips: tuple[float, float] = (102, 120)

    @property
    def drop(self) -> float:
        """How far lies a chevron's tip behind its apex?"""
        return self.rib_half / math.tan(math.radians(self.rib_angle / 2))


def build(p: P) -> Part:
    """Cuts the sheet, then lays ribs, rims and pips on it."""
    x, y, top = p.plate
    body = block(p.plate)
    body = fillet(body.edges().filter_by(Axis.Z), p.corner)
    body -= [rod(p.port, top, (*at, 0)) for at in grid(2, 2, *p.ports)]
    for side in (-1, 1):
        body -= slot(2 * p.notch_depth, p.notch, top, (0, side * y / 2, 0), UP, rotation=90)
        at = (-p.ports[0] / 2, side * p.ports[1] / 2, top)
        body += rod(p.rim, p.rim_height, at) - rod(p.rim_bore, p.rim_height, at)
    outline = [
        (-p.rib_half, -p.drop),
        (0, 0),
        (p.rib_half, -p.drop),
        (p.rib_half, p.rib - p.drop),
        (0, p.rib),
        (-p.rib_half, p.rib - p.drop),
    ]
    rib = extrude(Polygon(*outline, align=None), amount=p.rib_height, dir=UP)
    for index in range(p.ribs):
        body += Pos(0, p.rib_first + index * p.rib_pitch, top) * rib
    body += [rod(p.pip, p.pip_height, (*at, top)) for at in grid(2, 2, *p.pips)]
    return body
