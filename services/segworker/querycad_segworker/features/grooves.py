"""Grooves turned into shafts, for retaining rings, O-rings and as undercuts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep

from .bosses import is_neck
from .stacks import stacks, wall_range
from .walls import Wall


@dataclass(frozen=True, slots=True)
class TurnedGroove:
    """One groove around a shaft. Metres. `radius` is its bottom's; `depth` counts from the lower of both shoulders."""

    radius: float
    width: float
    depth: float
    center: Vector
    axis: Vector
    faces: tuple[int, ...]
    body: int


def recognise_turned_grooves(brep: Brep, walls: Sequence[Wall], tolerances: Tolerances) -> list[TurnedGroove]:
    """Which grooves are turned into the model's shafts? Sorted by lowest face id."""
    found = []
    for stack in stacks(brep, walls, tolerances, lambda wall: wall.outward > 0 and wall.encloses):
        ordered = sorted(stack.walls, key=lambda w: wall_range(stack.axis, w))
        for i, wall in enumerate(ordered):
            if wall.kind is not SurfaceKind.CYLINDER or not is_neck(wall, stack) or not 0 < i < len(ordered) - 1:
                continue
            shoulder = min(ordered[i - 1].radius, ordered[i + 1].radius)
            low, high = wall_range(stack.axis, wall)
            sides = {other for face in wall.faces for _, other in brep.neighbours(face) if other in stack.shoulders}
            found.append(
                TurnedGroove(
                    radius=wall.radius,
                    width=high - low,
                    depth=shoulder - wall.radius,
                    center=stack.axis.at((low + high) / 2),
                    axis=stack.axis.direction,
                    faces=tuple(sorted({*wall.faces, *sides})),
                    body=wall.body,
                )
            )
    return sorted(found, key=lambda groove: groove.faces[0])
