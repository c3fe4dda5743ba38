"""A shell mill arbor with a side-lock shank: two clamping flats, collar with spanner flats, two driving lugs, pilot."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, block, cone, drill, rod

MODEL = Model("Shell mill arbor", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the shank begins at x = 0, the pilot points to +x."""

    shank: float = 25
    shank_length: float = 56
    shank_bevel: float = 2
    flat: float = 12  # length of a clamping flat along the axis
    flat_depth: float = 2  # below the shank's surface
    flats_x: tuple[float, float] = (18, 37)  # their middles from the shank's end
    collar: float = 50
    collar_length: float = 21
    wrench: float = 46  # across the collar's two flats (y)
    pilot: float = 22
    pilot_length: float = 19
    pilot_bevel: float = 1.5
    undercut: float = 20.6  # diameter, at the pilot's root
    undercut_width: float = 2.5
    lug: float = 10  # width of the driving lugs (along y)
    lug_height: float = 5  # above the collar's face
    lug_inner: float = 30  # diameter at which the lugs begin
    coolant: float = 5  # bore through all
    tap: float = 8.5  # core of M10 in the pilot's end
    tap_depth: float = 27
    balance: float = 7  # holes in the collar's rim
    balance_depth: float = 6
    balance_angle: float = 40  # between the two, about -z


def build(p: P) -> Part:
    """Turns along x, then mills the flats and the lugs."""
    face = p.shank_length + p.collar_length
    end = face + p.pilot_length
    body = rod(p.shank, p.shank_length - p.shank_bevel, (p.shank_bevel, 0, 0), RIGHT)
    body += cone(p.shank - 2 * p.shank_bevel, p.shank, p.shank_bevel, (0, 0, 0), RIGHT)
    body += rod(p.collar, p.collar_length, (p.shank_length, 0, 0), RIGHT)
    ring = rod(p.collar, p.lug_height, (face, 0, 0), RIGHT) - rod(p.lug_inner, p.lug_height, (face, 0, 0), RIGHT)
    body += ring & block((2 * p.lug_height, p.lug, 2 * p.collar), (face, 0, -p.collar))
    for side in (-1, 1):
        cut = (p.collar - p.wrench) / 2
        body -= block(
            (p.collar_length, cut, p.collar),
            (p.shank_length + p.collar_length / 2, side * (p.wrench + cut) / 2, -p.collar / 2),
        )
    body += rod(p.undercut, p.undercut_width, (face, 0, 0), RIGHT)
    body += rod(p.pilot, p.pilot_length - p.undercut_width - p.pilot_bevel, (face + p.undercut_width, 0, 0), RIGHT)
    body += cone(p.pilot, p.pilot - 2 * p.pilot_bevel, p.pilot_bevel, (end - p.pilot_bevel, 0, 0), RIGHT)
    for x in p.flats_x:
        body -= block((p.flat, p.shank, p.flat_depth), (x, 0, p.shank / 2 - p.flat_depth))
    body -= rod(p.coolant, end, (0, 0, 0), RIGHT)
    body -= drill(p.tap, p.tap_depth, (end, 0, 0), LEFT)
    for side in (-1, 1):
        a = math.radians(-90 + side * p.balance_angle / 2)
        out = (0.0, math.cos(a), math.sin(a))
        start = (p.shank_length + p.collar_length / 2, *(c * (p.collar / 2 - p.balance_depth) for c in out[1:]))
        body -= rod(p.balance, 2 * p.balance_depth, start, out)
    return body
