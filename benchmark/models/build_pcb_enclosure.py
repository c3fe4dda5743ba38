"""An electronics housing: open box with standoffs with and without hole, cable cutout, rectangular windows, lugs."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Item, Model, count, length, lengths, points, size
from benchmark.shapes import BACK, block, grid, rod

MODEL = Model("Enclosure for a circuit board", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the floor's underside lies on z = 0, the box is open to the top."""

    size: tuple[float, float, float] = (120, 86, 40)
    wall: float = 3
    corner: float = 6
    with_hole: int = 4
    standoff: float = 7
    standoff_height: float = 8
    standoff_hole: float = 2.5  # tap drill of M3
    standoff_depth: float = 7
    standoff_span: tuple[float, float] = (90, 56)
    without_hole: int = 2
    peg: float = 5
    peg_height: float = 11
    peg_spacing: float = 50
    cutout: tuple[float, float] = (26, 14)
    cutout_rise: float = 22
    glands: int = 2
    gland: float = 12.5
    gland_spacing: float = 40
    gland_rise: float = 22

    @property
    def inside(self) -> tuple[float, float, float]:
        """Of the hollow."""
        return (self.size[0] - 2 * self.wall, self.size[1] - 2 * self.wall, self.size[2] - self.wall)


def build(p: P) -> Part:
    """Hollows the box, plants standoffs on its floor, opens the front and the back wall."""
    box = fillet(block(p.size).edges().filter_by(Axis.Z), p.corner)
    hollow = fillet(block(p.inside, (0, 0, p.wall)).edges().filter_by(Axis.Z), p.corner - p.wall)
    body = box - hollow
    tops = p.wall + p.standoff_height
    posts = grid(2, 2, *p.standoff_span)
    body += [rod(p.standoff, p.standoff_height, (x, y, p.wall)) for x, y in posts]
    body += [rod(p.peg, p.peg_height, (x, y, p.wall)) for x, y in grid(p.without_hole, 1, p.peg_spacing, 0)]
    tools = [rod(p.standoff_hole, p.standoff_depth, (x, y, tops - p.standoff_depth)) for x, y in posts]
    front = -p.size[1] / 2
    tools.append(block((p.cutout[0], p.wall, p.cutout[1]), (0, front + p.wall / 2, p.cutout_rise - p.cutout[1] / 2)))
    for x, _ in grid(p.glands, 1, p.gland_spacing, 0):
        tools.append(rod(p.gland, p.wall, (x, -front - p.wall, p.gland_rise), BACK))
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by electronics engineers."""
    tops = p.wall + p.standoff_height
    posts = grid(2, 2, *p.standoff_span)
    return [
        count("standoff with hole", "How many standoffs with a hole does the enclosure have?", p.with_hole),
        count("standoff without hole", "How many standoffs without a hole are there?", p.without_hole),
        lengths(
            "standoff with hole",
            "diameter",
            "What is the outer diameter of the standoffs that have a hole?",
            [p.standoff] * p.with_hole,
        ),
        lengths(
            "standoff with hole",
            "height",
            "How high are the standoffs with holes above the floor?",
            [p.standoff_height] * p.with_hole,
        ),
        lengths(
            "standoff without hole",
            "height",
            "Height of the solid standoffs without hole?",
            [p.peg_height] * p.without_hole,
        ),
        lengths(
            "standoff without hole",
            "radius",
            "What radius have the standoffs without a hole?",
            [p.peg / 2] * p.without_hole,
        ),
        lengths(
            "blind hole",
            "depth",
            "The screw holes of the standoffs: how deep are they?",
            [p.standoff_depth] * p.with_hole,
        ),
        points(
            "blind hole",
            "Where are the centres of the blind holes visible from the top?",
            [(x, y, tops - p.standoff_depth / 2) for x, y in posts],
        ),
        size(
            "rectangular inside",
            "What is the size of the rectangular inside of the box, from the floor to the rim?",
            p.inside,
        ),
        length(
            "rectangular inside",
            "depth",
            "How deep is the rectangular inside, measured from the rim down to the floor?",
            p.inside[2],
        ),
        length("cutout", "width", "What is the width of the rectangular cutout in the front wall?", p.cutout[0]),
        length("cutout", "height", "How high is the cutout at the front?", p.cutout[1]),
        count("hole", "How many round holes are in the back wall?", p.glands),
        lengths("hole", "diameter", "What is the diameter of the holes visible from the back?", [p.gland] * p.glands),
        length("object", "thickness", "What is the wall thickness of the housing?", p.wall),
        size("object", "Outer dimensions of the enclosure?", p.size),
    ]
