"""Windows: openings cut square through a plate along any outline, scalloped ones and keyholes among them."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import replace

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.frames import frame_of, outline_of
from querycad_segworker.tolerances import Tolerances
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, EdgeRecord, FaceRecord, Loop
from querycad_segworker.vectors import dot, parallel

from .depression import Depression, DepressionKind, depression_in

SQUARE = 1e-2
"""Sine of the angle by which walls and far side may deviate from square."""
ENCLOSING_RAD = math.radians(200.0)
"""A wall that turns further than this holds what is put into it: a bore."""


def recognise_windows(brep: Brep, tolerances: Tolerances) -> Iterator[Depression]:
    """Which openings with convex corners in their outline are cut square through from a plane face?

    All walls behind one inner loop of the face, as long as each runs straight to one plane on the other side. Outlines
    without convex corners have their walls in one group of concave corners; what runs into a bore is a keyway, unless
    it is the slot of a keyhole, narrower than the bore and round at its end.
    """
    seen: set[int] = set()
    for face in brep.faces:
        if face.kind is not SurfaceKind.PLANE:
            continue
        for loop in face.loops:
            walls = [] if loop.outer else _walls(brep, face, loop)
            if len(walls) > 2 and seen.isdisjoint(walls):
                found = _window(brep, face, loop, walls, tolerances)
                if found is not None:
                    seen.update(walls)
                    yield found


def _window(
    brep: Brep, host: FaceRecord, rim: Loop, walls: Collection[int], tolerances: Tolerances
) -> Depression | None:
    corners = [(wall, other) for wall in walls for other in brep.beside(wall, EdgeConvexity.CONVEX) if other in walls]
    if not corners:
        return None
    bores = [wall for wall in walls if brep.faces[wall].sweep > ENCLOSING_RAD]
    if bores and not _is_keyhole(brep, bores, walls):
        return None
    outline, corner = outline_of(brep, rim, tolerances)
    if any(all(brep.faces[i].kind is SurfaceKind.PLANE for i in pair) for pair in corners):
        outline = "free"  # an L or a cross has as many sides as some polygon
    frame = frame_of(brep, walls, host.axis, rim)
    found = depression_in(DepressionKind.PASSAGE, outline, frame, walls, (), host.body)
    if bores:
        return replace(found, outline="keyhole", width=2 * brep.faces[bores[0]].radius)
    return replace(found, corner_radius=corner)


def _walls(brep: Brep, host: FaceRecord, loop: Loop) -> list[int]:
    """The faces behind a loop, where each runs square to one plane on the far side; else none."""
    far: int | None = None
    walls: dict[int, None] = {}
    for e in loop.edges:
        edge = brep.edges[e]
        beyond = [i for i in edge.faces if i != host.id]
        if edge.convexity is not EdgeConvexity.CONVEX or len(beyond) != 1:
            return []
        walls[beyond[0]] = None
    for wall in walls:
        for edge, other in brep.neighbours(wall):
            if other == host.id or (other in walls and _is_upright(edge, host)):
                continue
            face = brep.faces[other]
            if face.kind is not SurfaceKind.PLANE or dot(face.axis, host.axis) > SQUARE - 1 or far not in (None, other):
                return []
            if edge.convexity is not EdgeConvexity.CONVEX:
                return []
            far = other
    return list(walls) if far is not None else []


def _is_upright(edge: EdgeRecord, host: FaceRecord) -> bool:
    return edge.kind is EdgeKind.LINE and parallel(edge.direction, host.axis, SQUARE)


def _is_keyhole(brep: Brep, bores: Collection[int], walls: Collection[int]) -> bool:
    """Is it one bore with a slot beside it that is narrower and round at its end?"""
    rounds = [brep.faces[w] for w in walls if w not in bores and brep.faces[w].kind is SurfaceKind.CYLINDER]
    ends = [face for face in rounds if face.outward < 0]
    flats = len(walls) - len(bores) - len(rounds)
    if len(bores) != 1 or flats != 2 or not ends or len(ends) < len(rounds):
        return False
    bore = brep.faces[next(iter(bores))]
    return abs(sum(end.sweep for end in ends) - math.pi) < 0.1 and ends[0].radius < bore.radius
