"""The quill of a lathe's tailstock: a Morse taper in front, a seat for the nut behind, a long keyway below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import DOWN, LEFT, RIGHT, UP, circle, cone, drill, rod, slot

MODEL = Model("Tailstock quill", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; axis x; the front (taper) end at x = 0, the rear at x = length."""

    diameter: float = 55
    length: float = 210
    bevel: float = 2.5  # front outer edge, 45 degrees
    rear_bevel: float = 1
    taper_big: float = 23.825  # Morse 3 at the mouth
    taper: float = 19.922  # 1 : taper
    taper_depth: float = 81
    bore: float = 17  # through behind the taper
    nut: float = 30  # bore for the nut
    nut_depth: float = 45
    key: float = 8  # width of the keyway
    key_depth: float = 4.5
    key_length: float = 120  # over all, round ends
    key_start: float = 38  # from the front end
    ring: float = 3  # width of each oil groove
    ring_depth: float = 1.2
    ring_x: float = 170  # middle of the first
    ring_pitch: float = 14
    rings: int = 3
    taps: int = 3
    tap: float = 4.2  # core hole of M5, in the rear face
    tap_depth: float = 14
    tap_circle: float = 42
    oil: float = 5  # lubrication hole from the top into the bore
    oil_x: float = 125


def build(p: P) -> Part:
    body = rod(p.diameter, p.length, (0, 0, 0), RIGHT)
    rims = body.edges().sort_by(Axis.X)
    body = chamfer([rims[0]], p.bevel)
    body = chamfer(body.edges().sort_by(Axis.X)[-1:], p.rear_bevel)
    body -= rod(p.bore, p.length, (0, 0, 0), RIGHT)
    body -= cone(p.taper_big, p.taper_big - p.taper_depth / p.taper, p.taper_depth, (0, 0, 0), RIGHT)
    body -= rod(p.nut, p.nut_depth, (p.length, 0, 0), LEFT)
    middle = p.key_start + p.key_length / 2
    body -= slot(p.key_length, p.key, 10, (middle, 0, -p.diameter / 2 + p.key_depth), DOWN, 0)
    for index in range(p.rings):
        x = p.ring_x + index * p.ring_pitch - p.ring / 2
        body -= rod(p.diameter + 4, p.ring, (x, 0, 0), RIGHT) - rod(
            p.diameter - 2 * p.ring_depth, p.ring, (x, 0, 0), RIGHT
        )
    for y, z in circle(p.taps, p.tap_circle, 90):
        body -= drill(p.tap, p.tap_depth, (p.length, y, z), LEFT)
    body -= rod(p.oil, p.diameter, (p.oil_x, 0, 0), UP)
    return body
