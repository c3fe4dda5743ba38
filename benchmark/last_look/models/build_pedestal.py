"""A cast bearing pedestal: slotted foot, neck with ribs, barrel with the bearing's seat, lubrication boss."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, block, circle, drill, rod, slot

MODEL = Model("Bearing pedestal", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot stands on z = 0; the shaft runs along y, the bearing goes in from the front (-y)."""

    foot: tuple[float, float, float] = (260, 76, 24)
    foot_r: float = 12  # of its upright corners
    foot_slot: tuple[float, float] = (32, 18)
    foot_pitch: float = 200
    dowel_d: float = 8  # two holes through the foot, on a diagonal
    dowel: tuple[float, float] = (70, 26)
    centre: float = 95  # shaft height
    barrel_d: float = 130
    barrel_l: float = 64
    seat_d: float = 90
    seat_depth: float = 40
    shoulder_d: float = 76  # bore behind the seat
    ring_d: float = 94  # groove for the retaining ring
    ring_w: float = 3.2
    ring_edge: float = 5  # from the front to the groove
    neck: tuple[float, float] = (110, 50)
    rib: float = 14  # thickness
    rib_foot: float = 80  # from the middle to the rib's end on the foot
    rib_top: float = 80  # height where the rib's slope ends, at the neck's side
    boss_d: float = 22
    boss_top: float = 168
    grease_d: float = 8.5
    grease_y: float = -8
    cover_d: float = 6.8  # core hole of M8
    covers: int = 4
    cover_pcd: float = 110
    cover_depth: float = 18


def build(p: P) -> Part:
    """Casts, then machines."""
    half = p.barrel_l / 2
    body = block(p.foot)
    body = fillet(body.edges().filter_by(Axis.Z), p.foot_r)
    body += block((p.neck[0], p.neck[1], p.centre - p.foot[2] + 1), (0, 0, p.foot[2] - 1))
    for side in (-1, 1):
        web = Polygon(
            (side * (p.neck[0] / 2 - 2), p.foot[2] - 1),
            (side * p.rib_foot, p.foot[2] - 1),
            (side * p.rib_foot, p.foot[2]),
            (side * p.neck[0] / 2, p.rib_top),
            (side * (p.neck[0] / 2 - 2), p.rib_top),
            align=None,
        )
        body += extrude(Plane.XZ * web, amount=p.rib / 2, both=True)
    body += rod(p.barrel_d, p.barrel_l, (0, -half, p.centre), BACK)
    body += rod(p.boss_d, p.boss_top - p.centre, (0, p.grease_y, p.centre))
    body -= rod(p.seat_d, p.seat_depth, (0, -half, p.centre), BACK)
    body -= rod(p.shoulder_d, p.barrel_l, (0, -half, p.centre), BACK)
    body -= rod(p.ring_d, p.ring_w, (0, -half + p.ring_edge, p.centre), BACK)
    body -= rod(p.grease_d, p.boss_top - p.centre, (0, p.grease_y, p.centre))
    for x, z in circle(p.covers, p.cover_pcd, 45, (0, p.centre)):
        body -= drill(p.cover_d, p.cover_depth, (x, -half, z), BACK)
    for side in (-1, 1):
        body -= slot(*p.foot_slot, p.foot[2], (side * p.foot_pitch / 2, 0, p.foot[2]), DOWN)
        body -= rod(p.dowel_d, p.foot[2], (side * p.dowel[0], side * p.dowel[1], 0))
    return body
