"""Which finds of different views are one part? Those that share faces (stage 6)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Find:
    """A part as one view shows it, or, once merged, as all views together do."""

    faces: frozenset[int]
    views: tuple[str, ...]
    """Names of the cameras, in the order of the views."""
    score: float
    """The detector's; of several, the best."""


def merge(finds: Sequence[Find]) -> tuple[Find, ...]:
    """Which parts are there? Finds that share a face, directly or through others, are united; by lowest face id."""
    merged: list[Find] = []
    for find in finds:
        same = [other for other in merged if other.faces & find.faces]
        merged = [other for other in merged if other not in same]
        merged.append(_united([*same, find]))
    return tuple(sorted(merged, key=lambda find: min(find.faces)))


def _united(finds: Sequence[Find]) -> Find:
    return Find(
        faces=frozenset().union(*(find.faces for find in finds)),
        views=tuple(dict.fromkeys(view for find in finds for view in find.views)),
        score=max(find.score for find in finds),
    )
