"""A wall pan for a small control box: folded tray with keyholes, vents on top, cable entries below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Plane, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, LEFT, RIGHT, block, rod, slot

from benchmark.last_look.models.sheet_strip import strip

MODEL = Model("Wall pan", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the back's outer face is z = 0, the tray opens to +z, up on the wall is +y."""

    sheet: float = 1.2
    bend: float = 1.5  # inside radius
    size: tuple[float, float, float] = (240, 160, 55)  # outside
    relief: float = 4  # a wall ends this much before the neighbouring wall's outer face
    key_head: float = 10
    key_neck: float = 5
    key_lift: float = 12  # neck's end centre above the head's centre
    keys_x: float = 160  # between the two
    keys_y: float = 45  # of the heads
    foot: float = 5.5  # third fixing hole
    foot_y: float = -60
    rail: float = 4.2  # holes of the mounting rail
    rails_x: float = 100
    vent: tuple[float, float] = (4, 30)  # width, length
    vents: int = 9
    vent_pitch: float = 14
    vent_z: float = 30
    gland: float = 20.5  # cable entries in the lower wall
    glands: int = 3
    gland_pitch: float = 55
    gland_z: float = 28
    side: float = 16.2  # entry in the wall on +x
    side_z: float = 28
    lid: float = 3.5  # screw holes of the lid, two in each short wall
    lid_edge: float = 8  # from the free edge
    lids_y: float = 120


def build(p: P) -> Part:
    """Folds the walls up, punches."""
    t = p.sheet
    x, y, z = p.size
    u = [(-x / 2, z), (-x / 2, 0), (x / 2, 0), (x / 2, z)]
    v = [(-y / 2, z), (-y / 2, 0), (y / 2, 0), (y / 2, z)]
    body = extrude(Plane.XZ * strip(u, t, p.bend), amount=y / 2 - p.relief, both=True)
    body += extrude(Plane.YZ * strip(v, t, p.bend), amount=x / 2 - p.relief, both=True)
    for s in (-1, 1):
        kx = s * p.keys_x / 2
        body -= rod(p.key_head, t, (kx, p.keys_y, 0))
        body -= slot(p.key_lift + p.key_neck, p.key_neck, t, (kx, p.keys_y + p.key_lift / 2, t), rotation=90)
        body -= rod(p.rail, t, (s * p.rails_x / 2, 0, 0))
        for q in (-1, 1):
            body -= rod(p.lid, 4 * t, (s * (x / 2 - 2 * t), q * p.lids_y / 2, z - p.lid_edge), RIGHT if s > 0 else LEFT)
    body -= rod(p.foot, t, (0, p.foot_y, 0))
    w, h = p.vent
    for i in range(p.vents):
        vx = (i - (p.vents - 1) / 2) * p.vent_pitch
        body -= slot(h, w, 4 * t, (vx, y / 2 - 2 * t, p.vent_z), BACK, rotation=90)
    for i in range(p.glands):
        gx = (i - (p.glands - 1) / 2) * p.gland_pitch
        body -= rod(p.gland, 4 * t, (gx, -y / 2 + 2 * t, p.gland_z), FRONT)
    body -= rod(p.side, 4 * t, (x / 2 - 2 * t, 0, p.side_z), RIGHT)
    return body
