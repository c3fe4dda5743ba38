"""A microscope stage insert: seats for a slide and a dish, clip threads, countersunk holes, engraved ticks, key corner."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, Pos, Rot, fillet

from benchmark.kit import Model
from benchmark.shapes import DOWN, block, cone, grid, rod

MODEL = Model("Stage insert", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the underside is z = 0, the middle is x = y = 0."""

    size: tuple[float, float, float] = (160, 110, 4)
    corner: float = 4  # radius of three of the corners
    step: float = 2.2  # by which the lower part stands back all round
    step_height: float = 2  # of the lower part
    key: float = 8  # legs of the cut corner on +x +y, 45 degrees
    slide: tuple[float, float] = (76.4, 26.4)  # recess
    slide_depth: float = 1.2
    slide_x: float = -28  # of its middle
    window: tuple[float, float] = (66, 20)  # through, in the recess's middle
    window_corner: float = 2
    finger: float = 18  # diameter of the finger notches in the recess's long sides, through
    dish: float = 35.2  # round recess
    dish_depth: float = 2.5
    dish_hole: float = 30  # through
    dish_x: float = 46
    tap: float = 2.5  # core hole of M3, through, for the clips
    slide_taps: float = 44  # between the two beside the slide, along y
    slide_taps_x: float = -58
    dish_taps: float = 50  # between the two beside the dish, along y
    screw: float = 3.4  # in the four corners
    screws: tuple[float, float] = (144, 94)
    screw_head: float = 6.6  # 90 degree countersink
    tick: tuple[float, float, float] = (0.4, 5, 0.3)  # width, length, depth
    ticks: int = 9
    tick_pitch: float = 5
    ticks_y: float = -32


def build(p: P) -> Part:
    """Mills the plate with its step, then seats and holes."""
    x, y, z = p.size
    upper = block((x, y, z - p.step_height), (0, 0, p.step_height))
    lower = block((x - 2 * p.step, y - 2 * p.step, p.step_height))
    body = _round(upper, p.corner) + _round(lower, p.corner - p.step)
    reach = 2**0.5 * p.key
    body -= Pos(x / 2, y / 2, 0) * Rot(0, 0, 45) * block((reach, 4 * p.key, z))
    body -= block((*p.slide, p.slide_depth), (p.slide_x, 0, z - p.slide_depth))
    body -= fillet(block((*p.window, z), (p.slide_x, 0, 0)).edges().filter_by(Axis.Z), p.window_corner)
    for side in (-1, 1):
        body -= rod(p.finger, z, (p.slide_x, side * p.slide[1] / 2, 0))
        body -= rod(p.tap, z, (p.slide_taps_x, side * p.slide_taps / 2, 0))
        body -= rod(p.tap, z, (p.dish_x, side * p.dish_taps / 2, 0))
    body -= rod(p.dish, p.dish_depth, (p.dish_x, 0, z), DOWN)
    body -= rod(p.dish_hole, z, (p.dish_x, 0, 0))
    for sx, sy in grid(2, 2, *p.screws):
        body -= rod(p.screw, z, (sx, sy, 0))
        body -= cone(p.screw_head, p.screw, (p.screw_head - p.screw) / 2, (sx, sy, z), DOWN)
    width, length, depth = p.tick
    for tx, ty in grid(p.ticks, 1, p.tick_pitch, 0, (p.slide_x, p.ticks_y)):
        body -= block((width, length, depth), (tx, ty, z - depth))
    return body


def _round(body: Part, radius: float) -> Part:
    """Three corners; the one on +x +y will be cut."""
    edges = [e for e in body.edges().filter_by(Axis.Z) if e.center().X < 0 or e.center().Y < 0]
    return fillet(edges, radius)
