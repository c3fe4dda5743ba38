"""A printed holder for twelve round battery cells: blind cell seats with windows, bus bar channels, standoffs."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import block, grid, rod

MODEL = Model("Cell holder", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate lies on z = 0, the cells come from above, the middle is x = y = 0."""

    size: tuple[float, float, float] = (88, 68, 12)  # of the plate
    corner: float = 8
    cells: tuple[int, int] = (4, 3)
    pitch: float = 20.5
    seat: float = 18.6
    seat_depth: float = 9
    window: float = 13  # through the floor
    channel: tuple[float, float] = (8, 1.2)  # width, depth; on the underside along x, one below each row
    screw: float = 3.4  # clearance of M3
    standoff: float = 8
    standoff_height: float = 25  # above the plate
    notch: tuple[float, float] = (12, 2.5)  # for wires, in the front: width, depth
    insert: float = 4.2  # pilot of the heat-set inserts in the ends
    insert_depth: float = 6
    inserts_y: float = 41  # between the two of an end


def build(p: P) -> Part:
    """Prints the plate with its standoffs, leaves out the seats."""
    x, y, z = p.size
    body = fillet(block(p.size).edges().filter_by(Axis.Z), p.corner)
    posts = grid(p.cells[0] - 1, p.cells[1] - 1, p.pitch, p.pitch)
    outer = [at for at in posts if abs(at[0]) > p.pitch / 2]
    for at in outer:
        body += rod(p.standoff, p.standoff_height, (*at, z))
    for at in grid(*p.cells, p.pitch, p.pitch):
        body -= rod(p.seat, p.seat_depth, (*at, z - p.seat_depth))
        body -= rod(p.window, z, (*at, 0))
    for row in range(p.cells[1]):
        place = (row - (p.cells[1] - 1) / 2) * p.pitch
        body -= block((x, *p.channel), (0, place, 0))
    for at in posts:
        body -= rod(p.screw, z + p.standoff_height, (*at, 0))
    body -= block((p.notch[0], p.notch[1], z), (0, (p.notch[1] - y) / 2, 0))
    for end in (-1, 1):
        for side in (-1, 1):
            start = (end * x / 2, side * p.inserts_y / 4, z / 2)
            body -= rod(p.insert, p.insert_depth, start, (-end, 0, 0))
    return body
