"""A ball-bearing drawer slide, pulled out: outer rail, inner rail, eight balls and a rubber bumper."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Compound, Part, Pos, Sphere

from benchmark.kit import Model
from benchmark.shapes import BACK, assembly, block, cone, named, rod, slot

MODEL = Model("Drawer slide", "held_out", bodies=11)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the rails run along x, the outer rail's back lies on y = 0 and its left end on x = 0; z = 0 is the middle."""

    outer: tuple[float, float, float] = (300, 12, 45)
    inner: tuple[float, float, float] = (280, 8, 32)
    travel: float = 100  # x of the inner rail's left end
    sheet: float = 1.5
    ball: float = 5
    balls_x: tuple[float, ...] = (120, 175, 230, 285)
    ball_y: float = -7
    hole: float = 4.5  # in the outer rail
    holes_x: tuple[float, ...] = (20, 150, 280)
    upright: tuple[float, float] = (10, 4.5)  # slots of the outer rail, along z
    uprights_x: tuple[float, ...] = (55, 245)
    screw: float = 4  # in the inner rail
    sink: float = 6.4  # of 90 degrees
    screws_x: tuple[float, ...] = (30, 140, 250)  # from the inner rail's left end
    level: tuple[float, float] = (14, 4)  # slots of the inner rail, along x
    levels_x: tuple[float, ...] = (75, 205)  # from the inner rail's left end
    bumper: tuple[float, float, float] = (8, 8, 20)

    @property
    def reach(self) -> float:
        """Where does the inner rail end? x."""
        return self.travel + self.inner[0]


def build(p: P) -> Compound:
    """Bends the rails, punches them and puts the balls between them."""
    length, depth, height = p.outer
    outer = block(p.outer, (length / 2, -depth / 2, -height / 2))
    free = height - 2 * p.sheet
    outer -= block((length, depth - p.sheet, free), (length / 2, -(depth + p.sheet) / 2, -free / 2))
    outer -= [rod(p.hole, p.sheet, (x, -p.sheet, 0), BACK) for x in p.holes_x]
    outer -= [slot(*p.upright, p.sheet, (x, -p.sheet, 0), BACK, rotation=90) for x in p.uprights_x]
    bodies: list[Part] = [named(outer, "Outer rail", "Silver"), named(_inner(p), "Inner rail", "SteelBlue")]
    z = (free / 2 + p.inner[2] / 2) / 2
    spots = [(x, p.ball_y, side * z) for side in (1, -1) for x in p.balls_x]
    bodies += [named(Pos(*at) * Sphere(p.ball / 2), f"Ball {n}", "Goldenrod") for n, at in enumerate(spots, start=1)]
    x, y, z = p.bumper
    bodies.append(named(block(p.bumper, (x / 2, -p.sheet - y / 2, -z / 2)), "Bumper", "Black"))
    return assembly(bodies)


def _inner(p: P) -> Part:
    """The inner rail, open to the back."""
    length, depth, height = p.inner
    front = -p.outer[1]
    middle = p.travel + length / 2
    rail = block(p.inner, (middle, front + depth / 2, -height / 2))
    free = height - 2 * p.sheet
    rail -= block((length, depth - p.sheet, free), (middle, front + (depth + p.sheet) / 2, -free / 2))
    for x in p.screws_x:
        rail -= rod(p.screw, p.sheet, (p.travel + x, front, 0), BACK)
        rail -= cone(p.sink, p.screw, (p.sink - p.screw) / 2, (p.travel + x, front, 0), BACK)
    return rail - [slot(*p.level, p.sheet, (p.travel + x, front, 0), BACK) for x in p.levels_x]
