"""A parts chute for a press: folded channel with outward flanges, a stop lip at the low end, drain holes, a window."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Plane, Pos, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, block, rod, slot

from benchmark.last_look.models.sheet_strip import strip

MODEL = Model("Parts chute", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the channel runs along x from 0, its floor's underside is z = 0, y = 0 is its middle."""

    sheet: float = 1.5
    bend: float = 2  # inside radius
    length: float = 300  # of the channel, without the lip
    inside: float = 120  # between the side walls
    height: float = 65  # over all, from the floor's underside to the flanges' top
    over_flanges: float = 166
    flange_corner: float = 6  # radius of the flanges' free corners
    lip: float = 26  # length of the lip's slope along the upper corner line
    lip_rise: float = 45  # degrees
    lip_run: float = 12  # flat piece ahead of the lip's bend
    lip_width: float = 100
    drain: float = 8
    drains: int = 5
    drain_pitch: float = 45
    drain_x: float = 60  # of the first
    slot_length: float = 16
    slot_width: float = 6.5
    slots: int = 3  # per flange
    slot_pitch: float = 110
    slot_y: float = 148  # between the two rows
    window: tuple[float, float] = (70, 26)  # in the wall on +y
    window_x: float = 90
    window_z: float = 33


def build(p: P) -> Part:
    """Folds the channel, adds the lip, punches."""
    t, half, out = p.sheet, p.inside / 2, p.over_flanges / 2
    z = p.height
    # the lower/outer side, walked so that the sheet lies to the left
    line = [(-out, z - t), (-half - t, z - t), (-half - t, 0), (half + t, 0), (half + t, z - t), (out, z - t)]
    body = extrude(Plane.YZ * strip(line, t, p.bend), amount=p.length)
    body = fillet(
        [e for e in body.edges().filter_by(Axis.Z) if abs(abs(e.center().Y) - out) < 0.01], p.flange_corner
    )
    a = math.radians(p.lip_rise)
    run = p.length + p.lip_run
    side = [(p.length - 1, 0), (run, 0), (run + p.lip * math.cos(a), p.lip * math.sin(a))]
    lip = extrude(Plane.XZ * strip(side, t, p.bend), amount=p.lip_width / 2, both=True)
    body += lip
    for i in range(p.drains):
        body -= rod(p.drain, t, (p.drain_x + i * p.drain_pitch, 0, 0))
    for i in range(p.slots):
        x = p.length / 2 + (i - (p.slots - 1) / 2) * p.slot_pitch
        for s in (-1, 1):
            body -= slot(p.slot_length, p.slot_width, t, (x, s * p.slot_y / 2, z))
    w, h = p.window
    body -= block((w, 4 * t, h), (p.window_x, half + t / 2, p.window_z - h / 2))
    return body
