"""A moulded 12-way wire connector: collar, two rows of chambers, one of them blind, keying ribs, a spring latch."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Plane, Polygon, extrude, fillet

from benchmark.kit import Model
from benchmark.shapes import block, grid, rod

MODEL = Model("Connector shell", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the wires come in at z = 0, the mating face is on top; rows along x, latch at the back (high y)."""

    body: tuple[float, float, float] = (40, 18, 26)  # height over all
    body_radius: float = 1.5  # upright edges
    collar: tuple[float, float, float] = (46, 24, 3.5)
    collar_radius: float = 4
    columns: int = 6
    rows: int = 2
    pitch: float = 6.2
    row_pitch: float = 7.5
    wire: float = 5  # round, from the wire side
    wire_depth: float = 15
    pin: float = 3.8  # square, from the mating face
    blind: tuple[int, int] = (5, 0)  # column and row without the square opening
    ribs: tuple[tuple[float, float], ...] = ((-13, 2), (7, 3.2))  # x and width, at the front (low y)
    rib_out: float = 1.4
    latch: tuple[float, float] = (9, 2)  # width and thickness of the arm
    latch_gap: float = 2.2  # between arm and body
    latch_root: float = 3  # height of the bridge at the mating end
    latch_top: float = 24  # top of the bridge
    latch_end: float = 7  # free end of the arm above z = 0
    nose: tuple[float, float, float] = (1.6, 2, 6)  # out, flat height, height with the ramp
    nose_z: float = 13  # the catching face, looks down to the wire side


def build(p: P) -> Part:
    """Moulds it."""
    x, y, z = p.body
    body = block(p.body)
    body = fillet(body.edges().filter_by(Axis.Z), p.body_radius)
    collar = block(p.collar)
    body += fillet(collar.edges().filter_by(Axis.Z), p.collar_radius)
    for rx, width in p.ribs:
        body += block((width, p.rib_out + 2, z), (rx, -y / 2 - p.rib_out / 2 + 1, 0))
    inner = y / 2 + p.latch_gap
    outer = inner + p.latch[1]
    arm = [
        (y / 2 - 1, p.latch_top),
        (outer, p.latch_top),
        (outer, p.nose_z + p.nose[2]),
        (outer + p.nose[0], p.nose_z + p.nose[1]),
        (outer + p.nose[0], p.nose_z),
        (outer, p.nose_z),
        (outer, p.latch_end),
        (inner, p.latch_end),
        (inner, p.latch_top - p.latch_root),
        (y / 2 - 1, p.latch_top - p.latch_root),
    ]
    side = Plane.YZ.offset(-p.latch[0] / 2) * Polygon(*arm, align=None)
    body += extrude(side, amount=p.latch[0], dir=(1, 0, 0))
    places = grid(p.columns, p.rows, p.pitch, p.row_pitch)
    for index, at in enumerate(places):
        body -= rod(p.wire, p.wire_depth, (*at, 0))
        if index != p.blind[0] * p.rows + p.blind[1]:
            body -= block((p.pin, p.pin, z - p.wire_depth), (*at, p.wire_depth))
    return body
