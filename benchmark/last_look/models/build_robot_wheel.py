"""A printed wheel of a small robot: rim with tyre groove, web with lightening holes, hub with D-bore and nut trap."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Model
from benchmark.shapes import RIGHT, block, circle, rod

MODEL = Model("Robot wheel", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axle is z, the rim stands on z = 0, the hub sticks out at the top, the D's flat looks to +x."""

    diameter: float = 72
    width: float = 18
    rim: float = 60  # inner diameter of the rim
    groove: float = 12  # width of the tyre's seat
    groove_depth: float = 2.5
    web: float = 4
    web_z: float = 5  # its underside
    hub: float = 19
    hub_length: float = 27  # from z = 0
    bore: float = 6.1
    flat: float = 2.4  # from the axis
    screw: float = 3.2  # radial, +x side only
    screw_z: float = 22.5
    trap: tuple[float, float] = (2.7, 5.7)  # slot for a square nut: along x, y
    trap_x: float = 5.6  # of its middle
    trap_floor: float = 19.5  # z
    windows: int = 5
    window: float = 13
    window_circle: float = 41
    disc_holes: int = 3  # for an encoder disc
    disc_hole: float = 2.2
    disc_circle: float = 25


def build(p: P) -> Part:
    """Turns rim, web and hub, then cuts."""
    body = rod(p.diameter, p.width) - rod(p.rim, p.width)
    seat = rod(p.diameter + 2, p.groove) - rod(p.diameter - 2 * p.groove_depth, p.groove)
    seat.position = (0, 0, (p.width - p.groove) / 2)
    body -= seat
    body += rod(p.rim + 1, p.web, (0, 0, p.web_z))
    body += rod(p.hub, p.hub_length)
    shaft = rod(p.bore, p.hub_length)
    shaft -= block((p.bore, p.bore, p.hub_length), (p.flat + p.bore / 2, 0, 0))
    body -= shaft
    for x, y in circle(p.windows, p.window_circle, 90):
        body -= rod(p.window, p.web, (x, y, p.web_z))
    for x, y in circle(p.disc_holes, p.disc_circle, 30):
        body -= rod(p.disc_hole, p.web, (x, y, p.web_z))
    body -= rod(p.screw, p.hub, (0, 0, p.screw_z), RIGHT)
    body -= block((*p.trap, p.hub_length), (p.trap_x, 0, p.trap_floor))
    return body
