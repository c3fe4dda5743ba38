"""A suction cup stem of a carton erector: threaded end, undercut, hexagon, barrel with ring groove and relief hole, barbed nipple."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import DOWN, RIGHT, cone, prism, rod
from build123d import Axis, Part, chamfer

MODEL = Model("Suction cup stem", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is x, the threaded end begins at x = 0, the barb for the cup ends at +x."""

    thread: float = 10  # M10, plain cylinder
    thread_length: float = 13  # with chamfer
    edge: float = 1
    neck: float = 7.8
    neck_length: float = 2.5
    hexagon: float = 17  # across flats
    hexagon_length: float = 9
    collar: float = 22
    collar_length: float = 3
    barrel: float = 14
    barrel_length: float = 34
    groove: float = 11.4  # bottom of the O-ring groove
    groove_width: float = 2.6
    groove_at: float = 6  # from the collar to its near flank
    relief: float = 2.5  # cross hole from above into the bore
    relief_at: float = 22  # from the collar
    barbs: int = 3
    barb: float = 11  # large diameter
    barb_small: float = 8.5
    barb_length: float = 4.5
    bore: float = 4.5
    seat: float = 6.5  # counterbore at the threaded end
    seat_depth: float = 6


def build(p: P) -> Part:
    """Strings the steps together along x, then bores."""
    thread = rod(p.thread, p.thread_length, (0, 0, 0), RIGHT)
    body = chamfer([thread.edges().sort_by(Axis.X)[0]], p.edge)
    x = p.thread_length
    body += rod(p.neck, p.neck_length, (x, 0, 0), RIGHT)
    x += p.neck_length
    body += prism(p.hexagon, p.hexagon_length, (x, 0, 0), RIGHT)
    x += p.hexagon_length
    body += rod(p.collar, p.collar_length, (x, 0, 0), RIGHT)
    x += p.collar_length
    body += rod(p.barrel, p.barrel_length, (x, 0, 0), RIGHT)
    body -= rod(p.barrel + 4, p.groove_width, (x + p.groove_at, 0, 0), RIGHT) - rod(
        p.groove, p.groove_width, (x + p.groove_at, 0, 0), RIGHT
    )
    relief = x + p.relief_at
    x += p.barrel_length
    for _ in range(p.barbs):
        body += cone(p.barb, p.barb_small, p.barb_length, (x, 0, 0), RIGHT)
        x += p.barb_length
    body -= rod(p.bore, x, (0, 0, 0), RIGHT)
    body -= rod(p.seat, p.seat_depth, (0, 0, 0), RIGHT)
    body -= rod(p.relief, p.barrel / 2, (relief, 0, p.barrel / 2), DOWN)
    return body
