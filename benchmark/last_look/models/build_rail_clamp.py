"""A guide rail clamp on a conveyor: block on a support rod, guide rail, clamping knob, washer, grub screw."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import BACK, LEFT, RIGHT, UP, assembly, block, circle, named, prism, rod
from build123d import Axis, Compound, chamfer, fillet

MODEL = Model("Guide rail clamp", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the rail runs along x, the support rod along y, the block's underside is z = 0, its middle x = y = 0."""

    size: tuple[float, float, float] = (52, 38, 72)
    round: float = 5  # upright edges
    rail: float = 12
    rail_length: float = 220
    rail_z: float = 18
    rail_bore: float = 12.4
    support: float = 16
    support_length: float = 130
    support_z: float = 44
    support_bore: float = 16.4
    support_end: float = 1.5  # chamfer on both ends of the rod
    slit: float = 3
    screw: float = 8  # M8 stud of the knob
    screw_z: float = 62
    clear: float = 8.5  # hole on the knob's side of the slit
    stud: float = 44
    knob: float = 36
    knob_length: float = 20
    knob_edge: float = 2  # rounding of the outer end
    lobes: int = 6
    lobe: float = 9  # diameter of the finger recesses
    washer: float = 18
    washer_hole: float = 8.4
    washer_thick: float = 1.6
    grub: float = 6  # M6, from below
    grub_length: float = 10
    socket: float = 3
    socket_depth: float = 4


def build(p: P) -> Compound:
    """The knob sits on the +x side of the block, the grub screw presses on the rail from below."""
    x, y, _ = p.size
    body = block(p.size)
    body = fillet(body.edges().filter_by(Axis.Z), p.round)
    body -= rod(p.rail_bore, x, (-x / 2, 0, p.rail_z), RIGHT)
    body -= rod(p.support_bore, y, (0, -y / 2, p.support_z), BACK)
    body -= block((p.slit, y, p.size[2]), (0, 0, p.support_z))
    body -= rod(p.clear, x / 2, (0, 0, p.screw_z), RIGHT)
    body -= rod(p.screw, x / 2, (0, 0, p.screw_z), LEFT)
    body -= rod(p.grub, p.rail_z)
    rail = rod(p.rail, p.rail_length, (-p.rail_length / 2, 0, p.rail_z), RIGHT)
    support = rod(p.support, p.support_length, (0, -p.support_length / 2, p.support_z), BACK)
    support = chamfer(support.edges().filter_by(lambda e: e.is_closed), p.support_end)
    at = x / 2
    washer = rod(p.washer, p.washer_thick, (at, 0, p.screw_z), RIGHT) - rod(
        p.washer_hole, p.washer_thick, (at, 0, p.screw_z), RIGHT
    )
    at += p.washer_thick
    head = rod(p.knob, p.knob_length, (at, 0, p.screw_z), RIGHT)
    for j, k in circle(p.lobes, p.knob):
        head -= rod(p.lobe, p.knob_length, (at, j, p.screw_z + k), RIGHT)
    head = fillet(head.faces().sort_by(Axis.X)[-1].edges(), p.knob_edge)
    knob = head + rod(p.screw, p.stud, (at, 0, p.screw_z), LEFT)
    low = p.rail_z - p.rail / 2 - p.grub_length
    grub = rod(p.grub, p.grub_length, (0, 0, low), UP) - prism(p.socket, p.socket_depth, (0, 0, low), UP)
    return assembly([
        named(body, "clamp_block", "dimgray"),
        named(rail, "guide_rail", "silver"),
        named(support, "support_rod", "lightsteelblue"),
        named(knob, "star_grip", "black"),
        named(washer, "washer", "gold"),
        named(grub, "grub_screw", "darkgray"),
    ])
