"""A vee block for the marking-out table: a large vee on top, a small one below, clamping grooves, tapped ends."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, block, drill, prism

MODEL = Model("Vee block", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the block stands on z = 0, its middle is x = y = 0; the vees run along x."""

    size: tuple[float, float, float] = (80, 60, 50)
    bevel: float = 3  # of the four upright edges
    vee: float = 40  # width of its mouth, 90 degrees
    relief: float = 3  # width of the slot in its ground
    relief_depth: float = 4  # below the vee's apex
    small: float = 20  # width of the lower vee's mouth, 90 degrees
    groove: float = 10  # height of the clamping grooves
    groove_depth: float = 8
    groove_z: float = 20  # of its middle
    tap: float = 6.8  # core hole of M8
    tap_depth: float = 18
    taps_y: float = 40  # between the two of an end
    taps_z: float = 8


def build(p: P) -> Part:
    """Saws the block and mills everything through along x."""
    x, y, z = p.size
    body = block(p.size)
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel)
    body -= prism(p.vee / 2**0.5, x, (-x / 2, 0, z), RIGHT, sides=4)
    body -= block((x, p.relief, p.vee / 2), (0, 0, z - p.vee / 2 - p.relief_depth))
    body -= prism(p.small / 2**0.5, x, (-x / 2, 0, 0), RIGHT, sides=4)
    for side in (-1, 1):
        middle = side * (y - p.groove_depth) / 2
        body -= block((x, p.groove_depth, p.groove), (0, middle, p.groove_z - p.groove / 2))
        for end, into in ((-1, RIGHT), (1, LEFT)):
            body -= drill(p.tap, p.tap_depth, (end * x / 2, side * p.taps_y / 2, p.taps_z), into)
    return body
