"""A five inch sine bar: ground bar, two rollers, an end stop."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part, chamfer

from benchmark.kit import INCH, Model
from benchmark.shapes import BACK, DOWN, RIGHT, assembly, block, drill, grid, named, rod

MODEL = Model("Sine bar", "held_out", unit="in", bodies=4)


@dataclass(frozen=True, slots=True)
class P:
    """Inches; the bar lies along x, its middle is x = y = 0, the rollers stand on z = 0."""

    centers: float = 5.0  # between the rollers
    roller: float = 0.75  # diameter
    roller_chamfer: float = 0.03
    width: float = 1.0  # of bar, rollers and stop
    height: float = 0.875  # of the bar
    holes: int = 3  # lightening holes through the sides
    hole: float = 0.4375
    holes_pitch: float = 1.125
    tap: float = 0.201  # core hole of 1/4-20, in the top
    tap_depth: float = 0.4
    taps_x: float = 1.5  # between neighbours
    taps_y: float = 0.5
    tap_columns: int = 4
    stop: float = 0.25  # thickness of the end stop
    stop_height: float = 1.125
    stop_rise: float = 0.375  # of the stop above the bar
    screw: float = 0.266  # clearance holes in the stop
    screws_y: float = 0.5
    screw_drop: float = 0.25  # holes below the bar's top

    @property
    def length(self) -> float:
        """Of the bar: its ends are flush with the rollers."""
        return self.centers + self.roller

    @property
    def bar_z(self) -> float:
        return self.roller / 2

    @property
    def top_z(self) -> float:
        return self.bar_z + self.height


def _bar(p: P) -> Part:
    i = INCH
    x = p.length * i
    body = block((x, p.width * i, p.height * i), (0, 0, p.bar_z * i))
    seat = (p.roller * i, p.width * i, p.roller / 2 * i)
    for side in (-1, 1):
        body -= block(seat, (side * (x - p.roller * i) / 2, 0, p.bar_z * i))
    middle = p.bar_z + p.height / 2
    for column in range(p.holes):
        at = (column - (p.holes - 1) / 2) * p.holes_pitch
        body -= rod(p.hole * i, p.width * i, (at * i, -p.width / 2 * i, middle * i), BACK)
    for at, across in grid(p.tap_columns, 2, p.taps_x * i, p.taps_y * i):
        body -= drill(p.tap * i, p.tap_depth * i, (at, across, p.top_z * i), DOWN)
    for side in (-1, 1):
        mouth = (-x / 2, side * p.screws_y / 2 * i, (p.top_z - p.screw_drop) * i)
        body -= drill(p.tap * i, p.tap_depth * i, mouth, RIGHT)
    return body


def _roller(p: P, side: int) -> Part:
    i = INCH
    start = (side * p.centers / 2 * i, -p.width / 2 * i, p.roller / 2 * i)
    body = rod(p.roller * i, p.width * i, start, BACK)
    return chamfer(body.edges().filter_by(lambda e: e.geom_type.name == "CIRCLE"), p.roller_chamfer * i)


def _stop(p: P) -> Part:
    i = INCH
    x = -(p.length / 2 + p.stop) * i
    low = (p.top_z + p.stop_rise - p.stop_height) * i
    body = block((p.stop * i, p.width * i, p.stop_height * i), (x + p.stop / 2 * i, 0, low))
    for side in (-1, 1):
        start = (x, side * p.screws_y / 2 * i, (p.top_z - p.screw_drop) * i)
        body -= rod(p.screw * i, p.stop * i, start, RIGHT)
    return body


def build(p: P) -> Compound:
    """Grinds the bar and its rollers and sets the stop on the left end."""
    return assembly(
        [
            named(_bar(p), "bar", "lightsteelblue"),
            named(_roller(p, -1), "roller left", "gray"),
            named(_roller(p, 1), "roller right", "gray"),
            named(_stop(p), "end stop", "darkslategray"),
        ]
    )
