"""A toothed belt pulley for a 2 mm belt: hub with two grub screws, two flanges, recess in the free end."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import GeomType, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import circle, rod

MODEL = Model("Timing pulley", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the hub's free face z = 0, a grub screw lies towards +x."""

    teeth: int = 36
    pitch: float = 2
    drop: float = 0.254  # from the belt's pitch line to the tips
    groove: float = 0.555  # radius
    groove_depth: float = 0.75
    hub: float = 20
    hub_length: float = 7.5
    flange: float = 27
    flange_width: float = 1.2
    belt_width: float = 7.2  # between the flanges
    bore: float = 8
    bevel: float = 0.5  # both ends of the bore
    recess: float = 15
    recess_depth: float = 3
    grub: float = 2.5  # core hole of M3
    grub_z: float = 3.75

    @property
    def tip(self) -> float:
        """The diameter over the teeth."""
        return self.teeth * self.pitch / math.pi - 2 * self.drop

    @property
    def total(self) -> float:
        """The length over all."""
        return self.hub_length + 2 * self.flange_width + self.belt_width


def build(p: P) -> Part:
    """Turns the blank, cuts the grooves between the flanges, bores and drills."""
    low = p.hub_length + p.flange_width
    drum = rod(p.tip, p.belt_width, (0, 0, low))
    axes = circle(p.teeth, p.tip - 2 * p.groove_depth + 2 * p.groove)
    drum -= [rod(2 * p.groove, p.belt_width, (x, y, low)) for x, y in axes]
    body = rod(p.hub, p.hub_length)
    body += rod(p.flange, p.flange_width, (0, 0, p.hub_length))
    body += drum
    body += rod(p.flange, p.flange_width, (0, 0, low + p.belt_width))
    body -= rod(p.recess, p.recess_depth, (0, 0, p.total - p.recess_depth))
    body -= rod(p.bore, p.total)
    rims = [e for e in body.edges().filter_by(GeomType.CIRCLE) if abs(e.radius - p.bore / 2) < 1e-6]
    body = chamfer(rims, p.bevel)
    body -= rod(p.grub, p.hub, (0, 0, p.grub_z), (1, 0, 0))
    body -= rod(p.grub, p.hub, (0, 0, p.grub_z), (0, 1, 0))
    return body
