"""The milled aluminium body of a five-cavity microwave filter: resonator posts, coupling windows, a lid, two coax ports."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import LEFT, RIGHT, block, drill, grid, rod

MODEL = Model("RF filter body", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; stands on z = 0, the middle is x = y = 0, the cavities follow each other along x, open at the top."""

    size: tuple[float, float, float] = (150, 60, 32)  # without the lugs
    cavities: int = 5
    cavity: tuple[float, float, float] = (24, 44, 26)  # along x, along y, depth
    web: float = 4  # between neighbouring cavities
    corner: float = 4  # radius of the cavities' upright corners
    post: float = 8  # diameter of the resonators
    post_height: float = 20  # above the floor
    post_bore: float = 4
    post_bore_depth: float = 12
    windows: tuple[float, ...] = (14, 10, 10, 14)  # widths of the coupling windows along y, from -x to +x
    window_depth: float = 15  # from the top
    tap: float = 2.5  # core hole of M3 for the lid
    tap_depth: float = 8
    taps_long: int = 6  # on each long wall
    taps_pitch: float = 28
    taps_y: float = 52  # between the two rows
    taps_end: float = 28  # between the two of an end wall
    taps_end_x: float = 143
    port: float = 4.1  # bore of the coax port
    port_z: float = 18
    port_tap: float = 2.05  # core hole of M2.5
    port_tap_depth: float = 5
    port_square: float = 8.6  # pitch of the four about the port
    lug: tuple[float, float, float] = (12, 34, 5)  # beyond the end wall
    lug_hole: float = 4.5
    lug_holes_y: float = 20
    lug_holes_x: float = 162  # between those of the two ends
    lug_corner: float = 5


def build(p: P) -> Part:
    """Mills the body from a block."""
    x, y, z = p.size
    lugs = block((x + 2 * p.lug[0], p.lug[1], p.lug[2]))
    body = block(p.size) + fillet(lugs.edges().filter_by(Axis.Z), p.lug_corner)
    pitch = p.cavity[0] + p.web
    floor = z - p.cavity[2]
    places = [(i - (p.cavities - 1) / 2) * pitch for i in range(p.cavities)]
    for place in places:
        cavity = block(p.cavity, (place, 0, floor))
        body -= fillet(cavity.edges().filter_by(Axis.Z), p.corner)
    for width, place in zip(p.windows, places, strict=False):
        body -= block((p.web + 2, width, p.window_depth), (place + pitch / 2, 0, z - p.window_depth))
    for place in places:
        body += rod(p.post, p.post_height, (place, 0, floor))
        top = floor + p.post_height
        body -= rod(p.post_bore, p.post_bore_depth, (place, 0, top), (0, 0, -1))
    lid = grid(p.taps_long, 2, p.taps_pitch, p.taps_y) + grid(2, 2, p.taps_end_x, p.taps_end)
    for at in lid:
        body -= drill(p.tap, p.tap_depth, (*at, z))
    for end, into in ((-1, RIGHT), (1, LEFT)):
        body -= rod(p.port, (x - places[-1] * 2 - p.cavity[0]) / 2, (end * x / 2, 0, p.port_z), into)
        for dy, dz in grid(2, 2, p.port_square, p.port_square):
            body -= rod(p.port_tap, p.port_tap_depth, (end * x / 2, dy, p.port_z + dz), into)
    for at in grid(2, 2, p.lug_holes_x, p.lug_holes_y):
        body -= rod(p.lug_hole, p.lug[2], (*at, 0))
    return body
