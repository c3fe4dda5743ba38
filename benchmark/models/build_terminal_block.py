"""A pluggable terminal block: housing with rectangular wire chambers, clamping screws from above, solder pins below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part, Pos

from benchmark.kit import Item, Model, count, length, lengths, points, size
from benchmark.shapes import DOWN, assembly, block, named, rod

MODEL = Model("Terminal block", "dev", bodies=13)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the housing's underside lies on z = 0, wires enter from the front, pins point down."""

    poles: int = 6
    pitch: float = 5.08
    margin: float = 1.2
    depth: float = 12
    height: float = 14
    chamber: tuple[float, float, float] = (3.6, 8, 4)  # width, depth, height
    chamber_floor: float = 2
    shaft: float = 3.8  # for the screw
    screw: float = 3.4
    screw_height: float = 3
    screw_from_top: float = 2
    slit: tuple[float, float] = (0.6, 0.8)  # of the screw head: width, depth
    screw_y: float = -1
    pin: tuple[float, float, float] = (1, 1, 3.5)
    pin_y: float = 2.5

    @property
    def width(self) -> float:
        """Of the housing."""
        return self.poles * self.pitch + 2 * self.margin

    def columns(self) -> list[float]:
        """Where are the poles along x?"""
        return [(index - (self.poles - 1) / 2) * self.pitch for index in range(self.poles)]


def build(p: P) -> Compound:
    """One housing, and a screw and a pin for each pole."""
    mouth = -p.depth / 2
    _, depth, height = p.chamber
    well = p.height - p.chamber_floor - height
    tools: list[Part] = []
    for x in p.columns():
        tools.append(block(p.chamber, (x, mouth + depth / 2, p.chamber_floor)))
        tools.append(rod(p.shaft, well, (x, p.screw_y, p.height), DOWN))
    housing = block((p.width, p.depth, p.height)) - tools
    screw = rod(p.screw, p.screw_height) - block((p.screw, *p.slit), (0, 0, p.screw_height - p.slit[1]))
    bodies = [named(housing, "Housing", "SeaGreen")]
    seat = p.height - p.screw_from_top - p.screw_height
    for x in p.columns():
        bodies.append(named(Pos(x, p.screw_y, seat) * screw, "Slotted screw", "Silver"))
        bodies.append(named(block(p.pin, (x, p.pin_y, -p.pin[2])), "Solder pin", "Gold"))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by people who design circuit boards."""
    n = p.poles
    return [
        count("rectangular pin", "How many rectangular pins stick out at the bottom?", n),
        lengths(
            "rectangular pin", "height", "How long are the rectangular solder pins below the housing?", [p.pin[2]] * n
        ),
        lengths("rectangular pin", "width", "What's the width of each solder pin?", [p.pin[0]] * n),
        length("rectangular pin", "distance", "Centre distance of neighbouring solder pins?", p.pitch),
        points(
            "rectangular pin",
            "List the centre coordinates of the solder pins.",
            [(x, p.pin_y, -p.pin[2] / 2) for x in p.columns()],
        ),
        count("screw", "How many screws has the terminal block?", n),
        lengths("screw", "diameter", "What is the diameter of the slotted screws?", [p.screw] * n),
        lengths("screw", "height", "How high (long) is each of the slotted screws?", [p.screw_height] * n),
        count(
            "rectangular indentation", "How many rectangular indentations for wires are in the front of the housing?", n
        ),
        lengths(
            "rectangular indentation",
            "width",
            "How wide are the rectangular wire openings in the front?",
            [p.chamber[0]] * n,
        ),
        lengths(
            "rectangular indentation",
            "height",
            "What is the height of the rectangular openings at the front side?",
            [p.chamber[2]] * n,
        ),
        lengths(
            "rectangular indentation",
            "depth",
            "How deep do the rectangular wire openings go into the housing from the front?",
            [p.chamber[1]] * n,
        ),
        size("object", "What are the outer dimensions of the green housing?", (p.width, p.depth, p.height)),
        count("object", "How many bodies?", 1 + 2 * n),
        length("object", "height", "Total height, with the pins?", p.height + p.pin[2]),
    ]
