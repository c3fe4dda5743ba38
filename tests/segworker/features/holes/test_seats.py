"""Steps of a bore: seats, which are narrower than counterbores, and counterbores whose walls are drafted."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import Found, cone, cut, cylinder, find

MM = 1e-3


def housing(seat: float, bore: float) -> Found:
    """A round housing, 40 long, bored through, with a seat 26 deep whose mouth has a chamfer of 1 mm."""
    return find(
        cut(
            cylinder(50, 40),
            cylinder(bore, 60, (0, 0, -10)),
            cylinder(seat, 30, (0, 0, 14)),
            cone(seat, seat + 1, 1, (0, 0, 39)),
        )
    )


def test_a_step_too_narrow_for_a_screw_head_is_a_seat_as_deep_as_from_the_face() -> None:
    found = housing(31, 25)
    (seat,) = found.of("counterbore")
    assert "seat" in seat.tags
    assert seat.label == "seat of hole 1, diameter 62 mm, depth 26 mm"
    assert (seat.diameter, seat.depth) == pytest.approx((62 * MM, 26 * MM))
    assert "stepped" in found.hole.tags
    assert "counterbored" not in found.hole.tags
    assert seat.id in found.hole.children


def test_a_wider_step_is_a_counterbore() -> None:
    found = housing(35, 25)
    (sunk,) = found.of("counterbore")
    assert "seat" not in sunk.tags
    assert "counterbored" in found.hole.tags


def test_a_shallow_step_is_a_seat_and_no_spotface_where_it_is_narrow() -> None:
    for radius, kind in ((29.0, "counterbore"), (36.0, "spotface")):
        found = find(cut(cylinder(50, 40), cylinder(25, 60, (0, 0, -10)), cylinder(radius, 10, (0, 0, 31))))
        assert [part.kind for part in (*found.of("counterbore"), *found.of("spotface"))] == [kind]


def drafted(end: float) -> TopoDS_Shape:
    """A cup with walls that narrow from 24 to `end`, 12 deep, and a hole of 6 mm through its floor."""
    return cut(cylinder(15, 14), cone(end, 12, 12, (0, 0, 2)), cylinder(3, 20, (0, 0, -3)))


def test_a_drafted_step_above_a_floor_is_a_counterbore_with_its_widths() -> None:
    found = find(drafted(11.5))
    (sunk,) = found.of("counterbore")
    assert (sunk.diameter, sunk.depth) == pytest.approx((24 * MM, 12 * MM))
    assert (sunk.mouth_width, sunk.bottom_width) == pytest.approx((24 * MM, 23 * MM))
    assert sunk.bottom_thickness == pytest.approx(2 * MM)
    assert {"tapered", "stepped", "counterbored"} <= set(found.hole.tags)


def test_a_taper_that_runs_into_its_bore_is_no_counterbore() -> None:
    found = find(cut(cylinder(15, 34), cone(6, 8, 22, (0, 0, 12)), cylinder(6, 40, (0, 0, -3))))
    assert found.of("counterbore") == []
    assert "counterbored" not in found.hole.tags


@pytest.mark.parametrize(
    ("radius", "depth", "kind"), [(26, 12, "counterbore"), (26, 4, "spotface"), (44, 12, "spotface")]
)
def test_a_spot_face_is_shallower_than_it_is_wide_around_the_bore(radius: float, depth: float, kind: str) -> None:
    shape = cut(cylinder(60, 57), cylinder(20, 57), cylinder(radius, depth, (0, 0, 57 - depth)))
    assert [part.kind for part in find(shape).parts if part.kind in ("counterbore", "spotface")] == [kind]


def test_a_bore_that_tapers_into_a_narrower_one_has_no_counterbore_and_one_with_a_floor_has() -> None:
    block, wide, narrow = cylinder(30, 71), cylinder(13, 30, (0, 0, 41)), cylinder(7, 71)
    tapering = find(cut(block, wide, narrow, cone(7, 13, 15, (0, 0, 26))))
    assert "counterbored" not in tapering.hole.tags
    for floor in (1e-3, 6 / 1.6643):  # flat, or as a drill of 118 degrees leaves it
        assert "counterbored" in find(cut(block, wide, narrow, cone(7, 13, floor, (0, 0, 41 - floor)))).hole.tags
