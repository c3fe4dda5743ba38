"""Depressions as groups of faces that meet in concave edges, whether or not their rim is one boundary loop."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import add, cross, dot, norm, parallel, sub, unit

from .adjacency import ConcaveGraph
from .depression import Depression, DepressionKind
from .frames import POLYGONS, LocalFrame, frame_of, outline_of

FLAT_ANGLE = math.radians(10.0)
"""Walls may lean by this draft angle and still stand on their floor."""

CHANNEL_SHARE = 0.5
"""A slot wider than this share of its body is the inside of a channel section, not a slot in something."""

V_ANGLE = (math.radians(20.0), math.radians(160.0))
"""Two faces that enclose less or more than this are a crack or a bend, no groove with a V section."""


def group_depression(brep: Brep, group: set[int], graph: ConcaveGraph, tolerances: Tolerances) -> Depression | None:
    """What do these faces form, which meet in concave edges? None when they form no depression.

    The floor is the plane that the most others stand on. A floor with walls all around makes a pocket, walls that
    close a ring without a floor a passage, two walls that face each other a slot, channel or notch, two planes alone
    that open to one and the same face a V slot; whatever else stands on a floor makes a step.
    """
    planes = [brep.faces[f] for f in sorted(group) if brep.faces[f].kind is SurfaceKind.PLANE]
    if not planes:
        return None
    links = {face.id: _wall_links(graph, face.id, group) for face in planes}
    if (ring := _ring_axis(planes, links, group, graph)) is not None:
        return _passage(brep, group, ring, len(planes))
    floor = max(planes, key=lambda face: (len(links[face.id]), dot(face.axis, (0.1, -0.2, 1.0)), face.area))
    walls = [brep.faces[i] for i in sorted(links[floor.id])]
    if not walls:
        return None
    if len(planes) == 2 and len(walls) == 1 and walls[0].kind is SurfaceKind.PLANE:
        groove = _v_groove(brep, group, floor, walls[0])
        if groove is not None:
            return groove
    if _is_walled_in(brep, floor, group):
        outline, corner = outline_of(brep, floor.loops[0], tolerances)
        frame = frame_of(brep, group, floor.axis, floor.loops[0])
        pocket = _depression(DepressionKind.POCKET, outline, frame, group, (floor.id,), floor.body)
        return replace(pocket, corner_radius=corner)
    return _open_on_floor(brep, group, floor, walls)


def _open_on_floor(brep: Brep, group: set[int], floor: FaceRecord, walls: Sequence[FaceRecord]) -> Depression | None:
    """A slot, channel, notch or step: a floor with walls that leave a side open."""
    normal = floor.axis
    plane_walls = [wall for wall in walls if wall.kind is SurfaceKind.PLANE]
    opposite = _facing_pair(plane_walls)
    round_ends = [wall for wall in walls if wall.kind is SurfaceKind.CYLINDER]
    if opposite is not None:
        along = unit(cross(opposite[0].axis, normal))
    elif plane_walls:
        along = unit(cross(plane_walls[0].axis, normal))
    else:
        along = None
    if along is not None and norm(along) == 0:
        return None
    frame = frame_of(brep, group, normal, None, along)
    length, width, _ = frame.size
    kind = DepressionKind.STEP
    if opposite is not None:
        width = abs(dot(sub(opposite[0].point, opposite[1].point), opposite[0].axis))
        kind = DepressionKind.SLOT
        if width > CHANNEL_SHARE * _extent(brep, floor.body, opposite[0].axis):
            kind = DepressionKind.CHANNEL
        elif length < width:
            kind = DepressionKind.NOTCH
    elif len(round_ends) > 1 and plane_walls:
        kind = DepressionKind.SLOT  # closed at both ends by the round of the cutter, open along one side
    if not plane_walls:
        outline = "circular"
    elif round_ends:
        outline = "obround" if kind is DepressionKind.SLOT else "free"
    else:
        outline = "rectangular" if _is_square(plane_walls) else "free"
    return replace(_depression(kind, outline, frame, group, (floor.id,), floor.body, is_open=True), width=width)


def _depression(
    kind: DepressionKind,
    outline: str,
    frame: LocalFrame,
    group: set[int],
    floor: tuple[int, ...],
    body: int,
    *,
    is_open: bool = False,
) -> Depression:
    length, width, depth = frame.size
    return Depression(
        kind=kind,
        outline=outline,
        normal=frame.n,
        opening=frame.point(0.5, 0.5, 1.0),
        center=frame.point(0.5, 0.5, 0.5),
        length=length,
        width=width,
        depth=depth,
        direction=frame.u,
        floor=floor,
        faces=tuple(sorted(group)),
        body=body,
        is_open=is_open,
    )


def _is_walled_in(brep: Brep, floor: FaceRecord, group: set[int]) -> bool:
    """Do faces of the group stand all around the floor?"""
    if not floor.loops or not floor.loops[0].outer:
        return False
    edges = [brep.edges[e] for e in floor.loops[0].edges]
    return bool(edges) and all(
        edge.convexity in (EdgeConvexity.CONCAVE, EdgeConvexity.SMOOTH) and set(edge.faces) <= group for edge in edges
    )


def _ring_axis(
    planes: Sequence[FaceRecord], links: dict[int, set[int]], group: set[int], graph: ConcaveGraph
) -> Vector | None:
    """The direction of a tunnel: all its planes are parallel to it, and each meets the next, all the way around."""
    walls_only = all(f in graph.blends or graph.brep.faces[f].kind is SurfaceKind.PLANE for f in group)
    if len(planes) < 3 or not walls_only or any(len(links[face.id]) != 2 for face in planes):
        return None
    axis = next((unit(c) for face in planes[1:] if norm(c := cross(planes[0].axis, face.axis)) > 0.1), None)
    if axis is None or any(abs(dot(face.axis, axis)) > 0.02 for face in planes):
        return None
    return axis


def _passage(brep: Brep, group: set[int], axis: Vector, sides: int) -> Depression:
    x, y, z = axis
    upwards = next((c > 0 for c in (z, -y, x) if abs(c) > 0.05), True)
    normal = axis if upwards else (-x, -y, -z)
    frame = frame_of(brep, group, normal, None)
    outline = POLYGONS.get(sides, "polygonal")
    return _depression(DepressionKind.PASSAGE, outline, frame, group, (), brep.faces[min(group)].body)


def _v_groove(brep: Brep, group: set[int], a: FaceRecord, b: FaceRecord) -> Depression | None:
    """Two planes whose outer edges lie in one face (or two in one plane): a slot with a V section."""
    rims = []
    for face in (a, b):
        bounds = [
            (edge.length, brep.faces[other])
            for edge, other in brep.neighbours(face.id)
            if edge.convexity is EdgeConvexity.CONVEX and abs(dot(brep.faces[other].axis, cross(a.axis, b.axis))) < 0.1
        ]
        if not bounds:
            return None
        rims.append(max(bounds, key=lambda bound: bound[0])[1])
    first, second = rims
    flush = dot(first.axis, second.axis) > 1 - 1e-6 and abs(dot(sub(first.point, second.point), first.axis)) < 1e-6
    normal = unit(add(a.axis, b.axis))
    along = unit(cross(a.axis, b.axis))
    opening_angle = math.pi - math.acos(max(-1.0, min(1.0, dot(a.axis, b.axis))))
    if not (first.id == second.id or flush) or norm(along) == 0 or not V_ANGLE[0] < opening_angle < V_ANGLE[1]:
        return None
    frame = frame_of(brep, group, normal, None, along)
    return _depression(DepressionKind.SLOT, "triangular", frame, group, (), a.body, is_open=True)


def _is_square(walls: Sequence[FaceRecord]) -> bool:
    first = walls[0].axis
    return all(parallel(wall.axis, first, 0.05) or abs(dot(wall.axis, first)) < 0.05 for wall in walls)


def _wall_links(graph: ConcaveGraph, face: int, group: set[int]) -> set[int]:
    """The faces of the group that stand on this one: planes, also over a fillet, and round walls with a sharp foot."""
    found: set[int] = set()
    for other in graph.concave[face] & group:
        if other in graph.blends and not graph.is_sharp(face, other):
            found |= {f for f in graph.concave[other] & group if f not in graph.blends and f != face}
        else:
            found.add(other)
    return {f for f in found if graph.brep.faces[f].kind in (SurfaceKind.PLANE, SurfaceKind.CYLINDER)}


def _extent(brep: Brep, body: int, direction: Vector) -> float:
    """How far does a body reach along a direction?"""
    along = [
        dot(p, direction)
        for f in brep.bodies[body].faces
        for e in brep.face_edges[f]
        for p in (brep.edges[e].start, brep.edges[e].mid)
    ]
    return max(along) - min(along)


def _facing_pair(walls: Sequence[FaceRecord]) -> tuple[FaceRecord, FaceRecord] | None:
    """Two walls that look at each other across the floor."""
    best: tuple[FaceRecord, FaceRecord] | None = None
    for i, a in enumerate(walls):
        for b in walls[i + 1 :]:
            if dot(a.axis, b.axis) < -math.cos(FLAT_ANGLE) and dot(sub(b.point, a.point), a.axis) > 0:
                if best is None or a.area + b.area > best[0].area + best[1].area:
                    best = (a, b)
    return best
