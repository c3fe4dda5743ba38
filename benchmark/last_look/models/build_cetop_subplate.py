"""A subplate for one size 6 valve: hole pattern on top, one threaded port on each side, counterbored corners."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, FRONT, LEFT, RIGHT, block, drill, grid, rod

MODEL = Model("CETOP 3 subplate", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the block stands on z = 0, the middle of the pattern is x = y = 0. P to the back, T to the front."""

    size: tuple[float, float, float] = (116, 84, 46)
    bevel: float = 4  # of the upright edges
    port: float = 7.5  # valve ports on top
    pt: float = 20.8  # between P and T, along y
    pt_x: float = 1.25
    a_x: float = -7.55
    b_x: float = 9.95
    bolts: tuple[tuple[float, float], ...] = ((-20.25, -15.5), (20.25, -16.25), (20.25, 16.25), (-20.25, 15.5))
    bolt: float = 4.2  # M5 core
    bolt_depth: float = 14
    pin: tuple[float, float] = (12.75, 16.25)
    pin_hole: float = 4
    pin_depth: float = 4.5
    gallery_z: float = 21  # height of the side ports' axes
    tap: float = 15.25  # G3/8 core
    tap_depth: float = 17
    spot: float = 27  # spot face round the side ports
    spot_depth: float = 1
    gallery: float = 8  # drilled on from the tapped port to the valve port
    corner_x: float = 94  # mounting holes
    corner_y: float = 62
    corner: float = 9
    head: float = 15  # counterbore
    head_depth: float = 9


def build(p: P) -> Part:
    """Mills the block and drills the ports."""
    x, y, z = p.size
    body = chamfer(block(p.size).edges().filter_by(Axis.Z), p.bevel)
    ports = [
        ((p.pt_x, p.pt / 2), (p.pt_x, y / 2), FRONT),
        ((p.pt_x, -p.pt / 2), (p.pt_x, -y / 2), BACK),
        ((p.a_x, 0), (-x / 2, 0), RIGHT),
        ((p.b_x, 0), (x / 2, 0), LEFT),
    ]
    for top, side, into in ports:
        body -= rod(p.port, z - p.gallery_z, (*top, p.gallery_z))
        mouth = (*side, p.gallery_z)
        reach = abs(top[0] - side[0]) + abs(top[1] - side[1])
        body -= rod(p.spot, p.spot_depth, mouth, into)
        body -= rod(p.tap, p.tap_depth, mouth, into)
        body -= rod(p.gallery, reach, mouth, into)
    for at in p.bolts:
        body -= drill(p.bolt, p.bolt_depth, (*at, z))
    body -= rod(p.pin_hole, p.pin_depth, (*p.pin, z), DOWN)
    for at in grid(2, 2, p.corner_x, p.corner_y):
        body -= rod(p.corner, z, (*at, 0))
        body -= rod(p.head, p.head_depth, (*at, z), DOWN)
    return body
