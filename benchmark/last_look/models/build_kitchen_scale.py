"""A kitchen scale of named bodies: a rounded housing, a round platform, a display, two buttons, a battery lid, four feet."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Compound, fillet

from benchmark.kit import Model
from benchmark.shapes import DOWN, assembly, block, grid, named, rod

MODEL = Model("Kitchen scale", "held_out", bodies=10)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the feet stand on z = 0, the housing's middle is x = y = 0, the display is in front."""

    housing: tuple[float, float, float] = (180, 226, 26)
    corner: float = 32
    foot: float = 20
    foot_height: float = 5
    feet_x: float = 126
    feet_y: float = 170
    pillar: float = 42  # part of the housing
    pillar_height: float = 4
    platform: float = 156
    platform_height: float = 7
    platform_y: float = 24
    display: tuple[float, float, float] = (64, 26, 2)  # flush
    controls_y: float = -86
    button: float = 15
    button_height: float = 6
    button_depth: float = 3.5  # of the hole in the housing
    button_hole: float = 16
    buttons_x: float = 112  # between them
    lid: tuple[float, float, float] = (58, 44, 2.5)  # flush with the underside
    lid_y: float = 30

    @property
    def top(self) -> float:
        """Height of the housing's upper face."""
        return self.foot_height + self.housing[2]

    @property
    def height(self) -> float:
        """Over all."""
        return self.top + self.pillar_height + self.platform_height


def build(p: P) -> Compound:
    """Everything in its place."""
    low = p.foot_height
    housing = fillet(block(p.housing, (0, 0, low)).edges().filter_by(Axis.Z), p.corner)
    housing += rod(p.pillar, p.pillar_height, (0, p.platform_y, p.top))
    display = block(p.display, (0, p.controls_y, p.top - p.display[2]))
    lid = block(p.lid, (0, p.lid_y, low))
    housing = housing - display - lid
    xs = (-p.buttons_x / 2, p.buttons_x / 2)
    for x in xs:
        housing -= rod(p.button_hole, p.button_depth, (x, p.controls_y, p.top), DOWN)
    buttons = [rod(p.button, p.button_height, (x, p.controls_y, p.top - p.button_depth)) for x in xs]
    platform = rod(p.platform, p.platform_height, (0, p.platform_y, p.top + p.pillar_height))
    return assembly(
        [
            named(housing, "Housing", "WhiteSmoke"),
            named(platform, "Weighing platform", "LightSteelBlue"),
            named(display, "Display", "Black"),
            named(buttons[0], "Tare button", "Red"),
            named(buttons[1], "Unit button", "DimGray"),
            named(lid, "Battery lid", "Gray"),
            *[
                named(rod(p.foot, p.foot_height, (x, y, 0)), f"Rubber foot {n}", "DarkSlateGray")
                for n, (x, y) in enumerate(grid(2, 2, p.feet_x, p.feet_y), start=1)
            ],
        ]
    )
