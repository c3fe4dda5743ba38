"""Half of a moulded wire spool: disc with windows and a rim bead, drafted hub, centre tube, ribs, a wire slit."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Rot

from benchmark.kit import Model
from benchmark.shapes import block, circle, cone, rod

MODEL = Model("Spool half", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the disc's outer face lies on z = 0, the hub points up."""

    disc: float = 150
    disc_thickness: float = 3
    bead_width: float = 3  # of the rim bead, radially
    bead_height: float = 6  # from the disc's outer face
    hub: float = 64  # outside, where it leaves the disc
    hub_height: float = 30  # above the disc
    hub_inside: float = 56  # at the pocket's floor
    draft: float = 1.5  # degrees, inside and outside
    tube: float = 24
    bore: float = 16
    ribs: int = 6
    rib: float = 2
    rib_height: float = 24  # above the disc
    windows: int = 6
    window: float = 22
    window_circle: float = 108
    slit: float = 4  # wire slit, width
    slit_length: float = 16  # from the rim inwards


def build(p: P) -> Part:
    """Moulds disc, hub, tube and ribs."""
    t, h = p.disc_thickness, p.hub_height
    grow = 2 * h * math.tan(math.radians(p.draft))
    body = rod(p.disc, t)
    body += rod(p.disc, p.bead_height) - rod(p.disc - 2 * p.bead_width, p.bead_height)
    hub = cone(p.hub, p.hub - grow, h, (0, 0, t))
    hub -= cone(p.hub_inside, p.hub_inside + grow, h, (0, 0, t))
    body += hub
    body += rod(p.tube, h, (0, 0, t))
    reach = (p.hub_inside + p.hub) / 4
    for i in range(p.ribs):
        body += Rot(0, 0, 360 / p.ribs * i) * block((reach, p.rib, p.rib_height), (reach / 2, 0, t))
    body -= rod(p.bore, t + h)
    for x, y in circle(p.windows, p.window_circle):
        body -= rod(p.window, t, (x, y, 0))
    a = 180 / p.windows
    body -= Rot(0, 0, a) * block((p.slit_length, p.slit, p.bead_height), (p.disc / 2 - p.slit_length / 2, 0, 0))
    return body
