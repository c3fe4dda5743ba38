"""A bent sheet tool rack for the wall: back wall with keyholes, shelf with holes and slots, a slanted lip in front."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin, tan

from build123d import Axis, Part, Plane, Polygon, Vector, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, block, grid, rod, slot

MODEL = Model("Tool rack", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the back wall's rear lies on y = 0, the shelf's underside on z = 0, the middle on x = 0."""

    width: float = 240
    sheet: float = 1.5
    radius: float = 2.5  # inside of the bends
    back: float = 78  # height over all
    shelf: float = 62  # from the wall to the theoretical corner of the lip, outside
    lip: float = 18  # from that corner along the outside
    slant: float = 50  # of the lip against the shelf's plane, degrees
    small: float = 8
    small_n: int = 6
    small_pitch: float = 24
    large: float = 17
    large_n: int = 3
    large_pitch: float = 38
    large_x: float = -70  # the middle one
    row_back: float = 18  # small holes' row from the wall's rear
    row_front: float = 43
    slot: tuple[float, float] = (34, 9)
    slots_n: int = 2
    slots_pitch: float = 48
    slots_x: float = 66
    key: float = 10  # keyholes
    key_neck: float = 5
    key_rise: float = 12  # from the round hole's centre to the end of the neck
    key_pitch: float = 190
    key_z: float = 52
    corner: float = 8  # upper corners of the wall

    @property
    def depth(self) -> float:
        """From the rear to the lip's front edge."""
        return self.shelf + self.lip * cos(radians(self.slant))

    @property
    def lip_top(self) -> float:
        """The lip's highest point: its inner edge."""
        a = radians(self.slant)
        return self.lip * sin(a) + self.sheet * cos(a)


def build(p: P) -> Part:
    """Profile, bends, then punches."""
    t, a = p.sheet, radians(p.slant)
    end = Vector(-p.shelf - p.lip * cos(a), p.lip * sin(a))
    inner_end = end + Vector(sin(a), cos(a)) * t
    inner_corner = Vector(-p.shelf + t * tan(a / 2), t)
    outline = [(0, p.back), (0, 0), (-p.shelf, 0), end, inner_end, inner_corner, (-t, t), (-t, p.back)]
    face = Plane.YZ * Polygon(*[tuple(v)[:2] for v in outline], align=None)
    body = extrude(face.face(), amount=p.width / 2, both=True)

    def at(y: float, z: float):
        return [
            e
            for e in body.edges().filter_by(Axis.X)
            if abs(e.center().Y - y) < 1e-3 and abs(e.center().Z - z) < 1e-3
        ]

    sharp = at(0, 0) + at(-p.shelf, 0)
    hollow = at(-t, t) + at(inner_corner.X, t)
    body = fillet(sharp, p.radius + t)
    body = fillet(
        [
            e
            for e in body.edges().filter_by(Axis.X)
            if any((e.center() - h.center()).length < 1e-3 for h in hollow)
        ],
        p.radius,
    )
    upper = [e for e in body.edges().filter_by(Axis.Y) if abs(e.center().Z - p.back) < 1e-3]
    body = fillet(upper, p.corner)
    for x, y in grid(p.small_n, 1, p.small_pitch, 0, (0, -p.row_back)):
        body -= rod(p.small, t, (x, y, 0))
    for x, y in grid(p.large_n, 1, p.large_pitch, 0, (p.large_x, -p.row_front)):
        body -= rod(p.large, t, (x, y, 0))
    for x, y in grid(p.slots_n, 1, p.slots_pitch, 0, (p.slots_x, -p.row_front)):
        body -= slot(*p.slot, t, (x, y, t))
    for x in (-p.key_pitch / 2, p.key_pitch / 2):
        body -= rod(p.key, t, (x, -t, p.key_z), BACK)
        straight = p.key_rise - p.key_neck / 2
        body -= block((p.key_neck, t, straight), (x, -t / 2, p.key_z))
        body -= rod(p.key_neck, t, (x, -t, p.key_z + straight), BACK)
    return body
