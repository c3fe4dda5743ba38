"""A printed case for a small microcontroller board: base with insert bosses, standoffs and vents, and a screwed lid with a lip."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part, Pos, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, RIGHT, assembly, block, grid, named, rod, slot

MODEL = Model("Microcontroller case with lid", "held_out", bodies=2)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the underside of the base is z = 0, the USB opening lies towards -x, the vents towards +y."""

    length: float = 92  # x, without ears
    width: float = 58  # y
    height: float = 26  # of the base
    corner: float = 6  # outer upright corners
    wall: float = 2.4
    floor: float = 2
    boss: float = 8  # diameter of the corner columns
    boss_span: tuple[float, float] = (80, 46)  # between their axes
    insert: float = 4  # hole for a heat-set insert
    insert_depth: float = 8
    post: float = 6  # standoffs of the board
    post_height: float = 5  # over the floor
    post_span: tuple[float, float] = (46, 23)
    post_x: float = -6  # of the pattern's middle
    pilot: float = 2.5  # blind, as deep as the post is high
    usb: tuple[float, float] = (12, 7)  # y, z
    usb_z: float = 11  # of its middle
    cable: float = 12.5
    cable_z: float = 14
    vents: int = 6
    vent: tuple[float, float] = (2.5, 14)  # width, height over all
    vent_pitch: float = 6
    vent_z: float = 14  # of their middle
    ear: tuple[float, float] = (14, 18)  # x, y
    ear_height: float = 4
    ear_hole: float = 4.5
    ear_reach: float = 7  # of its hole from the wall
    lid: float = 3
    lip: float = 2  # how deep it dips into the base
    lip_wall: float = 1.6
    gap: float = 0.25  # between lip and wall
    boss_gap: float = 0.5  # between lip and boss
    screw: float = 3.4
    head: float = 6.2
    head_depth: float = 1.6
    window: tuple[float, float] = (26, 14)
    window_x: float = -14
    led: float = 5.2
    led_x: float = 22


def build(p: P) -> Compound:
    """Hollows the base, sets bosses and posts, opens the walls; cuts the lid."""

    def plan(offset: float, amount: float) -> Part:
        size = (p.length - 2 * offset, p.width - 2 * offset)
        return extrude(RectangleRounded(*size, p.corner - offset), amount=amount)

    corners = grid(2, 2, *p.boss_span)
    base = plan(0, p.height)
    for side in (-1, 1):
        base += block((p.ear[0] + 5, p.ear[1], p.ear_height), (side * (p.length / 2 + (p.ear[0] - 5) / 2), 0, 0))
    base -= Pos(0, 0, p.floor) * plan(p.wall, p.height)
    for x, y in corners:
        base += rod(p.boss, p.height, (x, y, 0))
    for x, y in corners:
        base -= rod(p.insert, p.insert_depth, (x, y, p.height - p.insert_depth))
    for x, y in grid(2, 2, *p.post_span, (p.post_x, 0)):
        base += rod(p.post, p.post_height + p.floor, (x, y, 0))
    for x, y in grid(2, 2, *p.post_span, (p.post_x, 0)):
        base -= rod(p.pilot, p.post_height, (x, y, p.floor))
    base -= block((2 * p.wall, *p.usb), (-p.length / 2, 0, p.usb_z - p.usb[1] / 2))
    base -= rod(p.cable, 2 * p.wall, (p.length / 2 - 1.5 * p.wall, 0, p.cable_z), RIGHT)
    for x, _ in grid(p.vents, 1, p.vent_pitch, 0):
        mouth = (x, p.width / 2 - 1.5 * p.wall, p.vent_z)
        base -= slot(p.vent[1], p.vent[0], 2 * p.wall, mouth, BACK, 90)
    for side in (-1, 1):
        base -= rod(p.ear_hole, p.ear_height, (side * (p.length / 2 + p.ear_reach), 0, 0))

    lid = Pos(0, 0, p.height) * plan(0, p.lid)
    outside = p.wall + p.gap
    ring = plan(outside, p.lip) - plan(outside + p.lip_wall, p.lip)
    for x, y in corners:
        ring -= rod(p.boss + 2 * p.boss_gap, p.lip, (x, y, 0))
    lid += Pos(0, 0, p.height - p.lip) * ring
    top = p.height + p.lid
    for x, y in corners:
        lid -= rod(p.screw, p.lid, (x, y, p.height))
        lid -= rod(p.head, p.head_depth, (x, y, top - p.head_depth))
    lid -= block((*p.window, p.lid), (p.window_x, 0, p.height))
    lid -= rod(p.led, p.lid, (p.led_x, 0, p.height))
    return assembly([named(base, "base", "darkslategray"), named(lid, "lid", "orange")])
