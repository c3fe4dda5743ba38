"""The rod-end cap of a pneumatic tie-rod cylinder, drawn in inches."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import INCH, Model
from benchmark.shapes import FRONT, LEFT, block, drill, grid, rod

MODEL = Model("Tie rod cap", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Inches; the outer face lies on z = 0, the pilot that enters the tube points up, the port is at the back."""

    square: float = 3.0
    thickness: float = 1.25
    bevel: float = 0.125  # of the four upright edges
    tie: float = 0.406  # tie-rod holes
    tie_pitch: float = 2.3
    pilot: float = 2.0
    pilot_height: float = 0.375
    groove: float = 0.125  # width of the O-ring groove on the pilot
    groove_depth: float = 0.1  # radial
    groove_z: float = 0.1875  # of its middle above the block
    bore: float = 1.0  # for the rod
    gland: float = 1.375  # counterbore for the rod seal, in the outer face
    gland_depth: float = 0.5
    port: float = 0.578  # tap drill 3/8 NPT
    port_depth: float = 0.75  # of the full diameter
    port_z: float = 0.8
    passage: float = 0.25  # from the pilot's face into the port
    passage_y: float = 0.72
    needle: float = 0.213  # tap drill 1/4-28, cushion needle, from the right
    needle_depth: float = 0.625  # of the full diameter


def build(p: P) -> Part:
    """Mills the block, turns the pilot, drills; inches become millimetres at the end of each dimension."""
    i = INCH
    s, t = p.square * i, p.thickness * i
    body = block((s, s, t))
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel * i)
    body += rod(p.pilot * i, p.pilot_height * i, (0, 0, t))
    low = t + (p.groove_z - p.groove / 2) * i
    body -= rod((p.pilot + 1) * i, p.groove * i, (0, 0, low)) - rod(
        (p.pilot - 2 * p.groove_depth) * i, p.groove * i, (0, 0, low)
    )
    for x, y in grid(2, 2, p.tie_pitch * i, p.tie_pitch * i):
        body -= rod(p.tie * i, t, (x, y, 0))
    body -= rod(p.bore * i, t + p.pilot_height * i)
    body -= rod(p.gland * i, p.gland_depth * i)
    body -= drill(p.port * i, p.port_depth * i, (0, s / 2, p.port_z * i), FRONT)
    depth = (p.thickness + p.pilot_height - p.port_z) * i
    body -= rod(p.passage * i, depth, (0, p.passage_y * i, p.port_z * i))
    body -= drill(p.needle * i, p.needle_depth * i, (s / 2, 0, p.port_z * i), LEFT)
    return body
