"""Pockets, cutouts, slots, channels, notches and steps: what was cut in is found, with the measures it was cut with."""

from __future__ import annotations

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS_Edge
from tests.segworker.shapes import (
    box,
    chamfered,
    compound,
    cut,
    cylinder,
    edges,
    filleted,
    find,
    fuse,
    nurbs,
    plate,
    prism,
    turned,
)

from querycad_contracts import Part, Side

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-7)


def only(found: list[Part]) -> Part:
    (part,) = found
    return part


def test_a_rectangular_pocket_has_its_own_size_and_opens_upwards() -> None:
    pocket = only(find(cut(plate(), box((20, 12, 5), (-10, -6, -5)))).of("pocket"))
    assert "rectangular" in pocket.tags
    assert [pocket.length, pocket.width, pocket.depth] == near(20, 12, 5)
    assert list(pocket.local_size or ()) == near(20, 12, 5)
    assert list(pocket.opening or ()) == near(0, 0, 0)
    assert pocket.bottom == "flat"
    assert len(pocket.faces) == 5


def test_a_rectangular_cutout_goes_through() -> None:
    found = find(cut(plate(), box((20, 12, 40), (-10, -6, -30))))
    cutout = only(found.of("cutout"))
    assert cutout.bottom == "through"
    assert cutout.depth == pytest.approx(20 * MM)
    assert not found.of("pocket")


def test_an_obround_cutout_is_a_slot_by_its_outline() -> None:
    tool = fuse(box((20, 6, 40), (-10, -3, -30)), cylinder(3, 40, (-10, 0, -30)), cylinder(3, 40, (10, 0, -30)))
    cutout = only(find(cut(plate(), tool)).of("cutout"))
    assert "obround" in cutout.tags
    assert [cutout.length, cutout.width] == near(26, 6)


def test_a_milled_slot_runs_from_side_to_side() -> None:
    slot = only(find(cut(plate(), box((100, 8, 6), (-50, -4, -6)))).of("slot"))
    assert [slot.length, slot.width, slot.depth] == near(60, 8, 6)


def test_a_slot_that_a_hole_interrupts_is_one_slot() -> None:
    shape = cut(plate(), box((100, 4, 6), (-50, -2, -6)), cylinder(6, 60, (0, 0, -40)))
    assert len(find(shape).of("slot")) == 1


def test_two_slots_side_by_side_are_two() -> None:
    shape = cut(plate(), box((100, 4, 6), (-50, -12, -6)), box((100, 4, 6), (-50, 8, -6)))
    assert len(find(shape).of("slot")) == 2


def test_the_inside_of_a_u_section_is_a_channel_and_no_slot() -> None:
    found = find(cut(plate(), box((100, 30, 15), (-50, -15, -15))))
    assert len(found.of("channel")) == 1
    assert not found.of("slot")


def test_a_step_along_an_edge_is_a_step() -> None:
    step = only(find(cut(plate(), box((100, 10, 5), (-50, 10, -5)))).of("step"))
    assert step.depth == pytest.approx(5 * MM)


def test_equal_corner_steps_have_one_depth_on_either_side_and_a_level_floor_stays_the_floor() -> None:
    corners = [box((30, 15, 5), (x, y, -4)) for x in (-50, 20) for y in (-35, 20)]
    found = find(cut(box((100, 70, 3), (-50, -35, -3)), *corners)).of("step")
    assert [step.depth for step in found] == near(15, 15, 15, 15)
    shoulders = [box((4, 100, 8), (x, -50, z)) for x in (-30, 26) for z in (-20, -8)]
    found = find(cut(plate(), *shoulders)).of("step")
    assert [step.depth for step in found] == near(8, 8, 8, 8)


def test_a_groove_that_runs_out_into_a_step_as_deep_is_as_long_as_its_walls() -> None:
    groove = only(find(cut(plate(), box((60, 15, 3), (-30, 5, -3)), box((2, 40, 3), (-1, -20, -3)))).of("slot"))
    assert [groove.length, groove.width, groove.depth] == near(25, 2, 3)
    neck = only(find(cut(plate(), box((60, 6, 3), (-30, -3, -3)), box((60, 16, 4), (-30, -8, -7)))).of("slot"))
    assert ("t_slot" in neck.tags, [neck.length, neck.width, neck.depth]) == (True, near(60, 6, 7))


def test_chamfers_that_meet_in_an_inner_corner_are_no_v_slot_and_a_v_beside_them_is_one() -> None:
    corner = cut(plate(), box((40, 30, 40), (0, 0, -30)))
    curves = {edge: BRepAdaptor_Curve(edge) for edge in edges(corner)}
    top = [e for e, c in curves.items() if abs(c.Value((c.FirstParameter() + c.LastParameter()) / 2).Z()) < 1e-6]
    shape = chamfered(corner, 0.7, *top)
    assert not find(shape).of("slot")
    vee = prism([(-20, -30, 1), (-12, -30, 1), (-16, -30, -3)], (0, 60, 0))
    assert only(find(cut(shape, vee)).of("slot")).depth == pytest.approx(3 * MM)


def test_a_protrusion_is_no_step_in_the_plate_around_it() -> None:
    found = find(fuse(plate(), box((20, 12, 5), (-10, -6, 0))))
    assert not found.of("step")
    protrusion = only(found.of("protrusion"))
    assert "rectangular" in protrusion.tags
    assert protrusion.height == pytest.approx(5 * MM)
    assert list(protrusion.tip or ()) == near(0, 0, 5)


def test_a_pocket_with_holes_in_its_floor_stays_a_pocket() -> None:
    shape = cut(plate(), box((30, 20, 5), (-15, -10, -5)), cylinder(2, 60, (5, 0, -40)), cylinder(2, 60, (-5, 0, -40)))
    found = find(shape)
    assert len(found.of("pocket")) == 1
    assert len(found.of("hole")) == 2


@pytest.mark.parametrize("degrees", [0.0, 33.0, 90.0])
def test_depressions_do_not_change_with_the_frame_or_the_kind_of_surface(degrees: float) -> None:
    shape = cut(plate(), box((20, 12, 5), (-25, -6, -5)), box((8, 100, 6), (15, -50, -6)))
    found = find(nurbs(turned(shape, (1, 1, 0.5), degrees)))
    assert only(found.of("pocket")).local_size == near(20, 12, 5)
    assert only(found.of("slot")).local_size == near(40, 8, 6)


def test_a_hexagonal_block_is_a_prism_and_a_cuboid_one_prism_along_its_shortest_way() -> None:
    block = only(find(box((30, 20, 4))).of("prism"))
    assert {"rectangular", "plate"} <= set(block.tags)
    assert block.height == pytest.approx(4 * MM)


def test_fins_are_counted_by_their_number_and_not_by_their_faces() -> None:
    fins = [box((40, 2, 15), (-20, y, -0.001)) for y in (-15, -7, 1, 9)]
    found = find(fuse(plate(), *fins))
    assert len([rib for rib in found.of("rib") if "fin" in rib.tags]) == 4
    assert {round((rib.thickness or 0) / MM, 6) for rib in found.of("rib")} == {2.0}


def test_the_outermost_fins_of_a_row_may_be_flush_with_the_base() -> None:
    fins = [box((60, 2, 15), (-30, y, -0.001)) for y in (-20, -10, -1, 8, 18)]
    ribs = [rib for rib in find(fuse(plate(), *fins)).of("rib") if "fin" in rib.tags]
    assert len(ribs) == 5
    assert {round((rib.height or 0) / MM, 2) for rib in ribs} == {15.0}
    assert {round((rib.length or 0) / MM, 6) for rib in ribs} == {60.0}


def test_the_wall_of_an_angle_is_no_rib() -> None:
    assert find(fuse(plate(), box((60, 2, 15), (-30, -20, -0.001)))).of("rib") == []


def test_bars_between_the_openings_of_a_grid_are_no_ribs() -> None:
    openings = [box((30, 5, 30), (-15, y, -25)) for y in (-14, -5, 4)]
    assert find(cut(plate(), *openings)).of("rib") == []


def test_what_stands_on_both_faces_of_a_plate_does_not_make_it_a_rib() -> None:
    """The disc below and the pins above meet the plate in concave edges, but not along its edge."""
    pins = [box((3, 3, 21), (x, y, -0.001)) for x in range(-25, 25, 8) for y in range(-16, 16, 8)]
    notched = cut(box((60, 40, 5), (-30, -20, -5)), box((6, 14, 10), (-30, -7, -7)))
    cooler = find(fuse(notched, cylinder(15, 3, (0, 0, -7.999)), *pins))
    assert cooler.of("rib") == []
    (base,) = (part for part in cooler.of("prism") if "plate" in part.tags)
    assert base.height == pytest.approx(5 * MM)


def test_square_legs_between_two_plates_are_no_ribs() -> None:
    legs = [box((6, 6, 40), (x, y, -0.001)) for x in (-25, 19) for y in (-16, 10)]
    assert find(fuse(plate(), box((60, 40, 5), (-30, -20, 39.999)), *legs)).of("rib") == []


def test_the_gap_between_two_lugs_on_a_tube_is_a_slot_that_opens_away_from_it() -> None:
    lugs = [box((4, 16, 14), (x, 0, 10)) for x in (-6, 2)]
    tube = cut(fuse(cylinder(8, 40), *lugs), cylinder(6, 60, (0, 0, -10)))
    slot = only([part for part in find(tube).seen_parts if part.kind == "slot"])
    assert slot.width == pytest.approx(4 * MM)
    assert slot.length == pytest.approx(14 * MM)
    assert slot.sides == (Side.BACK,)


@pytest.mark.parametrize("second", [20, 2], ids=["far apart", "joined by a web"])
def test_lugs_far_apart_or_joined_leave_no_slot(second: float) -> None:
    lugs = [box((4, 16, 14), (x, 0, 10)) for x in (-6, second)]
    web = [box((6, 16, 14), (-3, 0, 10))] if second < 10 else []
    assert find(fuse(cylinder(30, 40, (0, -30, 0)), *lugs, *web)).of("slot") == []


def test_two_bodies_that_touch_keep_their_own_features() -> None:
    shape = compound(
        cut(plate(), cylinder(3, 60, (10, 0, -40))), cut(box((20, 20, 5), (-25, -10, 0)), box((8, 8, 9), (-20, -4, -1)))
    )
    found = find(shape)
    assert len(found.of("hole")) == 1
    assert len(found.of("cutout")) == 1
    assert len(found.of("body")) == 2


def test_the_gap_between_two_short_lugs_is_a_slot_though_they_are_no_ribs() -> None:
    lugs = [box((12, 6, 14), (-6, y, 0)) for y in (-10, 4)]
    found = find(fuse(plate(), *lugs))
    assert found.of("rib") == []
    (slot,) = [part for part in found.of("slot") if "fork" in part.tags]
    assert slot.width == pytest.approx(8e-3)


@pytest.mark.parametrize("axis", [(0, 0, 1), (1, 0, 0), (1, 2, 3)])
@pytest.mark.parametrize("degrees", [0, 90, 33])
@pytest.mark.parametrize("depth", [8, 20])
def test_the_local_size_of_what_is_cut_in_has_the_longer_side_first(
    axis: tuple[float, float, float], degrees: float, depth: float
) -> None:
    found = find(turned(cut(plate(), box((10, 24, depth), (-5, -12, -depth))), axis, degrees))
    (part,) = found.of("pocket" if depth < 20 else "cutout")
    assert part.local_size == pytest.approx((24e-3, 10e-3, depth * 1e-3))


@pytest.mark.parametrize("degrees", [0, 90])
def test_two_flats_across_the_end_of_a_shaft_are_steps_of_one_depth(degrees: float) -> None:
    flats = [box((40, 40, 20), (-20, y, 40)) for y in (10, -50)]
    steps = find(turned(cut(cylinder(15, 60), *flats), (1, 0, 0), degrees)).of("step")
    assert [step.depth for step in steps] == near(5, 5)
    assert [step.width for step in steps] == near(20, 20)


def test_a_lowered_part_of_a_disc_is_as_deep_as_it_is_low() -> None:
    (step,) = find(cut(cylinder(30, 10), box((60, 80, 10), (10, -40, 8)))).of("step")
    assert [step.depth] == near(2)


@pytest.mark.parametrize("shelf", [0.0, 1.5])
def test_a_pocket_open_at_its_corners_reaches_to_where_its_walls_have_rounded_off(shelf: float) -> None:
    """With a `shelf`, one wall alone is rounded and runs on to that, higher than where the others end."""
    hollow = cut(box((80, 60, 20 + shelf), (-40, -30, 0)), box((56, 36, 18 + shelf), (-28, -18, 2)))
    rim = [
        edge
        for edge, (x, y, z) in ((edge, _middle(edge)) for edge in edges(hollow))
        if z > 20 + shelf - 1e-6 and ((x, y) == (28, 0) or (not shelf and (abs(x), abs(y)) in ((28, 0), (0, 18))))
    ]
    lower = box((66, 60, 5), (-40, -30, 20))
    corners = (box((14, 14, 14), (x, y, 16)) for x in (-40, 26) for y in (-30, 16))
    (pocket,) = find(cut(filleted(hollow, 2, *rim), lower, *corners)).of("pocket")
    assert pocket.depth == pytest.approx(18 * MM)


def _middle(edge: TopoDS_Edge) -> tuple[float, float, float]:
    curve = BRepAdaptor_Curve(edge)
    point = curve.Value((curve.FirstParameter() + curve.LastParameter()) / 2)
    return round(point.X(), 6), round(point.Y(), 6), point.Z()
