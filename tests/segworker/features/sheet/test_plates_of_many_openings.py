"""Plates with many openings: what is gone through does not grow with the square of their number."""

from __future__ import annotations

from collections import Counter

import pytest
from tests.segworker.shapes import box, cut, find

from querycad_segworker.features.sheet import plates
from querycad_segworker.topology import Brep, FaceRecord


def test_a_face_with_many_openings_is_gone_through_once_a_direction(monkeypatch: pytest.MonkeyPatch) -> None:
    gone_through = Counter[int]()
    real = plates._ends

    def counted(brep: Brep, face: FaceRecord, wall: FaceRecord) -> list[tuple[float, int]]:
        gone_through[wall.id] += 1
        return real(brep, face, wall)

    monkeypatch.setattr(plates, "_ends", counted)
    openings = [box((4, 4, 10), (8.0 * x, 8.0 * y, -2)) for x in range(5) for y in range(5)]
    found = find(cut(box((42, 42, 5), (-3, -3, 0)), *openings))
    assert len(found.of("cutout")) == 25
    assert max(gone_through.values()) == 4
