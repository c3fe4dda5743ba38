"""A small bench vise of named bodies: base with fixed jaw and nut block, sliding jaw, two jaw plates, spindle, handle."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound

from benchmark.kit import Model
from benchmark.shapes import BACK, LEFT, RIGHT, assembly, block, grid, named, rod

MODEL = Model("Bench vise", "held_out", bodies=8)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the base stands on z = 0, its middle is x = y = 0; the spindle runs along x, its head on the right."""

    base: tuple[float, float, float] = (170, 120, 18)
    hole: float = 9
    holes_x: float = 134
    holes_y: float = 98
    jaw: tuple[float, float, float] = (30, 76, 54)  # both jaws, standing on the base
    plate: tuple[float, float, float] = (6, 76, 28)  # flush with the jaws' tops
    plate_hole: float = 5.5
    plate_holes_y: float = 46
    opening: float = 38
    nut: tuple[float, float, float] = (22, 44, 46)
    spindle: float = 16
    spindle_z: float = 46
    clearance: float = 16.5  # hole in the nut block
    seat: float = 12  # depth of the spindle's seat in the sliding jaw
    free: float = 26  # of the spindle beyond the base's right end, up to its head
    head: float = 25
    head_length: float = 24
    handle: float = 8
    handle_length: float = 110
    knob: float = 14
    knob_length: float = 10

    @property
    def left(self) -> float:
        """x of the base's left end."""
        return -self.base[0] / 2

    @property
    def slide(self) -> float:
        """x of the sliding jaw's left face, behind its plate."""
        return self.left + self.jaw[0] + 2 * self.plate[0] + self.opening

    @property
    def start(self) -> float:
        """x of the spindle's left end."""
        return self.slide + self.jaw[0] - self.seat

    @property
    def head_x(self) -> float:
        """x of the head's left face."""
        return -self.left + self.free

    @property
    def handle_x(self) -> float:
        """x of the handle's axis."""
        return self.head_x + self.head_length / 2

    @property
    def spindle_length(self) -> float:
        """With the head."""
        return self.head_x + self.head_length - self.start

    @property
    def top(self) -> float:
        """Height of the jaws' tops."""
        return self.base[2] + self.jaw[2]


def build(p: P) -> Compound:
    """Everything in its place."""
    t = p.base[2]
    base = block(p.base) + block(p.jaw, (p.left + p.jaw[0] / 2, 0, t))
    base += block(p.nut, (-p.left - p.nut[0] / 2, 0, t))
    base -= rod(p.clearance, p.nut[0], (-p.left, 0, p.spindle_z), LEFT)
    for x, y in grid(2, 2, p.holes_x, p.holes_y):
        base -= rod(p.hole, t, (x, y, 0))
    slider = block(p.jaw, (p.slide + p.jaw[0] / 2, 0, t))
    slider -= rod(p.spindle, p.seat, (p.slide + p.jaw[0], 0, p.spindle_z), LEFT)

    def plate(x: float):
        body = block(p.plate, (x + p.plate[0] / 2, 0, p.top - p.plate[2]))
        for y in (-p.plate_holes_y / 2, p.plate_holes_y / 2):
            body -= rod(p.plate_hole, p.plate[0], (x, y, p.top - p.plate[2] / 2), RIGHT)
        return body

    spindle = rod(p.spindle, p.head_x - p.start, (p.start, 0, p.spindle_z), RIGHT)
    spindle += rod(p.head, p.head_length, (p.head_x, 0, p.spindle_z), RIGHT)
    spindle -= rod(p.handle, p.head, (p.handle_x, -p.head / 2, p.spindle_z), BACK)
    end = p.handle_length / 2
    bar = rod(p.handle, p.handle_length, (p.handle_x, -end, p.spindle_z), BACK)
    knobs = [rod(p.knob, p.knob_length, (p.handle_x, y, p.spindle_z), BACK) for y in (-end - p.knob_length, end)]
    return assembly(
        [
            named(base, "Base", "SteelBlue"),
            named(slider, "Sliding jaw", "LightSteelBlue"),
            named(plate(p.left + p.jaw[0]), "Fixed jaw plate", "DimGray"),
            named(plate(p.slide - p.plate[0]), "Sliding jaw plate", "DimGray"),
            named(spindle, "Spindle", "Silver"),
            named(bar, "Handle bar", "Goldenrod"),
            named(knobs[0], "Knob front", "Red"),
            named(knobs[1], "Knob back", "Red"),
        ]
    )
