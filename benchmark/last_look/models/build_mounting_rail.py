"""A mounting rail for stations: T-slot on top, counterbored screws in its floor, cable groove, end taps, locating holes below."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, UP, block, drill, rod, slot

MODEL = Model("Mounting rail", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the underside is z = 0, the rail runs along x from x = 0, y = 0 is its middle."""

    length: float = 420
    width: float = 48
    height: float = 28
    bevel: float = 1.5  # at the two upper long edges
    mouth: float = 10.2  # width of the T-slot's mouth
    lip: float = 5  # height of the mouth
    tee: float = 18  # width of the T-slot below
    tee_height: float = 7.5
    screws: int = 5
    screw: float = 6.6
    screw_first: float = 50  # from the rail's end x = 0
    screw_pitch: float = 80
    head: float = 11  # counterbores in the slot's floor
    head_depth: float = 6.5
    groove: float = 6  # width of the cable groove in the side y < 0
    groove_depth: float = 4.5
    groove_z: float = 18  # of its middle
    ends: float = 5  # core holes M6 in both ends
    end_dy: float = 30
    end_z: float = 8
    end_depth: float = 16
    pin: float = 8  # locating hole in the underside
    pin_x: float = 90
    pin_depth: float = 10
    oblong: float = 12  # overall length of the locating slot at the other end, along x
    oblong_x: float = 330
    notch: tuple[float, float] = (20, 14)  # cut-out at the end of large x, on the side y > 0: along x, along y


def build(p: P) -> Part:
    """Extrudes the section, then drills."""
    body = block((p.length, p.width, p.height), (p.length / 2, 0, 0))
    edges = [e for e in body.edges().filter_by(Axis.X) if abs(e.center().Z - p.height) < 1e-3]
    body = chamfer(edges, p.bevel)
    middle = p.length / 2
    body -= block((p.length, p.mouth, p.lip), (middle, 0, p.height - p.lip))
    floor = p.height - p.lip - p.tee_height
    body -= block((p.length, p.tee, p.tee_height), (middle, 0, floor))
    for i in range(p.screws):
        x = p.screw_first + i * p.screw_pitch
        body -= rod(p.screw, floor, (x, 0, 0))
        body -= rod(p.head, p.head_depth, (x, 0, floor - p.head_depth))
    body -= block((p.length, 2 * p.groove_depth, p.groove), (middle, -p.width / 2, p.groove_z - p.groove / 2))
    for y in (-p.end_dy / 2, p.end_dy / 2):
        body -= drill(p.ends, p.end_depth, (0, y, p.end_z), RIGHT)
    x, y = p.notch
    body -= block((2 * x, y, p.height), (p.length, p.width / 2 - y / 2, 0))
    body -= drill(p.ends, p.end_depth, (p.length, -p.end_dy / 2, p.end_z), LEFT)
    body -= rod(p.pin, p.pin_depth, (p.pin_x, 0, 0))
    body -= slot(p.oblong, p.pin, p.pin_depth, (p.oblong_x, 0, 0), UP)
    return body
