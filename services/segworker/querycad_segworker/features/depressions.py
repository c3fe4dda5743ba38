"""Depressions of any outline: pockets, passages, slots, notches and steps cut into the material."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, FaceRecord, Loop
from querycad_segworker.vectors import cross, dot, mean, norm, parallel, sub, unit

from .adjacency import ConcaveGraph
from .depression import Depression, DepressionKind
from .frames import frame_of, outline_of
from .groups import group_depression
from .holes import IsClear


def recognise_depressions(
    brep: Brep, taken: Collection[int], tolerances: Tolerances, is_clear: IsClear | None = None
) -> list[Depression]:
    """Which depressions does the model have? Sorted by lowest face id. `taken`: faces of holes, which do not count.

    Closed ones are found from their rim: a whole boundary loop of some face along which the material turns away
    (convex edges, or roundings). Open ones are groups of faces that meet in concave edges. With `is_clear`, a slot
    that other features interrupt is one slot.
    """
    graph = ConcaveGraph(brep, taken)
    found: list[Depression] = []
    used = set(taken)
    for face in brep.faces:
        for loop in face.loops:
            if loop.outer or (face.id in used and face.id in taken):
                continue
            group = graph.behind(face, loop)
            if not group or group & used:
                continue
            depression = _closed(brep, face, loop, group, tolerances)
            if depression is not None:
                used |= group
                found.append(depression)
    for group in graph.concave_groups(used):
        depression = group_depression(brep, group, graph, tolerances)
        if depression is not None:
            used |= group
            found.append(depression)
    if is_clear is not None:
        found = _united_slots(brep, found, tolerances, is_clear)
    return sorted(found, key=lambda d: d.faces[0])


def _united_slots(brep: Brep, found: list[Depression], tolerances: Tolerances, is_clear: IsClear) -> list[Depression]:
    """Pieces of one slot, cut in one pass and parted by holes or pockets since, made one slot."""
    result = [d for d in found if d.kind is not DepressionKind.SLOT]
    slots = sorted((d for d in found if d.kind is DepressionKind.SLOT), key=lambda d: -d.length)
    while slots:
        slot = slots.pop(0)
        grown = True
        while grown:
            grown = False
            for other in slots:
                if _one_cut(slot, other, tolerances) and is_clear(slot.center, other.center):
                    slots.remove(other)
                    faces = {*slot.faces, *other.faces}
                    frame = frame_of(brep, faces, slot.normal, None, slot.direction)
                    slot = replace(
                        slot,
                        length=frame.size[0],
                        opening=frame.point(0.5, 0.5, 1.0),
                        center=frame.point(0.5, 0.5, 0.5),
                        depth=frame.size[2],
                        floor=tuple(sorted({*slot.floor, *other.floor})),
                        faces=tuple(sorted(faces)),
                    )
                    grown = True
                    break
        result.append(slot)
    return result


def _one_cut(a: Depression, b: Depression, tolerances: Tolerances) -> bool:
    """Same body, floor plane, direction, centre line and width?"""
    near = 10 * tolerances.length
    if a.body != b.body or dot(a.normal, b.normal) < 1 - 1e-6 or not parallel(a.direction, b.direction, 1e-3):
        return False
    floors = [dot(d.center, a.normal) - d.depth / 2 for d in (a, b)]
    across = cross(a.normal, a.direction)
    return (
        abs(floors[0] - floors[1]) <= near
        and abs(a.width - b.width) <= near
        and abs(dot(sub(a.center, b.center), across)) <= near
    )


def _closed(brep: Brep, host: FaceRecord, rim: Loop, group: set[int], tolerances: Tolerances) -> Depression | None:
    """A pocket or passage behind a rim."""
    normal = _out_of(brep, host, rim, group)
    walls = [f for f in group if abs(dot(_facing(brep, f), normal)) < math.sin(math.radians(45.0))]
    floors = [
        f for f in group if dot(_facing(brep, f), normal) >= math.sin(math.radians(45.0)) and brep.faces[f].outward <= 0
    ]
    if not walls:
        return None
    frame = frame_of(brep, group, normal, rim)
    through = not floors
    outline, corner = outline_of(brep, rim, tolerances)
    along, across, deep = frame.size
    return Depression(
        kind=DepressionKind.PASSAGE if through else DepressionKind.POCKET,
        outline=outline,
        normal=normal,
        opening=frame.point(0.5, 0.5, 1.0),
        center=frame.point(0.5, 0.5, 0.5),
        length=along,
        width=across,
        depth=deep,
        direction=frame.u,
        floor=tuple(sorted(floors)),
        faces=tuple(sorted(group)),
        body=host.body,
        corner_radius=corner,
    )


def _out_of(brep: Brep, host: FaceRecord, rim: Loop, group: set[int]) -> Vector:
    """The direction out of the opening: the host's normal where it is plane; else away from the floor."""
    if host.kind is SurfaceKind.PLANE:
        return host.axis
    planes = [brep.faces[f] for f in group if brep.faces[f].kind is SurfaceKind.PLANE]
    rim_center = mean([brep.edges[e].mid for e in rim.edges])
    facing = [f for f in planes if dot(sub(rim_center, f.point), f.axis) > 0.9 * norm(sub(rim_center, f.point))]
    if facing:
        return max(facing, key=lambda f: f.area).axis
    return unit(sub(rim_center, mean([brep.faces[f].point for f in group])))


def _facing(brep: Brep, face_id: int) -> Vector:
    face = brep.faces[face_id]
    return face.axis if face.kind is SurfaceKind.PLANE else face.point_normal
