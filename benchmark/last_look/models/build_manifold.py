"""A hydraulic manifold block: valve pattern on top, galleries lengthwise, outlets front and back."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, FRONT, LEFT, RIGHT, block, drill, grid, rod

MODEL = Model("Hydraulic manifold", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the block stands on z = 0, its middle is x = y = 0; the valve sits on top."""

    size: tuple[float, float, float] = (140, 100, 65)
    bevel: float = 2  # of the upright edges
    valve_x: float = -20  # middle of the valve
    valve_d: float = 7.5  # its four oil holes
    supply_y: float = 15  # P at -y, tank T at +y, from the valve's middle
    outlet_x: float = 13  # A at -x, B at +x, from the valve's middle
    screw_grid: tuple[float, float] = (46, 38)
    screw_d: float = 4.2  # core hole of M5
    screw_depth: float = 14
    gallery_d: float = 14
    gallery_z: float = 20
    supply_l: float = 95  # length of the supply gallery from the left; the tank gallery goes through
    mouth_d: float = 19  # threaded ends of the galleries
    mouth_depth: float = 18
    face_d: float = 27  # spot face about them
    face_depth: float = 1
    work_d: float = 10  # drillings of the outlets
    work_z: float = 35
    port_d: float = 15.2  # threaded ends of the outlets
    port_depth: float = 15
    gauge_d: float = 6  # from the right into the supply gallery
    gauge_port_d: float = 11.8
    gauge_port_depth: float = 12
    mount_d: float = 11
    mount_head_d: float = 18
    mount_head: float = 11  # depth
    mount_grid: tuple[float, float] = (114, 68)


def build(p: P) -> Part:
    """Mills the block and drills it from all sides."""
    x, y, z = p.size
    body = block(p.size)
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel)
    for side in (-1, 1):
        body -= rod(p.valve_d, z - p.gallery_z, (p.valve_x, side * p.supply_y, p.gallery_z))
        body -= rod(p.valve_d, z - p.work_z, (p.valve_x + side * p.outlet_x, 0, p.work_z))
    for sx, sy in grid(2, 2, *p.screw_grid, center=(p.valve_x, 0)):
        body -= drill(p.screw_d, p.screw_depth, (sx, sy, z))
    supply = (-x / 2, -p.supply_y, p.gallery_z)
    tank = (-x / 2, p.supply_y, p.gallery_z)
    body -= rod(p.gallery_d, p.supply_l, supply, RIGHT)
    body -= rod(p.gallery_d, x, tank, RIGHT)
    for mouth, into in ((supply, RIGHT), (tank, RIGHT), ((x / 2, p.supply_y, p.gallery_z), LEFT)):
        body -= rod(p.mouth_d, p.mouth_depth, mouth, into)
        body -= rod(p.face_d, p.face_depth, mouth, into)
    gauge = (x / 2, -p.supply_y, p.gallery_z)
    body -= rod(p.gauge_d, x - p.supply_l, gauge, LEFT)
    body -= rod(p.gauge_port_d, p.gauge_port_depth, gauge, LEFT)
    for side, into in ((-1, BACK), (1, FRONT)):
        mouth = (p.valve_x + side * p.outlet_x, side * y / 2, p.work_z)
        body -= rod(p.work_d, y / 2, mouth, into)
        body -= rod(p.port_d, p.port_depth, mouth, into)
    for mx, my in grid(2, 2, *p.mount_grid):
        body -= rod(p.mount_d, z, (mx, my, 0))
        body -= rod(p.mount_head_d, p.mount_head, (mx, my, z), DOWN)
    return body
