"""The lower half of a gear housing: an open box with a bolted rim, bearing bores, a drain port, feet and standoffs."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths, point, points, size, volume
from benchmark.shapes import BACK, LEFT, RIGHT, block, grid, rod

MODEL = Model("Gear housing, lower half", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the feet stand on z = 0, the box's middle is x = y = 0."""

    width: float = 140
    depth: float = 90
    height: float = 60  # of the box without feet
    wall: float = 6
    rim: float = 12  # how far the flange stands out
    rim_height: float = 8
    bolts: tuple[int, int] = (3, 2)
    bolt: float = 6.6
    foot: tuple[float, float, float] = (24, 20, 10)
    foot_x: float = 110
    foot_y: float = 66
    input_bore: float = 32  # in the left wall
    output_bore: float = 40  # in the right wall
    bore_height: float = 42
    drain: float = 8.5  # core hole of M10
    drain_height: float = 22
    standoffs: int = 4
    standoff: float = 10
    standoff_height: float = 15
    standoff_hole: float = 3.3  # core hole of M4
    standoff_hole_depth: float = 12
    standoff_x: float = 80
    standoff_y: float = 40

    @property
    def top(self) -> float:
        """Height of the rim's upper face."""
        return self.foot[2] + self.height

    @property
    def floor(self) -> float:
        """Height of the inner floor."""
        return self.foot[2] + self.wall


def build(p: P) -> Part:
    """Shells the box, adds rim and feet, bores."""
    z = p.foot[2]
    body = block((p.width, p.depth, p.height), (0, 0, z))
    body += block((p.width + 2 * p.rim, p.depth + 2 * p.rim, p.rim_height), (0, 0, p.top - p.rim_height))
    body += [block(p.foot, (x, y, 0)) for x, y in grid(2, 2, p.foot_x, p.foot_y)]
    body -= block((p.width - 2 * p.wall, p.depth - 2 * p.wall, p.height), (0, 0, p.floor))
    body += [rod(p.standoff, p.standoff_height, (x, y, p.floor)) for x, y in grid(2, 2, p.standoff_x, p.standoff_y)]
    tip = p.floor + p.standoff_height
    for x, y in grid(2, 2, p.standoff_x, p.standoff_y):
        body -= rod(p.standoff_hole, p.standoff_hole_depth, (x, y, tip - p.standoff_hole_depth))
    for x, y in _bolts(p):
        body -= rod(p.bolt, p.rim_height, (x, y, p.top - p.rim_height))
    body -= rod(p.input_bore, p.wall, (-p.width / 2 + p.wall, 0, p.bore_height), LEFT)
    body -= rod(p.output_bore, p.wall, (p.width / 2 - p.wall, 0, p.bore_height), RIGHT)
    return body - rod(p.drain, p.wall, (0, p.depth / 2 - p.wall, p.drain_height), BACK)


def questions(p: P) -> list[Item]:
    """Asked by a fitter, a designer and an assembly robot's programmer."""
    inside = (p.width - 2 * p.wall, p.depth - 2 * p.wall)
    return [
        count("mounting hole", "How many bolt holes does the flange have?", p.bolts[0] * p.bolts[1]),
        length("mounting hole", "diameter", "What is the diameter of one of the bolt holes in the rim?", p.bolt),
        length("hole", "diameter", "What diameter does the hole on the left side have?", p.input_bore),
        length("hole", "radius", "What is the radius of the largest hole visible from the right?", p.output_bore / 2),
        length("hole", "depth", "How deep is the hole which is visible from the back?", p.wall),
        point(
            "hole",
            "Where is the center of the largest hole?",
            (p.width / 2 - p.wall / 2, 0, p.bore_height),
        ),
        count("standoff with hole", "How many standoffs are inside the housing?", p.standoffs),
        lengths("standoff with hole", "height", "How tall are the standoffs?", [p.standoff_height] * p.standoffs),
        lengths(
            "standoff with hole",
            "diameter",
            "What is the outer diameter of the standoffs?",
            [p.standoff] * p.standoffs,
        ),
        lengths(
            "blind hole",
            "depth",
            "How deep are the blind holes in the standoffs?",
            [p.standoff_hole_depth] * p.standoffs,
        ),
        count("leg", "How many feet does the housing stand on?", 4),
        length("leg", "height", "How high is one foot?", p.foot[2]),
        length("leg", "distance", "How far apart are the two feet visible from the front?", p.foot_x - p.foot[0]),
        length("rectangular inside", "width", "How wide is the rectangular inside?", inside[0]),
        length("rectangular inside", "depth", "How deep is the inside, measured from the rim down?", p.top - p.floor),
        length("object", "thickness", "How thick are the walls of the box?", p.wall),
        size(
            "object",
            "Overall dimensions of the housing?",
            (p.width + 2 * p.rim, p.depth + 2 * p.rim, p.top),
        ),
        points(
            "mounting hole",
            "At which positions are the centres of the bolt holes?",
            [(x, y, p.top - p.rim_height / 2) for x, y in sorted(_bolts(p))],
        ),
        volume("rectangular part", "Which volume has a single foot?", p.foot[0] * p.foot[1] * p.foot[2]),
    ]


def _bolts(p: P) -> list[tuple[float, float]]:
    return grid(*p.bolts, (p.width + p.rim) / 2, p.depth + p.rim)
