"""Along which directions is an opening reached, and a screw driven in?"""

from __future__ import annotations

import pytest
from tests.segworker.shapes import box, compound, cut, cylinder, find, fuse, plate

DOWN, UP, LEFT = (0.0, 0.0, -1.0), (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0)


def test_a_blind_hole_has_one_way_in_and_a_through_hole_two() -> None:
    found = find(cut(plate(), cylinder(4, 10, (-10, 0, -10)), cylinder(4, 40, (10, 0, -30))))
    ways = {hole.bottom: {tuple(round(c) + 0.0 for c in way) for way in hole.approach} for hole in found.of("hole")}
    assert ways == {"flat": {DOWN}, "through": {DOWN, UP}}


def test_a_hole_from_the_right_is_drilled_to_the_left() -> None:
    (hole,) = find(cut(plate(), cylinder(4, 10, (20, 0, -10), (1, 0, 0)))).of("hole")
    (way,) = hole.approach
    assert way == pytest.approx(LEFT)


def test_a_screw_goes_the_way_that_its_shank_points_and_a_pin_has_no_such_way() -> None:
    """One screw with its head on top, one with its head below, and a plain pin."""
    upright = fuse(cylinder(2.5, 16, (0, 0, -16)), cylinder(4.25, 5))
    hanging = fuse(cylinder(2.5, 16, (30, 0, 0)), cylinder(4.25, 5, (30, 0, -5)))
    bodies = find(compound(upright, hanging, cylinder(2.5, 16, (60, 0, 0)))).of("body")
    screws = [pytest.approx(way) for body in bodies for way in body.approach]
    assert screws == [DOWN, UP]
    assert bodies[2].approach == ()


def test_what_stands_out_has_no_way_in() -> None:
    (boss,) = find(fuse(plate(), cylinder(5, 10))).of("boss")
    assert boss.approach == ()
    assert not any(body.approach for body in find(box((10, 20, 30))).of("body"))
