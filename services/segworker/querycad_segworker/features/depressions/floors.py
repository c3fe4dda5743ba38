"""Which of the plane faces of a cut is its floor?"""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.adjacency import ConcaveGraph
from querycad_segworker.features.shared.regular import depth_of_flat
from querycad_segworker.tolerances import FACING
from querycad_segworker.topology import Brep, EdgeConvexity, FaceRecord
from querycad_segworker.vectors import dot

from .slot_sections import facing_pair


def floor_of(
    graph: ConcaveGraph, group: set[int], planes: Sequence[FaceRecord], links: dict[int, set[int]]
) -> FaceRecord:
    """The plane that the most others stand on; of several, one that walls surround.

    The end of a slot bears as many walls as its floor: the larger one is the floor. In a corner of two or three
    faces that are all alike, the one between two walls that face each other, or the flat of a shaft where it is the
    larger one; else `by_attitude` decides.
    """
    most = max(len(links[face.id]) for face in planes)
    largest = max(face.area for face in planes)

    def rank(face: FaceRecord) -> tuple[float, ...]:
        walls = [graph.brep.faces[i] for i in sorted(links[face.id])]
        pair = facing_pair([wall for wall in walls if wall.kind is SurfaceKind.PLANE], face.axis)
        size = round(face.area / largest, 3) if most > 2 or pair is not None else 0.0
        return (
            is_surrounded(graph.brep, face, group),
            len(walls),
            pair is not None,
            size,
            face.area >= largest and depth_of_flat(graph.brep, face) is not None,
            *by_attitude(face, planes),
        )

    return max(planes, key=rank)


def by_attitude(face: FaceRecord, planes: Sequence[FaceRecord]) -> tuple[float, ...]:
    """Which of the planes of a corner is its floor, where nothing else tells them apart? The largest tuple is.

    A level one, whether it looks up or down, then the larger one, so that equal corners have equal depths on whichever
    side of the part they are. Where these are alike too: facing top, then front, then right.
    """
    largest = max(plane.area for plane in planes)
    return (
        abs(face.axis[2]) > FACING.parallel,
        round(face.area / largest, 2),
        dot(face.axis, (0.1, -0.2, 1.0)),
        face.area,
    )


def is_surrounded(brep: Brep, face: FaceRecord, group: set[int]) -> bool:
    """Do faces of the group stand on all of its outline?"""
    return bool(face.loops) and all(
        brep.edges[e].convexity is EdgeConvexity.CONCAVE and group.issuperset(brep.edges[e].faces)
        for e in face.loops[0].edges
    )
