"""A clamping lever, placed obliquely: two bosses with bores, a slot in the arm, a ring groove around one bore."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part

from benchmark.kit import Item, Model, count, length, lengths
from benchmark.shapes import block, rod, slot

MODEL = Model("Clamping lever in an oblique position", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; drawn lying on z = 0 along x, then turned about y and z."""

    span: float = 96  # between the bosses' axes
    arm: tuple[float, float] = (22, 10)  # width, thickness
    large: float = 44
    large_height: float = 18
    large_bore: float = 25
    ring: tuple[float, float] = (31, 37)  # inner and outer diameter of the groove on top
    ring_depth: float = 2.5
    small: float = 28
    small_height: float = 14
    small_bore: float = 12
    slot: tuple[float, float] = (34, 9)
    tilt: float = 25
    turn: float = 40


def build(p: P) -> Part:
    """Joins, bores and turns."""
    body = block((p.span, *p.arm), (p.span / 2, 0, 0)) + rod(p.large, p.large_height)
    body += rod(p.small, p.small_height, (p.span, 0, 0))
    body -= rod(p.large_bore, p.large_height) + rod(p.small_bore, p.small_height, (p.span, 0, 0))
    groove = rod(p.ring[1], p.ring_depth) - rod(p.ring[0], p.ring_depth)
    body -= groove.translate((0, 0, p.large_height - p.ring_depth))
    body -= slot(*p.slot, p.arm[1], (p.span / 2 + 4, 0, p.arm[1]))
    return body.rotate(Axis.Y, p.tilt).rotate(Axis.Z, p.turn)


def questions(p: P) -> list[Item]:
    """Asked by a machinist; nothing here depends on the position."""
    bores = sorted((p.large_bore, p.small_bore))
    return [
        count("hole", "How many round holes go through the lever?", 2),
        lengths("hole", "diameter", "What are the diameters of the round holes?", bores),
        lengths("hole", "depth", "And how deep are these round holes?", sorted((p.large_height, p.small_height))),
        length("hole", "distance", "What is the distance between the axes of the two round holes?", p.span),
        length("hole with ring", "radius", "What radius has the hole with a ring around it?", p.large_bore / 2),
        length("ring", "depth", "How deep is the ring groove?", p.ring_depth),
        length("ring", "width", "How wide is the annular groove?", (p.ring[1] - p.ring[0]) / 2),
        length("slot", "length", "How long is the slot in the arm?", p.slot[0]),
        length("slot", "width", "How wide is the elongated hole?", p.slot[1]),
        count("slot", "How many obround slots are there?", 1),
        length("cylinder", "diameter", "What is the outer diameter of the biggest boss?", p.large),
        length("hole", "radius", "What is the radius of the smallest round hole?", p.small_bore / 2),
        length("hole", "diameter", "Which is the largest bore diameter?", p.large_bore),
    ]
