"""One half of a jaw coupling: a hub with bore and keyway, a thicker disc, three jaws on its face."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import GeomType, Part, Polygon, Pos, Rot, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import DOWN, UP, block, cone, drill, rod

MODEL = Model("Jaw coupling half", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the axis is z, the hub's end is z = 0, the jaws point up."""

    hub_d: float = 60  # of the slimmer part
    hub_l: float = 28
    disc_d: float = 80  # of the part that carries the jaws
    disc_l: float = 22
    jaws: int = 3
    jaw_h: float = 18
    jaw_id: float = 38  # circle that the jaws' inner faces lie on
    jaw_angle: float = 50  # width of a jaw, its flanks are radial
    bore: float = 28
    key_w: float = 8
    key_t: float = 31.3  # from the keyway's ground to the bore's opposite side
    lead_in: float = 1.5  # bevel of the bore at the hub's end, 45 degrees
    set_d: float = 6.8  # of the hole for the grub screw, over the keyway
    set_z: float = 14
    pull_d: float = 5  # of the two puller holes in the hub's end
    pull_pcd: float = 44
    pull_depth: float = 15
    round_r: float = 4  # of the corner between hub and disc


def build(p: P) -> Part:
    """Turns, mills between the jaws, broaches and drills."""
    top = p.hub_l + p.disc_l
    body = rod(p.hub_d, p.hub_l) + rod(p.disc_d, p.disc_l, (0, 0, p.hub_l))
    corner = [
        e
        for e in body.edges().filter_by(GeomType.CIRCLE)
        if abs(e.radius - p.hub_d / 2) < 1e-6 and abs(e.center().Z - p.hub_l) < 1e-6
    ]
    body = fillet(corner, p.round_r)
    ring = rod(p.disc_d, p.jaw_h, (0, 0, top)) - rod(p.jaw_id, p.jaw_h, (0, 0, top))
    half = math.radians(p.jaw_angle / 2)
    far = p.disc_d
    wedge = Polygon(
        (0, 0), (far * math.cos(half), -far * math.sin(half)), (far * math.cos(half), far * math.sin(half)), align=None
    )
    wedge = extrude(Pos(0, 0, top) * wedge, amount=p.jaw_h, dir=UP)
    for index in range(p.jaws):
        body += ring & (Rot(0, 0, 30 + 360 / p.jaws * index) * wedge)
    body -= rod(p.bore, top)
    body -= cone(p.bore + 2 * p.lead_in, p.bore, p.lead_in)
    reach = p.key_t - p.bore / 2
    body -= block((p.key_w, reach, top), (0, reach / 2, 0))
    body -= rod(p.set_d, p.hub_d / 2, (0, p.bore / 2, p.set_z), (0, 1, 0))
    for side in (-1, 1):
        body -= drill(p.pull_d, p.pull_depth, (side * p.pull_pcd / 2, 0, 0), UP)
    return body
