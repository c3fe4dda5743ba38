"""A shielding box for a photodiode: box with bosses and standoffs, lid with a window seat, circuit board, window glass."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, Part, fillet

from benchmark.kit import Model
from benchmark.shapes import DOWN, LEFT, RIGHT, assembly, block, cone, grid, named, rod

MODEL = Model("Photodiode box", "held_out", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the box stands on z = 0, its middle is x = y = 0, the long side runs along x."""

    size: tuple[float, float, float] = (64, 44, 26)  # of the box without the lid
    corner: float = 6  # outer radius of the upright edges
    wall: float = 2.5
    floor: float = 3
    boss: float = 8  # in the corners, for the lid's screws
    bosses: tuple[float, float] = (52, 32)
    boss_tap: float = 2.5  # core hole of M3
    boss_tap_depth: float = 12
    standoff: float = 5
    standoff_height: float = 4  # above the floor
    standoffs: tuple[float, float] = (36, 16)
    standoff_tap: float = 1.6  # core hole of M2
    standoff_tap_depth: float = 5
    post_boss: float = 10  # on the floor's middle
    post_boss_height: float = 3.5  # above the floor
    post: float = 3.3  # core hole of M4, from below
    post_depth: float = 5
    jack: float = 6.5  # D-shaped hole for the SMA jack in the wall on +x
    jack_flat: float = 5.9  # from the flat, which lies below, to the round opposite
    jack_z: float = 16
    cable: float = 5  # round hole in the wall on -x
    cable_y: float = -9
    switch: tuple[float, float] = (9, 4.5)  # rectangular hole in the wall on -x, along y and z
    switch_y: float = 7
    lid: float = 3  # thickness without the plug
    plug: float = 1.5  # how far the lid's underside reaches into the box
    play: float = 0.2  # between plug and wall, each side
    screw: float = 3.4  # countersunk holes in the lid
    screw_head: float = 6.4  # diameter on top, 90 degrees
    aperture: float = 12.7  # through the lid
    aperture_x: float = 6
    seat: float = 16  # for the glass, from the top
    seat_depth: float = 1.2
    glass: float = 15.8
    glass_thickness: float = 1
    board: tuple[float, float, float] = (42, 22, 1.6)
    board_hole: float = 2.2


def build(p: P) -> Compound:
    """Hollows the box and closes it."""
    x, y, z = p.size
    inside = (x - 2 * p.wall, y - 2 * p.wall)
    room = _rounded((*inside, z), (0, 0, p.floor), p.corner - p.wall)
    box = _rounded(p.size, (0, 0, 0), p.corner) - room
    boss_top = z - p.plug
    for bx, by in grid(2, 2, *p.bosses):
        box += rod(p.boss, boss_top - p.floor, (bx, by, p.floor)) & _rounded(p.size, (0, 0, 0), p.corner)
    for bx, by in grid(2, 2, *p.bosses):
        box -= rod(p.boss_tap, p.boss_tap_depth, (bx, by, boss_top), DOWN)
    on = p.floor + p.standoff_height
    for sx, sy in grid(2, 2, *p.standoffs):
        box += rod(p.standoff, p.standoff_height, (sx, sy, p.floor))
        box -= rod(p.standoff_tap, p.standoff_tap_depth, (sx, sy, on), DOWN)
    box += rod(p.post_boss, p.post_boss_height, (0, 0, p.floor))
    box -= rod(p.post, p.post_depth)
    jack = rod(p.jack, p.wall, (x / 2, 0, p.jack_z), LEFT)
    flat_z = p.jack_z + p.jack / 2 - p.jack_flat
    jack -= block((x, p.jack, p.jack), (x / 2, 0, flat_z - p.jack))
    box -= jack
    box -= rod(p.cable, p.wall, (-x / 2, p.cable_y, p.jack_z), RIGHT)
    box -= block((p.wall, *p.switch), ((p.wall - x) / 2, p.switch_y, p.jack_z - p.switch[1] / 2))

    lid = _rounded((x, y, p.lid), (0, 0, z), p.corner)
    plug = (inside[0] - 2 * p.play, inside[1] - 2 * p.play, p.plug)
    lid += _rounded(plug, (0, 0, z - p.plug), p.corner - p.wall - p.play)
    top = z + p.lid
    sink = (p.screw_head - p.screw) / 2
    for bx, by in grid(2, 2, *p.bosses):
        lid -= rod(p.screw, p.lid + p.plug, (bx, by, top), DOWN)
        lid -= cone(p.screw_head, p.screw, sink, (bx, by, top), DOWN)
    lid -= rod(p.aperture, p.lid + p.plug, (p.aperture_x, 0, top), DOWN)
    lid -= rod(p.seat, p.seat_depth, (p.aperture_x, 0, top), DOWN)

    board = block(p.board, (0, 0, on))
    for sx, sy in grid(2, 2, *p.standoffs):
        board -= rod(p.board_hole, p.board[2], (sx, sy, on))
    glass = rod(p.glass, p.glass_thickness, (p.aperture_x, 0, top - p.seat_depth))
    return assembly(
        [
            named(box, "Box", "slategray"),
            named(lid, "Lid", "silver"),
            named(board, "Board", "darkgreen"),
            named(glass, "Window", "lightcyan"),
        ]
    )


def _rounded(size: tuple[float, float, float], base: tuple[float, float, float], radius: float) -> Part:
    body = block(size, base)
    return fillet(body.edges().filter_by(Axis.Z), radius)
