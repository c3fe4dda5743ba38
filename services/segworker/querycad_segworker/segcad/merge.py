"""Which finds of different views are one part? Those that share faces, or meet and are never seen apart (stage 6).

The QueryCAD paper unites what shares a face. A wall that only one view shows and a floor that only another shows share
none, though they meet along an edge: such finds are united too, unless some view shows both, as two.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .prune import FaceGraph


@dataclass(frozen=True, slots=True)
class Find:
    """A part as one view shows it, or, once merged, as all views together do."""

    faces: frozenset[int]
    views: tuple[str, ...]
    """Names of the cameras, in the order of the views."""
    score: float
    """The detector's; of several, the best."""


def merge(finds: Sequence[Find], graph: FaceGraph | None = None) -> tuple[Find, ...]:
    """Which parts are there? Finds that share a face, directly or through others, are united; by lowest face id.

    With a graph, parts that meet in it are then united as well, those that meet along most edges first, as long as no
    view shows something of both.
    """
    merged: list[Find] = []
    for find in finds:
        same = [other for other in merged if other.faces & find.faces]
        merged = [other for other in merged if other not in same]
        merged.append(_united([*same, find]))
    merged.sort(key=lambda find: min(find.faces))
    while graph is not None and (pair := _meeting(merged, graph)) is not None:
        first, second = pair
        merged[first] = _united([merged[first], merged.pop(second)])
    return tuple(merged)


def _meeting(parts: Sequence[Find], graph: FaceGraph) -> tuple[int, int] | None:
    """Which two parts meet along most edges, of those that no view shows both of? The lower index first."""
    if not parts or not len(graph.pairs):
        return None
    part_of = np.full(int(graph.pairs.max()) + 1, -1, dtype=np.int64)
    for index, part in enumerate(parts):
        ids = np.fromiter(part.faces, dtype=np.int64)
        part_of[ids[ids < len(part_of)]] = index  # a face that meets no other may have a higher id
    meeting = np.sort(part_of[graph.pairs], axis=1)
    meeting = meeting[(meeting[:, 0] >= 0) & (meeting[:, 0] < meeting[:, 1])]
    pairs, edges = np.unique(meeting, axis=0, return_counts=True)
    for at in np.argsort(-edges, kind="stable"):
        first, second = (int(index) for index in pairs[at])
        if not set(parts[first].views) & set(parts[second].views):
            return first, second
    return None


def _united(finds: Sequence[Find]) -> Find:
    return Find(
        faces=frozenset().union(*(find.faces for find in finds)),
        views=tuple(dict.fromkeys(view for find in finds for view in find.views)),
        score=max(find.score for find in finds),
    )
