"""A butt hinge, opened flat: two leaves with knuckles and countersunk holes, the pin and a washer."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, exists, length, lengths, point, points, size, texts, volume
from benchmark.shapes import BACK, DOWN, FRONT, assembly, block, cone, named, rod

MODEL = Model("Butt hinge", "dev", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the hinge's axis is y, its middle the origin; the leaves lie in the plane z = 0."""

    leaf: float = 45  # from the axis to the edge
    length: float = 80
    thickness: float = 4
    knuckle: float = 12
    middle: float = 29  # length of the right leaf's knuckle
    outer: float = 25  # length of each of the left leaf's knuckles
    clearance: float = 1
    pin: float = 6
    bore: float = 6.2
    tail: float = 4  # of the pin beyond the knuckles
    head: float = 9
    head_height: float = 3
    washer: float = 11
    washer_thickness: float = 1
    hole: float = 5
    sink: float = 10  # of 90 degrees
    near: float = 20  # x of the hole in the middle
    far: float = 34  # x of the other two
    far_y: float = 56  # between them

    def holes(self) -> list[tuple[float, float]]:
        """Where are the right leaf's holes?"""
        return [(self.near, 0), (self.far, -self.far_y / 2), (self.far, self.far_y / 2)]


def leaf(p: P, side: int, knuckles: list[tuple[float, float]], gaps: list[tuple[float, float]]) -> Part:
    """A leaf on the side of +x or -x; `knuckles` and `gaps` are pairs of y."""
    body = block((p.leaf, p.length, p.thickness), (side * p.leaf / 2, 0, -p.thickness / 2))
    free = p.knuckle / 2 + p.clearance
    for low, high in gaps:
        body -= block((free, high - low, p.thickness), (side * free / 2, (low + high) / 2, -p.thickness / 2))
    for low, high in knuckles:
        body += rod(p.knuckle, high - low, (0, low, 0), BACK)
    body -= rod(p.bore, p.length, (0, -p.length / 2, 0), BACK)
    for x, y in p.holes():
        body -= rod(p.hole, p.thickness, (side * x, y, -p.thickness / 2))
        body -= cone(p.sink, p.hole, (p.sink - p.hole) / 2, (side * x, y, p.thickness / 2), DOWN)
    return body


def build(p: P) -> Compound:
    """Puts the pin through the leaves' knuckles."""
    half, inner, mid = p.length / 2, p.length / 2 - p.outer, p.middle / 2
    left = leaf(p, -1, [(-half, -inner), (inner, half)], [(-inner, inner)])
    right = leaf(p, 1, [(-mid, mid)], [(-half, -mid), (mid, half)])
    pin = rod(p.pin, p.length + p.tail, (0, half, 0), FRONT) + rod(p.head, p.head_height, (0, half, 0), BACK)
    washer = rod(p.washer, p.washer_thickness, (0, -half, 0), FRONT) - rod(
        p.bore, p.washer_thickness, (0, -half, 0), FRONT
    )
    return assembly(
        [
            named(left, "Left leaf", "SteelBlue"),
            named(right, "Right leaf", "LightSteelBlue"),
            named(pin, "Hinge pin", "Goldenrod"),
            named(washer, "Washer", "DimGray"),
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked by a joiner, a buyer, an assembly planner and a student."""
    half = p.length / 2
    return [
        count("hole with bevel", "How many countersunk screw holes are there on both leaves together?", 6),
        texts(
            "object", "List the names of all bodies in this file.", ["Left leaf", "Right leaf", "Hinge pin", "Washer"]
        ),
        count("object", "number of separate parts?", 4),
        length("screw head", "diameter", "What's the diameter of the hinge pin's head?", p.head),
        length("rod", "length", "Total length of the hinge pin, head included?", p.length + p.tail + p.head_height),
        length("object", "thickness", "How thick is the sheet of the leaves? one value", p.thickness),
        count("tube", "How many tubular knuckles belong to the left leaf?", 2),
        length("tube", "diameter", "Outer diameter of the right leaf's knuckle?", p.knuckle),
        length("tube", "length", "How long is the knuckle of the right leaf, measured along y?", p.middle),
        length("ring", "diameter", "Outside dia of the washer", p.washer),
        length("ring", "thickness", "How thick is the washer?", p.washer_thickness),
        point("ring", "Where's the washer's centre?", (0, -half - p.washer_thickness / 2, 0)),
        volume(
            "ring",
            "What volume of material does the washer have?",
            pi / 4 * (p.washer**2 - p.bore**2) * p.washer_thickness,
        ),
        lengths(
            "hole with bevel",
            "diameter",
            "What are the diameters of the countersunk holes, without the bevel?",
            [p.hole] * 6,
        ),
        points(
            "mounting hole",
            "Centres of the three screw holes in the right leaf?",
            [(x, y, 0) for x, y in p.holes()],
        ),
        length(
            "mounting hole",
            "distance",
            "In the left leaf, what is the greatest distance between two screw holes along y (centre to centre)?",
            p.far_y,
        ),
        exists("nut hole", "Does the hinge have any nuts?", False),
        size(
            "object",
            "How large is the opened hinge overall (x by y by z)?",
            (2 * p.leaf, p.length + p.tail + p.head_height, p.knuckle),
        ),
    ]
