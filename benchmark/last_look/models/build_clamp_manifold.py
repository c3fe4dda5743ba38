"""A hydraulic distribution block for a clamping fixture: two galleries, six outlets on top, a gauge port in front."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, LEFT, RIGHT, block, drill, grid, rod

MODEL = Model("Clamp manifold", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the block stands on z = 0, centred in x and y; the galleries run along x."""

    size: tuple[float, float, float] = (130, 70, 50)
    bevel: float = 2  # of the four upright edges
    gallery_z: float = 19
    pressure: float = 9  # gallery diameter, drilled from the left
    pressure_y: float = -14
    tank: float = 12  # gallery diameter, drilled from the right
    tank_y: float = 14
    gallery_depth: float = 112  # full diameter, both, from the end face
    inlet: float = 15.25  # core of G 3/8 at both mouths
    inlet_depth: float = 15
    ports: tuple[int, int] = (3, 2)
    pitch: float = 34  # along x
    spot: float = 23  # spot face round each outlet
    spot_depth: float = 1
    port: float = 11.8  # core of G 1/4
    port_depth: float = 14  # from the top of the block
    riser: float = 6  # from the outlet down to the gallery's axis
    gauge: float = 8.8  # core of G 1/8 in the front
    gauge_depth: float = 10
    gauge_x: float = 17
    gauge_riser: float = 3
    bolt: float = 6.6
    head: float = 11
    head_depth: float = 7
    bolts: tuple[float, float] = (114, 56)


def build(p: P) -> Part:
    """Drills the block from five sides."""
    x, y, z = p.size
    body = block(p.size)
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel)
    for end, into, d, gy in ((-x / 2, RIGHT, p.pressure, p.pressure_y), (x / 2, LEFT, p.tank, p.tank_y)):
        body -= drill(d, p.gallery_depth, (end, gy, p.gallery_z), into)
        body -= rod(p.inlet, p.inlet_depth, (end, gy, p.gallery_z), into)
    for px, py in grid(*p.ports, p.pitch, p.tank_y - p.pressure_y):
        body -= rod(p.spot, p.spot_depth, (px, py, z), DOWN)
        body -= rod(p.port, p.port_depth, (px, py, z), DOWN)
        body -= rod(p.riser, z - p.gallery_z, (px, py, z), DOWN)
    body -= rod(p.gauge, p.gauge_depth, (p.gauge_x, -y / 2, p.gallery_z), BACK)
    body -= rod(p.gauge_riser, y / 2 + p.pressure_y, (p.gauge_x, -y / 2, p.gallery_z), BACK)
    for bx, by in grid(2, 2, *p.bolts):
        body -= rod(p.bolt, z, (bx, by, z), DOWN)
        body -= rod(p.head, p.head_depth, (bx, by, z), DOWN)
    return body
