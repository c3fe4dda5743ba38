"""A cryostat's radiation shield: thin can with a bolted flange, beam windows, vents, a wire slot, a threaded boss on top."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import GeomType, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, RIGHT, circle, rod, slot

MODEL = Model("Radiation shield", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the flange's underside is z = 0, the closed end is on top."""

    inside: float = 60
    wall: float = 1.5
    height: float = 110  # to the closed end's outer face, without the boss
    end: float = 2  # thickness of the closed end
    end_radius: float = 2  # round its outer edge
    flange: float = 84
    flange_thickness: float = 4
    root: float = 1.5  # fillet between flange and wall
    bolt: float = 3.4
    bolts: int = 8
    bolt_circle: float = 74
    bolt_start: float = 22.5  # degrees from x
    register: float = 66  # shallow counterbore in the underside
    register_depth: float = 1.5
    beam: float = 20  # the two windows on the x axis
    view: float = 12  # the window on +y
    window_z: float = 70
    wire_length: float = 14  # obround hole in the wall on -y
    wire_width: float = 6
    wire_z: float = 16
    vent: float = 3
    vents: int = 3
    vent_circle: float = 40
    boss: float = 12
    boss_height: float = 6
    tap: float = 3.3  # core hole of M4
    tap_depth: float = 7


def build(p: P) -> Part:
    """Turns the can and drills it."""
    outside = p.inside + 2 * p.wall
    t = p.flange_thickness
    body = rod(outside, p.height) + rod(p.flange, t)
    body = fillet(_ring(body, outside / 2, t), p.root)
    body = fillet(_ring(body, outside / 2, p.height), p.end_radius)
    body -= rod(p.inside, p.height - p.end)
    body -= rod(p.register, p.register_depth)
    body += rod(p.boss, p.boss_height, (0, 0, p.height))
    body -= rod(p.tap, p.tap_depth, (0, 0, p.height + p.boss_height), DOWN)
    for x, y in circle(p.bolts, p.bolt_circle, p.bolt_start):
        body -= rod(p.bolt, t, (x, y, 0))
    for x, y in circle(p.vents, p.vent_circle, 90):
        body -= rod(p.vent, p.end, (x, y, p.height), DOWN)
    body -= rod(p.beam, outside + 2, (-outside / 2 - 1, 0, p.window_z), RIGHT)
    body -= rod(p.view, outside / 2 + 1, (0, 0, p.window_z), BACK)
    return body - slot(p.wire_length, p.wire_width, outside / 2 + 1, (0, -outside / 2 - 1, p.wire_z), BACK)


def _ring(body: Part, radius: float, z: float) -> list:
    circles = body.edges().filter_by(GeomType.CIRCLE)
    return [e for e in circles if abs(e.radius - radius) < 0.01 and abs(e.center().Z - z) < 0.01]
