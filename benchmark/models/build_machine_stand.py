"""A machine stand: table top with a border hole pattern on four square legs with foot plates, one welded body."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Item, Model, count, length, lengths, point, size
from benchmark.shapes import block, grid, rod

MODEL = Model("Machine stand on four legs", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the foot plates stand on z = 0."""

    top: tuple[float, float, float] = (600, 400, 20)
    leg: float = 50
    leg_height: float = 480  # from the foot plate to the top
    leg_span: tuple[float, float] = (500, 300)
    foot: tuple[float, float, float] = (90, 90, 12)
    foot_hole: float = 14
    foot_hole_spacing: float = 70
    table_holes: tuple[int, int] = (4, 2)
    table_hole: float = 11
    table_pitch: tuple[float, float] = (90, 120)

    @property
    def height(self) -> float:
        """Over all."""
        return self.foot[2] + self.leg_height + self.top[2]


def build(p: P) -> Part:
    """Feet, legs, top; each foot is drilled on both outer sides of its leg."""
    under = p.foot[2] + p.leg_height
    legs = grid(2, 2, *p.leg_span)
    body = block(p.top, (0, 0, under))
    body += [block((p.leg, p.leg, p.leg_height), (x, y, p.foot[2])) for x, y in legs]
    body += [block(p.foot, (x, y, 0)) for x, y in legs]
    tools = [rod(p.table_hole, p.top[2], (x, y, under)) for x, y in grid(*p.table_holes, *p.table_pitch)]
    for x, y in legs:
        tools += [rod(p.foot_hole, p.foot[2], (a, y, 0)) for a, _ in grid(2, 1, p.foot_hole_spacing, 0, (x, 0))]
    return body - tools


def questions(p: P) -> list[Item]:
    """Asked by plant planners."""
    holes = p.table_holes[0] * p.table_holes[1]
    return [
        count("leg", "How many legs does the stand have?", 4),
        lengths("leg", "height", "How high are the legs between foot plate and table top?", [p.leg_height] * 4),
        lengths("leg", "width", "What is the width of each leg in x direction?", [p.leg] * 4),
        length(
            "leg",
            "distance",
            "How far apart are the two legs visible from the front? I mean the free space between them.",
            p.leg_span[0] - p.leg,
        ),
        length("leg", "distance", "Seen from the left, what is the gap between the two legs?", p.leg_span[1] - p.leg),
        length("object", "height", "How tall is the stand?", p.height),
        length("object", "width", "How wide is the stand?", p.top[0]),
        length("object", "depth", "What depth has the stand, from front to back?", p.top[1]),
        count("hole", "How many holes with a diameter of 11 mm does the table top have?", holes),
        count("mounting hole", "In total, how many 14 mm anchor holes are in the feet?", 8),
        lengths("through hole", "depth", "How deep are the 11 mm through holes in the table top?", [p.top[2]] * holes),
        length("hole", "diameter", "What is the diameter of the smallest hole?", p.table_hole),
        length("hole", "radius", "What radius have the largest holes? One number is enough.", p.foot_hole / 2),
        count("hole", "How many holes are visible from the front?", 0),
        point("object", "Where lies the centre of the stand's bounding box?", (0, 0, p.height / 2)),
        size("object", "Overall size of the stand?", (p.top[0], p.top[1], p.height)),
        count("through hole", "How many vertical through holes have a diameter above 12 mm?", 8),
    ]
