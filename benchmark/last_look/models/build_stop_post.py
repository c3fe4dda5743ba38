"""A welded stop post for the end of a pallet conveyor: plate, square tube, two gussets, cap, rubber bumper."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part, Plane, Polyline, Pos, extrude, make_face

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, assembly, block, grid, named, rod

MODEL = Model("Stop post", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate stands on z = 0, the tube's axis is x = y = 0, the pallets come from +x."""

    plate: tuple[float, float, float] = (220, 180, 15)
    anchor: float = 18
    anchors: tuple[float, float] = (170, 130)
    tube: float = 80
    wall: float = 5
    height: float = 400  # of the tube
    gusset: float = 8  # thickness
    gusset_foot: float = 45  # along the plate
    gusset_height: float = 120  # along the tube
    gusset_nose: float = 12  # height of the blunt ends
    snipe: float = 15  # the clipped corner at the weld
    cap: tuple[float, float, float] = (96, 96, 10)
    bumper: float = 65
    bumper_length: float = 28
    bumper_up: float = 330  # its axis above the plate's top
    bumper_hole: float = 9
    sink: float = 20  # counterbore of the bumper's screw
    sink_depth: float = 16
    cable: float = 25  # cable hole in the tube's wall on -x
    cable_up: float = 90  # above the plate's top


def build(p: P) -> Compound:
    """Cuts, sets, welds."""
    t = p.plate[2]
    plate = block(p.plate)
    for x, y in grid(2, 2, *p.anchors):
        plate -= rod(p.anchor, t, (x, y, 0))
    tube = block((p.tube, p.tube, p.height), (0, 0, t))
    inner = p.tube - 2 * p.wall
    tube -= block((inner, inner, p.height), (0, 0, t))
    tube -= rod(p.cable, p.tube / 2, (0, 0, t + p.cable_up), LEFT)
    tube -= rod(p.bumper_hole, p.tube / 2, (0, 0, t + p.bumper_up), RIGHT)
    f, h, n, s = p.gusset_foot, p.gusset_height, p.gusset_nose, p.snipe
    outline = [(s, 0), (f, 0), (f, n), (n, h), (0, h), (0, s)]

    def gusset(side: int) -> Part:
        line = [(side * (p.tube / 2 + a), t + b) for a, b in outline]
        face = Plane.YZ * make_face(Polyline(*line, close=True))
        return extrude(face, amount=p.gusset / 2, both=True)

    cap = block(p.cap, (0, 0, t + p.height))
    start = (p.tube / 2, 0, t + p.bumper_up)
    bumper = rod(p.bumper, p.bumper_length, start, RIGHT)
    bumper -= rod(p.bumper_hole, p.bumper_length, start, RIGHT)
    bumper -= rod(p.sink, p.sink_depth, (p.tube / 2 + p.bumper_length, 0, t + p.bumper_up), LEFT)
    return assembly(
        [
            named(plate, "base plate", "steelblue"),
            named(tube, "post tube", "gold"),
            named(gusset(-1), "gusset right", "gold"),
            named(gusset(1), "gusset left", "gold"),
            named(cap, "cap plate", "gold"),
            named(bumper, "rubber bumper", "black"),
        ]
    )
