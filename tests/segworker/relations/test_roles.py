"""What a part is to the others: a hole that goes right through a ring, or through one of its walls."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, cylinder, find, plate

from querycad_segworker.relations.roles import Kinds

RING = cut(cylinder(18, 16), cylinder(10, 40, (0, 0, -10)))
ALONG_X = (1.0, 0.0, 0.0)


def right_through(shape: TopoDS_Shape, kind: str, diameter: float) -> list[bool]:
    found = find(shape)
    kinds = Kinds(found.parts)
    cuts = [part for part in kinds.get(kind) if abs((part.diameter or part.width or 0.0) - diameter) < 1e-6]
    return [kinds.plays(part, "right_through") for part in cuts]


@pytest.mark.parametrize(("start", "answer"), [(0.0, False), (-30.0, True)])
def test_through_a_ring_is_through_both_of_its_walls(start: float, answer: bool) -> None:
    drilled = cut(RING, cylinder(2.5, 30.0 - start, (start, 0, 8), ALONG_X))
    assert set(right_through(drilled, "hole", 0.005)) == {answer}


def test_slots_in_both_walls_of_a_sleeve_go_through_both_and_one_does_not() -> None:
    both, one = (cut(RING, box((40.0 + x, 4, 6), (-x, -2, 5))) for x in (30.0, 0.0))
    assert set(right_through(both, "cutout", 0.004)) == {True}
    assert set(right_through(one, "cutout", 0.004)) == {False}


def test_through_a_plate_with_a_wide_bore_beside_is_right_through_and_blind_is_not() -> None:
    drilled = cut(plate(), cylinder(3, 60, (20, 0, -20)), cylinder(8, 60, (-10, 0, -20)), cylinder(2, 40, (20, 12, -8)))
    assert right_through(drilled, "hole", 0.006) == [True]
    assert right_through(drilled, "hole", 0.004) == [False]
