"""Round notches and grooves: part of a cylinder sunk into a plane face or the edge of a plate, without a floor."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import replace

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.frames import frame_of
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.walls import Wall
from querycad_segworker.tolerances import Tolerances, exceeds
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, FaceRecord
from querycad_segworker.vectors import dot, parallel, sub

from .depression import Depression, DepressionKind, depression_in

SWEEP_RAD = (math.radians(45.0), math.radians(275.0))
"""A cylinder sunk in by less than this is a shallow curve; of one sunk in further, hardly a mouth is left."""
HALF_TURN_RAD = math.radians(10.0)
"""Within this of half a circle a notch is called semicircular."""


def recognise_round_notches(
    brep: Brep, walls: Collection[Wall], used: set[int], tolerances: Tolerances
) -> Iterator[Depression]:
    """Concave partial cylinders between two convex lines on faces that are level with each other, as depressions.

    Longer than wide they are grooves with a round bottom, else notches, as in the edge of a plate.
    """
    for wall in walls:
        if (
            wall.kind is not SurfaceKind.CYLINDER
            or wall.outward > 0
            or wall.encloses
            or not used.isdisjoint(wall.faces)
        ):
            continue
        sides = _beside(brep, wall)
        if sides is None:
            continue
        if not SWEEP_RAD[0] <= wall.sweep <= SWEEP_RAD[1]:
            refuse("notch", wall.faces, f"it turns by {math.degrees(wall.sweep):.0f} degrees")
            continue
        if not all(_are_level(sides[0], side, 10 * tolerances.length) for side in sides[1:]):
            refuse("notch", wall.faces, "the faces on both sides of it are not level")
            continue
        frame = frame_of(brep, set(wall.faces), sides[0].axis, None, wall.axis.direction)
        length, width, _ = frame.size
        kind = DepressionKind.SLOT if exceeds(length, width) else DepressionKind.NOTCH
        half = abs(wall.sweep - math.pi) <= HALF_TURN_RAD
        found = depression_in(
            kind, "semicircular" if half else "circular", frame, wall.faces, (), wall.body, is_open=True
        )
        yield replace(found, corner_radius=wall.radius)


def _are_level(a: FaceRecord, b: FaceRecord, near: float) -> bool:
    return dot(a.axis, b.axis) > math.cos(0.01) and abs(dot(sub(b.point, a.point), a.axis)) <= near


def _beside(brep: Brep, wall: Wall) -> list[FaceRecord] | None:
    """The plane faces along the wall's straight rims; None when it meets anything but in convex edges."""
    sides: list[FaceRecord] = []
    rims = 0
    for face in wall.faces:
        for edge, other in brep.neighbours(face):
            if other in wall.faces:
                continue
            if edge.convexity is not EdgeConvexity.CONVEX:
                return None
            if edge.kind is EdgeKind.LINE and parallel(edge.direction, wall.axis.direction, 1e-2):
                rims += 1
                sides.append(brep.faces[other])
    return sides if rims > 1 and all(face.kind is SurfaceKind.PLANE for face in sides) else None
