"""A ratchet wheel: slanted teeth, a hub in front with a keyed bore and a set screw, lightening holes, a balance hole."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians, sin

from build123d import Part, Plane, Polygon, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, LEFT, block, circle, cone, rod

MODEL = Model("Ratchet wheel", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is y, the wheel's rear lies on y = 0, the hub stands on its front; the keyway is above."""

    teeth: int = 20
    outer: float = 124
    root: float = 108
    thickness: float = 13
    hub: float = 42
    hub_height: float = 16
    bevel: float = 2  # at the hub's front rim
    bore: float = 20
    key: float = 6  # DIN 6885
    key_height: float = 2.8  # beyond the bore
    holes: int = 5
    hole: float = 21
    hole_circle: float = 76
    balance: float = 7
    balance_depth: float = 5
    balance_angle: float = 126  # degrees from x, on the holes' circle
    screw: float = 5  # core hole of M6, from the right

    @property
    def width(self) -> float:
        """Along the axis."""
        return self.thickness + self.hub_height

    @property
    def screw_y(self) -> float:
        """Middle of the hub's height."""
        return -self.thickness - self.hub_height / 2

    @property
    def balance_at(self) -> tuple[float, float]:
        """x and z."""
        a = radians(self.balance_angle)
        return self.hole_circle / 2 * cos(a), self.hole_circle / 2 * sin(a)


def build(p: P) -> Part:
    """Saw teeth, hub, then holes."""
    spots = []
    for n in range(p.teeth):
        a = 2 * pi * n / p.teeth
        spots += [(p.root / 2 * cos(a), p.root / 2 * sin(a)), (p.outer / 2 * cos(a), p.outer / 2 * sin(a))]
    face = (Plane.XZ * Polygon(*spots, align=None)).face()
    body = extrude(face, amount=p.thickness, dir=(0, -1, 0))
    body += rod(p.hub, p.hub_height - p.bevel, (0, -p.thickness, 0), FRONT)
    body += cone(p.hub, p.hub - 2 * p.bevel, p.bevel, (0, -p.width + p.bevel, 0), FRONT)
    body -= rod(p.bore, p.width, (0, -p.width, 0), BACK)
    body -= block((p.key, p.width, p.bore / 2 + p.key_height), (0, -p.width / 2, 0))
    for x, z in circle(p.holes, p.hole_circle, 90):
        body -= rod(p.hole, p.thickness, (x, -p.thickness, z), BACK)
    x, z = p.balance_at
    body -= rod(p.balance, p.balance_depth, (x, 0, z), FRONT)
    return body - rod(p.screw, p.hub / 2, (p.hub / 2, p.screw_y, 0), LEFT)
