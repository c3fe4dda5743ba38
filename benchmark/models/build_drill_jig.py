"""A drill jig: a stepped plate with guide holes in a row, countersunk fixing holes, two locating pins and a handle."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Location, Part, chamfer

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import DOWN, RIGHT, block, cone, grid, rod

MODEL = Model("Drill jig with locating pins", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate's underside is z = 0, its middle the origin; the low half lies at the front."""

    width: float = 120
    depth: float = 70
    high: float = 16
    low: float = 9  # thickness of the front half
    step: float = 30  # depth of the front half
    guides: tuple[float, ...] = (4, 5, 6, 8, 10)
    guide_pitch: float = 18
    fixing: float = 5.5
    fixing_head: float = 11
    fixing_x: float = 100
    fixing_y: float = -25
    pin: float = 8
    pin_height: float = 14
    pin_chamfer: float = 1
    pin_x: float = 104
    pin_y: float = 25
    handle: float = 12
    handle_length: float = 40


def build(p: P) -> Part:
    """Mills the step, drills, then sets pins and handle."""
    body = block((p.width, p.depth, p.high))
    body -= block((p.width, p.step, p.high - p.low), (0, -(p.depth - p.step) / 2, p.low))
    body += [rod(p.handle, p.handle_length, (p.width / 2, 15, p.high / 2), RIGHT)]
    pin = rod(p.pin, p.pin_height)
    pin = chamfer(pin.edges().group_by(Axis.Z)[-1], p.pin_chamfer)
    body += [pin.moved(_at(x, p.pin_y, p.high)) for x, _ in grid(2, 1, p.pin_x, 0)]
    for (x, _), diameter in zip(grid(len(p.guides), 1, p.guide_pitch, 0), p.guides, strict=True):
        body -= rod(diameter, p.high, (x, 0, 0)).moved(_at(0, 5, 0))
    for x, _ in grid(2, 1, p.fixing_x, 0):
        body -= rod(p.fixing, p.low, (x, p.fixing_y, 0))
        head = (p.fixing_head - p.fixing) / 2  # of 90 degrees
        body -= cone(p.fixing_head, p.fixing, head, (x, p.fixing_y, p.low), DOWN)
    return body


def questions(p: P) -> list[Item]:
    """Asked by a toolmaker and by a robot's programmer."""
    half = (len(p.guides) - 1) / 2
    return [
        count("hole", "How many holes can be seen from above?", len(p.guides) + 2),
        lengths("hole", "diameter", "Which different hole diameters does the jig have?", sorted({*p.guides, p.fixing})),
        length("through hole", "radius", "Radius of the biggest hole in the part?", max(p.guides) / 2),
        point(
            "hole",
            "Where is the centre of the hole with the smallest diameter?",
            (-half * p.guide_pitch, 5, p.high / 2),
        ),
        length(
            "hole",
            "distance",
            "What is the greatest distance between the centres of two holes along the width of the part?",
            p.fixing_x,
        ),
        count("hole with bevel", "What is the number of countersunk holes on the top?", 2),
        lengths("hole with bevel", "depth", "How deep are the countersunk holes?", [p.low, p.low]),
        count("rectangular pin", "How many square pins are there?", 0),
        lengths("rod", "height", "By how much do the two locating pins rise above the plate?", [p.pin_height] * 2),
        lengths("rod", "diameter", "Which diameter do the locating pins on top have?", [p.pin] * 2),
        points(
            "rod",
            "Give me the centre points of the pins on top of the plate.",
            [(x, p.pin_y, p.high + p.pin_height / 2) for x in (-p.pin_x / 2, p.pin_x / 2)],
        ),
        length("rod", "length", "How long is the handle that sticks out on the right?", p.handle_length),
        length("rod", "diameter", "What diameter has the rod on the right hand side?", p.handle),
        size(
            "object",
            "What are the overall extents of the object?",
            (p.width + p.handle_length, p.depth, p.high + p.pin_height),
            "extents",
        ),
        length("step", "height", "How high is the step at the front?", p.high - p.low),
    ]


def _at(x: float, y: float, z: float) -> Location:
    return Location((x, y, z))
