"""Arms: bars that run out from a round hub to an eye, a rim or a free end, as of levers, cranks and wheels."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.protrusions.protrusions import Protrusion
from querycad_segworker.features.shared.adjacency import breaks_edge
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.features.shared.reach import faces_span
from querycad_segworker.tolerances import Tolerances, exceeds, significant
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord
from querycad_segworker.vectors import add, dist, dot, foot, mid, norm, parallel, scale, sub, unit

ALONG = 0.02
"""Sine of the angle by which the edge at the root of an arm may lean off the hub's axis."""
CORNER_RAD = math.radians(100.0)
"""What turns by less is the rounded corner of a block, which its sides run into, too."""
SIDEWAYS = 0.5
"""Cosine: what stands out of a hub less than 30 degrees off square to its axis is a part of an arm."""
TAPER = math.sin(math.radians(10.0))
"""The sides of an arm lean by no more than this against its length: levers taper."""


@dataclass(frozen=True, slots=True)
class Arm:
    """One arm. Metres, frame of the file.

    `width` is between its sides, at their middles; `thickness` along the hub's axis; `length` from the hub to its end,
    or to the eye or rim that it runs into. `direction` points away from the hub. `center_length`: from the axis of the
    hub to that of what is round at its end, an eye or a bore; None where nothing is.
    """

    width: float
    thickness: float
    length: float
    direction: Vector
    axis: Vector
    center: Vector
    tip: Vector
    faces: tuple[int, ...]
    """Its sides and its end."""
    caps: tuple[int, ...]
    """Its top and bottom, which may go on beyond it."""
    sides: tuple[int, int]
    is_spoke: bool
    """It ends at the inside of a rim."""
    center_length: float | None = None


@dataclass(frozen=True, slots=True)
class _Hub:
    axis: Axis
    radius: float
    sides: tuple[int, ...]
    """The plane faces that run into it."""


def recognise_arms(brep: Brep, ribs: Collection[frozenset[int]], tolerances: Tolerances) -> list[Arm]:
    """Which arms does the model have? Sorted by lowest face id. `ribs`: flanks of ribs, which are no arms.

    An arm has two plane sides that look away from each other and both end at one outer cylinder, in concave edges or
    over fillets along its axis, or run tangentially into a bored hub that stands out beyond them. It is longer than
    wide. Of two hubs it points away from the one that more arms stand on, or the wider one.
    """
    found: dict[frozenset[int], Arm] = {}
    for hub in sorted(_hubs(brep, tolerances), key=lambda hub: (-len(hub.sides), -hub.radius)):
        for a, b in _pairs(brep, hub):
            sides = frozenset((a.id, b.id))
            arm = None if sides in found or any(sides <= rib for rib in ribs) else _arm(brep, hub, a, b)
            if arm is not None:
                found[sides] = arm
    return sorted(found.values(), key=lambda arm: arm.faces)


def without_arms(protrusions: Sequence[Protrusion], arms: Sequence[Arm]) -> list[Protrusion]:
    """Those that do not stand on a hub or rim and are made of arms."""
    return [
        found
        for found in protrusions
        if not any(
            not set(arm.sides).isdisjoint(found.faces) and abs(dot(found.normal, arm.axis)) < SIDEWAYS for arm in arms
        )
    ]


def _hubs(brep: Brep, tolerances: Tolerances) -> list[_Hub]:
    """The outer cylinders that plane faces run into, by axis; the widest of an axis where sides end."""
    hubs: list[tuple[Axis, dict[int, float]]] = []
    for face in brep.faces:
        for wall in _roots(brep, face) if face.kind is SurfaceKind.PLANE else ():
            axis = Axis.of(brep.faces[wall])
            sides = next((known for one, known in hubs if one.same_line(axis, tolerances)), None)
            if sides is None:
                hubs.append((axis, sides := {}))
            sides[face.id] = max(sides.get(face.id, 0.0), brep.faces[wall].radius)
    return [_Hub(axis, max(sides.values()), tuple(sorted(sides))) for axis, sides in hubs]


def _roots(brep: Brep, side: FaceRecord) -> Iterator[int]:
    """The outer cylinders along whose axis a plane face ends, in a concave edge, over a fillet, or tangentially.

    What it runs into tangentially is a hub that stands out beyond it, around a bore; the round end of a link or ear
    is as thick as its sides.
    """
    for edge, other in brep.neighbours(side.id):
        if edge.kind is not EdgeKind.LINE or brep.faces[other].kind is not SurfaceKind.CYLINDER:
            continue
        if edge.convexity is EdgeConvexity.CONCAVE or _is_proud_hub(brep, brep.faces[other], edge):
            beyond = [other]
        elif edge.convexity is EdgeConvexity.SMOOTH and brep.faces[other].outward < 0:
            beyond = brep.beside(other, EdgeConvexity.SMOOTH)
        else:
            continue
        walls = [brep.faces[i] for i in beyond if brep.faces[i].kind is SurfaceKind.CYLINDER]
        yield from (w.id for w in walls if w.outward > 0 and parallel(w.axis, edge.direction, ALONG))


def _is_proud_hub(brep: Brep, wall: FaceRecord, edge: EdgeRecord) -> bool:
    """Is it an outer cylinder around a bore, that a tangential edge along it covers a part of?"""
    if edge.convexity is not EdgeConvexity.SMOOTH or wall.outward < 0 or wall.sweep < CORNER_RAD:
        return False
    low, high = faces_span(brep, (wall.id,), wall.axis)
    near = ALONG * wall.radius
    return exceeds(high - low, edge.length) and any(
        face.kind is SurfaceKind.CYLINDER and face.outward < 0 and face.body == wall.body
        and face.radius < wall.radius and parallel(face.axis, wall.axis, ALONG)
        and Axis.of(wall).radius_of(face.origin) < near
        for face in brep.faces
    )  # fmt: skip


def _pairs(brep: Brep, hub: _Hub) -> Iterator[tuple[FaceRecord, FaceRecord]]:
    """Sides that look away from each other on one side of the hub, each with the nearest.

    Of several in one plane, as where rings cut a spoke in pieces, the one straight across.
    """
    widths: dict[int, list[tuple[float, float, int]]] = defaultdict(list)
    for number, i in enumerate(hub.sides):
        for j in hub.sides[number + 1 :]:
            a, b = brep.faces[i], brep.faces[j]
            width, way = dot(sub(a.point, b.point), a.axis), _outwards(hub, a, b)
            opposed = width > 0 and dot(a.axis, b.axis) < -math.cos(2 * math.asin(TAPER))
            if opposed and way is not None and max(abs(dot(face.axis, way)) for face in (a, b)) < TAPER:
                apart = significant(width), dist(a.point, b.point)
                widths[i].append((*apart, j))
                widths[j].append((*apart, i))
    nearest = {i: min(found)[2] for i, found in widths.items()}
    for i, j in nearest.items():
        if i < j and nearest[j] == i:
            yield brep.faces[i], brep.faces[j]


def _outwards(hub: _Hub, a: FaceRecord, b: FaceRecord) -> Vector | None:
    """The direction from the hub's axis to between two sides; None where they lie on different sides of it."""
    arms = [sub(face.point, foot(face.point, hub.axis.origin, hub.axis.direction)) for face in (a, b)]
    middle = mid(*arms)
    if norm(middle) < hub.radius / 2:
        return None
    way = unit(middle)
    return way if min(dot(arm, way) for arm in arms) > 0 else None


def _arm(brep: Brep, hub: _Hub, a: FaceRecord, b: FaceRecord) -> Arm | None:
    way, axis = _outwards(hub, a, b), hub.axis.direction
    assert way is not None  # of a pair
    around = [brep.faces[i] for i in _around(brep, a) | _around(brep, b)]
    caps = [face for face in around if face.kind is SurfaceKind.PLANE and parallel(face.axis, axis, ALONG)]
    levels = [dot(cap.point, axis) for cap in caps]
    if max(levels, default=0.0) - min(levels, default=0.0) <= 0:
        levels = list(faces_span(brep, (a.id, b.id), axis))
    rims = [face.radius for face in around if _is_rim(face, hub)]
    near = ALONG * hub.radius
    ends = {i for i in _ends(brep, a, axis) | _ends(brep, b, axis) if not _is_on(brep.faces[i], hub, near)}
    origin = dot(hub.axis.origin, way)
    reach = min(rims) if rims else faces_span(brep, (a.id, b.id, *ends), way)[1] - origin
    width = abs(dot(sub(a.point, b.point), unit(sub(a.axis, b.axis))))
    length, thickness = reach - hub.radius, max(levels) - min(levels)
    if not exceeds(length, width) or exceeds(thickness, length):
        return None
    at = add(hub.axis.origin, scale(axis, (max(levels) + min(levels)) / 2 - dot(hub.axis.origin, axis)))
    return Arm(
        width=width,
        thickness=thickness,
        length=length,
        direction=way,
        axis=axis,
        center=add(at, scale(way, hub.radius + length / 2)),
        tip=add(at, scale(way, reach)),
        faces=tuple(sorted({a.id, b.id, *ends})),
        caps=tuple(sorted({cap.id for cap in caps})),
        sides=(a.id, b.id),
        is_spoke=bool(rims),
        center_length=None if rims else _to_the_eye(brep, hub, way, reach, width),
    )


def _is_on(face: FaceRecord, hub: _Hub, near: float) -> bool:
    """Is it a wall about the hub's axis?"""
    return face.kind is SurfaceKind.CYLINDER and hub.axis.radius_of(face.origin) < near


def _to_the_eye(brep: Brep, hub: _Hub, way: Vector, reach: float, width: float) -> float | None:
    """From the hub's axis to the parallel one at the end of an arm: of the eye that it runs into, or of its bore."""
    found = []
    for face in brep.faces:
        if face.kind is SurfaceKind.CYLINDER and parallel(face.axis, hub.axis.direction, ALONG):
            aside = sub(face.origin, foot(face.origin, hub.axis.origin, hub.axis.direction))
            along = dot(aside, way)
            straight = norm(sub(aside, scale(way, along))) < ALONG * reach
            if straight and along > hub.radius and abs(along - reach) < face.radius + width:
                found.append((abs(along - reach), along))
    return min(found)[1] if found else None


def _around(brep: Brep, side: FaceRecord) -> set[int]:
    """The faces that a side ends at, over rounds and chamfers, and over fillets."""
    found = set()
    for edge, other in brep.neighbours(side.id):
        face = brep.faces[other]
        hollow = edge.convexity is EdgeConvexity.SMOOTH and face.outward < 0
        over = hollow or breaks_edge(brep, side, edge, face)
        found |= set(brep.beside(other, edge.convexity)) - {side.id} if over else {other}
        found.add(other)
    return found


def _ends(brep: Brep, side: FaceRecord, axis: Vector) -> set[int]:
    """The faces that a side turns into at the free end: square to it, or round."""
    return {
        other
        for edge, other in brep.neighbours(side.id)
        if edge.kind is EdgeKind.LINE
        and parallel(edge.direction, axis, ALONG)
        and (edge.convexity is EdgeConvexity.CONVEX or _rounds(edge, brep.faces[other]))
    }


def _rounds(edge: EdgeRecord, face: FaceRecord) -> bool:
    return edge.convexity is EdgeConvexity.SMOOTH and face.outward > 0


def _is_rim(face: FaceRecord, hub: _Hub) -> bool:
    """Is it the inside of a rim around the hub?"""
    hollow = face.kind is SurfaceKind.CYLINDER and face.outward < 0
    on_axis = hollow and parallel(face.axis, hub.axis.direction, ALONG)
    return on_axis and hub.axis.radius_of(face.origin) < ALONG * face.radius and face.radius > hub.radius
