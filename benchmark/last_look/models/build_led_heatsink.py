"""An extruded heat sink of an LED lamp, milled: fins with cross cuts, a pocket for the LED board, probe and wire holes."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Part

from benchmark.kit import Model
from benchmark.shapes import BACK, RIGHT, UP, block, drill, grid, rod

MODEL = Model("LED heat sink", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; extruded along y; base underside at z = 0, the fins stand up; middle x = y = 0."""

    length: float = 130  # y
    width: float = 112  # x
    base: float = 9
    fins: int = 13  # together with the two thicker outer ones
    fin: float = 2
    outer_fin: float = 4
    height: float = 42  # over all
    pitch: float = 9  # between the middles of neighbouring fins
    cuts: int = 2
    cut: float = 6  # width of each cross cut
    cut_y: float = 50  # between the middles of the two cuts
    cut_z: float = 14  # ground of the cuts
    pocket_x: float = 56
    pocket_y: float = 48
    pocket_depth: float = 2.5
    tap: float = 2.5  # M3 core, through the pocket's ground into the base
    tap_dx: float = 48
    tap_dy: float = 38
    tap_depth: float = 5
    wire: float = 5  # through the base in the pocket's middle line
    wire_y: float = 15
    mount: float = 4.5
    mount_dx: float = 99
    mount_dy: float = 110
    probe: float = 2.2  # from the right side
    probe_depth: float = 38
    probe_z: float = 6


def build(p: P) -> Part:
    body = block((p.width, p.length, p.base))
    for index in range(p.fins):
        side = index - (p.fins - 1) / 2
        last = abs(side) == (p.fins - 1) / 2
        wide = p.outer_fin if last else p.fin
        body += block((wide, p.length, p.height), (side * p.pitch, 0, 0))
    for s in (-1, 1):
        body -= block((p.width + 10, p.cut, p.height), (0, s * p.cut_y / 2, p.cut_z))
    body -= block((p.pocket_x, p.pocket_y, p.pocket_depth))
    for x, y in grid(2, 2, p.tap_dx, p.tap_dy):
        body -= rod(p.tap, p.tap_depth, (x, y, p.pocket_depth))
    body -= rod(p.wire, p.base, (p.pitch / 2, p.wire_y, 0))
    for x, y in grid(2, 2, p.mount_dx, p.mount_dy):
        body -= rod(p.mount, p.base, (x, y, 0))
    body -= drill(p.probe, p.probe_depth, (p.width / 2, 0, p.probe_z), (-1, 0, 0))
    return body
