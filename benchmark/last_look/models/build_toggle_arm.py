"""A clamp lever for a shaft: split hub with clamping screw, arm with pockets in both sides, forked end with pin bore."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, chamfer, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, block, rod, slot

MODEL = Model("Split-hub toggle arm", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the hub's axis is x through the origin, the arm stands up along +z, both symmetrical to x = 0."""

    hub: float = 48
    hub_width: float = 32  # along x
    bore: float = 25
    centres: float = 130  # from the hub's bore to the fork's pin bore
    arm: float = 16  # thickness along x
    root: float = 36  # width of the arm at the hub's axis
    eye: float = 26  # round end, diameter
    eye_width: float = 28  # thickness of the fork along x
    eye_block: float = 40  # the fork's thick part reaches that far below the pin's axis
    gap: float = 12  # the fork's slot
    gap_depth: float = 38  # from the fork's tip
    pin: float = 10
    pocket: tuple[float, float, float] = (40, 14, 4.5)  # length, width, depth; round ends, both sides of the arm
    pocket_at: float = 56  # of its middle over the hub's axis
    ears: tuple[float, float] = (22, 17)  # clamping lugs below the hub: width along y, reach below the hub's bottom
    slit: float = 3
    clamp: float = 9  # clear hole of M8 in the lug at +y
    clamp_tap: float = 6.8  # in the lug at -y
    clamp_at: float = 30.5  # below the hub's axis
    sink: float = 14
    sink_depth: float = 4
    key: tuple[float, float] = (8, 3.3)  # keyway at the bore's upper side: width, depth
    bevel: float = 1  # at both mouths of the hub's bore
    round: float = 3  # between arm and fork, and at the lower corners of the lugs


def build(p: P) -> Part:
    """Models the flat shape in the plane y-z, thickens it along x, then bores and mills."""
    top = p.centres
    side = Plane.YZ
    outline = Polygon(
        (-p.root / 2, 0), (p.root / 2, 0), (p.eye / 2, top - p.eye_block), (p.eye / 2, top), (-p.eye / 2, top),
        (-p.eye / 2, top - p.eye_block), align=None,
    )
    body = extrude(side * outline, amount=p.arm / 2, both=True)
    eye = block((p.eye_width, p.eye, p.eye_block), (0, 0, top - p.eye_block))
    body += eye
    body += rod(p.eye, p.eye_width, (-p.eye_width / 2, 0, top), (1, 0, 0))
    body += rod(p.hub, p.hub_width, (-p.hub_width / 2, 0, 0), (1, 0, 0))
    low = p.hub / 2 + p.ears[1]
    body += block((p.hub_width, p.ears[0], low), (0, 0, -low))
    r, step = p.round, top - p.eye_block
    for sign in (-1, 1):
        fill = block((r, p.eye, r), (sign * (p.arm / 2 + r / 2), 0, step - r))
        body += fill - rod(2 * r, p.eye, (sign * (p.arm / 2 + r), -p.eye / 2, step - r), BACK)
    corners = body.edges().filter_by(Axis.X).group_by(Axis.Z)[0]
    body = fillet(corners, p.round)
    body -= rod(p.bore, p.hub_width, (-p.hub_width / 2, 0, 0), (1, 0, 0))
    mouths = body.edges().filter_by(lambda e: e.geom_type.name == "CIRCLE" and abs(e.radius - p.bore / 2) < 0.01)
    body = chamfer(mouths, p.bevel)
    body -= block((p.hub_width, p.key[0], p.key[1] + p.bore / 2), (0, 0, 0))
    body -= block((p.hub_width, p.slit, low), (0, 0, -low))
    body -= rod(p.clamp, p.ears[0] / 2, (0, 0, -p.clamp_at), BACK)
    body -= rod(p.clamp_tap, p.ears[0] / 2, (0, 0, -p.clamp_at), FRONT)
    body -= rod(p.sink, p.sink_depth, (0, p.ears[0] / 2, -p.clamp_at), FRONT)
    tip = top + p.eye / 2
    body -= block((p.gap, p.eye, p.gap_depth), (0, 0, tip - p.gap_depth))
    body -= rod(p.pin, p.eye_width, (-p.eye_width / 2, 0, top), (1, 0, 0))
    for x, into in ((p.arm / 2, (-1, 0, 0)), (-p.arm / 2, (1, 0, 0))):
        body -= slot(p.pocket[0], p.pocket[1], p.pocket[2], (x, 0, p.pocket_at), into, 90)
    return body
