"""A two-cylinder section of an engine block: bores, crank chambers between three bulkheads, half bearings, oil ways, taps."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Model
from benchmark.shapes import BACK, RIGHT, UP, block, drill, grid, rod

MODEL = Model("Crankcase slice", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the sump face is z = 0, the crank's axis the x axis, x = 0 the middle."""

    size: tuple[float, float, float] = (190, 110, 140)
    bore: float = 68
    pitch: float = 84  # between the cylinders
    chamber: tuple[float, float, float] = (70, 84, 60)  # from the sump face, one below each bore
    bearing: float = 52  # half bores in the sump face, along x
    caps: float = 8.5  # core holes M10 for the bearing caps, from below
    cap_dy: float = 76
    cap_depth: float = 30
    head: float = 10.2  # core holes M12 in the deck
    head_dy: float = 84
    head_depth: float = 32
    dowel: float = 10  # two in the deck, at (-pitch, dowel_y) and (pitch, -dowel_y)
    dowel_y: float = 20
    dowel_depth: float = 9
    water: float = 12  # blind holes in the deck beside the bores
    water_dy: float = 90
    water_depth: float = 50
    gallery: float = 14  # along x through the block
    gallery_y: float = 44
    gallery_z: float = 74
    feed: float = 6  # from the gallery to each bearing's axis
    mount: float = 6.8  # core holes M8 in the side y < 0
    mount_dx: float = 60
    mount_dz: float = 40
    mount_z: float = 90  # of their pattern's middle
    mount_depth: float = 16


def build(p: P) -> Part:
    """Casts the block with its chambers, then machines it."""
    long, wide, high = p.size
    body = block(p.size)
    for x, y in grid(2, 1, p.pitch, 0):
        body -= block(p.chamber, (x, y, 0))
        body -= rod(p.bore, high, (x, y, 0))
    body -= rod(p.bearing, long, (-long / 2, 0, 0), RIGHT)
    for x, y in grid(3, 2, p.pitch, p.cap_dy):
        body -= drill(p.caps, p.cap_depth, (x, y, 0), UP)
    for x, y in grid(3, 2, p.pitch, p.head_dy):
        body -= drill(p.head, p.head_depth, (x, y, high))
    for s in (-1, 1):
        body -= rod(p.dowel, p.dowel_depth, (s * p.pitch, -s * p.dowel_y, high - p.dowel_depth))
    for x, y in grid(2, 2, p.pitch, p.water_dy):
        body -= drill(p.water, p.water_depth, (x, y, high))
    body -= rod(p.gallery, long, (-long / 2, p.gallery_y, p.gallery_z), RIGHT)
    reach = math.hypot(p.gallery_y, p.gallery_z)
    for x, _ in grid(3, 1, p.pitch, 0):
        body -= rod(p.feed, reach, (x, 0, 0), (0, p.gallery_y / reach, p.gallery_z / reach))
    for x, z in grid(2, 2, p.mount_dx, p.mount_dz, (0, p.mount_z)):
        body -= drill(p.mount, p.mount_depth, (x, -wide / 2, z), BACK)
    return body
