"""A sub-table with three T-slots, counterbored corner holes, reamed stop holes, a key slot below and a nameplate recess."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, block, drill, grid, rod

MODEL = Model("T-slot table", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the table lies on z = 0, its middle is x = y = 0; the T-slots run along x."""

    table: tuple[float, float, float] = (240, 160, 36)
    bevel: float = 6  # of the upright edges
    slots: int = 3
    pitch: float = 45
    throat: float = 12
    throat_depth: float = 13
    foot: float = 20  # width of the T's lower part
    foot_height: float = 8
    bolt: float = 9
    bolt_head: float = 15
    bolt_head_depth: float = 9
    bolts: tuple[float, float] = (200, 136)
    ream: float = 8
    ream_depth: float = 16
    reams_x: float = 160
    ream_y: float = 22.5
    key: float = 14  # width of the slot below, along y
    key_depth: float = 5
    tap: float = 5  # core hole of M6
    tap_depth: float = 14
    taps_x: float = 130
    side_z: float = 18  # of the tapped holes and the recess
    recess: tuple[float, float, float] = (70, 1.5, 20)


def build(p: P) -> Part:
    """Mills slots and recess, drills."""
    x, y, z = p.table
    body = block(p.table)
    body = chamfer(body.edges().filter_by(Axis.Z), p.bevel)
    for _, at in grid(1, p.slots, 0, p.pitch):
        body -= block((x, p.throat, p.throat_depth), (0, at, z - p.throat_depth))
        body -= block((x, p.foot, p.foot_height), (0, at, z - p.throat_depth - p.foot_height))
    for at in grid(2, 2, *p.bolts):
        body -= rod(p.bolt, z, (*at, 0)) + rod(p.bolt_head, p.bolt_head_depth, (*at, z), DOWN)
    for side in (-1, 1):
        body -= rod(p.ream, p.ream_depth, (side * p.reams_x / 2, p.ream_y, z), DOWN)
        body -= drill(p.tap, p.tap_depth, (side * p.taps_x / 2, -y / 2, p.side_z), BACK)
    body -= block((p.key, y, p.key_depth))
    return body - block(p.recess, (0, (p.recess[1] - y) / 2, p.side_z - p.recess[2] / 2))
