"""The scene: a gear with a hub, and an engine block with a shaft. `python -m metawizard.scene` writes their STEP files.

Millimetres and the files' own axes; where the two stand in the robot's world is at the end, in metres.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

FOLDER = Path(__file__).parent

Matrix = NDArray[np.float64]
"""(4, 4) float64: a pose, metres."""


@dataclass(frozen=True, slots=True)
class GearPart:
    """The axis is z, the toothed rim at the bottom, z from 0."""

    module: float = 2
    teeth: int = 22
    pressure_angle: float = 20
    rim: float = 12
    bore: float = 12.1
    hub: float = 28
    hub_height: float = 14
    flats: float = 24

    @property
    def height(self) -> float:
        """Overall."""
        return self.rim + self.hub_height


@dataclass(frozen=True, slots=True)
class Block:
    """The shaft stands on the top, away from the middle; the block's lower corner is at the origin."""

    width: float = 120
    depth: float = 80
    height: float = 60
    shaft: float = 12
    shaft_length: float = 34
    shaft_x: float = 75
    shaft_y: float = 40
    chamfer: float = 1
    bolt: float = 6.6
    bolt_inset: float = 12
    cylinder: float = 40
    cylinder_depth: float = 45
    cylinder_x: float = 32


GEAR, BLOCK = GearPart(), Block()


def at(x: float, y: float, z: float, about: str = "z", degrees: float = 0.0) -> Matrix:
    """A pose: turned about an axis of the world, then moved."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[about]
    angle, pose = np.radians(degrees), np.eye(4)
    pose[[i, i, j, j], [i, j, i, j]] = np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)
    pose[:3, 3] = x, y, z
    return pose


GEAR_IN_WORLD = at(0.40, -0.25, 0.02, "z", 30)
BLOCK_IN_WORLD = at(0.55, 0.20, 0.30, "y", 90)
"""The block lies on its side: its shaft points along the world's x axis."""


def build(folder: Path = FOLDER) -> None:
    """Writes gear.step and engine_block.step."""
    from build123d import (
        Align,
        Axis,
        Box,
        BuildPart,
        BuildSketch,
        Circle,
        Cylinder,
        Face,
        GeomType,
        GridLocations,
        Hole,
        Locations,
        Mode,
        Plane,
        SlotOverall,
        Wire,
        chamfer,
        extrude,
        insert,
    )

    from _example import export
    from build_gear_shaft import GearShaft, tooth_edges

    up = (Align.CENTER, Align.CENTER, Align.MIN)
    corner = (Align.MIN, Align.MIN, Align.MIN)
    g, b = GEAR, BLOCK
    teeth = GearShaft(module=g.module, teeth=g.teeth, pressure_angle=g.pressure_angle)
    outline = Face(Wire([edge for index in range(g.teeth) for edge in tooth_edges(teeth, index)]))
    with BuildPart() as gear:
        with BuildSketch(Plane.XY):
            insert(outline)
        extrude(amount=g.rim)
        with BuildSketch(Plane.XY.offset(g.rim)):
            Circle(g.hub / 2)
        extrude(amount=g.hub_height)
        for side in (1, -1):
            with Locations((side * (g.flats / 2 + 10), 0, g.rim)):
                Box(20, g.hub, g.hub_height, align=up, mode=Mode.SUBTRACT)
        Hole(g.bore / 2)
    with BuildPart() as block:
        Box(b.width, b.depth, b.height, align=corner)
        with Locations(Plane.XY.offset(b.height)):
            with Locations((b.shaft_x, b.shaft_y)):
                Cylinder(b.shaft / 2, b.shaft_length, align=up)
            with Locations((b.cylinder_x, b.depth / 2)):
                Hole(b.cylinder / 2, depth=b.cylinder_depth)
            with (
                Locations((b.width / 2, b.depth / 2)),
                GridLocations(b.width - 2 * b.bolt_inset, b.depth - 2 * b.bolt_inset, 2, 2),
            ):
                Hole(b.bolt / 2)
        ends = block.edges().filter_by(GeomType.CIRCLE).sort_by(Axis.Z)[-1:]
        chamfer(ends, b.chamfer)
        with BuildSketch(Plane.XZ), Locations((b.width / 2, b.height / 2)):
            SlotOverall(40, 10)
        extrude(amount=-6, mode=Mode.SUBTRACT)
    export(gear.part, folder / "gear.step")
    export(block.part, folder / "engine_block.step")


if __name__ == "__main__":
    build(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER)
