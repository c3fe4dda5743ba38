"""Masked faces that hang together, and finds of several views that are one part."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest

from querycad_segworker.segcad.merge import Find, merge
from querycad_segworker.segcad.prune import FaceGraph, prune

CHAIN = FaceGraph(np.array([(0, 1), (1, 2), (2, 3), (4, 5)], dtype=np.int32))


def test_what_hangs_together_with_the_start_stays() -> None:
    assert prune(frozenset({0, 1, 2, 4, 5}), 1, CHAIN) == {0, 1, 2}
    assert prune(frozenset({0, 1, 2, 4, 5}), 5, CHAIN) == {4, 5}


def test_the_way_goes_over_masked_faces_only() -> None:
    assert prune(frozenset({0, 1, 3}), 0, CHAIN) == {0, 1}


def test_a_face_without_neighbours_stays_alone() -> None:
    nothing = FaceGraph(np.zeros((0, 2), dtype=np.int32))
    assert prune(frozenset({7, 8}), 7, nothing) == {7}


def test_the_start_must_be_masked() -> None:
    with pytest.raises(ValueError, match="face 3"):
        prune(frozenset({0, 1}), 3, CHAIN)


def find(*faces: int, view: str = "top", score: float = 0.5) -> Find:
    return Find(frozenset(faces), (view,), score)


def test_finds_that_share_a_face_are_one_part_with_the_best_score() -> None:
    (part,) = merge([find(1, 2, view="top", score=0.4), find(2, 3, view="left", score=0.7)])
    assert part == Find(frozenset({1, 2, 3}), ("top", "left"), 0.7)


def test_finds_without_common_faces_stay_apart() -> None:
    assert [sorted(part.faces) for part in merge([find(5, 6), find(1, 2, view="left")])] == [[1, 2], [5, 6]]


def test_sharing_goes_through_others_whatever_the_order() -> None:
    finds = [find(1, 2), find(3, 4, view="left"), find(2, 3, view="back"), find(9)]
    for order in permutations(finds):
        assert [sorted(part.faces) for part in merge(order)] == [[1, 2, 3, 4], [9]]


def test_nothing_merges_to_nothing() -> None:
    assert merge([]) == ()


def test_finds_that_meet_along_an_edge_are_one_where_no_view_shows_them_apart() -> None:
    wall, floor = find(0, 1, view="left"), find(2, view="top", score=0.8)
    assert merge([wall, floor], CHAIN) == (Find(frozenset({0, 1, 2}), ("left", "top"), 0.8),)
    assert len(merge([wall, floor])) == 2, "as published"


def test_neighbours_that_one_view_shows_as_two_stay_two() -> None:
    one, other = find(0, 1, view="top"), find(2, view="top")
    assert len(merge([one, other, find(2, view="left")], CHAIN)) == 2


def test_of_several_neighbours_the_one_with_most_common_edges_is_the_same_part() -> None:
    """Face 4 meets face 0 along one edge, faces 2 and 3 along two; from the top, those are another part."""
    graph = FaceGraph(np.array([(0, 4), (2, 4), (3, 4), (2, 3)], dtype=np.int32))
    parts = merge([find(0, view="top"), find(2, 3, view="top"), find(4, view="left")], graph)
    assert [sorted(part.faces) for part in parts] == [[0], [2, 3, 4]]


def test_faces_beyond_the_graph_meet_nothing() -> None:
    assert len(merge([find(7), find(8, view="left")], FaceGraph(np.zeros((0, 2), dtype=np.int32)))) == 2
    assert len(merge([find(77), find(88, view="left")], CHAIN)) == 2
