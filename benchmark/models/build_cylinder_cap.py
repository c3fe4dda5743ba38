"""The rod-side end cap of a hydraulic cylinder: rod bore along y, counterbored tie-rod holes, spigot, ports."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Item, Model, count, exists, length, lengths, point, points, size
from benchmark.shapes import BACK, DOWN, FRONT, RIGHT, UP, block, drill, grid, rod

MODEL = Model("End cap of a hydraulic cylinder", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the rod's axis is y, the block's front face lies in y = 0, the rod comes out at the front."""

    square: float = 90  # along x and z
    thickness: float = 40
    bevel: float = 4  # of the four long edges, at 45 degrees
    pilot: float = 58
    pilot_height: float = 6
    spigot: float = 63
    spigot_height: float = 12
    groove: float = 57  # diameter at the bottom
    groove_width: float = 4.2
    groove_gap: float = 4  # from the spigot's end
    bore: float = 28
    wiper: float = 38
    wiper_depth: float = 7
    tie: float = 11
    tie_head: float = 17.5
    tie_head_depth: float = 10
    tie_span: float = 66  # along x and z
    port: float = 11.8  # core hole of G 1/4
    port_depth: float = 16
    port_y: float = 24
    bleed: float = 5  # core hole of M6
    bleed_depth: float = 14
    bleed_at: tuple[float, float] = (24, 12)  # y, z
    feet: int = 2
    foot: float = 8.5  # core hole of M10
    foot_depth: float = 15
    foot_span: float = 28
    foot_y: float = 20


def build(p: P) -> Part:
    """Bevels the block, adds the round ends, drills from five sides."""
    half = p.square / 2
    body = chamfer(
        block((p.square, p.thickness, p.square), (0, p.thickness / 2, -half)).edges().filter_by(Axis.Y), p.bevel
    )
    body += rod(p.pilot, p.pilot_height, (0, 0, 0), FRONT) + rod(p.spigot, p.spigot_height, (0, p.thickness, 0), BACK)
    end = p.thickness + p.spigot_height
    start = (0, end - p.groove_gap, 0)
    body -= rod(p.spigot, p.groove_width, start, FRONT) - rod(p.groove, p.groove_width, start, FRONT)
    body -= rod(p.bore, p.pilot_height + end, (0, end, 0), FRONT)
    body -= rod(p.wiper, p.wiper_depth, (0, -p.pilot_height, 0), BACK)
    for x, z in grid(2, 2, p.tie_span, p.tie_span):
        body -= rod(p.tie, p.thickness, (x, 0, z), BACK) + rod(p.tie_head, p.tie_head_depth, (x, 0, z), BACK)
    body -= drill(p.port, p.port_depth, (0, p.port_y, half), DOWN)
    body -= drill(p.bleed, p.bleed_depth, (-half, *p.bleed_at), RIGHT)
    return body - [drill(p.foot, p.foot_depth, (x, p.foot_y, -half), UP) for x, _ in grid(p.feet, 1, p.foot_span, 0)]


def questions(p: P) -> list[Item]:
    """Asked by a machinist, a maintenance engineer, a seal supplier and a student from abroad."""
    half = p.square / 2
    total = p.pilot_height + p.thickness + p.spigot_height
    return [
        length("through hole", "diameter", "rod bore dia thru the middle?", p.bore),
        count("through hole", "no. of thru holes, rod bore not counted", 4),
        lengths(
            "through hole",
            "diameter",
            "There is a tie rod hole in every corner. What are their diameters (of the drilled hole, not of the "
            "counterbore)?",
            [p.tie] * 4,
        ),
        length("hole", "diameter", "c'bore dia of a tie rod hole", p.tie_head),
        length(
            "through hole", "distance", "tie rod holes: horizontal c-c distance between left and right one", p.tie_span
        ),
        length(
            "ring",
            "width",
            "We supply the O-ring for the groove around the spigot at the back. How wide is that groove?",
            p.groove_width,
        ),
        length(
            "circular protrusion",
            "height",
            "By how many mm does the round pilot stand out of the front face?",
            p.pilot_height,
        ),
        length("circular protrusion", "radius", "outside radius of the spigot on the rear side?", p.spigot / 2),
        length("threaded hole", "diameter", "Please, what is the diameter of the port hole on top?", p.port),
        length("threaded hole", "depth", "how deep is the threaded hole in the top, no drill tip", p.port_depth),
        points(
            "threaded hole",
            "The cap gets bolted down from below. Where are the centres of the two blind holes in the bottom?",
            [(x, p.foot_y, -half + p.foot_depth / 2) for x, _ in grid(p.feet, 1, p.foot_span, 0)],
        ),
        count("blind hole", "What number of blind holes there are in all?", 2 + p.feet),
        count("bevel", "How many of the outer edges are bevelled? They run from front to back.", 4),
        exists("hole", "Can one see a hole on the right side?", False),
        point(
            "hole",
            "And the small bleed screw hole on the left, where's its center?",
            (-half + p.bleed_depth / 2, *p.bleed_at),
        ),
        size(
            "object",
            "Sorry to bother you again, I must reserve the space for this end cap in our layout. What are width, depth "
            "and height of the whole part (pilot and spigot included)?",
            (p.square, total, p.square),
        ),
    ]
