"""A stepped drive shaft: three diameters, a feather keyway, a ring groove, bevelled ends, a tapped centre hole."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Item, Model, count, length, point, size
from benchmark.shapes import LEFT, RIGHT, UP, drill, rod, slot

MODEL = Model("Stepped drive shaft", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the left end lies at x = 0."""

    left: tuple[float, float] = (25, 45)  # diameter, length
    middle: tuple[float, float] = (40, 70)
    right: tuple[float, float] = (30, 60)
    bevel: float = 1.5
    key_length: float = 40
    key_width: float = 8  # DIN 6885 for a 30 mm shaft
    key_depth: float = 4
    key_from_step: float = 8
    groove_width: float = 1.3
    groove_diameter: float = 23.9  # DIN 471 for a 25 mm shaft
    groove_at: float = 6
    tap: float = 8.5  # tap drill of M10
    tap_depth: float = 22

    @property
    def length(self) -> float:
        """Over all."""
        return self.left[1] + self.middle[1] + self.right[1]

    @property
    def step(self) -> float:
        """Where the right journal begins."""
        return self.left[1] + self.middle[1]


def build(p: P) -> Part:
    """Turns, bevels the ends, mills the keyway from above, drills the right end."""
    shaft = rod(p.left[0], p.left[1], along=RIGHT)
    shaft += rod(p.middle[0], p.middle[1], (p.left[1], 0, 0), RIGHT)
    shaft += rod(p.right[0], p.right[1], (p.step, 0, 0), RIGHT)
    ends = shaft.edges().group_by(Axis.X)
    shaft = chamfer(ends[0] + ends[-1], p.bevel)
    ring = rod(p.left[0], p.groove_width, (p.groove_at, 0, 0), RIGHT)
    ring -= rod(p.groove_diameter, p.groove_width, (p.groove_at, 0, 0), RIGHT)
    floor = p.right[0] / 2 - p.key_depth
    key = slot(p.key_length, p.key_width, 2 * p.key_depth, (p.step + p.key_from_step + p.key_length / 2, 0, floor), UP)
    return shaft - [ring, key, drill(p.tap, p.tap_depth, (p.length, 0, 0), LEFT)]


def questions(p: P) -> list[Item]:
    """Asked by turners and by students of machine elements."""
    return [
        length("shaft", "length", "How long is the shaft in total?", p.length),
        length("shaft", "diameter", "What is the biggest diameter of the shaft?", p.middle[0]),
        length("shaft", "radius", "What is the radius of the thickest section of the shaft?", p.middle[0] / 2),
        length("shaft", "length", "What is the length of the shaft section with a diameter of 40 mm?", p.middle[1]),
        length("shaft", "diameter", "What is the diameter of the journal at the left end of the shaft?", p.left[0]),
        count("slot", "How many keyways are milled into the shaft?", 1),
        length("slot", "width", "What is the width of the keyway on the top?", p.key_width),
        length("slot", "length", "Length of the key slot including the round ends?", p.key_length),
        length(
            "bevel", "size", "How large is the 45 degree chamfer at the shaft's ends, measured along the axis?", p.bevel
        ),
        count("bevel", "How many bevelled ends has the shaft?", 2),
        length("threaded hole", "diameter", "What is the core diameter of the threaded hole in the right end?", p.tap),
        length(
            "threaded hole",
            "depth",
            "How deep is the hole visible from the right, not counting the drill tip?",
            p.tap_depth,
        ),
        point("shaft", "Where is the centre of the shaft's bounding box?", (p.length / 2, 0, 0)),
        length("groove", "width", "What is the width of the retaining ring groove?", p.groove_width),
        length(
            "groove", "diameter", "To which diameter is the circlip groove turned at its bottom?", p.groove_diameter
        ),
        size("object", "What size is the shaft (x, y, z)?", (p.length, p.middle[0], p.middle[0])),
    ]
