"""A hot melt distributor block: inlet and gallery, four outlets for nozzles, heater bores, sensor hole, cover pocket, fixing holes."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, LEFT, RIGHT, block, drill, grid, rod
from build123d import Axis, Part, Pos, RectangleRounded, chamfer, extrude

MODEL = Model("Hot melt distributor block", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the underside is z = 0, x = y = 0 its middle, the nozzles sit on the front, -y, the hose on the left, -x."""

    size: tuple[float, float, float] = (140, 60, 54)
    edge: float = 2  # chamfer on the four upright edges
    inlet: float = 11.8  # G1/4, from the left
    inlet_depth: float = 14
    gallery: float = 8  # on from the inlet
    gallery_end: float = 12  # wall left before the right side
    gallery_at: tuple[float, float] = (-8, 20)  # y, z
    outlets: int = 4
    outlet_pitch: float = 30
    outlet: float = 10.2  # M12, from the front
    outlet_depth: float = 12
    link: float = 4  # on from the outlet into the gallery
    screen: float = 16  # counterbore round each outlet
    screen_depth: float = 2
    heater: float = 12.7
    heater_y: float = 20  # both, right through along x
    heater_z: tuple[float, float] = (14, 36)
    sensor: float = 6  # blind, from the right
    sensor_depth: float = 45
    sensor_at: tuple[float, float] = (-20, 40)  # y, z
    pocket: tuple[float, float] = (80, 34)  # in the top
    pocket_depth: float = 6
    pocket_corner: float = 5
    cover: float = 3.3  # M4 round the pocket
    cover_span: tuple[float, float] = (96, 46)
    cover_depth: float = 8
    mount: float = 6.6  # right through from above
    mount_x: float = 122  # between them
    mount_y: float = 6
    mount_head: float = 11
    mount_head_depth: float = 6.5
    drain: float = 8.5  # M10 plug from below into the gallery
    drain_x: float = 45


def build(p: P) -> Part:
    """Chamfers the block, then drills everything."""
    x, y, z = p.size
    body = block(p.size)
    body = chamfer(body.edges().filter_by(Axis.Z), p.edge)
    gy, gz = p.gallery_at
    body -= rod(p.inlet, p.inlet_depth, (-x / 2, gy, gz), RIGHT)
    body -= rod(p.gallery, x - p.gallery_end, (-x / 2, gy, gz), RIGHT)
    for at, _ in grid(p.outlets, 1, p.outlet_pitch, 0):
        body -= rod(p.screen, p.screen_depth, (at, -y / 2, gz), BACK)
        body -= rod(p.outlet, p.outlet_depth + p.screen_depth, (at, -y / 2, gz), BACK)
        body -= rod(p.link, gy + y / 2, (at, -y / 2, gz), BACK)
    for high in p.heater_z:
        body -= rod(p.heater, x, (-x / 2, p.heater_y, high), RIGHT)
    body -= drill(p.sensor, p.sensor_depth, (x / 2, *p.sensor_at), LEFT)
    low = z - p.pocket_depth
    body -= Pos(0, 0, low) * extrude(RectangleRounded(*p.pocket, p.pocket_corner), amount=p.pocket_depth)
    for at in grid(2, 2, *p.cover_span):
        body -= drill(p.cover, p.cover_depth, (*at, z))
    for side in (-1, 1):
        body -= rod(p.mount, z, (side * p.mount_x / 2, p.mount_y, 0))
        body -= rod(p.mount_head, p.mount_head_depth, (side * p.mount_x / 2, p.mount_y, z), DOWN)
    body -= rod(p.drain, gz, (p.drain_x, gy, 0))
    return body
