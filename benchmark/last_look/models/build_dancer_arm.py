"""A film dancer arm: clamping hub with key seat and slit, tapering arm with window, roller boss, spring holes, stop pad."""

from __future__ import annotations

from dataclasses import dataclass

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, block, rod, slot
from build123d import Part, Plane, Polygon, chamfer, extrude

MODEL = Model("Film dancer arm", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the hub's axis is y through the origin, the roller boss lies towards +x, y = 0 is the arm's middle."""

    centres: float = 280
    hub: float = 56
    hub_width: float = 44  # y
    hub_edge: float = 2  # chamfer
    bore: float = 25
    key: float = 8
    key_top: float = 28.3  # bore's far side to the key seat's bottom
    arm: float = 16  # thickness, y
    root: float = 44  # height of the arm at the hub's axis, z
    end: float = 24  # at the boss's axis
    boss: float = 34
    boss_width: float = 30
    pin: float = 12
    window: tuple[float, float] = (110, 14)
    window_x: float = 118
    springs: int = 3
    spring: float = 6.5
    spring_x: float = 196  # the first
    spring_pitch: float = 18
    slit: float = 3  # from -x into the bore
    lug: tuple[float, float] = (30, 30)  # clamping lug behind the hub: y, z
    lug_reach: float = 48  # from the axis to the lug's end, towards -x
    screw: float = 8.5  # through the upper half, from above
    screw_tap: float = 6.8  # M8 in the lower half, right through
    screw_x: float = 38  # from the axis
    head: float = 14
    head_depth: float = 5
    pad: tuple[float, float] = (20, 24)  # stop pad under the arm: x, y
    pad_x: float = 48
    pad_low: float = 30  # its face under the axis


def build(p: P) -> Part:
    """Joins hub, arm, boss, lug and pad, then bores."""
    hub = chamfer(rod(p.hub, p.hub_width, (0, -p.hub_width / 2, 0), BACK).edges().filter_by(lambda e: e.is_closed), p.hub_edge)
    body = hub
    plane = Plane(origin=(0, p.arm / 2, 0), x_dir=(1, 0, 0), z_dir=(0, -1, 0))
    shape = Polygon((0, -p.root / 2), (p.centres, -p.end / 2), (p.centres, p.end / 2), (0, p.root / 2), align=None)
    body += extrude(plane * shape, amount=p.arm)
    body += rod(p.boss, p.boss_width, (p.centres, -p.boss_width / 2, 0), BACK)
    body += block((p.lug_reach, p.lug[0], p.lug[1]), (-p.lug_reach / 2, 0, -p.lug[1] / 2))
    body += block((p.pad[0], p.pad[1], p.pad_low), (p.pad_x, 0, -p.pad_low))
    through = p.hub_width
    body -= rod(p.bore, through, (0, -through / 2, 0), BACK)
    body -= block((p.key, through, p.bore / 2), (0, 0, p.key_top - p.bore))
    body -= rod(p.pin, p.boss_width, (p.centres, -p.boss_width / 2, 0), BACK)
    body -= block((p.lug_reach, p.hub_width, p.slit), (-p.lug_reach / 2, 0, -p.slit / 2))
    top = p.lug[1] / 2
    body -= rod(p.screw, top, (-p.screw_x, 0, top), DOWN)
    body -= rod(p.head, p.head_depth, (-p.screw_x, 0, top), DOWN)
    body -= rod(p.screw_tap, top, (-p.screw_x, 0, 0), DOWN)
    body -= slot(*p.window, p.arm, (p.window_x, -p.arm / 2, 0), BACK)
    for index in range(p.springs):
        body -= rod(p.spring, p.arm, (p.spring_x + index * p.spring_pitch, -p.arm / 2, 0), BACK)
    return body
