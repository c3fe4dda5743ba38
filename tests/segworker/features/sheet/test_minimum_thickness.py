"""The least material between two faces that look away from each other, and what is no wall."""

from __future__ import annotations

import build123d as bd
import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import ball, box, compound, cut, cylinder, find, plate, scaled, turned

MM = 1e-3


def thinnest(shape: TopoDS_Shape) -> float | None:
    found = find(shape).shape.minimum_thickness
    return None if found is None else found / MM


@pytest.mark.parametrize("factor", [1.0, 100.0])
def test_between_a_bottom_and_the_face_below_it_however_it_lies(factor: float) -> None:
    shape = cut(plate(60, 40, 20), box((30, 20, 17), (-15, -10, -17)))
    for placed in (shape, turned(shape, (0.3, 0.5, 0.8), 40)):
        assert thinnest(scaled(placed, factor)) == pytest.approx(3 * factor, rel=1e-4)


def test_a_block_is_as_thick_as_it_is_low_and_a_tube_as_its_wall() -> None:
    assert thinnest(plate(60, 40, 20)) == pytest.approx(20)
    assert thinnest(cut(cylinder(20, 60), cylinder(17.5, 60))) == pytest.approx(2.5)


def test_beside_a_hole_to_a_side_to_another_hole_and_to_a_round_wall() -> None:
    assert thinnest(cut(plate(60, 40, 20), cylinder(4, 20, (24, 0, -20)))) == pytest.approx(2)
    pair = cut(plate(60, 40, 20), cylinder(4, 20, (0, 0, -20)), cylinder(5, 20, (10.5, 0, -20)))
    assert thinnest(pair) == pytest.approx(1.5)
    assert thinnest(cut(cylinder(30, 40), cylinder(9, 40, (18, 0, 0)))) == pytest.approx(3)


def test_a_wall_that_tapers_is_as_thin_as_at_its_rim() -> None:
    wedge = bd.extrude(bd.make_face(bd.Polyline((0, 0), (6, 0), (4.25, 40), (1.75, 40), close=True)), 50)
    assert thinnest(wedge.wrapped) == pytest.approx(2.5, rel=0.02)


def test_a_wedge_is_no_wall() -> None:
    knife = bd.extrude(bd.make_face(bd.Polyline((0, 0), (6, 0), (3, 40), close=True)), 50)
    assert thinnest(knife.wrapped) == pytest.approx(50)


def test_a_chamfer_and_a_fillet_end_in_no_wall() -> None:
    beveled = bd.chamfer(bd.Box(60, 40, 20).edges(), 2)
    assert thinnest(beveled.wrapped) == pytest.approx(20)
    rounded = bd.fillet(bd.Box(60, 40, 20).edges(), 2)
    assert thinnest(rounded.wrapped) == pytest.approx(20)


def test_holes_that_meet_leave_no_wall_between_them() -> None:
    shape = cut(plate(60, 40, 20), cylinder(4, 20, (-3, 0, -20)), cylinder(4, 20, (3, 0, -20)))
    assert thinnest(shape) == pytest.approx(16, rel=1e-3)


def test_of_freeform_walls_nothing_is_said() -> None:
    curve = bd.Spline((0, 0), (20, 8), (40, -6), (60, 0))
    spline = bd.make_face(curve + bd.Polyline((60, 0), (60, 30), (0, 30), (0, 0)))
    assert thinnest(bd.extrude(spline, 12).wrapped) is None


def test_each_body_has_its_own_and_the_whole_that_of_the_thinnest() -> None:
    found = find(compound(plate(60, 40, 20), box((10, 10, 5), (50, 50, 0))))
    assert sorted(body.minimum_thickness or 0.0 for body in found.of("body")) == pytest.approx([5 * MM, 20 * MM])
    assert found.shape.minimum_thickness == pytest.approx(5 * MM)
    with_ball = find(compound(plate(60, 40, 20), ball(5, (50, 50, 0))))
    assert [body.minimum_thickness for body in with_ball.of("body")] == [pytest.approx(20 * MM), None]
    assert with_ball.shape.minimum_thickness is None
