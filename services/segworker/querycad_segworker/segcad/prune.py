"""Which of the masked faces belong together? Those that hang together with the one nearest the camera (stage 5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.topology import spread


@dataclass(frozen=True, slots=True, eq=False)
class FaceGraph:
    """Which faces meet along an edge? The B-rep's adjacency without the rest of it."""

    pairs: NDArray[np.int32]
    """(E, 2) int32, ids of two faces that meet; each pair once, in either order."""

    def among(self, faces: frozenset[int]) -> dict[int, list[int]]:
        """Which of these faces does each of them meet?"""
        neighbours: dict[int, list[int]] = {face: [] for face in faces}
        if len(self.pairs):
            ids = np.fromiter(faces, dtype=np.int32, count=len(faces))
            both = np.isin(self.pairs, ids).all(axis=1)
            for one, other in self.pairs[both].tolist():
                neighbours[one].append(other)
                neighbours[other].append(one)
        return neighbours


def prune(faces: frozenset[int], start: int, graph: FaceGraph) -> frozenset[int]:
    """Which of `faces` can be reached from `start`, going from face to face over common edges only?"""
    if start not in faces:
        raise ValueError(f"face {start} is not among those to start from")
    return frozenset(spread((start,), graph.among(faces).__getitem__))
