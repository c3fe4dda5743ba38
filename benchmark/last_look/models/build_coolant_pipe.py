"""A bent coolant pipe: tube with two bends in space, oval flange, hexagonal nipple, clamp block on the straight run."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Circle, Compound, Part, Plane, Polyline, FilletPolyline, SlotOverall, chamfer, extrude, fillet, sweep

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, FRONT, RIGHT, assembly, block, named, prism, rod

MODEL = Model("Bent coolant pipe", "held_out", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the flange's face is z = 0, the tube rises along z, bends to +x, then to +y."""

    tube: float = 16
    wall: float = 1.5
    bend: float = 36  # of the centre line, both bends 90 degrees
    rise: float = 120  # of the middle run's centre line over the flange's face
    run: float = 190  # from the first run's centre line to the last run's
    reach: float = 110  # from the middle run's centre line to the tube's end
    flange: tuple[float, float, float] = (72, 38, 12)  # along y, along x, thickness
    flange_hole: float = 9
    flange_span: float = 50
    socket: float = 7  # depth of the flange's socket from its upper side
    ring: tuple[float, float, float] = (19, 26, 2)  # groove in the flange's face: inner, outer diameter, depth
    nipple_flats: float = 27
    nipple_hex: float = 15
    nipple_thread: float = 24  # M24x1.5
    nipple_thread_length: float = 13
    nipple_socket: float = 10  # depth, takes the tube
    nipple_bevel: float = 1.5
    clamp: tuple[float, float, float] = (24, 56, 32)  # along x, y, z
    clamp_x: float = 95  # of its middle
    clamp_hole: float = 6.6  # two, upright
    clamp_span: float = 38
    clamp_round: float = 4  # upright edges


def build(p: P) -> Compound:
    """Sweeps the tube, then sets the fittings on it."""
    bore = p.tube - 2 * p.wall
    seat = p.flange[2] - p.socket  # the tube's lower end
    line = FilletPolyline((0, 0, seat), (0, 0, p.rise), (p.run, 0, p.rise), (p.run, p.reach, p.rise), radius=p.bend)
    ring = Plane((0, 0, seat)) * (Circle(p.tube / 2) - Circle(bore / 2))
    tube = sweep(ring, path=line)
    flange = extrude(SlotOverall(p.flange[0], p.flange[1], rotation=90), amount=p.flange[2])
    flange -= rod(bore, p.flange[2]) + rod(p.tube, p.socket, (0, 0, seat))
    flange -= rod(p.ring[1], p.ring[2]) - rod(p.ring[0], p.ring[2])
    for side in (-1, 1):
        flange -= rod(p.flange_hole, p.flange[2], (0, side * p.flange_span / 2, 0))
    start = p.reach - p.nipple_socket
    nipple = prism(p.nipple_flats, p.nipple_hex, (p.run, start, p.rise), BACK)
    thread = rod(p.nipple_thread, p.nipple_thread_length, (p.run, start + p.nipple_hex, p.rise), BACK)
    nipple += chamfer(thread.faces().sort_by(Axis.Y)[-1].edges(), p.nipple_bevel)
    nipple -= rod(bore, p.nipple_hex + p.nipple_thread_length, (p.run, start, p.rise), BACK)
    nipple -= rod(p.tube, p.nipple_socket, (p.run, start, p.rise), BACK)
    clamp = block(p.clamp, (p.clamp_x, 0, p.rise - p.clamp[2] / 2))
    clamp = fillet(clamp.edges().filter_by(Axis.Z), p.clamp_round)
    clamp -= rod(p.tube, p.clamp[0], (p.clamp_x - p.clamp[0] / 2, 0, p.rise), RIGHT)
    for side in (-1, 1):
        clamp -= rod(p.clamp_hole, p.clamp[2], (p.clamp_x, side * p.clamp_span / 2, p.rise - p.clamp[2] / 2))
    return assembly(
        [
            named(tube, "tube", "silver"),
            named(flange, "flange", "steelblue"),
            named(nipple, "nipple", "goldenrod"),
            named(clamp, "clamp block", "dimgray"),
        ]
    )
