"""A cross-drilled and slotted brake disc: friction ring, hollow hat, bevelled wheel bolt holes, jacking threads."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths
from benchmark.shapes import DOWN, circle, cone, rod, slot

MODEL = Model("Brake disc", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the axis is z, the friction ring lies on z = 0, the hat points up."""

    disc: float = 260
    thickness: float = 12  # of the friction ring
    hat: float = 140
    height: float = 45
    hollow: float = 126  # of the hat, from below
    crown: float = 8  # the hat's face
    bore: float = 65
    bolts: int = 5
    bolt: float = 13
    bolt_circle: float = 100
    bevel: float = 1.5  # at 45 degrees
    threads: int = 2
    thread: float = 6.8  # core hole of M8
    drilled: int = 12
    drilled_hole: float = 8
    drilled_circle: float = 220
    slots: int = 6
    slot: tuple[float, float, float] = (42, 4, 2)  # length, width, depth
    slot_circle: float = 202  # of their middles


def build(p: P) -> Part:
    """Turns ring and hat, hollows, drills, mills the slots."""
    body = rod(p.disc, p.thickness) + rod(p.hat, p.height)
    body -= rod(p.hollow, p.height - p.crown)
    body -= rod(p.bore, p.height)
    for x, y in circle(p.bolts, p.bolt_circle, 90):
        body -= rod(p.bolt, p.height, (x, y, 0))
        body -= cone(p.bolt + 2 * p.bevel, p.bolt, p.bevel, (x, y, p.height), DOWN)
    between = circle(p.bolts, p.bolt_circle, 90 + 180 / p.bolts)[: p.threads]
    body -= [rod(p.thread, p.height, (x, y, 0)) for x, y in between]
    start = 180 / p.drilled
    body -= [rod(p.drilled_hole, p.thickness, (x, y, 0)) for x, y in circle(p.drilled, p.drilled_circle, start)]
    for index, (x, y) in enumerate(circle(p.slots, p.slot_circle)):
        body -= slot(*p.slot, (x, y, p.thickness), rotation=-index * 360 / p.slots)
    return body


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a car mechanic, a machinist and a British rally driver."""
    return [
        count("radial slots", "How many radial slots are visible from the top?", p.slots),
        lengths("radial slots", "width", "What is the width of the radial slots on the top?", [p.slot[1]] * p.slots),
        count("hole with bevel", "How many holes with a bevel are visible from the top?", p.bolts),
        lengths("hole with bevel", "radius", "What is the radius of the holes with a bevel?", [p.bolt / 2] * p.bolts),
        length("hole", "diameter", "What is the diameter of the largest hole visible from the top?", p.bore),
        length("circular protrusion", "diameter", "What is the diameter of the circular protrusion on the top?", p.hat),
        length(
            "circular protrusion",
            "height",
            "What is the height of the circular protrusion on the top?",
            p.height - p.thickness,
        ),
        length("object", "diameter", "outer dia of the disc?", p.disc),
        length(
            "ring", "thickness", "How thick is the friction ring, i.e. the flat outer part of the disc?", p.thickness
        ),
        length("mounting hole", "diameter", "What's the PCD of the five wheel bolt holes?", p.bolt_circle),
        length("object", "height", "Overall height of the brake disc, hat included", p.height),
        count(
            "through hole", "I count the 8 mm cross-drilled holes and always lose track, how many are they?", p.drilled
        ),
        lengths("radial slots", "depth", "wich depth have the slots milled into the top", [p.slot[2]] * p.slots),
        lengths(
            "threaded hole",
            "diameter",
            "Core diameter of the two M8 threaded holes between the wheel bolt holes, please.",
            [p.thread] * p.threads,
        ),
    ]
