"""Two plates held by four hexagonal screws with washers and nuts: every body named and coloured."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass

from build123d import Compound, Part, Pos

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import DOWN, assembly, block, grid, named, prism, rod

MODEL = Model("Screwed plate joint", "dev", bodies=14)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the lower plate lies on z = 0; M10 screws by ISO 4017, washers by ISO 7089, nuts by ISO 4032."""

    lower: tuple[float, float, float] = (140, 90, 12)
    upper: tuple[float, float, float] = (100, 90, 8)
    clearance: float = 11
    span: tuple[float, float] = (70, 60)
    screws: int = 4
    screw: float = 10
    screw_length: float = 40
    flats: float = 16
    head_height: float = 6.4
    washer: float = 20
    washer_hole: float = 10.5
    washer_height: float = 2
    nut_height: float = 8.4

    @property
    def top(self) -> float:
        """Of the upper plate."""
        return self.lower[2] + self.upper[2]

    def at(self) -> list[tuple[float, float]]:
        """Where are the screws?"""
        return grid(2, self.screws // 2, *self.span)


def plate(p: P, size_mm: tuple[float, float, float]) -> Part:
    """Drilled for the screws; on z = 0."""
    return block(size_mm) - [rod(p.clearance, size_mm[2], (x, y, 0)) for x, y in p.at()]


def build(p: P) -> Compound:
    """Stacks the plates, then a washer, a screw and a nut at each place."""
    bodies = [
        named(plate(p, p.lower), "Lower plate", "SlateGray"),
        named(plate(p, p.upper), "Upper plate", "SteelBlue", Pos(0, 0, p.lower[2])),
    ]
    washer = rod(p.washer, p.washer_height) - rod(p.washer_hole, p.washer_height)
    screw = prism(p.flats, p.head_height) + rod(p.screw, p.screw_length, along=DOWN)
    nut = prism(p.flats, p.nut_height) - rod(p.screw, p.nut_height)
    for x, y in p.at():
        seat = p.top + p.washer_height
        bodies.append(named(copy(washer), "Washer 10 ISO 7089", "Gold", Pos(x, y, p.top)))
        bodies.append(
            named(copy(screw), f"Hexagon screw M{p.screw:g}x{p.screw_length:g}", "Firebrick", Pos(x, y, seat))
        )
        bodies.append(named(copy(nut), "Hexagon nut M10", "DarkGreen", Pos(x, y, -p.nut_height)))
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by assemblers and by those who program their robots."""
    head = p.top + p.washer_height + p.head_height
    tip = head - p.head_height - p.screw_length
    middle = (head + tip) / 2
    n = p.screws
    return [
        count("hexagonal screw", "How many hexagonal screws are used in this assembly?", n),
        count("object", "How many bodies does the whole assembly contain?", 2 + 3 * n),
        count("ring", "How many washers (flat rings) are there?", n),
        lengths("ring", "diameter", "What is the outer diameter of the washers?", [p.washer] * n),
        lengths("ring", "thickness", "How thick are the washers?", [p.washer_height] * n),
        count("nut", "How many nuts does the joint need?", n),
        lengths("nut", "height", "Height of the nuts?", [p.nut_height] * n),
        lengths(
            "hexagonal screw head", "height", "How high are the hexagonal heads of the screws?", [p.head_height] * n
        ),
        lengths(
            "hexagonal screw", "diameter", "What is the diameter of the shanks of the hexagonal screws?", [p.screw] * n
        ),
        points(
            "hexagonal screw",
            "Give the centre of the bounding box of each hexagon screw.",
            [(x, y, middle) for x, y in p.at()],
        ),
        size("rectangular part", "What is the size of the rectangular part called upper plate?", p.upper),
        length("rectangular part", "thickness", "How thick is the lower plate?", p.lower[2]),
        lengths(
            "through hole", "diameter", "What diameter have the through holes of the lower plate?", [p.clearance] * n
        ),
        point("object", "Where is the center of the upper plate?", (0, 0, p.lower[2] + p.upper[2] / 2)),
        length(
            "object",
            "height",
            "How high is the assembly from the screw tips to the top of the screw heads?",
            head - tip,
        ),
        count("object", "How many red bodies are in the assembly?", n),
    ]
