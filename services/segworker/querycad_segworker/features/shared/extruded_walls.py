"""Tunnels and troughs: walls that all run along one direction, each bordering the next along it."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import FACING
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord
from querycad_segworker.vectors import cross, dot, norm, span, sub, unit

from .axes import Axis
from .frames import ARCHED, POLYGONS, polygon_name

ACROSS = 0.02
"""Cosine above which a face does not run along a direction: 1.1 degrees."""
MORE_THAN_HALF = math.radians(200.0)
"""Walls that turn further than this hold on to what lies in them; the two flanks of a slot turn by 180 degrees."""
REGULAR_RAD = math.radians(3.0)
"""Corners of a regular polygon agree in their angle by this."""


@dataclass(frozen=True, slots=True)
class Tunnel:
    """Walls around one direction. `turn`: the angle by which they turn, one after the other; 2 pi when `closed`."""

    axis: Vector
    closed: bool
    turn: float
    outline: str
    """Of the section: 'hexagonal', 'obround' … ; of what other cuts left of a regular polygon, that of the polygon."""


def tunnel_of(brep: Brep, group: Collection[int]) -> Tunnel | None:
    """Which tunnel do these faces form? None when they do not all run along one direction, or branch.

    What other cuts across that direction have parted of one plane or cylinder is one wall.
    """
    faces = [brep.faces[i] for i in sorted(group)]
    if len(faces) < 2 or any(f.kind not in (SurfaceKind.PLANE, SurfaceKind.CYLINDER) for f in faces):
        return None
    axis = _common_direction(faces)
    if axis is None:
        return None
    owners = first_of_surface(faces, lambda a, b: _behind(brep, a, b, axis))
    links = _links(brep, group, axis, owners)
    faces = [face for face in faces if owners[face.id] == face.id]
    if any(len(links[face.id]) > 2 for face in faces) or sum(not links[face.id] for face in faces):
        return None
    ends = sum(len(links[face.id]) == 1 for face in faces)
    if ends not in (0, 2) or (ends == 0 and len(faces) < 3 and not _two_links(brep, faces)):
        return None
    corners = [edge.angle for i in links for j, edge in links[i].items() if i < j]
    turn = sum(corners) + sum(face.sweep for face in faces if face.kind is SurfaceKind.CYLINDER)
    closed = ends == 0
    return Tunnel(axis, closed, 2 * math.pi if closed else turn, section_of(faces, corners, closed=closed))


def _common_direction(faces: Collection[FaceRecord]) -> Vector | None:
    """The direction that all faces run along: planes hold it, cylinders turn around it."""
    axis = next((f.axis for f in faces if f.kind is SurfaceKind.CYLINDER), None)
    if axis is None:
        planes = list(faces)
        products = [cross(planes[0].axis, plane.axis) for plane in planes[1:]]
        axis = next((unit(c) for c in products if norm(c) > 0.1), None)
    if axis is None:
        return None
    for face in faces:
        off = abs(dot(face.axis, axis)) if face.kind is SurfaceKind.PLANE else norm(cross(face.axis, axis))
        if off > ACROSS or (face.kind is SurfaceKind.CYLINDER and face.outward > 0):
            return None
    return axis


def _links(
    brep: Brep, group: Collection[int], axis: Vector, owners: dict[int, int]
) -> dict[int, dict[int, EdgeRecord]]:
    """Which faces of the group border each other along the direction, in a concave corner or smoothly?"""
    links: dict[int, dict[int, EdgeRecord]] = defaultdict(dict)
    for face in group:
        for edge, other in brep.neighbours(face):
            if other not in group or edge.kind is not EdgeKind.LINE or edge.convexity is EdgeConvexity.CONVEX:
                continue
            if owners[face] != owners[other] and norm(cross(edge.direction, axis)) < ACROSS:
                links[owners[face]][owners[other]] = edge
    return links


def _two_links(brep: Brep, faces: Collection[FaceRecord]) -> bool:
    """Do two faces border each other along two lines, as a flat and a round side of a D do?"""
    a, b = faces
    lines = {edge.id for edge, other in brep.neighbours(a.id) if other == b.id and edge.kind is EdgeKind.LINE}
    return len(lines) > 1 and any(f.kind is SurfaceKind.CYLINDER for f in faces)


def section_of(faces: Collection[FaceRecord], corners: Sequence[float] = (), *, closed: bool = True) -> str:
    """The name of the section of walls that run along one direction; `corners`: the angles that they meet at."""
    flats = [f for f in faces if f.kind is SurfaceKind.PLANE]
    owners = first_of_surface(flats)
    flats = [f for f in flats if owners[f.id] == f.id]
    rounds = [f for f in faces if f.kind is SurfaceKind.CYLINDER]
    if len(flats) == 2 and rounds and _is_obround(flats[0], flats[1], rounds):
        return "obround"
    if len(flats) == 1 and _is_half_obround(flats[0], rounds):
        return "obround"
    if not flats:
        return "circular"
    if len(flats) == 1 or (closed and len(flats) == 2):
        return "free"
    sharp = [angle for angle in corners if angle > REGULAR_RAD]
    if not closed and sharp and max(sharp) - min(sharp) < REGULAR_RAD and not rounds:
        sides = 2 * math.pi / sharp[0]
        if abs(sides - round(sides)) < 0.1:
            return POLYGONS.get(round(sides), "polygonal")
    name = polygon_name([face.axis for face in flats])
    return "rectangular" if name == ARCHED and not closed else name  # two flanks and what joins them


def first_of_surface(
    faces: Collection[FaceRecord], together: Callable[[FaceRecord, FaceRecord], bool] = lambda _a, _b: True
) -> dict[int, int]:
    """The first of those planes and cylinders that are pieces of one, and look the same way, for each by id.

    `together`: what pieces must meet besides.
    """
    found: list[FaceRecord] = []
    owners = {}
    for face in faces:
        same = [f for f in found if _is_one_surface(f, face) and together(f, face)]
        owners[face.id] = same[0].id if same else face.id
        if not same:
            found.append(face)
    return owners


def _is_one_surface(a: FaceRecord, b: FaceRecord) -> bool:
    near = 1e-3 * math.sqrt(b.area)
    if a.kind is not b.kind or a.outward != b.outward:
        return False
    if a.kind is SurfaceKind.PLANE:
        return dot(a.axis, b.axis) > 0.9999 and abs(dot(sub(a.point, b.point), a.axis)) < near
    if a.kind is SurfaceKind.CYLINDER:
        return abs(a.radius - b.radius) < near and Axis.of(a).radius_of(b.origin) < near
    return False


def _behind(brep: Brep, a: FaceRecord, b: FaceRecord, along: Vector) -> bool:
    """Do two pieces of a wall lie behind each other along a direction? The lips of a T slot lie beside each other."""
    across = unit(cross(a.facing, along))
    (low, high), (first, last) = (
        span((p for e in brep.face_edges[f.id] for p in (brep.edges[e].start, brep.edges[e].mid)), across)
        for f in (a, b)
    )
    return min(high, last) - max(low, first) > 1e-3 * min(high - low, last - first)


def _is_obround(a: FaceRecord, b: FaceRecord, rounds: Collection[FaceRecord]) -> bool:
    """Do two flats face each other at the diameter of the rounds between them?"""
    gap = dot(sub(b.point, a.point), a.axis)
    opposed = dot(a.axis, b.axis) < -FACING.parallel
    return opposed and all(abs(abs(gap) - 2 * f.radius) < 0.02 * abs(gap) for f in rounds)


def _is_half_obround(flat: FaceRecord, rounds: Collection[FaceRecord]) -> bool:
    """Do two rounds of one radius lie at the ends of a flat, as where another cut took the flat across from it?

    Each turns by more than a right angle, or it would be the rounded corner of another outline.
    """
    if len(rounds) != 2:
        return False
    a, b = rounds
    heights = [dot(sub(f.origin, flat.point), flat.axis) for f in rounds]
    near = 0.02 * a.radius
    return (
        all(abs(height - a.radius) < near for height in heights)
        and abs(a.radius - b.radius) < near
        and min(a.sweep, b.sweep) > math.pi / 2 + REGULAR_RAD
        and Axis.of(a).radius_of(b.origin) > near
    )
