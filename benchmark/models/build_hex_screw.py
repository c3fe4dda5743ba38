"""A hexagonal head screw after ISO 4017 with a washer face and a bevelled tip, stored as B-splines, lying along x."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Form, Item, Model, count, length, point, size
from benchmark.shapes import LEFT, RIGHT, cone, prism, rod

MODEL = Model("Hexagonal head screw", "dev", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the head's bearing face lies on x = 0 and the shank points to +x; M16 by ISO 4017."""

    shank: float = 16
    length: float = 60
    flats: float = 24
    head_height: float = 10
    washer: float = 22
    washer_height: float = 0.6
    tip: float = 2  # bevel of the point, 45 degrees

    @property
    def corners(self) -> float:
        """Across the head's corners."""
        return self.flats * 2 / 3**0.5


def build(p: P) -> Part:
    """Head, washer face, shank, point."""
    head = prism(p.flats, p.head_height - p.washer_height, (-p.washer_height, 0, 0), LEFT)
    head += rod(p.washer, p.washer_height, along=LEFT)
    straight = p.length - p.tip
    return (
        head + rod(p.shank, straight, along=RIGHT) + cone(p.shank, p.shank - 2 * p.tip, p.tip, (straight, 0, 0), RIGHT)
    )


def questions(p: P) -> list[Item]:
    """Asked by people who look for the right spanner."""
    return [
        count("hexagonal screw", "How many hexagonal screws do you see in the model?", 1),
        length(
            "hexagonal screw",
            "length",
            "Total length of the hexagonal screw, head and shank together?",
            p.length + p.head_height,
        ),
        length(
            "hexagonal screw head",
            "height",
            "What is the height of the hexagonal screw head along its axis, washer face included?",
            p.head_height,
        ),
        length(
            "hexagonal screw head",
            "width",
            "Which spanner fits, so what is the width across flats of the hexagonal head?",
            p.flats,
        ),
        length("screw", "length", "How long is the screw's shank below the head, tip included?", p.length),
        length("screw", "diameter", "What is the diameter of the screw's shank?", p.shank),
        length("screw", "radius", "radius of the cylindrical shank of the screw", p.shank / 2),
        length("bevel", "size", "How long is the bevel at the tip of the screw, measured along the axis?", p.tip),
        length(
            "circular protrusion", "diameter", "What is the diameter of the round washer face under the head?", p.washer
        ),
        point(
            "screw", "Where is the centre of the whole screw's bounding box?", ((p.length - p.head_height) / 2, 0, 0)
        ),
        size(
            "object", "Bounding box of the screw in x, y, z?", (p.length + p.head_height, p.corners, p.flats), "extents"
        ),
    ]
