"""A Z-shaped sheet bracket for a proximity sensor: lower flange with slots, web with window, upper flange with bore."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Pos, RectangleRounded, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, block, rod, slot

MODEL = Model("Z-shaped sensor bracket", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the lower flange's underside is z = 0, it runs to -x; the web's face at +x is x = 0."""

    width: float = 64  # along y
    sheet: float = 2.5
    bend: float = 3  # inner radius
    low: float = 42  # outside, from x = 0 to the lower flange's free edge
    high: float = 50  # outside, from the web's -x face to the upper flange's free edge
    height: float = 58  # outside
    low_corner: float = 6
    high_corner: float = 12
    slots: int = 2
    slot: tuple[float, float] = (15, 6.6)  # length over all along x, width
    slot_x: float = -24  # of the middles
    slot_span: float = 36
    sensor: float = 18.5
    sensor_x: float = 26
    screws: int = 2
    screw: float = 3.4
    screw_span: float = 44  # along y, at the sensor hole's x
    window: tuple[float, float, float] = (24, 12, 3)  # along y, along z, corner
    window_z: float = 34
    nuts: int = 2
    nut: float = 5.4  # holes for press nuts in the web
    nut_span: float = 46
    nut_z: float = 22


def build(p: P) -> Part:
    """Bends the strip, then punches it."""
    t, r, w = p.sheet, p.bend, p.width
    out = r + t
    foot = block((p.low - out, w, t), (-(p.low + out) / 2, 0, 0))
    web = block((t, w, p.height - 2 * out), (-t / 2, 0, out))
    left, right = -t, p.high - t
    head = block((p.high - out, w, t), ((left + out + right) / 2, 0, p.height - t))
    knee = rod(2 * out, w, (-out, -w / 2, out), (0, 1, 0)) - rod(2 * r, w, (-out, -w / 2, out), (0, 1, 0))
    knee &= block((out, w, out), (-out / 2, 0, 0))
    z = p.height - out
    upper = rod(2 * out, w, (left + out, -w / 2, z), (0, 1, 0)) - rod(2 * r, w, (left + out, -w / 2, z), (0, 1, 0))
    upper &= block((out, w, out), (left + out / 2, 0, z))
    body = foot + knee + web + upper + head
    body = body.clean()
    body = fillet(body.edges().filter_by(Axis.Z).group_by(Axis.X)[0], p.low_corner)
    body = fillet(body.edges().filter_by(Axis.Z).group_by(Axis.X)[-1], p.high_corner)
    for side in (-1, 1):
        body -= slot(p.slot[0], p.slot[1], t, (p.slot_x, side * p.slot_span / 2, t))
        body -= rod(p.screw, t, (p.sensor_x, side * p.screw_span / 2, p.height - t))
        body -= rod(p.nut, t, (0, side * p.nut_span / 2, p.nut_z), LEFT)
    body -= rod(p.sensor, t, (p.sensor_x, 0, p.height - t))
    plane = Plane((0, 0, p.window_z), x_dir=(0, 1, 0), z_dir=(1, 0, 0))
    body -= extrude(plane * RectangleRounded(*p.window), amount=t, both=True)
    return body
