"""A welded oil tank for a power pack: shell with rim, bolted lid, baffle, two feet, drain socket."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, assembly, block, drill, named, rod

MODEL = Model("Oil reservoir", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; length along x, width along y; the feet stand on z = 0, x = y = 0 is the middle of the tank."""

    length: float = 640  # outside of the shell
    width: float = 420
    height: float = 360  # of the shell with its rim, without the feet
    sheet: float = 4  # wall and floor of the shell
    rim: float = 32  # how far the rim stands out from the wall
    rim_thickness: float = 6
    feet: float = 90  # height of the feet
    foot_width: float = 60  # along x
    foot_sheet: float = 5
    foot_x: float = 250  # of their middles
    foot_hole: float = 13
    foot_holes_y: float = 340  # between the two of a foot
    lid: float = 10  # thickness
    bolt: float = 9
    bolts_x: tuple[float, ...] = (-336, -112, 112, 336)
    bolts_y: float = 226  # of the long rows; the short sides have one each in the middle
    filler: float = 82  # opening of the filler breather
    filler_at: tuple[float, float] = (-220, 110)
    filter: float = 120  # opening of the return filter
    filter_at: tuple[float, float] = (-190, -80)
    suction: float = 56  # opening of the suction pipe
    suction_at: tuple[float, float] = (210, 60)
    motor_taps: int = 4  # for the motor foot
    motor_tap: float = 10.2  # M12 core, right through
    motor_x: float = 140
    motor_y: float = 125
    motor_at: tuple[float, float] = (150, -70)
    baffle: float = 3  # thickness
    baffle_x: float = 30  # its left face
    baffle_height: float = 240
    window: float = 70  # edge of the square passages cut out of the lower corners
    gauge: float = 12.5  # holes of the level gauge in the front wall
    gauge_pitch: float = 127
    gauge_x: float = -230
    gauge_low: float = 85  # lower hole above the underside of the shell
    socket: float = 42  # outside diameter of the drain socket
    socket_length: float = 30
    socket_bore: float = 24.1  # core of G3/4
    socket_x: float = 270
    socket_z: float = 40  # above the underside of the shell


def build(p: P) -> Compound:
    """Six bodies in place."""
    z0, s = p.feet, p.sheet
    top = z0 + p.height
    shell = block((p.length, p.width, p.height), (0, 0, z0))
    shell += block((p.length + 2 * p.rim, p.width + 2 * p.rim, p.rim_thickness), (0, 0, top - p.rim_thickness))
    shell -= block((p.length - 2 * s, p.width - 2 * s, p.height), (0, 0, z0 + s))
    holes = [(x, side * p.bolts_y) for x in p.bolts_x for side in (-1, 1)]
    holes += [(-p.bolts_x[-1], 0), (p.bolts_x[-1], 0)]
    for x, y in holes:
        shell -= rod(p.bolt, p.rim_thickness, (x, y, top - p.rim_thickness))
    for i in (0, 1):
        shell -= rod(p.gauge, 2 * s, (p.gauge_x, -p.width / 2 - 1, z0 + p.gauge_low + i * p.gauge_pitch), BACK)
    mouth = (p.socket_x, -p.width / 2 + s, z0 + p.socket_z)
    shell -= rod(p.socket, 2 * s, mouth, FRONT)

    lid = block((p.length + 2 * p.rim, p.width + 2 * p.rim, p.lid), (0, 0, top))
    for x, y in holes:
        lid -= rod(p.bolt, p.lid, (x, y, top))
    for d, (x, y) in ((p.filler, p.filler_at), (p.filter, p.filter_at), (p.suction, p.suction_at)):
        lid -= rod(d, p.lid, (x, y, top))
    for i in (-1, 1):
        for j in (-1, 1):
            lid -= rod(p.motor_tap, p.lid, (p.motor_at[0] + i * p.motor_x / 2, p.motor_at[1] + j * p.motor_y / 2, top))

    inner = p.width - 2 * s
    mid = p.baffle_x + p.baffle / 2
    baffle = block((p.baffle, inner, p.baffle_height), (mid, 0, z0 + s))
    for side in (-1, 1):
        baffle -= block((p.baffle, p.window, p.window), (mid, side * (inner - p.window) / 2, z0 + s))

    def foot(x: float):
        t = p.foot_sheet
        body = block((p.foot_width, p.width, p.feet), (x, 0, 0))
        body -= block((p.foot_width - 2 * t, p.width, p.feet - t), (x, 0, t))
        for side in (-1, 1):
            body -= rod(p.foot_hole, t, (x, side * p.foot_holes_y / 2, 0))
        return body

    socket = rod(p.socket, p.socket_length, mouth, FRONT) - rod(p.socket_bore, p.socket_length, mouth, FRONT)
    return assembly([
        named(shell, "tank shell", "steelblue"),
        named(lid, "lid", "gray"),
        named(baffle, "baffle", "orange"),
        named(foot(-p.foot_x), "foot left", "black"),
        named(foot(p.foot_x), "foot right", "black"),
        named(socket, "drain socket", "gold"),
    ])
