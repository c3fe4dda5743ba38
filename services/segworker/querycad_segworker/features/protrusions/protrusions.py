"""Protrusions of any outline that rise from a face: rectangular and polygonal pads, pins, ribs."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.features.shared.axes import Axis
from querycad_segworker.features.shared.frames import LocalFrame, face_points, frame_of, outline_of
from querycad_segworker.features.shared.reach import edges_span
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.features.shared.shaft_steps import ALIKE
from querycad_segworker.features.shared.walls import REVOLVED
from querycad_segworker.tolerances import FACING, Tolerances, exceeds, reaches
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord, Loop
from querycad_segworker.vectors import add, cross, dot, foot, mean, norm, scale, sub, unit

RIB_RATIO = 3.0
"""A protrusion this much longer than thick is a rib, fin or wall."""

MOST_AROUND = 0.5
"""The middle of a loop that goes most of the way around a cylinder lies nearer to the axis than this share of the
radius: it has no side."""
AS_LARGE = 0.9
"""The top of a protrusion is at least this share as long and wide as its outline: chamfers and drafts take the rest."""


@dataclass(frozen=True, slots=True)
class Protrusion:
    """One protrusion. Metres, frame of the file. `base` and `tip` lie on its middle axis along `normal`."""

    outline: str
    normal: Vector
    base: Vector
    tip: Vector
    center: Vector
    length: float
    width: float
    height: float
    faces: tuple[int, ...]
    tags: tuple[str, ...]
    feet: tuple[int, ...] = ()
    """Of a pad or ledge, the walls in which it rises, also such as run on below."""


def recognise_protrusions(brep: Brep, round_faces: Collection[int], tolerances: Tolerances) -> list[Protrusion]:
    """Which protrusions have another outline than a circle? Sorted by lowest face id.

    A protrusion is what lies beyond an inner loop of a face when all edges of that loop are concave; round ones, whose
    walls are all in `round_faces`, are bosses.
    """
    found = []
    for face in brep.faces:
        for loop in face.loops:
            if loop.outer:
                continue
            group = _beyond(brep, face, loop)
            walls = {other for e in loop.edges for other in brep.edges[e].faces if other != face.id}
            if not group or walls <= set(round_faces):
                continue
            if group <= _fillets(brep, loop):
                refuse("protrusion", group, "fillets alone, at the foot of what stands on more than this face")
            elif _is_turned(brep, loop, walls, tolerances):
                refuse("protrusion", group, "a step or groove turned about an axis")
            elif not _is_minor(brep, face, group):
                refuse("protrusion", group, "it is more than half of its body: the rest stands on it")
            elif (protrusion := _protrusion(brep, face, loop, group, tolerances)) is not None:
                found.append(protrusion)
    return sorted(found, key=lambda p: p.faces[0])


def _is_turned(brep: Brep, rim: Loop, walls: set[int], tolerances: Tolerances) -> bool:
    """Does a cylinder or cone rise from a circle around its axis, also over a fillet? A boss, or a groove's neck."""
    faces = [brep.faces[wall] for wall in walls]
    if any(face.kind not in REVOLVED for face in faces):
        return False
    axis = Axis.of(faces[0])
    near = 10 * tolerances.length
    circles = [brep.edges[e] for e in rim.edges]
    if not all(circle.center is not None and axis.radius_of(circle.center) <= near for circle in circles):
        return False
    beside = (brep.faces[other] for wall in walls for edge, other in brep.neighbours(wall) if edge.id not in rim.edges)
    stem = [face for face in (*faces, *beside) if face.kind in (SurfaceKind.CYLINDER, SurfaceKind.CONE)]
    return any(Axis.of(face).same_line(axis, tolerances) for face in stem)


def _is_minor(brep: Brep, host: FaceRecord, group: set[int]) -> bool:
    """Does it stand on the body, rather than the body on it?"""
    body = brep.bodies[host.body]
    return sum(brep.faces[f].area for f in group) < 0.5 * body.area


def _beyond(brep: Brep, host: FaceRecord, loop: Loop) -> set[int]:
    """The faces on the far side of a loop that rises; empty when it sinks, or when they lead back to the host."""
    rim = set(loop.edges)
    first: set[int] = set()
    for e in loop.edges:
        edge = brep.edges[e]
        others = [i for i in edge.faces if i != host.id]
        if not others:
            return set()
        rounded = edge.convexity is EdgeConvexity.SMOOTH and brep.faces[others[0]].outward < 0
        if edge.convexity is not EdgeConvexity.CONCAVE and not rounded:
            return set()
        first.update(others)
    group, todo = set(first), list(first)
    while todo:
        current = todo.pop()
        for e in brep.face_edges[current]:
            if e in rim:
                continue
            for other in brep.edges[e].faces:
                if other == host.id:
                    return first
                if other not in group:
                    group.add(other)
                    todo.append(other)
    return group


def _fillets(brep: Brep, loop: Loop) -> set[int]:
    return {i for e in loop.edges for i in brep.edges[e].faces if brep.edges[e].convexity is EdgeConvexity.SMOOTH}


def _protrusion(brep: Brep, host: FaceRecord, loop: Loop, group: set[int], tolerances: Tolerances) -> Protrusion | None:
    """What stands on the host, None without a height. On a cylinder it stands off the axis, its height is radial."""
    is_round = host.kind is SurfaceKind.CYLINDER
    if is_round:
        normal = _off_axis(brep, host, loop)
    else:
        normal = host.axis if host.outward == 0 and host.axis != (0.0, 0.0, 0.0) else host.point_normal
    frame = frame_of(brep, group, normal, loop)
    fillets = _fillets(brep, loop)
    if group - fillets:  # as high as it stands on the host, as wide as it is above the fillet at its foot
        above = frame_of(brep, group - fillets, normal, loop)
        low, size = (*above.low[:2], frame.low[2]), (*above.size[:2], frame.size[2])
        frame = LocalFrame(above.u, above.v, above.n, low, size)
    if is_round:
        frame = _up_to_its_top(brep, _from_the_wall(brep, host, frame, group), group)
    else:
        frame = _from_its_foot(brep, _up_to_its_top(brep, frame, group), loop)
    if frame.size[2] <= 10 * tolerances.length:
        refuse("protrusion", group, "it has no height")
        return None
    outline, _ = outline_of(brep, loop, tolerances)
    length, width, height = frame.size
    return Protrusion(
        outline=outline,
        normal=normal,
        base=frame.point(0.5, 0.5, 0.0),
        tip=frame.point(0.5, 0.5, 1.0),
        center=frame.point(0.5, 0.5, 0.5),
        length=length,
        width=width,
        height=height,
        faces=tuple(sorted(group)),
        tags=tags_of(length, width, height),
    )


def _off_axis(brep: Brep, host: FaceRecord, loop: Loop) -> Vector:
    """Which way is out of a cylinder in the middle of a loop in it? Unit vector; inwards in a bore."""
    points = [sub(p, foot(p, host.origin, host.axis)) for e in loop.edges for p in brep.edge_points[e]]
    towards = mean(points)
    if norm(towards) <= MOST_AROUND * host.radius:
        return host.point_normal
    towards = unit(towards)
    across = cross(host.axis, towards)
    turns = [math.atan2(dot(p, across), dot(p, towards)) for p in points]
    turn = (min(turns) + max(turns)) / 2
    return scale(add(scale(towards, math.cos(turn)), scale(across, math.sin(turn))), float(host.outward))


def _from_the_wall(brep: Brep, host: FaceRecord, frame: LocalFrame, group: Collection[int]) -> LocalFrame:
    """The same frame, from the wall of a cylinder in its middle, as high as the group is radially."""
    axis = Axis.of(host)
    height = max(host.outward * (axis.radius_of(p) - host.radius) for p in face_points(brep, group))
    low = (*frame.low[:2], dot(host.origin, frame.n) + host.outward * host.radius)
    return LocalFrame(frame.u, frame.v, frame.n, low, (*frame.size[:2], max(height, 0.0)))


def _from_its_foot(brep: Brep, frame: LocalFrame, loop: Loop) -> LocalFrame:
    """The same frame, no lower than its foot: a hole in its top may be deeper than it is high."""
    foot = edges_span(brep, loop.edges, frame.n)[0]
    deeper = max(0.0, foot - frame.low[2])
    low, size = (*frame.low[:2], frame.low[2] + deeper), (*frame.size[:2], frame.size[2] - deeper)
    return LocalFrame(frame.u, frame.v, frame.n, low, size)


def _up_to_its_top(brep: Brep, frame: LocalFrame, group: Collection[int]) -> LocalFrame:
    """The same frame, as high as the level plane that is as large as the outline: what stands on that is not it."""
    planes = brep.of_kind(SurfaceKind.PLANE, sorted(group))
    level = (face for face in planes if dot(face.axis, frame.n) > FACING.parallel)
    for top in sorted(level, key=lambda face: dot(face.point, frame.n)):
        size = frame_of(brep, (top.id,), frame.n, None, frame.u).size
        height = dot(top.point, frame.n) - frame.low[2]
        if min(size[0] / frame.size[0], size[1] / frame.size[1]) > AS_LARGE and height > 0:
            return LocalFrame(frame.u, frame.v, frame.n, frame.low, (*frame.size[:2], height))
    return frame


def tags_of(length: float, width: float, height: float) -> tuple[str, ...]:
    """What else is a protrusion of these measures: 'rib', 'slender', 'flat'?"""
    rib = ("rib",) if exceeds(length, RIB_RATIO * width) else ()
    if height > ALIKE * max(length, width):
        return (*rib, "slender")
    return (*rib, "flat") if not reaches(height, 0.5 * width) else rib
