"""A machine's levelling foot in inches: round base with cone and screw holes, rubber pad, stem, hexagon nut."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import INCH, Item, Model, count, length, lengths, size, text
from benchmark.shapes import DOWN, assembly, block, cone, named, prism, rod

MODEL = Model("Levelling foot", "held_out", unit="in", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres, from inches; the base lies on z = 0, the rubber pad hangs below, the stem is the z axis."""

    base: float = 3 * INCH
    base_height: float = 0.5 * INCH
    cone: tuple[float, float] = (1.5 * INCH, 1 * INCH)  # lower and upper diameter
    cone_height: float = 0.6 * INCH
    hole: float = 0.34 * INCH
    hole_span: float = 2.2 * INCH
    pad: float = 1.7 * INCH
    pad_height: float = 0.2 * INCH
    stem: float = 0.625 * INCH
    stem_depth: float = 0.4 * INCH  # inside the cone
    stem_out: float = 4.5 * INCH  # above the cone
    screwdriver: tuple[float, float] = (0.1 * INCH, 0.15 * INCH)  # width, depth
    flats: float = 0.9375 * INCH
    nut: float = 0.375 * INCH
    nut_from_end: float = 2 * INCH

    @property
    def levels(self) -> tuple[float, float, float]:
        """Where on z are the cone's upper end, the stem's lower and its upper end?"""
        shoulder = self.base_height + self.cone_height
        return shoulder, shoulder - self.stem_depth, shoulder + self.stem_out


def build(p: P) -> Compound:
    """The stem stands in a blind hole of the base and carries the nut."""
    _, low, high = p.levels
    base = rod(p.base, p.base_height) + cone(*p.cone, p.cone_height, (0, 0, p.base_height))
    base -= [rod(p.hole, p.base_height, (x, 0, 0)) for x in (-p.hole_span / 2, p.hole_span / 2)]
    base -= rod(p.stem, p.stem_depth, (0, 0, low))
    width, depth = p.screwdriver
    stem = rod(p.stem, high - low, (0, 0, low)) - block((p.stem + 1, width, depth), (0, 0, high - depth))
    seat = (0, 0, high - p.nut_from_end)
    nut = prism(p.flats, p.nut, seat) - rod(p.stem, p.nut, seat)
    return assembly(
        [
            named(base, "Foot", "Silver"),
            named(rod(p.pad, p.pad_height, (0, 0, 0), DOWN), "Rubber pad", "Black"),
            named(stem, "Threaded stem", "SteelBlue"),
            named(nut, "Jam nut", "Goldenrod"),
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a millwright, a buyer and a line planner."""
    shoulder, _, high = p.levels
    return [
        length("circular base", "diameter", "State the outer diameter of the circular base.", p.base),
        length("circular base", "thickness", "Thickness of the circular base, without the cone?", p.base_height),
        length("cone", "height", "Determine the height of the cone.", p.cone_height),
        length("cone", "diameter", "Give me the diameter of the cone where it is narrowest.", p.cone[1]),
        count("mounting hole", "How many mounting holes does the foot have?", 2),
        lengths("mounting hole", "radius", "Radius of the mounting holes in the foot?", [p.hole / 2] * 2),
        length("mounting hole", "distance", "Center-to-center distance of the two mounting holes?", p.hole_span),
        length("rod", "diameter", "What diameter does the threaded stem have?", p.stem),
        length("slot", "width", "Width of the slot at the upper end of the stem?", p.screwdriver[0]),
        size("object", "Overall size of the complete assembly in x, y and z?", (p.base, p.base, p.pad_height + high)),
        length("nut", "width", "wrench size of the jam nut, i.e. across its flats", p.flats),
        length("nut", "height", "how tall is the nut?", p.nut),
        length("rod", "height", "And the stem - how far does it stick up above the cone?", high - shoulder),
        text("object", "Which component of the assembly sits lowest? Its name please.", "Rubber pad"),
    ]
