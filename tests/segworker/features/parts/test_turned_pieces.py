"""Heads, shanks, necks, eyes, bars across, ring sectors and bends of sheet: what the pieces of a part are called."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    Found,
    box,
    cut,
    cylinder,
    filleted,
    find,
    fuse,
    plate,
    prism,
    rims,
    scaled,
    torus,
    turned,
    upright,
)

from querycad_contracts import Part

MM = 1e-3
X, Y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)


def tagged(found: Found, tag: str) -> list[Part]:
    return [part for part in found.parts if tag in part.tags]


def pin(head: float, neck: float | None = None, gap: float = 2.0) -> TopoDS_Shape:
    """A shank of 10 mm and 60 mm length below a head 8 mm high, with a neck of `gap` between both."""
    if neck is None:
        return fuse(cylinder(5, 60), cylinder(head / 2, 8, (0, 0, 60)))
    return fuse(cylinder(5, 60), cylinder(neck / 2, gap, (0, 0, 60)), cylinder(head / 2, 8, (0, 0, 60 + gap)))


@pytest.mark.parametrize("head", [13.0, 20.0, 38.0])
@pytest.mark.parametrize("neck", [None, 8.0])
def test_a_pin_has_a_head_and_a_shank(head: float, neck: float | None) -> None:
    found = find(scaled(turned(pin(head, neck), (1, 2, 3), 40), 100))
    (top,), (shank,) = tagged(found, "head"), tagged(found, "shank")
    assert (top.diameter, shank.diameter) == pytest.approx((head / 10, 1.0))
    assert len(tagged(found, "headed")) == 1


def test_a_neck_of_a_tenth_of_a_millimetre_parts_no_head_from_its_shank() -> None:
    found = find(pin(16.0, 9.8, 0.1))
    assert [part.diameter for part in tagged(found, "head")] == pytest.approx([16 * MM])
    assert tagged(found, "neck")


def test_a_head_over_a_fillet_sits_on_its_shank_which_is_as_long_as_drawn() -> None:
    shape = cut(pin(40.0), cylinder(1.5, 70))
    found = find(filleted(shape, 3.0, *rims(shape, 5, 60)))
    assert [part.diameter for part in tagged(found, "head")] == pytest.approx([40 * MM])
    (shank,) = tagged(found, "shank")
    assert shank.height == pytest.approx(60 * MM)
    (fillet,) = found.of("fillet")
    assert fillet.radius == pytest.approx(3 * MM)


def test_a_shaft_with_a_collar_a_tube_with_a_flange_and_a_huge_disc_have_no_head() -> None:
    collar = fuse(cylinder(5, 60), cylinder(10, 8, (0, 0, 26)))
    tube = cut(fuse(cylinder(5, 60), cylinder(10, 8, (0, 0, 60))), cylinder(4, 70))
    for shape in (collar, tube, pin(50.0)):
        assert not tagged(find(shape), "head")


def test_an_eye_bolt_has_an_eye_with_both_diameters_and_a_shank() -> None:
    found = find(fuse(torus(12.5, 2.5), cylinder(2.5, 50, (0, -11, 0), (0, -1, 0))))
    (eye,) = tagged(found, "eye")
    assert (eye.inner_diameter, eye.outer_diameter) == pytest.approx((20 * MM, 30 * MM))
    assert len(tagged(found, "shank")) == 1
    assert not tagged(find(fuse(torus(12.5, 2.5), cylinder(2.5, 50, (12.5, 0, 0)))), "eye")


def test_an_eye_may_be_a_drilled_disc() -> None:
    disc = cut(cylinder(15, 8), cylinder(8, 8))
    found = find(cut(fuse(disc, cylinder(3, 60, (0, 0, 4), X)), cylinder(8, 8)))
    assert [eye.inner_diameter for eye in tagged(found, "eye")] == pytest.approx([16 * MM])


def test_a_bar_across_is_one_part_from_tip_to_tip() -> None:
    (bar,) = find(fuse(cylinder(7.5, 60), cylinder(2.5, 60, (-30, 0, 45), X))).of("crossbar")
    assert (bar.length, bar.diameter) == pytest.approx((60 * MM, 5 * MM))
    stubs = fuse(plate(30, 30, 20), cylinder(2.5, 20, (-30, 0, -10), X), cylinder(2.5, 20, (10, 0, -10), X))
    assert not find(stubs).of("crossbar")


def test_half_a_ring_has_both_diameters_and_its_cross_section() -> None:
    ring = cut(cylinder(65, 30), cylinder(35, 30), box((140, 70, 30), (-70, -70, 0)))
    (arc,) = find(turned(ring, (1, 1, 0), 25)).of("ring_sector")
    assert (arc.outer_diameter, arc.inner_diameter) == pytest.approx((130 * MM, 70 * MM))
    assert (arc.thickness, arc.height) == pytest.approx((30 * MM, 30 * MM))
    assert arc.angle == pytest.approx(math.pi)
    crescent = cut(cylinder(65, 30), cylinder(50, 30, (0, -20, 0)), box((140, 70, 30), (-70, -70, 0)))
    assert not find(crescent).of("ring_sector")


def angle() -> TopoDS_Shape:
    """Two legs of sheet of 3 mm with an inner bend radius of 2 mm."""
    legs = fuse(box((40, 30, 3), (5, 0, 0)), box((3, 30, 40), (0, 0, 5)))
    bent = cut(cylinder(5, 30, (5, 0, 5), Y), cylinder(2, 30, (5, 0, 5), Y))
    return fuse(legs, cut(bent, box((20, 30, 20), (5, 0, 0)), box((20, 30, 20), (0, 0, 5))))


def test_a_bend_of_sheet_has_both_radii_its_angle_and_its_thickness() -> None:
    found = find(angle())
    (bend,) = found.of("bend")
    assert (bend.bend_radius, bend.thickness, bend.length) == pytest.approx((2 * MM, 3 * MM, 30 * MM))
    assert bend.radii == pytest.approx((5 * MM, 2 * MM))
    assert bend.bend_angle == pytest.approx(math.pi / 2)
    assert sorted(wall.thickness or 0.0 for wall in found.of("wall")) == pytest.approx([3 * MM, 3 * MM])


def test_the_rounded_corner_of_a_box_is_no_bend() -> None:
    outer, inner = box((60, 40, 30)), box((54, 34, 30), (3, 3, 3))
    shell = cut(filleted(outer, 8, *upright(outer)), filleted(inner, 5, *upright(inner)))
    assert not find(shell).of("bend")


def test_the_outer_two_of_four_steps_are_its_ends_and_the_others_lie_between() -> None:
    steps = ((0, 10, 20), (20, 14, 30), (50, 18, 12), (62, 9, 25))
    shaft = fuse(*(cylinder(d / 2, height, (0, 0, at)) for at, d, height in steps))
    found = find(turned(shaft, (1, 2, 3), 40))
    ends, middles = tagged(found, "end_step"), tagged(found, "middle_step")
    assert sorted(part.diameter or 0 for part in ends) == pytest.approx([9 * MM, 10 * MM])
    assert sorted(part.diameter or 0 for part in middles) == pytest.approx([14 * MM, 18 * MM])


def test_two_steps_are_both_ends_and_a_plain_pin_or_pins_beside_each_other_have_none() -> None:
    two = find(fuse(cylinder(5, 30), cylinder(8, 20, (0, 0, 30))))
    assert len(tagged(two, "end_step")) == 2
    assert not tagged(two, "middle_step")
    pins = fuse(plate(60, 40, 10), *(cylinder(4, 15, (x, 8, 0)) for x in (-20, 0, 20)))
    for none in (cylinder(5, 30), pins):
        assert not tagged(find(none), "end_step")
        assert not tagged(find(none), "middle_step")


def sharp_angle() -> TopoDS_Shape:
    """Two legs of sheet of 3 mm that meet in a sharp corner inside, round about that outside."""
    legs = fuse(box((42, 30, 3), (3, 0, 0)), box((3, 30, 42), (0, 0, 3)))
    return fuse(legs, cut(cylinder(3, 30, (3, 0, 3), Y), box((3, 30, 6), (3, 0, 0)), box((6, 30, 3), (0, 0, 3))))


def test_a_bend_may_be_sharp_inside_where_its_outside_is_round_about_that_edge() -> None:
    (bend,) = find(turned(sharp_angle(), (1, 2, 3), 25)).of("bend")
    assert (bend.bend_radius, bend.radius, bend.thickness) == pytest.approx((0.0, 3 * MM, 3 * MM))
    assert (bend.length, bend.bend_angle) == pytest.approx((30 * MM, math.pi / 2))


@pytest.mark.parametrize("outer", [1.5, 6.0])
def test_a_rounded_edge_behind_a_sharp_corner_is_no_bend(outer: float) -> None:
    legs = prism([(0, 0, 0), (45, 0, 0), (45, 0, 3), (3, 0, 3), (3, 0, 45), (0, 0, 45)], (0, 30, 0))
    tool = cut(box((outer, 30, outer)), cylinder(outer, 30, (outer, 0, outer), Y))
    assert not find(cut(legs, tool)).of("bend")
