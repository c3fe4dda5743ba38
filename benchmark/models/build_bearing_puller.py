"""A two-legged bearing puller: crosshead with forks, spindle with hexagon and tip, tommy bar, bolted legs."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians, tan

from build123d import Compound, Part

from benchmark.kit import Item, Model, angle, count, exists, length, lengths, point, size, texts, volume
from benchmark.shapes import BACK, DOWN, FRONT, RIGHT, assembly, block, cone, named, prism, rod

MODEL = Model("Bearing puller with two legs", "dev", bodies=9)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the spindle's axis is z, the crosshead lies along x about the origin, the legs hang down."""

    crosshead: tuple[float, float, float] = (140, 36, 24)
    fork: tuple[float, float] = (25, 13)  # of the slots in its ends, along x and y
    leg: tuple[float, float] = (20, 12)  # along x and y
    leg_top: float = 10
    leg_bottom: float = -130
    claw: tuple[float, float] = (18, 10)  # inwards, height
    legs: float = 115  # between the legs' middles and the bolts' axes
    bolt: float = 10
    bolt_hole: float = 10.5
    bolt_length: float = 50  # below the head
    flats: float = 16  # ISO 4017, ISO 4032
    bolt_head: float = 6.4
    nut: float = 8.4
    spindle: float = 14
    spindle_top: float = 60  # where the hexagon begins
    spindle_bottom: float = -100  # where the tip begins
    hexagon: float = 22
    hexagon_height: float = 16
    tip: float = 4  # smallest diameter
    tip_angle: float = 60  # from flank to flank
    bar: float = 8
    bar_length: float = 150

    @property
    def tip_length(self) -> float:
        """How long is the conical tip?"""
        return (self.spindle - self.tip) / 2 / tan(radians(self.tip_angle / 2))

    @property
    def bar_z(self) -> float:
        """How high does the tommy bar lie? In the middle of the hexagon."""
        return self.spindle_top + self.hexagon_height / 2


def crosshead(p: P) -> Part:
    """A beam with a hole in the middle and a drilled fork at either end."""
    width, depth, height = p.crosshead
    body = block(p.crosshead, (0, 0, -height / 2)) - rod(p.spindle, height, (0, 0, -height / 2))
    for side in (-1, 1):
        body -= block((*p.fork, height), (side * (width - p.fork[0]) / 2, 0, -height / 2))
        body -= rod(p.bolt_hole, depth, (side * p.legs / 2, -depth / 2, 0), BACK)
    return body


def leg(p: P, side: int) -> Part:
    """A bar with a claw that points to the middle."""
    x = side * p.legs / 2
    body = block((*p.leg, p.leg_top - p.leg_bottom), (x, 0, p.leg_bottom))
    body += block((p.claw[0], p.leg[1], p.claw[1]), (x - side * (p.leg[0] + p.claw[0]) / 2, 0, p.leg_bottom))
    return body - rod(p.bolt_hole, p.leg[1], (x, -p.leg[1] / 2, 0), BACK)


def build(p: P) -> Compound:
    """Bolts the legs into the forks, puts the spindle through the crosshead."""
    spindle = rod(p.spindle, p.spindle_top - p.spindle_bottom, (0, 0, p.spindle_bottom))
    spindle += cone(p.spindle, p.tip, p.tip_length, (0, 0, p.spindle_bottom), DOWN)
    spindle += prism(p.hexagon, p.hexagon_height, (0, 0, p.spindle_top), rotation=30)
    start = (-p.bar_length / 2, 0, p.bar_z)
    spindle -= rod(p.bar, p.bar_length, start, RIGHT)
    half = p.crosshead[1] / 2
    bodies = [
        named(crosshead(p), "Crosshead", "SteelBlue"),
        named(spindle, "Spindle", "Silver"),
        named(rod(p.bar, p.bar_length, start, RIGHT), "Tommy bar", "DimGray"),
    ]
    for side, name in ((-1, "left"), (1, "right")):
        x = side * p.legs / 2
        bolt = rod(p.bolt, p.bolt_length, (x, -half, 0), BACK) + prism(p.flats, p.bolt_head, (x, -half, 0), FRONT)
        nut = prism(p.flats, p.nut, (x, half, 0), BACK) - rod(p.bolt, p.nut, (x, half, 0), BACK)
        bodies += [
            named(leg(p, side), f"Leg {name}", "IndianRed"),
            named(bolt, f"Bolt {name}", "Goldenrod"),
            named(nut, f"Nut {name}", "Gold"),
        ]
    return assembly(bodies)


def questions(p: P) -> list[Item]:
    """Asked by a car mechanic, a toolmaker, a tool shop's clerk and an apprentice."""
    spindle = p.spindle_top - p.spindle_bottom
    return [
        count("object", "Of how many bodies does this puller consist?", 9),
        texts("nut", "what are the nuts called in the model tree", ["Nut left", "Nut right"]),
        length("shaft", "diameter", "spindle dia", p.spindle),
        length(
            "shaft",
            "length",
            "spindle: length over everything, hexagon and point included",
            spindle + p.hexagon_height + p.tip_length,
        ),
        length("hexagon", "width", "what wrench size fits on the hexagon of the spindle?", p.hexagon),
        angle(
            "cone",
            "The spindle ends in a conical point. What's the included angle of it, from flank to flank?",
            p.tip_angle,
        ),
        length(
            "leg",
            "distance",
            "Hello, I would like to know if my pulley fits between the claws of the two legs. What clear width is "
            "there from claw to claw?",
            p.legs - p.leg[0] - 2 * p.claw[0],
        ),
        length(
            "leg",
            "distance",
            "Reach of the puller = vertical distance from the underside of the crosshead down to the upper face of a "
            "claw. How much is it?",
            -p.crosshead[2] / 2 - p.leg_bottom - p.claw[1],
        ),
        lengths("leg", "thickness", "how thick are the legs in y direction", [p.leg[1]] * 2),
        lengths(
            "hexagonal screw head",
            "height",
            "The legs are hung on two hexagon bolts. What height do the heads of the bolts have?",
            [p.bolt_head] * 2,
        ),
        lengths(
            "hexagonal screw", "length", "leg bolts, length under the head (head not counted)?", [p.bolt_length] * 2
        ),
        lengths(
            "rectangular slot",
            "width",
            "what is the width (in y) of the slots in the ends of the crosshead",
            [p.fork[1]] * 2,
        ),
        size("rectangular part", "Could you give me the size of the crosshead?", p.crosshead),
        point("rod", "where's the middle of the tommy bar", (0, 0, p.bar_z)),
        volume(
            "rod", "volume of the tommy bar? (its weight I will compute by myself)", pi / 4 * p.bar**2 * p.bar_length
        ),
        exists("ring", "Are washers used anywhere in this assembly, yes or no?", False),
        length(
            "object",
            "height",
            "total height of the puller as it is drawn here, from the lowest point of the legs to the top",
            p.spindle_top + p.hexagon_height - p.leg_bottom,
        ),
    ]
