"""Pockets that another cut, or a narrower outlet of their own depth, opens at the side; and those outlets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.adjacency import ConcaveGraph
from querycad_segworker.features.shared.extruded_walls import MORE_THAN_HALF, tunnel_of
from querycad_segworker.features.shared.frames import frame_of
from querycad_segworker.tolerances import reaches
from querycad_segworker.topology import Brep, EdgeConvexity, EdgeKind, FaceRecord, parted
from querycad_segworker.vectors import cross, parallel, unit

from .depression import Depression, DepressionKind, depression_in
from .slot_sections import SQUARE, Pair, facing_pair


def held_floor(
    graph: ConcaveGraph, group: set[int], planes: Sequence[FaceRecord]
) -> tuple[set[int], list[FaceRecord]] | None:
    """A floor with walls square on it that turn so far that they are a pocket's, though it is open; and its pieces.

    Three walls of a rectangle turn by 180 degrees, those of a triangle by 240. The walls of a T slot or dovetail with
    a closed end turn as far about the way that it runs: those are asked for before. The walls of an outlet are others.
    """
    brep = graph.brep
    for plane in planes:
        pieces = graph.flush(plane.id) & group
        if len(group) - len(pieces) < 3 or plane.id != min(pieces):
            continue
        walls = group - pieces
        own = walls if tunnel_of(brep, walls) is not None else _without_outlet(brep, walls, plane)
        around = tunnel_of(brep, own)
        if around is not None and around.turn > MORE_THAN_HALF and parallel(around.axis, plane.axis, SQUARE):
            return own | pieces, [brep.faces[i] for i in sorted(pieces)]
    return None


def _without_outlet(brep: Brep, walls: set[int], floor: FaceRecord) -> set[int]:
    """The walls that run into each other, without two that face each other and each end at those in a convex edge."""

    def onwards(wall: int) -> set[int]:
        links = brep.neighbours(wall)
        return {
            i for e, i in links if i in walls and e.kind is EdgeKind.LINE and e.convexity is not EdgeConvexity.CONVEX
        }

    chain = max(parted(sorted(walls), onwards), key=len)
    pair = facing_pair(brep.of_kind(SurfaceKind.PLANE, sorted(walls - chain)), floor.axis)
    outlet = pair is not None and walls - chain == {pair[0].id, pair[1].id}
    return chain if outlet and all(_ends_at(brep, wall, chain) for wall in pair or ()) else set()


def _ends_at(brep: Brep, wall: FaceRecord, chain: set[int]) -> bool:
    return not chain.isdisjoint(brep.beside(wall.id, EdgeConvexity.CONVEX))


def recognise_outlets(brep: Brep, found: Sequence[Depression]) -> Iterator[Depression]:
    """Which narrower slots of the same depth lead out of open pockets? Their floor is that of the pocket."""
    taken = {face for cut in found for face in cut.faces}
    for pocket in found:
        if pocket.kind is not DepressionKind.POCKET or not pocket.is_open:
            continue
        own = set(pocket.faces)
        for floor in (brep.faces[i] for i in pocket.floor):
            beside = [i for i in brep.beside(floor.id, EdgeConvexity.CONCAVE) if i not in taken]
            ends = [wall for wall in brep.of_kind(SurfaceKind.PLANE, sorted(beside)) if _ends_at(brep, wall, own)]
            pair = facing_pair(ends, floor.axis)
            if pair is not None:
                yield _outlet(brep, pair, floor)


def _outlet(brep: Brep, pair: Pair, floor: FaceRecord) -> Depression:
    ids = {wall.id for wall in pair}
    frame = frame_of(brep, ids, floor.axis, None, unit(cross(pair[0].axis, floor.axis)))
    long = reaches(frame.size[0], frame.size[1])
    kind = DepressionKind.SLOT if long else DepressionKind.NOTCH
    return depression_in(kind, "rectangular", frame, ids, (), floor.body, is_open=True)
