"""The lower half of a pipe clamp: two semicircular seats in one block, screw holes beside and between them."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths, point, points, size
from benchmark.shapes import BACK, DOWN, block, rod

MODEL = Model("Half of a double pipe clamp", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the underside lies on z = 0, the pipes run along y with their axes in the top face."""

    size: tuple[float, float, float] = (122, 36, 30)
    pipe: float = 28
    pipe_spacing: float = 56
    screw: float = 9
    screw_spread: float = 102  # of the outer ones; one more is in the middle
    head: float = 14
    head_depth: float = 6

    def screws(self) -> list[float]:
        """Where are the screws along x?"""
        return [-self.screw_spread / 2, 0, self.screw_spread / 2]


def build(p: P) -> Part:
    """Bores the seats, drills the screw holes; the middle one is counterbored from above."""
    top, half = p.size[2], p.size[1] / 2
    tools = [rod(p.pipe, p.size[1], (side * p.pipe_spacing / 2, -half, top), BACK) for side in (-1, 1)]
    tools += [rod(p.screw, top, (x, 0, 0)) for x in p.screws()]
    return block(p.size) - [*tools, rod(p.head, p.head_depth, (0, 0, top), DOWN)]


def questions(p: P) -> list[Item]:
    """Asked by plumbers and by students."""
    middle = p.size[2] / 2
    return [
        count("semicircle", "How many semicircles are cut into the top?", 2),
        lengths("semicircle", "radius", "What is the radius of the semicircular seats?", [p.pipe / 2] * 2),
        lengths("semicircle", "diameter", "Give me the diameters of the two semicircular grooves.", [p.pipe] * 2),
        length(
            "semicircle", "distance", "What is the distance between the axes of the two semicircles?", p.pipe_spacing
        ),
        lengths("semicircle", "depth", "How deep do the semicircles go below the top face?", [p.pipe / 2] * 2),
        count("through hole", "How many vertical through holes has the clamp half?", 3),
        lengths(
            "through hole",
            "diameter",
            "Which diameter have the screw holes (for the stepped one take its narrow bore)?",
            [p.screw] * 3,
        ),
        count("hole", "How many counterbored holes are on top?", 1),
        point("hole", "Where's the centre of the counterbored hole, half-way between top and bottom?", (0, 0, middle)),
        length("hole", "diameter", "What is the diameter of the counterbore in the top?", p.head),
        length("hole", "depth", "What is the depth of the wide step of the counterbored hole?", p.head_depth),
        points("through hole", "Give the centres of all the screw holes.", [(x, 0, middle) for x in p.screws()]),
        length("object", "width", "How wide is the clamp?", p.size[0]),
        size("rectangular part", "What size is this block-shaped part?", p.size),
    ]
