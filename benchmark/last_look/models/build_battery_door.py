"""A moulded battery door: thin plate with a drafted skirt, two hinge tongues, a snap arm, ribs, bosses, grip bars."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Plane, Polygon, Pos, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import DOWN, block, rod

MODEL = Model("Battery door", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the outside face is z = 0, everything inside points to -z; the tongues point to -x."""

    length: float = 96
    width: float = 58
    plate: float = 2
    corner: float = 6  # radius of the plate's corners
    inset: float = 3  # of the skirt from the plate's outline
    skirt: float = 7  # height of the skirt below the plate's inside
    wall: float = 1.6  # of the skirt at its root
    draft: float = 2  # degrees, the skirt's outside leans inward
    tongues: int = 2
    tongue: tuple[float, float, float] = (11, 10, 1.8)  # along x from the skirt's root, width, thickness
    tongue_dy: float = 32
    tongue_z: float = -5  # of its upper side
    ribs: int = 3  # along y, between the skirt's long walls
    rib: float = 1.2
    rib_height: float = 4  # below the plate's inside
    rib_pitch: float = 22
    bosses: int = 4
    boss: float = 6
    boss_height: float = 6  # below the plate's inside
    pilot: float = 2.5  # blind, from the boss's end
    pilot_depth: float = 5
    boss_dx: float = 66
    boss_dy: float = 34
    bars: int = 5  # grip bars on the outside
    bar: tuple[float, float, float] = (1.5, 24, 0.8)  # along x, along y, height
    bar_pitch: float = 4
    bar_x: float = 30  # of the middle one
    snap: float = 14  # width of the snap arm
    snap_thick: float = 1.5
    snap_length: float = 12  # below the plate's inside
    snap_x: float = 46.5  # of its outer side
    hook: float = 1.2  # how far the hook reaches out
    hook_lead: float = 35  # degrees of the hook's lead-in from the arm's direction
    gap: float = 2  # slots in the skirt on both sides of the arm


def build(p: P) -> Part:
    """Plate, skirt, then everything on and below it."""
    low = -p.plate
    body = extrude(RectangleRounded(p.length, p.width, p.corner), amount=-p.plate)
    a, b, r = p.length - 2 * p.inset, p.width - 2 * p.inset, p.corner - p.inset
    outer = extrude(Plane((0, 0, low), z_dir=DOWN) * RectangleRounded(a, b, r), amount=p.skirt, taper=p.draft)
    inner = Pos(0, 0, low) * extrude(RectangleRounded(a - 2 * p.wall, b - 2 * p.wall, r - p.wall), amount=-p.skirt)
    skirt = outer - inner
    # room for the snap arm
    skirt -= block((10, p.snap + 2 * p.gap, p.skirt), (a / 2, 0, low - p.skirt))
    body += skirt
    for s in (-1, 1):
        x, w, t = p.tongue
        root = -a / 2
        body += block((x + 1, w, t), (root - x / 2 + 0.5, s * p.tongue_dy / 2, p.tongue_z - t))
    for i in range(p.ribs):
        x = (i - (p.ribs - 1) / 2) * p.rib_pitch
        body += block((p.rib, b - 2 * p.wall + 0.2, p.rib_height), (x, 0, low - p.rib_height))
    for sx in (-1, 1):
        for sy in (-1, 1):
            x, y = sx * p.boss_dx / 2, sy * p.boss_dy / 2
            end = low - p.boss_height
            body += rod(p.boss, p.boss_height, (x, y, end))
            body -= rod(p.pilot, p.pilot_depth, (x, y, end))
    for i in range(p.bars):
        x = p.bar_x + (i - (p.bars - 1) / 2) * p.bar_pitch
        body += block(p.bar, (x, 0, 0))
    out, end = p.snap_x, low - p.snap_length
    lead = p.hook / math.tan(math.radians(p.hook_lead))
    side = Polygon(
        (out - p.snap_thick, low), (out - p.snap_thick, end), (out, end),
        (out + p.hook, end + lead), (out, end + lead), (out, low), align=None,
    )
    body += extrude(Plane.XZ * side, amount=p.snap / 2, both=True)
    return body
