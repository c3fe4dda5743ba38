"""One half of a forged split flange for a 1 inch hose flange: hub with stepped half bore, two ears with spot-faced holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import INCH, Model
from benchmark.shapes import block, cone, rod

MODEL = Model("Split flange half", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Inches; the axis of the hose flange is z, the sealing side is z = 0, the split face is y = 0, the half lies at y > 0."""

    length: float = 2.75  # over both ears, along x
    depth: float = 1.125  # from the split face to the outermost of the ears' block
    ear: float = 0.625  # thickness of the ears
    height: float = 1.0  # of the hub, over all
    hub: float = 2.25  # diameter of the hub at the ears' top
    hub_draft: float = 0.0625  # how much smaller the hub's radius is on top
    bore: float = 1.53125  # for the hose shank
    recess: float = 1.78125  # for the flange head
    recess_depth: float = 0.3125
    hole: float = 0.40625  # for 3/8 bolts
    holes_x: float = 2.0625  # between the two
    hole_y: float = 0.515625  # from the split face
    spot: float = 0.75  # diameter of the spot face
    spot_depth: float = 0.0625
    corner: float = 0.4375  # radius of the two outer upright corners


def build(p: P) -> Part:
    """Forges and machines it; millimetres inside."""
    i = INCH
    ears = block((p.length * i, p.depth * i, p.ear * i), (0, p.depth * i / 2, 0))
    ears = fillet(ears.edges().filter_by(Axis.Z).sort_by(Axis.Y)[-2:], p.corner * i)
    half = block((4 * i, 2 * i, 2 * i), (0, i, 0))
    hub = cone(p.hub * i, (p.hub - 2 * p.hub_draft) * i, (p.height - p.ear) * i, (0, 0, p.ear * i))
    body = ears + (hub & half)
    for side in (-1, 1):
        at = (side * p.holes_x * i / 2, p.hole_y * i)
        body -= rod(p.spot * i, i, (*at, (p.ear - p.spot_depth) * i))
        body -= rod(p.hole * i, p.ear * i, (*at, 0))
    body -= rod(p.bore * i, p.height * i)
    body -= rod(p.recess * i, p.recess_depth * i)
    return body
