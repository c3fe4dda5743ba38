"""A compressor's reed valve plate: suction and discharge ports, seats, a reed recess with its rivet holes, dowels, screws."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part, Pos, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import block, grid, rod, slot

MODEL = Model("Reed valve plate", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the cylinder side is z = 0, the plate's middle x = y = 0, the discharge ports lie towards +x."""

    size: tuple[float, float, float] = (118, 86, 10)
    corner: float = 12
    screws: float = 9
    screw_dx: float = 96
    screw_dy: float = 64
    dowels: float = 6  # on the x axis's line through the plate's middle
    dowel_dx: float = 102
    discharge: float = 13  # two ports, through
    discharge_x: float = 26
    discharge_dy: float = 34
    seat: float = 19  # outside diameter of the raised seats about them
    trench: float = 25  # outside diameter of the trenches about the seats
    trench_depth: float = 1.5  # from the head side
    suction: float = 10  # three ports, through
    suction_x: float = -28
    suction_dy: float = 16
    recess: tuple[float, float] = (46, 20)  # for the suction reed's root, in the cylinder side
    recess_corner: float = 4
    recess_depth: float = 1.2
    recess_y: float = -30  # of its middle
    rivet: float = 3.3  # two core holes M4 through the plate, in the recess
    rivet_dx: float = 24
    bridge_length: float = 34  # of the slot between the two sides, along y
    bridge: float = 5  # its width
    bridge_x: float = -2
    bridge_depth: float = 4  # from the head side
    notch: float = 8  # mark in the edge x < 0: its width
    notch_depth: float = 4
    notch_y: float = 22


def build(p: P) -> Part:
    """Grinds the plate, then mills and drills."""
    long, _, thick = p.size
    body = extrude(RectangleRounded(p.size[0], p.size[1], p.corner), amount=thick)
    for x, y in grid(2, 2, p.screw_dx, p.screw_dy):
        body -= rod(p.screws, thick, (x, y, 0))
    for x, y in grid(2, 1, p.dowel_dx, 0):
        body -= rod(p.dowels, thick, (x, y, 0))
    low = thick - p.trench_depth
    for x, y in grid(1, 2, 0, p.discharge_dy, (p.discharge_x, 0)):
        body -= rod(p.trench, p.trench_depth, (x, y, low)) - rod(p.seat, p.trench_depth, (x, y, low))
        body -= rod(p.discharge, thick, (x, y, 0))
    for x, y in grid(1, 3, 0, p.suction_dy, (p.suction_x, 4)):
        body -= rod(p.suction, thick, (x, y, 0))
    body -= Pos(0, p.recess_y, 0) * extrude(RectangleRounded(*p.recess, p.recess_corner), amount=p.recess_depth)
    for x, y in grid(2, 1, p.rivet_dx, 0, (0, p.recess_y)):
        body -= rod(p.rivet, thick, (x, y, 0))
    body -= slot(p.bridge_length, p.bridge, p.bridge_depth, (p.bridge_x, 6, thick), (0, 0, -1), 90)
    body -= block((2 * p.notch_depth, p.notch, thick), (-long / 2, p.notch_y, 0))
    return body
