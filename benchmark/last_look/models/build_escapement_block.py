"""An escapement for headed screws: a T track on top, two blade gates from the front, a light barrier, an air jet."""

from __future__ import annotations

import math
from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, FRONT, UP, block, drill, rod

MODEL = Model("Escapement block", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; stands on z = 0, middle at x = y = 0; screws travel along x, hanging by their heads."""

    size: tuple[float, float, float] = (120, 60, 40)
    head_width: float = 14  # upper step of the track
    head_depth: float = 6
    shank_width: float = 6.4  # lower slot of the track
    shank_depth: float = 26  # from the top
    lead_in: float = 3  # chamfer at the entry (low x) of the shank slot
    gates: tuple[float, float] = (-20, 2)  # x of the two gates, in the front face
    gate_bore: float = 16  # seat of the blade cylinder
    gate_bore_depth: float = 10
    blade: tuple[float, float] = (5, 8)  # window, along x and z, from the seat to the shank slot
    gate_z: float = 22
    eye_x: float = 30  # light barrier across the track
    eye_z: float = 20
    eye: float = 5  # through along y
    eye_seat: float = 9  # counterbore, both sides
    eye_seat_depth: float = 8
    jet: float = 3  # air jet from the back face to the shank slot
    jet_x: float = -40  # where it enters the back face
    jet_z: float = 22
    jet_angle: float = 25  # off the face normal, leaning to high x
    bolts: tuple[float, float] = (100, 44)  # pattern of 4
    bolt: float = 6.6
    bolt_head: float = 11
    bolt_head_depth: float = 6.8
    taps: tuple[float, float] = (64, 28)  # pattern of 4 M4 for the track cover
    tap: float = 3.3
    tap_depth: float = 10
    dowels: float = 100  # between the two in the underside, on the long middle line
    dowel: float = 6
    dowel_depth: float = 9


def build(p: P) -> Part:
    """Mills the block."""
    x, y, z = p.size
    body = block(p.size)
    body -= block((x, p.head_width, p.head_depth), (0, 0, z - p.head_depth))
    body -= block((x, p.shank_width, p.shank_depth), (0, 0, z - p.shank_depth))
    entry = [
        e
        for e in body.edges().filter_by(Axis.Z)
        if abs(e.center().X + x / 2) < 1e-6 and abs(abs(e.center().Y) - p.shank_width / 2) < 1e-6
    ]
    body = chamfer(entry, p.lead_in)
    for gx in p.gates:
        body -= rod(p.gate_bore, p.gate_bore_depth, (gx, -y / 2, p.gate_z), BACK)
        body -= block((p.blade[0], y / 2, p.blade[1]), (gx, -y / 4, p.gate_z - p.blade[1] / 2))
    body -= rod(p.eye, y, (p.eye_x, -y / 2, p.eye_z), BACK)
    body -= rod(p.eye_seat, p.eye_seat_depth, (p.eye_x, -y / 2, p.eye_z), BACK)
    body -= rod(p.eye_seat, p.eye_seat_depth, (p.eye_x, y / 2, p.eye_z), FRONT)
    a = math.radians(p.jet_angle)
    way = (math.sin(a), -math.cos(a), 0)
    run = (y / 2) / math.cos(a)
    start = (p.jet_x - 5 * way[0], y / 2 - 5 * way[1], p.jet_z)
    body -= rod(p.jet, run + 5, start, way)
    for sx in (-1, 1):
        for sy in (-1, 1):
            at = (sx * p.bolts[0] / 2, sy * p.bolts[1] / 2)
            body -= rod(p.bolt, z, (*at, 0))
            body -= rod(p.bolt_head, p.bolt_head_depth, (*at, z - p.bolt_head_depth))
            body -= drill(p.tap, p.tap_depth, (sx * p.taps[0] / 2, sy * p.taps[1] / 2, z))
        body -= drill(p.dowel, p.dowel_depth, (sx * p.dowels / 2, 0, 0), UP)
    return body
