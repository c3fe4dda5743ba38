"""Ribs and fins: thin walls that stand on the material, with a narrow top face."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeRecord, FaceRecord
from querycad_segworker.vectors import cross, dot, parallel, sub, unit

from .frames import frame_of
from .protrusions import RIB_RATIO

RIGHT_ANGLE = (math.radians(75.0), math.radians(105.0))
"""The flanks of a rib stand about square on its top; casting drafts are below 15 degrees."""


@dataclass(frozen=True, slots=True)
class Rib:
    """One rib or fin. Metres. `thickness` is between its flanks, `height` from its lower foot to its top."""

    thickness: float
    height: float
    length: float
    normal: Vector
    direction: Vector
    center: Vector
    tip: Vector
    top: int
    flanks: tuple[int, int]
    body: int

    @property
    def faces(self) -> tuple[int, ...]:
        """All its faces."""
        return tuple(sorted((self.top, *self.flanks)))


def recognise_ribs(brep: Brep) -> list[Rib]:
    """Which ribs does the model have? Sorted by lowest face id.

    A rib is a plane top face with two parallel flanks that face away from each other, each meeting the top in a
    convex edge and the material below in a concave one, thin against its height and length.
    """
    found = []
    for top in brep.faces:
        if top.kind is not SurfaceKind.PLANE:
            continue
        flanks = _flanks(brep, top)
        if flanks is None:
            continue
        a, b = flanks
        thickness = dot(sub(a.point, b.point), a.axis)
        frame = frame_of(brep, {top.id, a.id, b.id}, top.axis, None, _along(a, top))
        length, _, height = frame.size
        if thickness <= 0 or height < thickness or length < RIB_RATIO * thickness:
            continue
        found.append(
            Rib(
                thickness=thickness,
                height=height,
                length=length,
                normal=top.axis,
                direction=frame.u,
                center=frame.point(0.5, 0.5, 0.5),
                tip=frame.point(0.5, 0.5, 1.0),
                top=top.id,
                flanks=(a.id, b.id),
                body=top.body,
            )
        )
    return sorted(_widest_tops(brep, found), key=lambda rib: rib.faces[0])


def _widest_tops(brep: Brep, ribs: Sequence[Rib]) -> list[Rib]:
    """Of ribs with the same two flanks, those with the largest top: the end faces of a rib are no tops."""
    best: dict[frozenset[int], tuple[float, Rib]] = {}
    for rib in ribs:
        flanks, area = frozenset(rib.flanks), brep.faces[rib.top].area
        if flanks not in best or area > best[flanks][0]:
            best[flanks] = (area, rib)
    return [rib for _, rib in best.values()]


def _along(flank: FaceRecord, top: FaceRecord) -> Vector:
    return unit(cross(flank.axis, top.axis))


def _flanks(brep: Brep, top: FaceRecord) -> tuple[FaceRecord, FaceRecord] | None:
    """The two longest parallel flanks of a top face that both stand on something."""
    sides: list[tuple[EdgeRecord, FaceRecord]] = []
    for edge, other in brep.neighbours(top.id):
        face = brep.faces[other]
        low, high = RIGHT_ANGLE
        if edge.convexity is EdgeConvexity.CONVEX and low <= edge.angle <= high and face.kind is SurfaceKind.PLANE:
            sides.append((edge, face))
    sides.sort(key=lambda side: -side[0].length)
    for i, (edge, a) in enumerate(sides):
        for other_edge, b in sides[i + 1 :]:
            opposed = dot(a.axis, b.axis) < -0.99 and dot(sub(a.point, b.point), a.axis) > 0
            alike = other_edge.length > 0.3 * edge.length
            if a.id != b.id and opposed and alike and all(_stands(brep, f, top) for f in (a, b)):
                return a, b
    return None


def _stands(brep: Brep, flank: FaceRecord, top: FaceRecord) -> bool:
    """Does the flank end in a concave edge below the top?"""
    level = dot(top.point, top.axis)
    return any(
        (
            edge.convexity is EdgeConvexity.CONCAVE
            or (edge.convexity is EdgeConvexity.SMOOTH and brep.faces[other].outward < 0)
        )
        and dot(edge.mid, top.axis) < level
        for edge, other in brep.neighbours(flank.id)
    )


def fins(ribs: Sequence[Rib], tolerances: Tolerances) -> set[int]:
    """Which ribs (by index) are fins, that is three or more alike that stand parallel in one body?"""

    def alike(a: Rib, b: Rib) -> bool:
        return (
            a.body == b.body
            and abs(a.thickness - b.thickness) <= 0.02 * a.thickness + tolerances.length
            and parallel(a.direction, b.direction, 0.02)
            and dot(a.normal, b.normal) > 0.99
        )

    return {i for i, a in enumerate(ribs) if sum(alike(a, b) for b in ribs) >= 3}
