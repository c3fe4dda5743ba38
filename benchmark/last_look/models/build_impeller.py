"""A semi-open pump impeller, cast: disc, hub, curved vanes in front, a ring and straight vanes behind."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, Pos, Rot, revolve

from benchmark.kit import Model
from benchmark.shapes import DOWN, block, circle, rod

MODEL = Model("Pump impeller", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the disc's back is z = 0, the pump's suction side is up."""

    outer_d: float = 210
    disc: float = 6  # thickness
    hub_d: float = 56
    hub_top: float = 44  # above the disc's back
    bore: float = 30
    key_w: float = 8
    key_t: float = 33.3  # over bore and keyway
    nut_d: float = 42  # recess for the nut in the hub's top
    nut_depth: float = 6
    vanes: int = 5
    vane: float = 5  # thickness
    vane_r: float = 75  # radius of the middle of its curve
    vane_c: float = 60  # from the axis to the curve's centre
    eye_d: float = 88  # circle where the vanes begin
    vane_in: float = 36  # height of the vanes' front edge above the disc's back, at the eye
    vane_out: float = 24  # and at the rim
    holes: int = 5
    hole_d: float = 8
    hole_pcd: float = 72
    ring_od: float = 100
    ring_id: float = 84
    ring_h: float = 8
    back_vanes: int = 8
    back_w: float = 5
    back_h: float = 3
    back_from: float = 112  # diameter where the back vanes begin
    back_to: float = 204  # and end


def build(p: P) -> Part:
    """Disc first, then what stands on it."""
    r0, r1 = p.eye_d / 2, p.outer_d / 2
    body = rod(p.outer_d, p.disc)
    body += rod(p.hub_d, p.hub_top - p.disc / 2, (0, 0, p.disc / 2))
    profile = Plane.XZ * Polygon(
        (r0, p.disc / 2), (r1, p.disc / 2), (r1, p.vane_out), (r0, p.vane_in), align=None
    )
    sweep = revolve(profile, Axis.Z)
    shell = rod(2 * p.vane_r + p.vane, p.vane_in, (p.vane_c, 0, 0)) - rod(
        2 * p.vane_r - p.vane, p.vane_in, (p.vane_c, 0, 0)
    )
    half = block((4 * r1, 2 * r1, p.vane_in), (0, r1, 0))
    vane = sweep & shell & half
    for index in range(p.vanes):
        body += Rot(0, 0, 360 / p.vanes * index) * vane
    body += rod(p.ring_od, p.ring_h, (0, 0, 0), DOWN) - rod(p.ring_id, p.ring_h, (0, 0, 0), DOWN)
    long = (p.back_to - p.back_from) / 2
    blade = block((long, p.back_w, p.back_h), (p.back_from / 2 + long / 2, 0, -p.back_h))
    for index in range(p.back_vanes):
        body += Rot(0, 0, 360 / p.back_vanes * index) * blade
    body -= rod(p.bore, p.hub_top)
    reach = p.key_t - p.bore / 2
    body -= block((p.key_w, reach, p.hub_top), (0, reach / 2, 0))
    body -= rod(p.nut_d, p.nut_depth, (0, 0, p.hub_top), DOWN)
    for x, y in circle(p.holes, p.hole_pcd):
        body -= rod(p.hole_d, p.disc, (x, y, 0))
    return body
