"""The saddle of a dovetail slide: female dovetail below, two T-slots above, gib screws, nut pocket, oil hole."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, Pos, RectangleRounded, chamfer, extrude

from benchmark.kit import Model
from benchmark.shapes import DOWN, FRONT, LEFT, RIGHT, block, drill, rod

MODEL = Model("Dovetail slide saddle", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the saddle's underside is z = 0, the dovetail runs along x."""

    length: float = 140
    width: float = 104
    height: float = 46
    bevel: float = 2  # of the four upright edges
    mouth: float = 44  # width of the dovetail at the underside
    dove_depth: float = 16
    dove_angle: float = 60  # between flank and underside
    neck: float = 10  # T-slot
    head: float = 18
    head_height: float = 7
    tee_depth: float = 18  # over all
    tees: float = 52  # apart
    gib: float = 5  # core of M6, through the right-hand cheek (+y)
    gibs: int = 3
    gib_pitch: float = 45
    gib_z: float = 7
    wiper: float = 4.2  # core of M5, in both ends
    wiper_depth: float = 12
    wipers: float = 80  # apart
    wiper_z: float = 11
    pocket: tuple[float, float] = (34, 24)  # for the leadscrew nut, in the dovetail's roof
    pocket_depth: float = 6
    pocket_r: float = 5
    pocket_x: float = -38
    oil: float = 3
    oil_x: float = 30


def build(p: P) -> Part:
    """Mills the dovetail and the T-slots through along x, then drills."""
    body = block((p.length, p.width, p.height))
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel)
    half, run = p.mouth / 2, p.dove_depth / math.tan(math.radians(p.dove_angle))
    outline = Polygon(
        (-half, 0), (half, 0), (half + run, p.dove_depth), (-half - run, p.dove_depth), align=None
    )
    body -= extrude(Plane((-p.length / 2, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0)) * outline, amount=p.length)
    for side in (-1, 1):
        y = side * p.tees / 2
        body -= block((p.length, p.neck, p.tee_depth), (0, y, p.height - p.tee_depth))
        body -= block((p.length, p.head, p.head_height), (0, y, p.height - p.tee_depth))
        for end, into in ((-1, RIGHT), (1, LEFT)):
            body -= drill(p.wiper, p.wiper_depth, (end * p.length / 2, side * p.wipers / 2, p.wiper_z), into)
    for index in range(p.gibs):
        x = (index - (p.gibs - 1) / 2) * p.gib_pitch
        body -= rod(p.gib, p.width / 2, (x, p.width / 2, p.gib_z), FRONT)
    pocket = RectangleRounded(*p.pocket, p.pocket_r)
    body -= extrude(Pos(p.pocket_x, 0, p.dove_depth) * pocket, amount=p.pocket_depth)
    body -= rod(p.oil, p.height, (p.oil_x, 0, p.height), DOWN)
    return body
