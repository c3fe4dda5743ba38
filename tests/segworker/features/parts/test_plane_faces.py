"""Plane faces and edges as such: what is asked of them by number, size and direction."""

from __future__ import annotations

import pytest
from tests.segworker.shapes import box, cone, cylinder, find, plate, split, turned

MM = 1e-3


def test_a_block_has_six_plane_faces_with_their_sizes_and_twelve_edges() -> None:
    found = find(turned(box((40, 30, 20)), (1, 2, 3), 25))
    faces = found.of("face")
    assert len(faces) == 6
    sizes = sorted(tuple(round((v or 0.0) / MM, 6) for v in (f.length, f.width)) for f in faces)
    assert sizes == [(30, 20), (30, 20), (40, 20), (40, 20), (40, 30), (40, 30)]
    assert found.shape.edge_count == 12


def test_a_face_that_is_stored_in_pieces_is_one() -> None:
    assert len(find(split(plate())).of("face")) == 6


def test_a_round_end_has_a_diameter_and_round_walls_are_no_plane_faces() -> None:
    ends = find(cylinder(5, 30)).of("face")
    assert [end.diameter for end in ends] == pytest.approx([10 * MM, 10 * MM])
    assert sorted(end.diameter or 0.0 for end in find(cone(5, 3, 30)).of("face")) == pytest.approx([6 * MM, 10 * MM])
    assert all("lying" in end.tags for end in ends)
