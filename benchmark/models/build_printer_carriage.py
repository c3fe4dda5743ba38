"""A 3D printer's carriage: half-round bearing seats, belt slot, nut holes, ringed holes, pins, bevelled corners."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Item, Model, count, length, lengths, point, size
from benchmark.shapes import DOWN, RIGHT, block, grid, prism, rod

MODEL = Model("Carriage of a 3D printer", "dev")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the block lies on z = 0, the carriage runs along x, the middle is x = y = 0."""

    block: tuple[float, float, float] = (80, 72, 24)
    corner: float = 5  # bevels of the upright edges, at 45 degrees
    seat: float = 7.5  # radius of the bearing seats (LM8UU)
    seat_span: float = 46
    belt: tuple[float, float] = (10, 8)  # width, depth of the slot along x
    nuts: tuple[float, float] = (62, 24)  # pattern
    flats: float = 5.5  # ISO 4032, M3
    nut_depth: float = 2.5
    clearance: float = 3.4
    rings: tuple[float, float] = (36, 44)  # pattern
    ring: float = 9
    ring_height: float = 2
    ring_hole: float = 4.2
    ring_depth: float = 12
    sign: tuple[float, float, float] = (34, 3, 10)  # milled into the front
    sign_z: float = 9
    pins: int = 2
    pin: tuple[float, float, float] = (6, 9, 4)  # at the back, along x, y and z
    pin_x: float = 22
    pin_z: float = 13
    magnet: float = 6
    magnet_depth: float = 3.2
    magnet_y: float = 14
    magnet_z: float = 14


def build(p: P) -> Part:
    """Saws and bevels the block, adds rings and pins, mills, drills."""
    width, depth, top = p.block
    body = block(p.block)
    body = chamfer(body.edges().filter_by(Axis.Z), p.corner)
    body += [rod(p.ring, p.ring_height, (x, y, top)) for x, y in grid(2, 2, *p.rings)]
    body += [block(p.pin, (x, (depth + p.pin[1]) / 2, p.pin_z)) for x in (-p.pin_x, p.pin_x)]
    body -= [rod(2 * p.seat, width, (-width / 2, y, 0), RIGHT) for y in (-p.seat_span / 2, p.seat_span / 2)]
    body -= block((width, *p.belt), (0, 0, top - p.belt[1]))
    for x, y in grid(2, 2, *p.nuts):
        body -= rod(p.clearance, top, (x, y, 0)) + prism(p.flats, p.nut_depth, (x, y, top), DOWN)
    body -= [rod(p.ring_hole, p.ring_depth, (x, y, top + p.ring_height), DOWN) for x, y in grid(2, 2, *p.rings)]
    body -= block(p.sign, (0, (p.sign[1] - depth) / 2, p.sign_z))
    return body - rod(p.magnet, p.magnet_depth, (-width / 2, p.magnet_y, p.magnet_z), RIGHT)


def questions(p: P) -> list[Item]:
    """Asked in the plain way, and by a maker, a mechatronics student and an injection moulder."""
    width, depth, height = p.block
    magnet = ((p.magnet_depth - width) / 2, p.magnet_y, p.magnet_z)
    return [
        count("nut hole", "How many nut holes are visible from the top?", 4),
        lengths("nut hole", "width", "What is the width across flats of the nut holes?", [p.flats] * 4),
        count("hole with ring", "How many holes with a ring are visible from the top?", 4),
        lengths("ring", "diameter", "What is the outer diameter of the rings on the top?", [p.ring] * 4),
        length("rectangular slot", "width", "What is the width of the rectangular slot on the top?", p.belt[0]),
        size("rectangular indentation", "What is the size of the rectangular indentation on the front?", p.sign),
        lengths("semicircle", "radius", "What is the radius of the semicircles visible from the left?", [p.seat] * 2),
        point("blind hole", "where is the centre of the magnet hole on the left?", magnet),
        lengths(
            "rectangular pin",
            "height",
            "How far do the two rectangular pins stick out at the back?",
            [p.pin[1]] * p.pins,
        ),
        lengths("hole with ring", "depth", "how deep r the holes that have a ring around", [p.ring_depth] * 4),
        lengths("bevel", "size", "Bevels of the four upright corner edges: how many mm per side?", [p.corner] * 4),
        length(
            "semicircle",
            "distance",
            "Axis-to-axis distance of the two half-round bearing seats underneath?",
            p.seat_span,
        ),
        length("rectangular slot", "depth", "Could you tell me the depth of the slot for the belt?", p.belt[1]),
        size(
            "object",
            "Overall dimensions of the carriage with pins and rings, x y z",
            (width, depth + p.pin[1], height + p.ring_height),
            "extents",
        ),
    ]
