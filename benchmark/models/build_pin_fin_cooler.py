"""A pin-fin cooler for a power module: base plate with square pins, ringed screw holes, contact disc below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths, points
from benchmark.shapes import DOWN, LEFT, block, grid, rod

MODEL = Model("Pin-fin cooler", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate lies on z = 0, the pins point up, the contact disc hangs below."""

    plate: tuple[float, float, float] = (80, 60, 5)
    columns: int = 8
    rows: int = 6
    pitch: float = 8
    pin: tuple[float, float, float] = (3, 3, 21)
    hole: float = 3.4
    span: tuple[float, float] = (70, 50)
    collar: float = 7.5
    collar_height: float = 2.5
    disc: float = 36
    disc_height: float = 3
    probe: float = 2
    probe_depth: float = 12
    cutout: tuple[float, float] = (6, 14)  # from the left edge inwards; along the edge


def build(p: P) -> Part:
    """Plate, pins, collars and disc; screw holes, a probe's hole from the right, a cutout at the left edge."""
    thick = p.plate[2]
    corners = grid(2, 2, *p.span)
    body = block(p.plate) + rod(p.disc, p.disc_height, (0, 0, 0), DOWN)
    body += [block(p.pin, (x, y, thick)) for x, y in grid(p.columns, p.rows, p.pitch, p.pitch)]
    body += [rod(p.collar, p.collar_height, (x, y, thick)) for x, y in corners]
    body -= [rod(p.hole, thick + p.collar_height, (x, y, 0)) for x, y in corners]
    body -= rod(p.probe, p.probe_depth, (p.plate[0] / 2, 0, thick / 2), LEFT)
    inwards, along = p.cutout
    return body - block((inwards, along, thick), ((inwards - p.plate[0]) / 2, 0, 0))


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a thermal engineer, an assembler and a trainee."""
    corners = grid(2, 2, *p.span)
    depth = p.plate[2] + p.collar_height
    return [
        count("rectangular pin", "How many rectangular pins rise from the top of the base plate?", p.columns * p.rows),
        length("rectangular pin", "height", "Height of one rectangular pin?", p.pin[2]),
        length("rectangular pin", "width", "Determine the width of a single rectangular pin.", p.pin[0]),
        lengths(
            "hole with ring", "diameter", "State the inner diameters of the holes with a ring facing up.", [p.hole] * 4
        ),
        lengths(
            "ring",
            "diameter",
            "Give me the outer diameters of the rings that surround the holes on the top face.",
            [p.collar] * 4,
        ),
        length("circular protrusion", "radius", "Radius of the circular protrusion seen from below?", p.disc / 2),
        length(
            "circular protrusion",
            "height",
            "By what height is the circular protrusion raised from the underside?",
            p.disc_height,
        ),
        length("blind hole", "depth", "Depth of the blind hole on the right-hand side?", p.probe_depth),
        points("hole with ring", "Indicate the centers of the 3.4 mm holes.", [(x, y, depth / 2) for x, y in corners]),
        count("hole", "How many holes with a diameter below 3 mm does the cooler contain?", 1),
        length("rectangular pin", "distance", "whats the clear gap between two neighbouring pins?", p.pitch - p.pin[0]),
        length(
            "ring",
            "height",
            "The collars round the screw holes, how far do they stick up from the plate?",
            p.collar_height,
        ),
        length(
            "cutout",
            "depth",
            "There's a rectangular cutout in the left edge. How far in from that edge does it reach?",
            p.cutout[0],
        ),
        length(
            "blind hole",
            "diameter",
            "I want to slide a temperature probe into the hole at the side. How big is that hole across?",
            p.probe,
        ),
    ]
