"""A liquid-cooled cold plate: winding channel, seal groove, tapped rim, two side ports, mounting holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Pos, RectangleRounded, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import RIGHT, block, drill, grid, rod

MODEL = Model("Cold plate", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the plate lies on z = 0, its middle is x = y = 0, the ports are in the face at -x."""

    size: tuple[float, float, float] = (200, 140, 22)
    corner: float = 6  # radius of the upright edges
    channel: float = 8  # width
    channel_depth: float = 14
    runs: int = 4
    runs_pitch: float = 26
    run: float = 114  # straight length of a run
    groove: float = 4  # width of the seal groove
    groove_depth: float = 3
    groove_size: tuple[float, float] = (160, 110)  # of its centre line
    groove_corner: float = 10  # radius of its centre line
    tap: float = 3.3  # core hole of M4 for the lid
    tap_depth: float = 10
    taps_x: float = 40  # between the four of a long side
    taps_y: float = 128  # between the rows of the long sides
    ends_x: float = 182  # between the pairs of the short sides
    ends_y: float = 40  # between the two of a short side
    mount: float = 6.6
    bore: float = 12  # counterbore of the mounting holes
    bore_depth: float = 6.8
    mounts: tuple[float, float] = (180, 120)
    port: float = 11.8  # core hole of G 1/4
    port_depth: float = 15
    face: float = 20  # spot face of the ports
    face_depth: float = 1
    feed: float = 6  # from port to channel


def _channel(p: P) -> Part:
    """Straight runs along x, joined by half rings by turns right and left."""
    z = p.size[2] - p.channel_depth
    tall = p.channel_depth
    bend = p.runs_pitch / 2
    ys = [(index - (p.runs - 1) / 2) * p.runs_pitch for index in range(p.runs)]
    whole = Part()
    for y in ys:
        whole += block((p.run, p.channel, tall), (0, y, z))
    for index in range(p.runs - 1):
        side = 1 if index % 2 == 0 else -1
        x, y = side * p.run / 2, ys[index] + bend
        ring = rod(2 * bend + p.channel, tall, (x, y, z)) - rod(2 * bend - p.channel, tall, (x, y, z))
        half = block((p.runs_pitch, 2 * p.runs_pitch, tall), (x + side * p.runs_pitch / 2, y, z))
        whole += ring & half
    for y in (ys[0], ys[-1]):
        whole += rod(p.channel, tall, (-p.run / 2, y, z))
    return whole


def build(p: P) -> Part:
    """Mills channel and groove from above and drills."""
    x, y, z = p.size
    body = fillet(block(p.size).edges().filter_by(Axis.Z), p.corner)
    body -= _channel(p)
    w, h = p.groove_size
    outer = RectangleRounded(w + p.groove, h + p.groove, p.groove_corner + p.groove / 2)
    inner = RectangleRounded(w - p.groove, h - p.groove, p.groove_corner - p.groove / 2)
    body -= extrude(Pos(0, 0, z) * (outer - inner), amount=-p.groove_depth)
    for at in grid(4, 2, p.taps_x, p.taps_y) + grid(2, 2, p.ends_x, p.ends_y):
        body -= drill(p.tap, p.tap_depth, (*at, z))
    for at in grid(2, 2, *p.mounts):
        body -= rod(p.mount, z, (*at, 0))
        body -= rod(p.bore, p.bore_depth, (*at, z - p.bore_depth))
    middle = z - p.channel_depth + p.feed / 2
    for side in (-1, 1):
        across = side * (p.runs - 1) / 2 * p.runs_pitch
        body -= rod(p.face, p.face_depth, (-x / 2, across, middle), RIGHT)
        body -= rod(p.port, p.port_depth, (-x / 2, across, middle), RIGHT)
        body -= rod(p.feed, x / 2 - p.run / 2, (-x / 2, across, middle), RIGHT)
    return body
