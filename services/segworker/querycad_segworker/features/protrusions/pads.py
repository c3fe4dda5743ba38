"""Pads and ridges: what rises from a face as far as its border, so that some of its sides are flush with the body's."""

from __future__ import annotations

from collections.abc import Collection

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.frames import edge_points, frame_of_edges, outline_of
from querycad_segworker.features.shared.refusals import refuse
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import add, dot, scale

from .protrusions import Protrusion, tags_of

SQUARE = 1e-2
"""Sine of the angle by which the sides of a pad may deviate from upright, and what it stands on from its top."""
MIN_FEET = 2
"""A wall that stands on one side only is a step of the body, or a flange bent up from it."""


def recognise_pads(brep: Brep, known: Collection[int], tolerances: Tolerances) -> list[Protrusion]:
    """Which protrusions reach as far as the border of the face they stand on? Sorted by lowest face id.

    A plane top with upright sides all around, of which two at least stand on one level and the others run on below it;
    smaller than what is left of that level beside it, for a larger one is the body, with steps cut beside it. `known`:
    faces of protrusions that stand within a face, and the tops of ribs.
    """
    found = []
    for top in brep.faces:
        if top.kind is SurfaceKind.PLANE and top.id not in known and top.loops and top.loops[0].outer:
            pad = _pad(brep, top, tolerances)
            if pad is not None:
                found.append(pad)
    return found


def _pad(brep: Brep, top: FaceRecord, tolerances: Tolerances) -> Protrusion | None:
    sides = _sides(brep, top)
    if sides is None:
        return None
    feet: dict[int, tuple[float, set[int]]] = {}
    for side in sides:
        foot = _foot(brep, side, top)
        if foot is not None:
            feet[side.id] = foot
    near = 10 * tolerances.length
    levels = [level for level, _ in feet.values()]
    if len(feet) < MIN_FEET or len(feet) == len(sides) or max(levels) - min(levels) > near:
        return None
    level = max(levels)
    if any(_low(brep, side, top) > level - near for side in sides if side.id not in feet):
        return None
    hosts = set().union(*(faces for _, faces in feet.values()))
    faces = {top.id, *feet}
    if top.area >= sum(brep.faces[f].area for f in hosts):
        refuse("protrusion", faces, "larger than what is left beside it: the body, with steps cut beside it")
        return None
    return _protrusion(brep, top, faces, level, tolerances)


def _sides(brep: Brep, top: FaceRecord) -> list[FaceRecord] | None:
    """The upright faces all around a top; None where one leans, or where something rises beside it."""
    sides: dict[int, FaceRecord] = {}
    for e in top.loops[0].edges:
        edge = brep.edges[e]
        others = [i for i in edge.faces if i != top.id]
        if len(others) != 1 or edge.convexity is not EdgeConvexity.CONVEX:
            return None
        side = brep.faces[others[0]]
        plane = side.kind is SurfaceKind.PLANE and abs(dot(side.axis, top.axis)) < SQUARE
        round_side = side.kind is SurfaceKind.CYLINDER and abs(dot(side.axis, top.axis)) > 1 - SQUARE
        if not plane and not round_side:
            return None
        sides[side.id] = side
    return list(sides.values())


def _foot(brep: Brep, side: FaceRecord, top: FaceRecord) -> tuple[float, set[int]] | None:
    """On which level does a side stand, along the top's normal, and on which faces? None where it runs on down."""
    levels: list[float] = []
    hosts: set[int] = set()
    for edge, other in brep.neighbours(side.id):
        host = brep.faces[other]
        if edge.convexity is EdgeConvexity.CONCAVE and _faces_up(host, top):
            levels.append(dot(host.point, top.axis))
            hosts.add(other)
        elif edge.convexity is EdgeConvexity.SMOOTH and host.outward < 0:  # over a fillet
            beyond = [brep.faces[i] for i in brep.beside(other, EdgeConvexity.SMOOTH) if i != side.id]
            levels += [dot(face.point, top.axis) for face in beyond if _faces_up(face, top)]
            hosts |= {face.id for face in beyond if _faces_up(face, top)}
    if not levels or _low(brep, side, top) < min(levels) - SQUARE * (dot(top.point, top.axis) - min(levels)):
        return None
    return min(levels), hosts


def _faces_up(face: FaceRecord, top: FaceRecord) -> bool:
    below = dot(face.point, top.axis) < dot(top.point, top.axis)
    return face.kind is SurfaceKind.PLANE and below and dot(face.axis, top.axis) > 1 - SQUARE


def _low(brep: Brep, side: FaceRecord, top: FaceRecord) -> float:
    """How far down does a side reach, along the top's normal?"""
    return min(dot(p, top.axis) for e in brep.face_edges[side.id] for p in brep.edges[e].points)


def _protrusion(brep: Brep, top: FaceRecord, faces: set[int], level: float, tolerances: Tolerances) -> Protrusion:
    rim = top.loops[0]
    frame = frame_of_edges(brep, rim.edges, top.axis, rim)
    length, width, _ = frame.size
    height = max(dot(p, top.axis) for e in rim.edges for p in edge_points(brep, e)) - level
    tip = frame.point(0.5, 0.5, 1.0)
    outline, _ = outline_of(brep, rim, tolerances)
    return Protrusion(
        outline=outline,
        normal=top.axis,
        base=add(tip, scale(top.axis, -height)),
        tip=tip,
        center=add(tip, scale(top.axis, -height / 2)),
        length=length,
        width=width,
        height=height,
        faces=tuple(sorted(faces)),
        tags=tags_of(length, width, height),
    )
