"""A machined soft jaw for a milling vice: work step, half-round nest, socket-screw mounting, key groove in the back."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, FRONT, LEFT, block, drill, rod

MODEL = Model("Soft jaw", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the jaw stands on z = 0, its gripping face looks to -y, its length runs along x."""

    length: float = 150
    thick: float = 40
    height: float = 60
    bevel: float = 3  # chamfer of the top back edge, 45 degrees
    step: float = 6  # how far the work step reaches into the gripping face
    step_depth: float = 4  # below the top
    nest: float = 60  # diameter of the half-round nest, its axis in the gripping face
    nest_depth: float = 18  # below the top
    screw: float = 13  # clearance of the M12 screws
    head: float = 20  # counterbore
    head_depth: float = 14  # from the gripping face
    screws: float = 98  # apart
    screw_z: float = 26
    dowel: float = 8
    dowel_depth: float = 12  # from the back, flat bottom
    dowels: float = 64  # apart
    dowel_z: float = 12
    key: float = 16  # width of the upright groove in the back
    key_depth: float = 5
    stop: float = 8.5  # core hole of the M10 work stop, in the right end
    stop_depth: float = 22  # full diameter
    stop_z: float = 40
    stop_y: float = 4  # behind the middle


def build(p: P) -> Part:
    """Saws the bar, mills step and nest, then drills."""
    front, back = -p.thick / 2, p.thick / 2
    body = block((p.length, p.thick, p.height))
    body = chamfer(body.edges().filter_by(Axis.X).sort_by(lambda e: e.center().Y + e.center().Z)[-1], p.bevel)
    body -= block((p.length, p.step, p.step_depth), (0, front + p.step / 2, p.height - p.step_depth))
    body -= rod(p.nest, p.nest_depth, (0, front, p.height), DOWN)
    body -= block((p.key, p.key_depth, p.height), (0, back - p.key_depth / 2, 0))
    for side in (-1, 1):
        x = side * p.screws / 2
        body -= rod(p.screw, p.thick, (x, front, p.screw_z), BACK)
        body -= rod(p.head, p.head_depth, (x, front, p.screw_z), BACK)
        body -= rod(p.dowel, p.dowel_depth, (side * p.dowels / 2, back, p.dowel_z), FRONT)
    body -= drill(p.stop, p.stop_depth, (p.length / 2, p.stop_y, p.stop_z), LEFT)
    return body
