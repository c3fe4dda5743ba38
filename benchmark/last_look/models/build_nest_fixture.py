"""A machining nest: a block with a pocket for a casting, three rest pads, finger notches, dowels and screws."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import LEFT, block, grid, rod

MODEL = Model("Nest fixture", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the block stands on z = 0, its middle is x = y = 0."""

    size: tuple[float, float, float] = (160, 110, 45)
    bevel: float = 4  # of the four upright edges
    pocket: tuple[float, float, float] = (84, 52, 18)  # length, width, depth
    pocket_x: float = -12  # of its middle
    corner: float = 8  # radius of the pocket's upright corners
    notch: float = 24  # width of the finger notches, open to the long sides
    notch_depth: float = 12
    push: float = 20  # diameter of the push-out hole in the pocket's floor
    pad: float = 12  # diameter of the rest pads
    pad_height: float = 3
    pads: tuple[tuple[float, float], ...] = ((-42, 14), (-42, -14), (18, 0))
    dowel: float = 10  # diameter, through
    dowels_x: float = 132  # between the two
    dowels_y: float = 20
    bolt: float = 9  # through hole of the screws
    head: float = 15  # diameter of the counterbores
    head_depth: float = 9.5
    bolts: tuple[float, float] = (132, 84)  # between them in x and y
    clamp: float = 8.5  # core hole of the side clamp's M10, from the right into the pocket
    clamp_z: float = 36


def build(p: P) -> Part:
    """Mills the pocket, leaves the pads, drills."""
    x, y, z = p.size
    body = block(p.size)
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel)
    floor = z - p.pocket[2]
    tool = block(p.pocket, (p.pocket_x, 0, floor))
    body -= fillet(tool.edges().filter_by(Axis.Z), p.corner)
    body -= block((p.notch, y, p.notch_depth), (p.pocket_x, 0, z - p.notch_depth))
    for px, py in p.pads:
        body += rod(p.pad, p.pad_height, (px, py, floor))
    body -= rod(p.push, floor, (p.pocket_x, 0, 0))
    for side in (-1, 1):
        body -= rod(p.dowel, z, (side * p.dowels_x / 2, p.dowels_y, 0))
    for bx, by in grid(2, 2, *p.bolts):
        body -= rod(p.bolt, z, (bx, by, 0))
        body -= rod(p.head, p.head_depth, (bx, by, z - p.head_depth))
    wall = x / 2 - (p.pocket_x + p.pocket[0] / 2)
    body -= rod(p.clamp, wall + 1, (x / 2, 0, p.clamp_z), LEFT)
    return body
