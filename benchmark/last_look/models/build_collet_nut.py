"""A clamping nut for collets, stored as B-splines: spanner slots, pin holes, a threaded bore with undercut, a taper."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, degrees

from build123d import Axis, Part, Pos, Rot, chamfer

from benchmark.kit import Form, Model
from benchmark.shapes import DOWN, block, circle, cone, rod

MODEL = Model("Collet nut", "held_out", Form.BSPLINE)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the axis is z, the thread opens on z = 0, the taper on the top."""

    outer: float = 50
    height: float = 32
    bevel: float = 1.5  # both outer rims
    thread: float = 36.5  # core hole of M38 x 1.5
    thread_depth: float = 17
    undercut: float = 39
    undercut_width: float = 3.5  # follows the thread
    wide: float = 33  # taper's lower end
    narrow: float = 24  # at the top face
    slots: int = 6
    slot: float = 6
    slot_depth: float = 3
    slot_length: float = 14  # from the top
    pins: int = 2
    pin: float = 4.5
    pin_depth: float = 4
    pin_circle: float = 36.5

    @property
    def taper_length(self) -> float:
        """What is left above the undercut."""
        return self.height - self.thread_depth - self.undercut_width

    @property
    def taper(self) -> float:
        """Included angle in degrees."""
        return 2 * degrees(atan((self.wide - self.narrow) / 2 / self.taper_length))


def build(p: P) -> Part:
    """Turns, then mills the slots."""
    body = rod(p.outer, p.height)
    body = chamfer(body.edges().group_by(Axis.Z)[0] + body.edges().group_by(Axis.Z)[-1], p.bevel)
    body -= rod(p.thread, p.thread_depth)
    body -= rod(p.undercut, p.undercut_width, (0, 0, p.thread_depth))
    body -= cone(p.wide, p.narrow, p.taper_length, (0, 0, p.thread_depth + p.undercut_width))
    cutter = Pos(p.outer / 2, 0, 0) * block((2 * p.slot_depth, p.slot, p.slot_length), (0, 0, p.height - p.slot_length))
    for n in range(p.slots):
        body -= Rot(0, 0, 360 / p.slots * n) * cutter
    for x, y in circle(p.pins, p.pin_circle, 90):
        body -= rod(p.pin, p.pin_depth, (x, y, p.height), DOWN)
    return body
