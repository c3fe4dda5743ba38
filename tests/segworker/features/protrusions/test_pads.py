"""Pads and ridges that reach the border of what they stand on, and what only looks like a protrusion."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    box,
    cut,
    cylinder,
    extruded,
    filleted,
    find,
    fuse,
    gear,
    plate,
    prism,
    rims,
    turned,
)

MM = 1e-3
BAR = box((140, 30, 32), (0, 0, 0))


def pads(shape: TopoDS_Shape) -> list[tuple[float, float, float]]:
    """Length, width and height of each protrusion, millimetres."""
    sizes = [part.local_size for part in find(shape).of("protrusion")]
    return [(round(a / MM, 6), round(b / MM, 6), round(c / MM, 6)) for a, b, c in filter(None, sizes)]


@pytest.mark.parametrize("degrees", [0, 37])
@pytest.mark.parametrize(
    ("size", "at"),
    [
        ((44, 25, 3), (0, 2.5, -3)),
        ((44, 25, 3), (0, 0, -3)),
        ((44, 30, 3), (48, 0, -3)),
    ],
    ids=["flush at an end", "in a corner", "right across"],
)
def test_a_pad_that_is_flush_with_a_side_has_its_measures(
    size: tuple[float, float, float], at: tuple[float, float, float], degrees: float
) -> None:
    assert pads(turned(fuse(BAR, box(size, at)), (1, 2, 3), degrees)) == [size]


def test_a_pad_knows_what_it_stands_out_from() -> None:
    (pad,) = find(fuse(BAR, box((44, 25, 3), (0, 0, -3)))).of("protrusion")
    assert pad.normal == pytest.approx((0, 0, -1))
    assert pad.center == pytest.approx((22 * MM, 12.5 * MM, -1.5 * MM))
    assert pad.tip == pytest.approx((22 * MM, 12.5 * MM, -3 * MM))


def test_two_lugs_on_a_block_are_two_pads() -> None:
    lugs = [box((10, 30, 20), (x, 0, 32)) for x in (40, 90)]
    assert pads(fuse(BAR, *lugs)) == [(30.0, 10.0, 20.0)] * 2


def test_a_block_with_steps_cut_at_both_ends_has_no_pad() -> None:
    steps = [box((20, 30, 10), (x, 0, 22)) for x in (0, 120)]
    assert pads(cut(BAR, *steps)) == []


def test_an_upright_flange_of_an_angle_is_no_pad() -> None:
    assert pads(fuse(box((60, 40, 4)), box((60, 4, 40)))) == []


def test_the_volume_of_a_protrusion_is_that_of_its_material() -> None:
    wedge = prism([(10, 5, 0), (30, 5, 0), (10, 5, 12)], (0, 20, 0))
    (found,) = find(fuse(plate(100, 60, 10), wedge)).of("protrusion")
    assert found.volume == pytest.approx(0.5 * 20 * 12 * 20 * MM**3)


def test_steps_and_grooves_of_a_turned_part_are_no_protrusions() -> None:
    steps = fuse(cylinder(20, 10), cylinder(12, 40))
    neck = cut(cylinder(12, 4, (0, 0, 30)), cylinder(9, 4, (0, 0, 30)))
    assert pads(cut(filleted(steps, 2, *rims(steps, 12, 10)), neck)) == []


@pytest.mark.parametrize("inner", [False, True])
def test_an_undercut_at_a_shoulder_of_any_outline_is_a_groove(inner: bool) -> None:
    hexagon = [(15.6, 0), (7.8, 13.5), (-7.8, 13.5), (-15.6, 0), (-7.8, -13.5), (7.8, -13.5)]
    if inner:
        shape = cut(plate(60, 60, 40), cylinder(10, 30, (0, 0, -30)), cylinder(11, 3, (0, 0, -30)))
    else:
        shape = fuse(extruded(hexagon, 0, 10), cylinder(9, 3, (0, 0, 10)), cylinder(10.5, 15, (0, 0, 13)))
    (groove,) = find(shape).of("groove")
    assert groove.width == pytest.approx(3 * MM)
    assert groove.depth == pytest.approx((1.0 if inner else 1.5) * MM)


def test_a_knob_on_a_thin_neck_has_no_groove() -> None:
    knob = fuse(plate(60, 60, 8), cylinder(5, 8), cylinder(10, 6, (0, 0, 8)))
    assert find(knob).of("groove") == []


def test_a_gear_with_a_bore_has_its_diameters_and_face_width() -> None:
    (body,) = find(cut(gear(18, 20, 16, 8), cylinder(5, 8))).of("body")
    assert body.diameter == pytest.approx(40 * MM)
    assert body.radii == pytest.approx((20 * MM, 16 * MM, 5 * MM), rel=0.01)
    assert body.thickness == pytest.approx(8 * MM)


def test_a_semicircle_is_as_deep_as_it_is_cut_in() -> None:
    (arc,) = find(cut(plate(60, 40, 10), cylinder(8, 10, (0, 20, -10)))).of("arc")
    assert arc.depth == pytest.approx(8 * MM)
    assert arc.length == pytest.approx(10 * MM)


def ledges(shape: TopoDS_Shape) -> list[tuple[float, ...]]:
    """Length, width and height of each ledge, millimetres."""
    sizes = [part.local_size for part in find(shape).of("elevation") if "ledge" in part.tags]
    return [tuple(round(size / MM, 3) for size in each) for each in sizes if each is not None]


def profile(*points: tuple[float, float], length: float = 60) -> TopoDS_Shape:
    """A profile in x and z, drawn along y."""
    return prism([(x, 0, z) for x, z in points], (0, length, 0))


def test_the_lip_of_an_angle_is_a_ledge_and_what_it_hangs_on_is_none() -> None:
    angle = profile((0, 0), (20, 0), (20, 12), (28, 12), (28, 26), (0, 26), length=100)
    assert ledges(angle) == [(100, 14, 8)]


@pytest.mark.parametrize("thick", [3.0, 15.0])
def test_the_outline_of_thin_legs_is_no_ledge_and_that_of_thick_ones_is(thick: float) -> None:
    """A channel whose legs are lower along half of its length."""
    inner = box((100, 50 - 2 * thick, 40), (0, thick, thick))
    channel = cut(box((100, 50, 40)), inner, box((60, 50, 20), (40, 0, 25)))
    assert bool(ledges(channel)) == (thick > 3)


def test_the_outline_of_a_gusset_is_no_ledge() -> None:
    angle = fuse(box((60, 60, 8)), box((60, 8, 60)))
    outline = [(8, 8), (48, 8), (48, 20), (30, 20), (30, 48), (8, 48)]
    found = find(fuse(angle, prism([(20, y, z) for y, z in outline], (5, 0, 0))))
    assert found.of("rib")
    assert not found.of("elevation")


def test_what_stands_on_a_thin_leg_beside_its_rim_is_a_ledge() -> None:
    angle = profile((0, 0), (60, 0), (60, 4), (4, 4), (4, 40), (0, 40), length=50)
    assert ledges(fuse(angle, box((12, 50, 6), (48, 0, 4)))) == [(50, 12, 6)]


def test_a_drafted_tongue_is_a_pad_with_its_draft() -> None:
    lean = 15 * math.tan(math.radians(5))
    outline = (0, 0), (40, 0), (40, 20), (28, 20), (28 - lean, 35), (12 + lean, 35), (12, 20), (0, 20)
    (tongue,) = find(profile(*outline)).of("protrusion")
    assert tongue.height == pytest.approx(15 * MM)
    assert tongue.draft == pytest.approx(math.radians(5))


def test_a_rail_whose_flanks_lean_over_the_face_is_a_dovetail() -> None:
    out = 10 / math.tan(math.radians(60))
    outline = (0, 0), (80, 0), (80, 20), (55, 20), (55 + out, 30), (25 - out, 30), (25, 20), (0, 20)
    (rail,) = find(profile(*outline)).of("protrusion")
    assert "dovetail" in rail.tags
    assert rail.angle == pytest.approx(math.radians(60))


def test_the_teeth_of_a_gear_are_no_ledges() -> None:
    assert ledges(fuse(gear(18, 20, 16, 8), cylinder(25, 4, (0, 0, -4)))) == []


def test_the_shaft_beyond_a_keyway_is_no_ledge() -> None:
    key = fuse(box((4, 8, 22), (11, -4, 9)), *(cylinder(4, 4, (11, 0, z), (1, 0, 0)) for z in (9, 31)))
    shaft = cut(fuse(cylinder(15, 40), cylinder(10, 80, (0, 0, -20))), key)
    assert not find(shaft).of("elevation")


def test_what_lies_beyond_the_slope_of_a_gusset_is_no_ledge() -> None:
    angle = fuse(box((60, 60, 8)), box((60, 8, 60)))
    gusset = prism([(26, 8, 8), (26, 48, 8), (26, 8, 48)], (8.0, 0.0, 0.0))
    assert find(fuse(angle, gusset)).of("elevation") == []
    drafted = prism([(0, 20, 8), (0, 40, 8), (0, 39, 20), (0, 21, 20)], (60.0, 0.0, 0.0))
    (ridge,) = find(fuse(box((60, 60, 8)), drafted)).of("protrusion")
    assert ridge.height == pytest.approx(12 * MM)


def test_what_a_slot_narrower_than_itself_leaves_is_no_ledge_and_what_a_wider_channel_leaves_is_one() -> None:
    block = box((60, 80, 50))
    vee = prism([(20, 0, 50), (40, 0, 50), (30, 0, 40)], (0, 80, 0))
    relieved = cut(block, vee, box((4, 80, 20), (28, 0, 25)))
    across = cut(block, box((60, 10, 8), (0, 35, 42)))
    tee = cut(block, box((10, 80, 20), (25, 0, 30)), box((20, 80, 8), (20, 0, 30)))
    for shape in (relieved, across, tee):
        assert ledges(shape) == []
    assert ledges(cut(box((60, 80, 30)), box((36, 80, 10), (12, 0, 20)))) == [(80, 12, 10)] * 2


def test_the_lower_wall_of_a_window_is_no_top_of_a_pad() -> None:
    window = box((10, 40, 6), (15, -5, 36))
    wedge = prism([(0, 0, 32), (44, 0, 32), (44, 0, 50), (0, 0, 60)], (0, 25, 0))
    assert pads(cut(fuse(BAR, wedge), window)) == []
    assert pads(cut(fuse(BAR, box((44, 25, 28), (0, 0, 32))), window)) == [(44, 25, 28)]


def test_the_room_of_a_pocket_with_deeper_pockets_in_its_floor_is_no_ledge() -> None:
    shallow = cut(plate(60, 100, 25), box((50, 90, 2), (-25, -45, -2)))
    found = find(cut(shallow, box((30, 30, 12), (-15, -40, -14)), box((44, 20, 2), (-22, 10, -4))))
    assert (len(found.of("pocket")), found.of("elevation")) == (3, [])


def test_a_plate_beyond_what_stands_across_it_is_no_ledge_and_the_tines_of_one_are() -> None:
    shape = fuse(box((100, 80, 25)), box((10, 80, 30), (70, 0, 25)))
    assert not find(shape).of("elevation")
    thick = fuse(box((100, 80, 45)), box((10, 80, 30), (70, 0, 45)))  # no thin wall, whose outline tines would be
    tines = find(cut(thick, box((10, 30, 60), (90, 25, -5)))).of("elevation")
    assert [tine.local_size for tine in tines] == [pytest.approx((0.045, 0.025, 0.01))] * 2
