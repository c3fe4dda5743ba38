"""The lower half of a moulded terminal box: drafted walls, screw posts, cable entries, fixing ears."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Part, Pos, RectangleRounded, extrude

from benchmark.kit import Model
from benchmark.shapes import BACK, RIGHT, UP, block, grid, rod

MODEL = Model("Terminal box", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres and degrees; the box stands on z = 0, open at the top, the row of cable entries looks to -y."""

    base: tuple[float, float] = (130, 90)  # outside, at the bottom
    height: float = 60
    draft: float = 1.5  # of all walls, in and out: the box widens upwards
    corner: float = 8  # outer radius at the bottom
    wall: float = 3  # measured level
    floor: float = 4
    post_d: float = 9
    post_top: float = 52  # above the underside
    post_grid: tuple[float, float] = (108, 68)
    pilot_d: float = 3.4
    pilot_depth: float = 14
    entry_d: float = 20.5  # in the long wall
    entries: int = 3
    entry_pitch: float = 36
    entry_z: float = 32
    side_d: float = 16.5  # in the short wall at +x
    rail: tuple[float, float, float] = (3, 56, 9)  # seats on the floor, above it
    rail_pitch: float = 46
    ear_r: float = 12  # of the ear's round end, its width is twice that
    ear: float = 5  # thickness
    ear_pitch: float = 154  # between the screw holes
    ear_d: float = 5.5
    dimple_d: float = 10  # in the underside
    dimple: float = 2  # depth


def build(p: P) -> Part:
    """Moulds the shell, then the posts and ears."""
    x, y = p.base
    body = extrude(RectangleRounded(x, y, p.corner), amount=p.height, taper=-p.draft)
    for side in (-1, 1):
        body += rod(2 * p.ear_r, p.ear, (side * p.ear_pitch / 2, 0, 0))
        reach = p.ear_pitch / 2 - x / 4
        body += block((reach, 2 * p.ear_r, p.ear), (side * (p.ear_pitch / 2 - reach / 2), 0, 0))
        body -= rod(p.ear_d, p.ear, (side * p.ear_pitch / 2, 0, 0))
    grow = 2 * p.floor * math.tan(math.radians(p.draft))
    inner = Pos(0, 0, p.floor) * RectangleRounded(
        x - 2 * p.wall + grow, y - 2 * p.wall + grow, p.corner - p.wall + grow / 2
    )
    body -= extrude(inner, amount=p.height - p.floor, taper=-p.draft)
    for px, py in grid(2, 2, *p.post_grid):
        body += rod(p.post_d, p.post_top - p.floor / 2, (px, py, p.floor / 2))
        body -= rod(p.pilot_d, p.pilot_depth, (px, py, p.post_top - p.pilot_depth))
    for side in (-1, 1):
        body += block((p.rail[0], p.rail[1], p.rail[2] + 1), (side * p.rail_pitch / 2, 0, p.floor - 1))
    for index in range(p.entries):
        body -= rod(p.entry_d, 20, ((index - (p.entries - 1) / 2) * p.entry_pitch, -y / 2 - 10, p.entry_z), BACK)
    body -= rod(p.side_d, 20, (x / 2 - 10, 0, p.entry_z), RIGHT)
    body -= rod(p.dimple_d, p.dimple, (0, 0, 0), UP)
    return body
