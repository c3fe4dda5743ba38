"""A keyed drive shaft: five steps with a collar, one closed and one open keyseat, a circlip groove, a pin hole, end holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import GeomType, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, LEFT, RIGHT, UP, cone, drill, rod, slot

MODEL = Model("Keyseat shaft", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the shaft's axis is x, its left end lies at x = 0."""

    diameters: tuple[float, ...] = (24, 30, 42, 32, 22)  # from the left end on
    steps: tuple[float, ...] = (45, 28, 12, 60, 40)  # their lengths
    bevel: float = 1.5  # 45 degrees, both ends
    key_a: float = 8  # width of the closed keyseat in the first step, open towards +z
    key_a_length: float = 32  # over its round ends
    key_a_start: float = 6  # from the left end
    key_a_depth: float = 4
    key_b: float = 6  # width of the keyseat in the last step, open towards +y and at the right end
    key_b_length: float = 25  # from the right end to the round end's apex
    key_b_depth: float = 3.5
    groove: float = 1.6  # width of the circlip groove in the fourth step
    groove_bottom: float = 30.3
    groove_gap: float = 16  # from the collar's right face to the groove
    pin: float = 6  # cross hole through the fourth step, along z
    pin_x: float = 130
    tap: float = 6.8  # core hole M8 in the left end
    tap_depth: float = 20
    centre: float = 3.15  # centre hole in the right end
    centre_depth: float = 7.5  # from the end face to the pilot's bottom edge
    centre_mouth: float = 6.7  # of its 60 degree cone


def build(p: P) -> Part:
    """Turns the steps, then mills and drills."""
    body = Part()
    x = 0.0
    for diameter, length in zip(p.diameters, p.steps):
        body += rod(diameter, length, (x, 0, 0), RIGHT)
        x += length
    ends = [e for e in body.edges().filter_by(GeomType.CIRCLE) if min(e.center().X, x - e.center().X) < 1e-3]
    body = chamfer(ends, p.bevel)
    top = p.diameters[0] / 2
    body -= slot(p.key_a_length, p.key_a, p.key_a_depth + 5, (p.key_a_start + p.key_a_length / 2, 0, top - p.key_a_depth), UP)
    side = p.diameters[4] / 2
    middle = x - p.key_b_length + p.key_b_length / 2 + 10
    body -= slot(p.key_b_length + 20, p.key_b, p.key_b_depth + 5, (middle, side - p.key_b_depth, 0), BACK)
    start = sum(p.steps[:3]) + p.groove_gap
    body -= rod(p.diameters[3] + 2, p.groove, (start, 0, 0), RIGHT) - rod(p.groove_bottom, p.groove, (start, 0, 0), RIGHT)
    body -= rod(p.pin, 2 * p.diameters[3], (p.pin_x, 0, -p.diameters[3]))
    body -= drill(p.tap, p.tap_depth, (0, 0, 0), RIGHT)
    body -= drill(p.centre, p.centre_depth, (x, 0, 0), LEFT)
    body -= cone(p.centre_mouth, 0, p.centre_mouth / 2 * 3**0.5, (x, 0, 0), LEFT)
    return body
