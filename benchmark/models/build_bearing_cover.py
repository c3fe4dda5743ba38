"""A bearing cover: raised rings about its screw holes, a bevelled central hole, a centring collar below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths, points, size
from benchmark.shapes import DOWN, circle, cone, rod

MODEL = Model("Bearing cover", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the flange's underside lies on z = 0, the collar hangs below it."""

    flange: float = 110
    flange_height: float = 10
    collar: float = 72
    collar_inner: float = 60
    collar_height: float = 9
    bore: float = 32
    bevel: float = 2
    holes: int = 6
    hole: float = 6.6
    circle: float = 90
    ring: float = 13
    ring_height: float = 2.5

    def at(self) -> list[tuple[float, float]]:
        """Where are the screws?"""
        return circle(self.holes, self.circle)


def build(p: P) -> Part:
    """Flange, collar, rings; then the holes."""
    body = rod(p.flange, p.flange_height) + rod(p.collar, p.collar_height, along=DOWN)
    body -= rod(p.collar_inner, p.collar_height, along=DOWN)
    body += [rod(p.ring, p.ring_height, (x, y, p.flange_height)) for x, y in p.at()]
    top = p.flange_height
    tools = [rod(p.bore, top), cone(p.bore + 2 * p.bevel, p.bore, p.bevel, (0, 0, top), DOWN)]
    tools += [rod(p.hole, top + p.ring_height, (x, y, 0)) for x, y in p.at()]
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by designers of gear boxes."""
    through = p.flange_height + p.ring_height
    n = p.holes
    return [
        count("hole with ring", "How many holes with a ring around them are visible from the top?", n),
        lengths(
            "hole with ring", "diameter", "What is the diameter of the holes that have a raised ring?", [p.hole] * n
        ),
        lengths(
            "hole with ring",
            "depth",
            "How deep are the through holes with the raised rings, ring included?",
            [through] * n,
        ),
        points(
            "hole with ring",
            "Where are the centres of the holes that carry a ring?",
            [(x, y, through / 2) for x, y in p.at()],
        ),
        lengths(
            "ring", "diameter", "What is the outer diameter of the raised rings around the screw holes?", [p.ring] * n
        ),
        lengths("ring", "height", "How much do the small rings stand above the flange?", [p.ring_height] * n),
        length("hole with bevel", "diameter", "Diameter of the hole with the bevelled edge (the bore itself)?", p.bore),
        count("hole with bevel", "How many holes with a bevelled edge are there?", 1),
        length("bevel", "size", "How deep is the bevel of the central hole, measured along the axis?", p.bevel),
        length("circular base", "diameter", "What is the outer diameter of the cover's circular flange?", p.flange),
        length("tube", "diameter", "Which outside diameter has the tubular collar below the flange?", p.collar),
        length(
            "tube",
            "thickness",
            "What is the wall thickness of the collar at the bottom?",
            (p.collar - p.collar_inner) / 2,
        ),
        length("tube", "height", "How far does the collar protrude below the flange?", p.collar_height),
        length("object", "height", "total height of the bearing cover", p.collar_height + through),
        size("object", "What are its extents in x, y, z?", (p.flange, p.flange, p.collar_height + through), "extents"),
    ]
