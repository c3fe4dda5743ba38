"""Slots with a narrower slot along their floor: a stepped slot, a T slot or dovetail with a relief groove."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

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
    owner = {face: cut for cut in found for face in cut.faces}
    inner = [cut for cut in found if cut.kind is DepressionKind.SLOT and cut.is_open]
    kept = {id(cut): cut for cut in found}
    while inner:
        slot = inner.pop()
        halves = [(floor, owner[floor.id]) for floor in _floors_beside(graph, slot) if floor.id in owner]
        for (floor, one), (level, other) in combinations(halves, 2):
            level_with = abs(dot(sub(level.point, floor.point), floor.axis)) <= SAME_LEVEL
            wide = _united(graph, floor, level, one, other) if level_with and one is not other else None
            if wide is not None and {id(one), id(other), id(slot)} <= kept.keys():
                kept = {key: cut for key, cut in kept.items() if key not in (id(one), id(other))} | {id(wide): wide}
                owner.update(dict.fromkeys(wide.faces, wide))
                inner.append(wide)
    return list(kept.values())


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
