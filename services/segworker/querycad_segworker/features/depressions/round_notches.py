"""Round notches and grooves without a floor: part of a cylinder, sunk into a plane or round face, or a plate's edge."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.adjacency import same_cylinder
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.features.shared.frames import frame_of
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.walls import Wall
from querycad_segworker.tolerances import Tolerances, exceeds
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord
from querycad_segworker.vectors import dot, parallel, sub, unit

from .depression import Depression, DepressionKind, depression_in

SWEEP_RAD = (math.radians(45.0), math.radians(275.0))
"""A cylinder sunk in by less than this is a shallow curve; of one sunk in further, hardly a mouth is left."""
DRAFT = math.sin(math.radians(10.0))
"""The sides of a body with draft lean by less."""
HALF_TURN_RAD = math.radians(10.0)
"""Within this of half a circle a notch is called semicircular."""


def recognise_round_notches(
    brep: Brep, walls: Collection[Wall], used: set[int], tolerances: Tolerances
) -> Iterator[Depression]:
    """Concave partial cylinders between two convex lines on faces that are level with each other, as depressions.

    Those faces are planes, or pieces of one outer cylinder along the same direction, or an outer cone about it: the rim
    of a wheel or knob. Longer than wide they are grooves with a round bottom, else notches, as in the edge of a plate.
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
        if not _are_level(sides, 10 * tolerances.length):
            refuse("notch", wall.faces, "the faces on both sides of it are not level")
            continue
        frame = frame_of(brep, set(wall.faces), _out_of(wall, sides[0]), None, wall.axis.direction)
        length, width, _ = frame.size
        kind = DepressionKind.SLOT if exceeds(length, width) else DepressionKind.NOTCH
        half = abs(wall.sweep - math.pi) <= HALF_TURN_RAD
        found = depression_in(
            kind, "semicircular" if half else "circular", frame, wall.faces, (), wall.body, is_open=True
        )
        yield replace(found, corner_radius=wall.radius)


def _are_level(sides: Sequence[FaceRecord], near: float) -> bool:
    """Are they pieces of one plane or outer cylinder, or one outer cone?"""
    first = sides[0]
    if first.kind is SurfaceKind.CONE:
        return all(side.id == first.id for side in sides)
    if first.kind is SurfaceKind.CYLINDER:
        return first.outward > 0 and all(side.id == first.id or same_cylinder(first, side) for side in sides)
    return all(
        dot(first.axis, side.axis) > math.cos(0.01) and abs(dot(sub(side.point, first.point), first.axis)) <= near
        for side in sides
    )


def _out_of(wall: Wall, side: FaceRecord) -> Vector:
    """The direction out of what a notch is sunk into: of a round one away from its axis, through the notch's own."""
    if side.kind is SurfaceKind.PLANE:
        return side.axis
    rim = Axis.of(side)
    return unit(sub(wall.axis.origin, rim.foot(wall.axis.origin)))


def _beside(brep: Brep, wall: Wall) -> list[FaceRecord] | None:
    """The faces along the wall's straight rims, all plane or all round about its direction.

    None when its outline meets anything but in convex edges, or a plane across at one end. What opens in it, a hole or
    another cut, does not count.
    """
    straight: list[FaceRecord] = []
    coned: list[FaceRecord] = []
    ends = set[int]()
    for face in wall.faces:
        outline = {edge for loop in brep.faces[face].loops if loop.outer for edge in loop.edges}
        for edge, other in brep.neighbours(face):
            if other in wall.faces or edge.id not in outline:
                continue
            if edge.convexity is EdgeConvexity.CONCAVE and _is_across(wall, brep.faces[other]):
                ends.add(other)
                continue
            if edge.convexity is not EdgeConvexity.CONVEX:
                return None
            if edge.kind is EdgeKind.LINE and parallel(edge.direction, wall.axis.direction, 1e-2):
                straight.append(brep.faces[other])
            elif _is_bent_rim(edge, brep.faces[other], wall.axis.direction):
                coned.append(brep.faces[other])
    sides = straight or coned  # beside straight rims a cone breaks the edge at the end
    plane = all(face.kind is SurfaceKind.PLANE for face in sides)
    round_ = all(
        face.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE) and parallel(face.axis, wall.axis.direction, 1e-2)
        for face in sides
    )
    return sides if len(sides) > 1 and len(ends) < 2 and (plane or round_) else None


def _is_bent_rim(edge: EdgeRecord, face: FaceRecord, along: Vector) -> bool:
    """Does it run along this direction, but for what an outer cone, as of a body with draft, bends it?"""
    on_cone = face.kind is SurfaceKind.CONE and face.outward > 0
    return on_cone and parallel(sub(edge.end, edge.start), along, DRAFT)


def _is_across(wall: Wall, face: FaceRecord) -> bool:
    return face.kind is SurfaceKind.PLANE and parallel(face.axis, wall.axis.direction, 1e-2)
