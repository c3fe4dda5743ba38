"""A quick-release adapter plate for cameras: dovetail flanks, stepped slot, pins, pads, ringed holes, nut holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Plane, Polyline, extrude, make_face

from benchmark.kit import Item, Model, count, length, lengths, size
from benchmark.shapes import UP, block, prism, rod, slot

MODEL = Model("Quick-release camera plate", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the underside lies on z = 0, the middle is x = y = 0, the dovetail runs along x."""

    plate: tuple[float, float, float] = (80, 54, 12)
    neck: float = 46  # width above the dovetail's flanks
    flank: float = 6  # height of the flanks
    slot: tuple[float, float] = (30, 7)
    slot_wide: tuple[float, float] = (38, 14)  # below, for the screw's head
    slot_wide_depth: float = 5
    pads: tuple[float, float, float] = (8, 36, 1)  # indentations for rubber
    pads_x: float = 24
    pins: tuple[float, float, float] = (3, 6, 2.5)
    pins_y: float = 15
    notch: float = 9  # radius of the finger notch on the right
    ring: float = 9
    ring_height: float = 1.5
    ring_hole: float = 4.3
    ring_x: float = 33.5
    ring_y: float = 16
    nut: float = 5.5  # across flats (ISO 4032, M3)
    nut_depth: float = 2.6
    nut_hole: float = 3.2
    nut_x: float = -34
    nut_y: float = 14


def build(p: P) -> Part:
    """Extrudes the dovetail's section, cuts, adds rings and pins."""
    width, depth, height = p.plate
    half, neck = depth / 2, p.neck / 2
    outline = Polyline(
        (-half, 0), (half, 0), (neck, p.flank), (neck, height), (-neck, height), (-neck, p.flank), close=True
    )
    body = extrude(Plane.YZ.offset(-width / 2) * make_face(outline), amount=width)
    body -= slot(*p.slot, height, (0, 0, 0), UP)
    body -= slot(*p.slot_wide, p.slot_wide_depth, (0, 0, 0), UP)
    body -= rod(2 * p.notch, height, (width / 2, 0, 0))
    for side in (-1, 1):
        body -= block(p.pads, (side * p.pads_x, 0, height - p.pads[2]))
        body += block(p.pins, (0, side * p.pins_y, height))
        body += rod(p.ring, p.ring_height, (p.ring_x, side * p.ring_y, height))
        body -= rod(p.ring_hole, height + p.ring_height, (p.ring_x, side * p.ring_y, 0))
        body -= prism(p.nut, p.nut_depth, (p.nut_x, side * p.nut_y, 0))
        body -= rod(p.nut_hole, height, (p.nut_x, side * p.nut_y, 0))
    return body


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a photographer, a milling operator and a designer."""
    width, depth, height = p.plate
    return [
        size(
            "object",
            "What are the extents of the entire object?",
            (width, depth, height + p.pins[2]),
            "extents",
        ),
        count("hole with ring", "How many holes with a ring are visible from the top?", 2),
        lengths("hole with ring", "diameter", "What is the diameter of the holes with a ring?", [p.ring_hole] * 2),
        count("nut hole", "How many nut holes are visible from the bottom?", 2),
        lengths("nut hole", "depth", "How deep are the nut holes on the bottom?", [p.nut_depth] * 2),
        length("semicircle", "radius", "What is the radius of the semicircle on the right?", p.notch),
        lengths(
            "rectangular indentation",
            "depth",
            "What is the depth of the rectangular indentations on the top?",
            [p.pads[2]] * 2,
        ),
        length("adapter plate", "width", "how wide is the adapter plate in x", width),
        length(
            "adapter plate",
            "thickness",
            "How thick is the adapter plate itself, without the rings and pins on top?",
            height,
        ),
        lengths("rectangular pin", "height", "height of the rectangular pins?", [p.pins[2]] * 2),
        length(
            "rectangular pin",
            "distance",
            "The two anti-twist pins on top, how far are they from each other, centre to centre?",
            2 * p.pins_y,
        ),
        lengths("ring", "diameter", "Outside diameter of the rings around the holes?", [p.ring] * 2),
        length("slot", "length", "Length of the slot, as seen from the top, over its round ends?", p.slot[0]),
        lengths("nut hole", "width", "Whats the across-flats size of the hex nut pockets?", [p.nut] * 2),
    ]
