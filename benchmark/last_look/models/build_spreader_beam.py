"""A spreader beam for a crane: a rectangular tube with a lifting eye on top, two shackle lugs below and end caps."""

from __future__ import annotations

from dataclasses import dataclass

from build123d import Axis, Circle, Compound, Part, Plane, Polygon, Pos, extrude, fillet, make_hull

from benchmark.kit import Model
from benchmark.shapes import UP, assembly, block, named, rod

MODEL = Model("Spreader beam", "held_out", bodies=6)


@dataclass(frozen=True, slots=True)
class P:
    """Millimetres; the tube lies along x, its middle is x = y = 0, its underside is z = 0."""

    length: float = 1600  # of the tube
    width: float = 80  # of the tube, along y
    height: float = 120  # of the tube
    wall: float = 6
    corner: float = 9  # outer radius of the tube's edges
    cap: float = 8  # thickness of the end caps
    eye_thickness: float = 20
    eye_foot: float = 220  # length on the tube
    eye_rise: float = 75  # hole's centre above the tube
    eye_radius: float = 45
    eye_hole: float = 42
    lug_thickness: float = 15
    lug_foot: float = 120
    lug_drop: float = 45  # hole's centre below the tube
    lug_radius: float = 30
    lug_hole: float = 26
    lugs_x: float = 1400  # between the two
    drain: float = 12  # holes in the underside
    drains_x: float = 1500  # between the two


def _plate(foot: float, rise: float, radius: float, thickness: float, hole: float, x: float, z: float, up: int) -> Part:
    """A padeye in the xz plane, its foot on z."""
    front = Plane(origin=(x, thickness / 2, z), x_dir=(1, 0, 0), z_dir=(0, -1, 0))
    outline = make_hull(
        (Pos(0, up * rise) * Circle(radius)).edges()
        + Polygon((-foot / 2, 0), (foot / 2, 0), (foot / 2, up * 12), (-foot / 2, up * 12), align=None).edges()
    )
    outline -= Pos(0, up * rise) * Circle(hole / 2)
    return extrude(front * outline, amount=thickness)


def build(p: P) -> Compound:
    """Cuts the tube and sets the plates on it."""
    tube = block((p.length, p.width, p.height))
    tube = fillet(tube.edges().filter_by(Axis.X), p.corner)
    inside = block((p.length, p.width - 2 * p.wall, p.height - 2 * p.wall), (0, 0, p.wall))
    tube -= fillet(inside.edges().filter_by(Axis.X), p.corner - p.wall)
    for side in (-1, 1):
        tube -= rod(p.drain, p.wall, (side * p.drains_x / 2, 0, 0), UP)
    cap = fillet(block((p.cap, p.width, p.height)).edges().filter_by(Axis.X), p.corner)
    end = (p.length + p.cap) / 2
    eye = _plate(p.eye_foot, p.eye_rise, p.eye_radius, p.eye_thickness, p.eye_hole, 0, p.height, 1)
    lugs = [
        _plate(p.lug_foot, p.lug_drop, p.lug_radius, p.lug_thickness, p.lug_hole, side * p.lugs_x / 2, 0, -1)
        for side in (-1, 1)
    ]
    return assembly(
        [
            named(tube, "beam", "gold"),
            named(eye, "lifting eye", "firebrick"),
            named(lugs[0], "shackle lug left", "firebrick"),
            named(lugs[1], "shackle lug right", "firebrick"),
            named(cap, "end cap left", "dimgray", Pos(-end, 0, 0)),
            named(cap, "end cap right", "dimgray", Pos(end, 0, 0)),
        ]
    )
