"""Balloons: around the model, never over each other, their leaders never crossing."""

from __future__ import annotations

from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from querycad_segworker.render.labels import Balloon, Point, place_balloons, ring_around

OUTLINE = np.array([(100, 100), (420, 80), (500, 300), (260, 420), (60, 330)], dtype=np.float64)
ANCHORS = st.lists(
    st.tuples(st.floats(0.02, 0.98), st.floats(0.02, 0.98), st.integers(1, 3)), min_size=1, max_size=40, unique=True
)


def _inside(spots: list[tuple[float, float, int]]) -> dict[int, Point]:
    """Points inside the outline: on the triangle from its first corner to one of its far edges."""
    points = {}
    for part, (a, b, edge) in enumerate(spots):
        share = np.sqrt(a)
        x, y = OUTLINE[0] * (1 - share) + (OUTLINE[edge] * (1 - b) + OUTLINE[edge + 1] * b) * share
        points[part] = (float(x), float(y))
    return points


def _cross(a: Balloon, b: Balloon) -> bool:
    def turn(p: Point, q: Point, r: Point) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    edge = 1e-6  # leaders that merely touch do not cross
    return (
        turn(a.anchor, a.rim, b.anchor) * turn(a.anchor, a.rim, b.rim) < -edge
        and turn(b.anchor, b.rim, a.anchor) * turn(b.anchor, b.rim, a.rim) < -edge
    )


def _distance(point: Point, start: Point, end: Point) -> float:
    """From a point to a line segment."""
    p, s, e = (np.array(value) for value in (point, start, end))
    way: NDArray[np.float64] = e - s
    share = np.clip((p - s) @ way / max(float(way @ way), 1e-12), 0, 1)
    return float(np.linalg.norm(p - s - share * way))


@settings(max_examples=60, deadline=None)
@given(ANCHORS)
def test_balloons_neither_overlap_nor_hide_leaders_and_leaders_do_not_cross(
    spots: list[tuple[float, float, int]],
) -> None:
    balloons = place_balloons(_inside(spots), ring_around(OUTLINE, 12.0))
    assert [balloon.part for balloon in balloons] == list(range(len(spots)))
    for a, b in combinations(balloons, 2):
        assert np.hypot(a.center[0] - b.center[0], a.center[1] - b.center[1]) >= 24
        assert not _cross(a, b)
        assert _distance(a.center, b.anchor, b.rim) > 11.9
        assert _distance(b.center, a.anchor, a.rim) > 11.9


def test_balloons_stay_outside_the_outline_and_touch_it() -> None:
    ring = ring_around(OUTLINE, 12.0)
    assert np.linalg.norm(ring.centers - ring.rims, axis=1) == pytest.approx(np.full(len(ring.rims), 12.0), abs=0.01)
    corners = np.concatenate([OUTLINE, OUTLINE[:1]])
    for center in ring.centers:
        nearest = min(_distance(tuple(center), tuple(a), tuple(b)) for a, b in pairwise(corners))
        assert nearest == pytest.approx(12.0, abs=0.05)


def test_a_ring_is_filled_with_places() -> None:
    length = np.linalg.norm(OUTLINE - np.roll(OUTLINE, 1, axis=0), axis=1).sum() + 2 * np.pi * 12
    assert len(ring_around(OUTLINE, 12.0).rims) >= 0.9 * length / (2 * 12 * 1.15)


def test_a_part_gets_the_place_next_to_it() -> None:
    ring = ring_around(OUTLINE, 12.0)
    (balloon,) = place_balloons({7: (400.0, 100.0)}, ring)
    assert balloon.part == 7
    assert np.hypot(balloon.rim[0] - 400, balloon.rim[1] - 100) < 30


def test_smaller_balloons_have_more_places() -> None:
    assert len(ring_around(OUTLINE, 6.0).rims) > 1.7 * len(ring_around(OUTLINE, 12.0).rims)


def test_more_balloons_than_places_are_refused() -> None:
    ring = ring_around(OUTLINE, 100.0)
    with pytest.raises(ValueError, match="only"):
        place_balloons(dict.fromkeys(range(50), (250.0, 250.0)), ring)


def test_a_single_point_has_a_ring_too() -> None:
    ring = ring_around(np.array([[10.0, 10.0]]), 5.0)
    assert len(ring.rims) >= 1
    assert place_balloons({}, ring) == ()
