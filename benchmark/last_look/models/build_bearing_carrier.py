"""A cast bearing carrier in inches: flange with pilot, drafted hub with four ribs, bearing seat, seal bore, jacking holes."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Plane, Polygon, Pos, Rot, extrude

from benchmark.kit import INCH, Model
from benchmark.shapes import circle, cone, rod

MODEL = Model("Bearing carrier", "held_out", unit="in")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the flange's mounting face z = 0, the pilot lies below, the hub above."""

    flange: float = 6.5 * INCH
    flange_thick: float = 0.625 * INCH
    pilot: float = 4 * INCH
    pilot_length: float = 0.1875 * INCH
    hub: float = 4.25 * INCH  # diameter where it leaves the flange
    hub_height: float = 2.5 * INCH  # of its top over the mounting face
    draft: float = 3  # degrees, of the hub's outside
    seat: float = 72  # bearing seat for a 6207, from the pilot's end
    seat_depth: float = 1.125 * INCH  # from the pilot's end face
    bore: float = 1.75 * INCH  # clearance bore beyond the seat's shoulder
    seal: float = 2.25 * INCH  # seal bore from the hub's top
    seal_depth: float = 0.5 * INCH
    bolts: int = 6
    bolt: float = 0.406 * INCH
    bolt_circle: float = 5.5 * INCH
    face: float = 0.875 * INCH  # spot faces about the bolt holes
    face_depth: float = 0.0625 * INCH
    jacks: int = 2
    jack: float = 0.3125 * INCH  # core hole of 3/8-16
    ribs: int = 4
    rib: float = 0.375 * INCH  # thickness
    rib_foot: float = 6 * INCH  # diameter on which the ribs end on the flange
    rib_top: float = 2 * INCH  # height over the mounting face at which they meet the hub
    grease: float = 0.339 * INCH  # core hole of 1/8 NPT, radial from +x
    grease_z: float = 1.5 * INCH


def build(p: P) -> Part:
    """Casts the shape, then machines it."""
    rise = p.hub_height - p.flange_thick
    top = p.hub - 2 * rise * math.tan(math.radians(p.draft))
    body = rod(p.flange, p.flange_thick) + rod(p.pilot, p.pilot_length, (0, 0, -p.pilot_length))
    body += cone(p.hub, top, rise, (0, 0, p.flange_thick))
    at_top = p.hub / 2 - (p.rib_top - p.flange_thick) * math.tan(math.radians(p.draft))
    inside = at_top - 0.15 * INCH  # the rib's slope runs on into the hub
    above = p.rib_top + 0.15 * INCH * (p.rib_top - p.flange_thick) / (p.rib_foot / 2 - at_top)
    side = Polygon(
        (inside, p.flange_thick / 2), (p.rib_foot / 2, p.flange_thick / 2), (p.rib_foot / 2, p.flange_thick),
        (inside, above), align=None,
    )
    rib = extrude(Plane.XZ * side, amount=p.rib / 2, both=True)
    for a in (90, 150, 270, 330):
        body += Rot(0, 0, a) * rib
    for x, y in circle(p.bolts, p.bolt_circle):
        body -= rod(p.bolt, p.flange_thick, (x, y, 0))
        body -= rod(p.face, p.flange_thick, (x, y, p.flange_thick - p.face_depth))
    for x, y in circle(p.jacks, p.bolt_circle, 30):
        body -= rod(p.jack, p.flange_thick, (x, y, 0))
    low = -p.pilot_length
    body -= rod(p.bore, p.hub_height - low, (0, 0, low))
    body -= rod(p.seat, p.seat_depth, (0, 0, low))
    body -= rod(p.seal, p.seal_depth, (0, 0, p.hub_height - p.seal_depth))
    body -= Pos(0, 0, p.grease_z) * rod(p.grease, p.hub, (0, 0, 0), (1, 0, 0))
    return body
