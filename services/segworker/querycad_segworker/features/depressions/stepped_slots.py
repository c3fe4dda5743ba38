"""Slots with a narrower slot along their floor: a stepped slot, a T slot or dovetail with a relief groove."""

from __future__ import annotations

from collections.abc import Sequence

from querycad_contracts import SurfaceKind
from querycad_segworker.features.shared.adjacency import ConcaveGraph
from querycad_segworker.topology import EdgeConvexity, FaceRecord
from querycad_segworker.vectors import dot, parallel, sub

from .concave_regions import slot_between
from .depression import Depression, DepressionKind
from .slot_sections import SQUARE, facing_pair, over_edge_break

LEVEL = 1.0 - 1e-6
"""Cosine: two halves of one floor look the same way."""
SAME_LEVEL = 1e-6
"""Metres. Two halves of one floor lie in one plane."""


def with_stepped_slots(graph: ConcaveGraph, found: Sequence[Depression]) -> list[Depression]:
    """The same depressions, with the two halves that a narrower slot parts a slot into made one again."""
    result = list(found)
    inner = [cut for cut in found if cut.kind is DepressionKind.SLOT and cut.is_open]
    while inner:
        slot = inner.pop()
        halves = [(floor, cut) for floor in _floors_beside(graph, slot) for cut in result if floor.id in cut.faces]
        for i, (floor, one) in enumerate(halves):
            for level, other in halves[i + 1 :]:
                apart = abs(dot(sub(level.point, floor.point), floor.axis))
                wide = None if one is other or apart > SAME_LEVEL else _united(graph, floor, level, one, other)
                if wide is not None and one in result and other in result:
                    result = [*(cut for cut in result if cut not in (one, other)), wide]
                    inner = [*(cut for cut in inner if cut not in (one, other)), wide]
    return result


def _floors_beside(graph: ConcaveGraph, slot: Depression) -> list[FaceRecord]:
    """The planes that look the way a slot opens, and that its walls end at, also over a chamfer or round."""
    brep = graph.brep
    walls = [face for face in brep.of_kind(SurfaceKind.PLANE, slot.faces) if face.id not in slot.floor]
    ends = [brep.faces[i] for wall in walls for i in brep.beside(wall.id, EdgeConvexity.CONVEX)]
    ends += [face for wall in walls for face in over_edge_break(brep, wall)]
    level = (face for face in ends if face.kind is SurfaceKind.PLANE and dot(face.axis, slot.normal) > LEVEL)
    mouth = slot.depth / 2 - SAME_LEVEL  # below it a window opens its wall
    return list({f.id: f for f in level if dot(sub(f.point, slot.center), slot.normal) > mouth}.values())


def _united(
    graph: ConcaveGraph, floor: FaceRecord, level: FaceRecord, one: Depression, other: Depression
) -> Depression | None:
    group = {*one.faces, *other.faces}
    walls = graph.brep.of_kind(SurfaceKind.PLANE, sorted(group - {floor.id, level.id}))
    ends = graph.brep.of_kind(SurfaceKind.CYLINDER, sorted(group))
    pair = facing_pair(walls, floor.axis)
    rounds = [end for end in ends if parallel(end.axis, floor.axis, SQUARE)]  # the others are fillets
    return slot_between(graph, group, floor, [*walls, *rounds], pair) if pair is not None else None
