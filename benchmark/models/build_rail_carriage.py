"""A linear guide: a rail with counterbored holes, a carriage on it with two end caps and a grease nipple."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part

from benchmark.kit import Item, Model, count, length, lengths, point, points, size, text
from benchmark.shapes import BACK, DOWN, FRONT, assembly, block, cone, drill, grid, named, rod

MODEL = Model("Linear guide with carriage", "dev", bodies=5)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the rail lies on z = 0 along y, its middle x = y = 0; the carriage stands in the middle."""

    rail: tuple[float, float, float] = (20, 220, 17.5)
    track: float = 3  # radius of the balls' half-round tracks, in the rail's flanks
    track_z: float = 11
    holes: int = 4
    hole: float = 6
    hole_head: float = 9.5
    hole_head_depth: float = 8.5
    hole_pitch: float = 60
    carriage: tuple[float, float, float] = (44, 50, 25.4)
    height: float = 30  # of the carriage's upper face
    channel: float = 20.8
    channel_top: float = 18.5
    screws: tuple[float, float] = (32, 36)  # pattern, x and y
    screw: float = 4.2  # core hole of M5
    screw_depth: float = 8
    cap: tuple[float, float, float] = (42, 12, 22)
    nipple: float = 6
    nipple_length: float = 9
    nipple_tip: float = 4  # length of its cone
    nipple_z: float = 24

    def rail_holes(self) -> list[float]:
        """Where are the rail's holes, y?"""
        return [(index - (self.holes - 1) / 2) * self.hole_pitch for index in range(self.holes)]


def rail(p: P) -> Part:
    """With its tracks and holes."""
    _, depth, height = p.rail
    body = block(p.rail)
    body -= [rod(2 * p.track, depth, (x, -depth / 2, p.track_z), BACK) for x in (-p.rail[0] / 2, p.rail[0] / 2)]
    for y in p.rail_holes():
        body -= rod(p.hole, height, (0, y, 0))
        body -= rod(p.hole_head, p.hole_head_depth, (0, y, height), DOWN)
    return body


def carriage(p: P) -> Part:
    """Bridges the rail; tapped on top."""
    low = p.height - p.carriage[2]
    body = block(p.carriage, (0, 0, low)) - block((p.channel, p.carriage[1], p.channel_top - low), (0, 0, low))
    return body - [drill(p.screw, p.screw_depth, (x, y, p.height)) for x, y in grid(2, 2, *p.screws)]


def cap(p: P, y: float) -> Part:
    """Goes on one end of the carriage, `y` its middle."""
    low = p.height - p.carriage[2]
    return block(p.cap, (0, y, low)) - block((p.channel, p.cap[1], p.channel_top - low), (0, y, low))


def build(p: P) -> Compound:
    """Slides the carriage on the rail."""
    y = (p.carriage[1] + p.cap[1]) / 2
    face = y + p.cap[1] / 2
    straight = p.nipple_length - p.nipple_tip
    nipple = rod(p.nipple, straight, (0, -face, p.nipple_z), FRONT)
    nipple += cone(p.nipple, p.nipple / 2, p.nipple_tip, (0, -face - straight, p.nipple_z), FRONT)
    return assembly(
        [
            named(rail(p), "Guide rail", "Silver"),
            named(carriage(p), "Carriage", "SlateGray"),
            named(cap(p, -y), "End cap front", "ForestGreen"),
            named(cap(p, y), "End cap rear", "ForestGreen"),
            named(nipple, "Grease nipple", "Goldenrod"),
        ]
    )


def questions(p: P) -> list[Item]:
    """Asked by machine builders, a robot's programmer and a purchaser."""
    hidden = sum(abs(y) < p.carriage[1] / 2 + p.cap[1] for y in p.rail_holes())
    return [
        length("object", "length", "How long is the guide rail?", p.rail[1]),
        length("object", "width", "rail width in mm", p.rail[0]),
        count("hole", "How many counterbored holes has the guide rail?", p.holes),
        count("hole", "How many of the rail's holes can be seen from the top?", p.holes - hidden),
        lengths("through hole", "diameter", "Bore diameters of the holes in the guide rail?", [p.hole] * p.holes),
        length(
            "hole",
            "distance",
            "What is the spacing of neighbouring holes along the rail (pitch)?",
            p.hole_pitch,
        ),
        point(
            "hole",
            "Which is the centre of the rail hole nearest to the front?",
            (0, p.rail_holes()[0], p.rail[2] / 2),
        ),
        size("rectangular part", "Size of the carriage without the end caps, please", p.carriage),
        count("threaded hole", "How many M5 tapped holes does the carriage have on its top side?", 4),
        lengths("threaded hole", "depth", "how deep are the threaded holes in the carriage", [p.screw_depth] * 4),
        length(
            "threaded hole",
            "distance",
            "Distance in x direction between the threaded holes of the carriage?",
            p.screws[0],
        ),
        points(
            "threaded hole",
            "I want to drive a screwdriver to the tapped holes on the carriage. Give me their centre positions.",
            [(x, y, p.height - p.screw_depth / 2) for x, y in grid(2, 2, *p.screws)],
        ),
        length("rectangular slot", "width", "How wide is the channel on the underside of the carriage?", p.channel),
        length("rectangular part", "thickness", "Thickness of the front end cap?", p.cap[1]),
        length("rod", "diameter", "What is the diameter of the grease nipple?", p.nipple),
        length("cone", "height", "How long is the cone at the tip of the nipple?", p.nipple_tip),
        length(
            "object",
            "height",
            "How tall is the complete guide, from the rail's underside to the carriage top?",
            p.height,
        ),
        length("object", "distance", "How much longer is the guide rail than the carriage?", p.rail[1] - p.carriage[1]),
        text("object", "What is the name of the smallest body?", "Grease nipple"),
    ]
