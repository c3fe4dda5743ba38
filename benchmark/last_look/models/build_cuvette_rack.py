"""A rack for standard cuvettes: two rows of square pockets with viewing windows, drains, a thermometer hole, feet."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Part, chamfer, fillet

from benchmark.kit import Model
from benchmark.shapes import BACK, DOWN, FRONT, block, grid, rod, slot

MODEL = Model("Cuvette rack", "held_out")


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the feet stand on z = 0, the middle is x = y = 0, the long side runs along x."""

    size: tuple[float, float, float] = (160, 52, 40)  # without the feet
    corner: float = 6  # radius of the upright edges
    bevel: float = 1.5  # 45 degrees, round the top
    foot: float = 10  # diameter
    foot_height: float = 4
    feet: tuple[float, float] = (140, 36)  # between the feet along x and y
    pocket: float = 12.6  # square
    pocket_depth: float = 32
    columns: int = 6
    rows: int = 2
    pitch: float = 24  # along a row
    row_pitch: float = 28
    drain: float = 5  # in each pocket's floor, right through
    window: float = 8  # width of the obround windows in the long sides
    window_height: float = 22
    window_z: float = 26  # of the windows' middle
    probe: float = 7  # thermometer hole in the middle
    probe_depth: float = 30
    label: tuple[float, float] = (34, 14)  # recess in the end on -x: width, height
    label_depth: float = 1
    label_z: float = 24  # of its middle


def build(p: P) -> Part:
    """Mills the block, then pockets, windows and holes."""
    x, y, z = p.size
    top = p.foot_height + z
    body = block(p.size, (0, 0, p.foot_height))
    body = fillet(body.edges().filter_by(Axis.Z), p.corner)
    body = chamfer(body.faces().sort_by(Axis.Z)[-1].edges(), p.bevel)
    for fx, fy in grid(2, 2, *p.feet):
        body += rod(p.foot, p.foot_height, (fx, fy, 0))
    for px, py in grid(p.columns, p.rows, p.pitch, p.row_pitch):
        body -= block((p.pocket, p.pocket, p.pocket_depth), (px, py, top - p.pocket_depth))
        body -= rod(p.drain, z, (px, py, p.foot_height))
        side = 1 if py > 0 else -1
        into = FRONT if side > 0 else BACK
        body -= slot(p.window_height, p.window, y / 2 - abs(py), (px, side * y / 2, p.window_z), into, 90)
    body -= rod(p.probe, p.probe_depth, (0, 0, top), DOWN)
    width, height = p.label
    body -= block((p.label_depth, width, height), ((p.label_depth - x) / 2, 0, p.label_z - height / 2))
    return body
