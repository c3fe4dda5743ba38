"""Edge treatments: fillets and rounds of one radius, and chamfers of one width."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

from querycad_contracts import SurfaceKind, Vector
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeRecord, FaceRecord
from querycad_segworker.vectors import Box, box_center, box_union

from .adjacency import is_blend

CHAMFER_ANGLES_RAD = (math.radians(20.0), math.radians(70.0))
"""A chamfer turns by this much against each neighbour: 45 degrees as a rule, 30 and 60 on lead-ins."""
CHAMFER_NEIGHBOURS = 1.5
"""Both faces that a chamfer joins are larger than itself by this factor; the sides of a polygon are not."""


@dataclass(frozen=True, slots=True)
class Blend:
    """A chain of blend faces. Metres. `radius` is 0 for a chamfer, whose `width` is measured across its face."""

    kind: str
    """'fillet' in a concave corner, 'round' on a convex edge, 'chamfer'."""
    radius: float
    width: float
    center: Vector
    box: Box
    faces: tuple[int, ...]
    body: int


def recognise_blends(brep: Brep, taken: Collection[int], tolerances: Tolerances) -> list[Blend]:
    """Which fillets, rounds and chamfers does the model have? Neighbouring ones of one size are one; lowest id first.

    `taken`: faces of holes and bosses, whose own chamfers and roundings belong to them.
    """
    kinds: dict[int, tuple[str, float]] = {}
    for face in brep.faces:
        if face.id in taken:
            continue
        if is_blend(brep, face) and not _is_wall(face):
            radius = face.minor_radius if face.kind is SurfaceKind.TORUS else face.radius
            kinds[face.id] = ("fillet" if face.outward < 0 else "round", radius)
        elif (width := _chamfer_width(brep, face)) is not None:
            kinds[face.id] = ("chamfer", width)
    found, seen = [], set[int]()
    for start in sorted(kinds):
        if start in seen:
            continue
        kind, size = kinds[start]
        chain, todo = {start}, [start]
        while todo:
            for _, other in brep.neighbours(todo.pop()):
                if other not in chain and other in kinds and _alike(kinds[other], (kind, size), tolerances):
                    chain.add(other)
                    todo.append(other)
        seen |= chain
        found.append(_blend(brep, kind, size, chain))
    return found


def _is_wall(face: FaceRecord) -> bool:
    """A face that turns by more than half a circle around its axis is a wall of its own."""
    return face.kind is SurfaceKind.CYLINDER and face.sweep > math.radians(179.0)


def _alike(a: tuple[str, float], b: tuple[str, float], tolerances: Tolerances) -> bool:
    return a[0] == b[0] and abs(a[1] - b[1]) <= max(0.01 * b[1], 3 * tolerances.length)


def _blend(brep: Brep, kind: str, size: float, chain: set[int]) -> Blend:
    box = box_union(brep.faces[f].box for f in chain)
    assert box is not None
    return Blend(
        kind=kind,
        radius=0.0 if kind == "chamfer" else size,
        width=size,
        center=box_center(box),
        box=box,
        faces=tuple(sorted(chain)),
        body=brep.faces[min(chain)].body,
    )


def _chamfer_width(brep: Brep, face: FaceRecord) -> float | None:
    """The width of a plane or conical strip between two convex edges, or None when the face is no chamfer."""
    if face.kind not in (SurfaceKind.PLANE, SurfaceKind.CONE) or len(face.loops) > 2:
        return None
    edges = [brep.edges[e] for e in brep.face_edges[face.id]]
    low, high = CHAMFER_ANGLES_RAD
    slanted = [e for e in edges if e.convexity is EdgeConvexity.CONVEX and low <= e.angle <= high]
    slanted.sort(key=lambda e: -e.length)
    if len(slanted) < 2:
        return None
    first, second = slanted[:2]
    length = (first.length + second.length) / 2
    width = face.area / length if length > 0 else math.inf
    if length < width or second.length < 0.5 * first.length:
        return None
    neighbours = [_other(brep, edge, face) for edge in (first, second)]
    if any(n is None or n.area < CHAMFER_NEIGHBOURS * face.area for n in neighbours) or neighbours[0] == neighbours[1]:
        return None
    return width


def _other(brep: Brep, edge: EdgeRecord, face: FaceRecord) -> FaceRecord | None:
    others = [i for i in edge.faces if i != face.id]
    return brep.faces[others[0]] if others else None
