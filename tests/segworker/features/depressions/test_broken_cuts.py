"""What is cut in stays what it is when another cut takes a corner of it, and only then becomes another thing."""

from __future__ import annotations

import math

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS_Edge
from tests.segworker.shapes import box, cut, cylinder, edges, extruded, filleted, find, plate, prism

TRIANGLE = ((-10.0, -8.0), (10.0, -8.0), (0.0, 18.0))


RECTANGLE = ((-10.0, -8.0), (10.0, -8.0), (10.0, 18.0), (-10.0, 18.0))


@pytest.mark.parametrize(("depth", "mouth"), [(3.0, "closed"), (9.0, "open")])
def test_a_pocket_whose_corner_lies_in_a_step_is_a_pocket_and_open_where_the_step_is_deeper(
    depth: float, mouth: str
) -> None:
    step = box((70, 10, depth), (-35, 17, -depth))
    found = find(cut(plate(), extruded(TRIANGLE, -8, 9), step))
    assert len(found.of("step")) == 1
    (pocket,) = [part for part in found.parts if part.kind in ("pocket", "slot", "channel", "cutout")]
    assert pocket.kind == "pocket"
    assert {"triangular", mouth} <= set(pocket.tags)


def test_a_rectangle_that_a_deeper_step_opens_along_a_side_is_a_slot_and_at_a_corner_a_pocket() -> None:
    step = box((70, 10, 9), (-35, 17, -9))
    (slot,) = find(cut(plate(), extruded(RECTANGLE, -8, 9), step)).of("slot")
    assert "rectangular" in slot.tags
    corner = box((25, 10, 9), (5, 17, -9))
    (pocket,) = find(cut(plate(), extruded(RECTANGLE, -8, 9), corner)).of("pocket")
    assert {"rectangular", "open"} <= set(pocket.tags)


@pytest.mark.parametrize(("mouth", "kind"), [(8.0, "slot"), (3.0, "pocket")])
def test_leaning_walls_make_a_dovetail_where_its_mouth_is_wide_and_else_a_triangle_without_its_tip(
    mouth: float, kind: str
) -> None:
    section = ((-35.0, -8.0, -6.0), (-35.0, 8.0, -6.0), (-35.0, mouth / 2, 0.0), (-35.0, -mouth / 2, 0.0))
    found = find(cut(plate(), prism(section, (40, 0, 0))))
    (part,) = [part for part in found.parts if part.kind in ("pocket", "slot", "channel", "notch", "step")]
    assert part.kind == kind
    assert ("dovetail" in part.tags) == (kind == "slot")


@pytest.mark.parametrize(("reach", "kind"), [(-4.0, "slot"), (10.0, "step")])
def test_a_slot_of_a_disc_cutter_that_lost_part_of_a_wall_is_a_slot_and_one_without_the_wall_a_step(
    reach: float, kind: str
) -> None:
    disc = cylinder(8, 10, (-5, -5, 0), (0, 1, 0))
    beside = box((reach + 40, 20, 30), (-40, -22, -25))
    found = find(cut(plate(), box((30, 10, 8), (-35, -5, -8)), disc, beside))
    cuts = [part for part in found.parts if part.kind in ("slot", "step", "notch")]
    assert [part.kind for part in cuts if part.depth == pytest.approx(0.008)] == [kind]


def test_a_slot_whose_floor_another_cut_parts_is_no_cutout() -> None:
    across = box((10, 50, 6), (-5, -25, -11))
    found = find(cut(plate(), box((70, 10, 8), (-35, -5, -8)), across))
    assert not [part for part in found.of("cutout") if abs((part.axis or part.normal or (0, 0, 0))[0]) > 0.9]
    assert any(part.width == pytest.approx(0.010) and part.length == pytest.approx(0.060) for part in found.of("slot"))


def test_an_open_slot_whose_walls_are_parted_halfway_down_is_not_closed() -> None:
    slot = (box((20, 8, 30), (15, -4, -25)), cylinder(4, 30, (15, 0, -25)))
    found = find(cut(plate(), *slot, box((30, 6, 4), (5, -3, -12))))
    assert not [part for part in found.of("cutout") if "closed" in part.tags]


def test_walls_that_run_on_all_around_stay_a_cutout_though_a_bore_crosses_them() -> None:
    found = find(cut(plate(), box((20, 10, 30), (-10, -5, -25)), cylinder(3, 60, (0, -30, -10), (0, 1, 0))))
    assert "rectangular" in found.of("cutout")[0].tags
    assert not found.of("slot")


def test_a_corner_step_beside_a_steep_slope_is_no_v_groove() -> None:
    foot = 6 * math.tan(math.radians(50))
    slope = prism(((10, -6, 0), (10, 0, 0), (10, 0, -foot)), (25, 0, 0))
    found = find(cut(plate(), box((25, 25, 14), (10, 0, -14)), slope))
    assert len(found.of("step")) == 1
    assert not found.of("slot")


@pytest.mark.parametrize("half", [0.7, 4.0])
def test_a_v_groove_may_be_narrow_and_parted_by_a_cut_across(half: float) -> None:
    groove = prism(((-35, -half, 0), (-35, half, 0), (-35, 0, -12)), (70, 0, 0))
    across = box((6, 20, 6), (0, -10, -6))
    parts = find(cut(plate(), groove, across)).parts
    assert [part.kind for part in parts if "v_shaped" in part.tags] == ["slot"]
    assert not [part for part in parts if part.kind == "step"]


@pytest.mark.parametrize("tilt", [0.0, 15.0, 30.0])
def test_a_v_groove_may_lean(tilt: float) -> None:
    first, second = (4 * math.tan(math.radians(45 + sign * tilt)) for sign in (1, -1))
    groove = prism(((-35, -first, 0), (-35, second, 0), (-35, 0, -4)), (70, 0, 0))
    (slot,) = find(cut(plate(), groove)).of("slot")
    assert "v_shaped" in slot.tags


@pytest.mark.parametrize(("width", "seats"), [(8.0, 1), (20.0, 0)])
def test_a_trough_wider_than_the_disc_that_it_fits_is_no_woodruff_seat(width: float, seats: int) -> None:
    trough = cylinder(8, width, (38, -width / 2, 40), (0, 1, 0))
    found = find(cut(cylinder(40, 80), trough))
    assert len([part for part in found.parts if "woodruff" in part.tags]) == seats
    assert any(part.kind.cuts_in for part in found.parts)


@pytest.mark.parametrize(("degrees", "bottom", "kind"), [(30.0, 0.0, "slot"), (60.0, 0.0, "step"), (30.0, 2.0, "step")])
def test_narrow_sharp_flanks_are_a_v_groove_without_what_lay_beside_one_and_others_an_undercut_step(
    degrees: float, bottom: float, kind: str
) -> None:
    """The flank beside which a deep step was cut ends at an upright wall. `bottom`: the radius in the fold."""
    run = 12 / math.tan(math.radians(degrees))
    groove = prism(((-35, 20 - run, -12), (-35, 20 + run, 0), (-35, 22, -12)), (70, 0, 0))
    beside = prism(((-35, 20 - run, -12), (-35, 25, -12), (-35, 25, 5), (-35, 20, 0)), (70, 0, 0))
    shape = cut(plate(), groove, beside)
    fold = [edge for edge in edges(shape) if all(math.dist(p, (p[0], 20 - run, -12)) < 1e-6 for p in ends(edge))]
    assert len(fold) == 1
    parts = find(filleted(shape, bottom, *fold) if bottom else shape).parts
    (part,) = [part for part in parts if part.kind in ("slot", "step", "notch")]
    assert part.kind == kind


def ends(edge: TopoDS_Edge) -> list[tuple[float, float, float]]:
    curve = BRepAdaptor_Curve(edge)
    points = [curve.Value(at) for at in (curve.FirstParameter(), curve.LastParameter())]
    return [(point.X(), point.Y(), point.Z()) for point in points]


def test_a_pocket_that_a_slope_opens_beside_its_floor_opens_at_its_mouth() -> None:
    slot = (box((20, 8, 12), (-10, -4, -12)), cylinder(4, 12, (-10, 0, -12)), cylinder(4, 12, (10, 0, -12)))
    slope = prism(((-35, 3.5, -20), (-35, 25, -20), (-35, 25, 0)), (70, 0, 0))
    (pocket,) = find(cut(plate(), *slot, slope)).of("pocket")
    assert "obround" in pocket.tags
    assert pocket.depth == pytest.approx(0.012)
    assert pocket.length == pytest.approx(0.028)


@pytest.mark.parametrize(("radius", "obround"), [(4.0, True), (3.0, False)])
def test_two_half_rounds_of_one_radius_at_the_ends_of_a_flat_are_an_obround(radius: float, obround: bool) -> None:
    """The flat across from it is cut away."""
    ends = (cylinder(4, 8, (-10, 0, -8)), cylinder(radius, 8, (10, radius - 4, -8)))
    across = box((20, 20, 18), (-10, 0, -18))
    parts = find(cut(plate(), box((20, 5, 8), (-10, -4, -8)), *ends, across)).parts
    (found,) = [part for part in parts if part.kind.cuts_in and part.depth == pytest.approx(0.008)]
    assert ("obround" in found.tags) == obround


def test_a_pocket_that_a_narrow_slot_opens_through_its_wall_is_no_t_slot() -> None:
    across = box((6, 40, 14), (-3, -4, -14))
    found = find(cut(plate(), box((30, 16, 8), (-15, -8, -8)), across))
    (pocket,) = found.of("pocket")
    assert {"rectangular", "open"} <= set(pocket.tags)
    assert (pocket.length, pocket.width, pocket.depth) == pytest.approx((0.030, 0.016, 0.008))
    (slot,) = found.of("slot")
    assert (slot.width, slot.depth) == pytest.approx((0.006, 0.014))


@pytest.mark.parametrize(("neck", "tagged"), [(8.0, True), (4.0, False)])
def test_a_t_slot_has_a_mouth_of_a_third_of_its_width_at_least(neck: float, tagged: bool) -> None:
    found = find(cut(plate(), box((70, 14, 4), (-35, -7, -12)), box((70, neck, 20), (-35, -neck / 2, -9))))
    assert any("t_slot" in part.tags for part in found.parts) == tagged


@pytest.mark.parametrize(("reach", "kind"), [(-4.0, "slot"), (12.0, "step")])
def test_a_round_ended_slot_that_lost_the_foot_of_a_wall_is_a_slot_and_one_without_the_wall_a_step(
    reach: float, kind: str
) -> None:
    slot = (box((30, 10, 8), (-35, -5, -8)), cylinder(5, 8, (-5, 0, -8)))
    foot = prism(((-35, 3, -14), (-35, 25, -14), (-35, 25, reach), (-35, 4.5, reach)), (70, 0, 0))
    parts = find(cut(plate(), *slot, foot)).parts
    (found,) = [part for part in parts if part.kind in ("slot", "step", "notch") and part.depth == pytest.approx(0.008)]
    assert found.kind == kind
    assert ("obround" in found.tags) == (kind == "slot")
