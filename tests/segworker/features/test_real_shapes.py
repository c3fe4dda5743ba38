"""Shapes that real files are full of: rounded outer edges, hubs between pockets, scalloped windows, plates, slits."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    Found,
    box,
    cone,
    cut,
    cylinder,
    extruded,
    filleted,
    find,
    fuse,
    nurbs,
    plate,
    prism,
    rims,
    shifted,
    torus,
    turned,
)

from querycad_contracts import Part

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-6)


def one(value: float) -> object:
    """Millimetres."""
    return pytest.approx(value * MM, abs=1e-6)


def of(found: Found, kind: str, *tags: str) -> list[Part]:
    return [part for part in found.parts if part.kind == kind and set(tags) <= set(part.tags)]


def only(found: list[Part]) -> Part:
    (part,) = found
    return part


def test_a_rounded_outer_edge_is_no_groove_but_a_hollow_one_is() -> None:
    disc = cylinder(20, 10)
    assert not of(find(filleted(disc, 3, *rims(disc, 20, 10))), "groove")
    shaft = cylinder(20, 40)
    assert only(of(find(cut(shaft, torus(20, 3, (0, 0, 20)))), "groove", "semicircular")).radius == one(17)


def arm() -> TopoDS_Shape:
    """A bar with a hub in its middle, and on either side of the hub a pocket that its outer wall bounds."""
    bar = box((120, 30, 12), (-60, -15, 0))
    pockets = [box((90, 20, 5), (-45, -10, 7))]
    return fuse(cut(bar, *pockets), cylinder(14, 12))


def test_pockets_that_have_only_a_hub_in_common_are_two() -> None:
    first, second = of(find(arm()), "pocket")
    assert [first.depth, second.depth] == near(5, 5)
    assert set(first.faces).isdisjoint(second.faces)


def test_what_stands_on_a_wall_makes_no_slot_or_step() -> None:
    wall = box((80, 10, 60), (0, 0, 0))
    pad = fuse(box((20, 4, 40), (20, -4, 0)), cylinder(10, 4, (30, -4, 40), (0, 1, 0)))
    found = find(fuse(wall, pad))
    assert not of(found, "slot")
    assert not of(found, "step")
    assert not of(find(fuse(plate(), cylinder(8, 10, (-22, 0, 0)))), "step")


def scalloped() -> TopoDS_Shape:
    """A window of 35 x 20 with a half-round bay in the middle of each side."""
    bays = [cylinder(3, 10, at) for at in ((-17.5, 0, -10), (17.5, 0, -10), (0, -10, -10), (0, 10, -10))]
    return cut(plate(80, 60, 10), fuse(box((35, 20, 10), (-17.5, -10, -10)), *bays))


@pytest.mark.parametrize("degrees", [0.0, 33.0])
def test_a_window_with_a_scalloped_outline_is_one_cutout(degrees: float) -> None:
    found = find(turned(scalloped(), (0, 0, 1), degrees))
    window = only(of(found, "cutout", "through"))
    assert [window.local_size[0], window.depth] == near(41, 10)  # type: ignore[index]
    assert not [part for part in found.parts if part.kind in ("step", "notch", "slot")]


def test_a_keyhole_is_one_cutout_and_no_hole() -> None:
    slot = fuse(box((10, 5, 10), (0, -2.5, -10)), cylinder(2.5, 10, (10, 0, -10)))
    found = find(cut(plate(), fuse(cylinder(5, 10, (0, 0, -10)), slot), cylinder(2, 20, (-20, 10, -20))))
    blind = find(cut(plate(60, 40, 10), fuse(cylinder(5, 10, (0, 0, -10)), slot)))
    keyhole = only(of(blind, "cutout", "keyhole"))
    assert [keyhole.length, keyhole.width] == near(17.5, 10)
    assert not of(blind, "hole")
    assert not of(blind, "notch")
    assert of(found, "hole")


@pytest.mark.parametrize("convert", [lambda shape: shape, nurbs])
def test_a_bore_with_a_keyway_is_a_hole(convert: object) -> None:
    hub = cut(cylinder(24, 50), fuse(cylinder(12, 50), box((8, 15, 50), (-4, 0, 0))))
    found = find(convert(hub))  # type: ignore[operator]
    assert only(of(found, "hole", "through")).diameter == one(24)
    assert of(found, "slot", "keyway")
    assert not of(found, "prism")


def test_a_cone_below_its_apex_has_its_own_radii() -> None:
    head = fuse(cone(10, 5, 5, (0, 0, 0), (0, 0, -1)), cylinder(5, 40, (0, 0, -40)))
    found = find(head)
    assert {round(part.diameter / MM, 6) for part in of(found, "cone") if part.diameter} == {20.0}
    assert of(found, "body", "screw")


def test_a_triangular_plate_has_the_centre_of_its_box() -> None:
    found = find(extruded([(0, 0), (90, 0), (20, 60)], 0, 5))
    part = only(of(found, "prism"))
    assert list(part.center) == near(45, 30, 2.5)
    assert list(part.extents) == near(90, 60, 5)


def bracket() -> TopoDS_Shape:
    """An L of 10 thick legs with a hole in each."""
    legs = fuse(box((60, 40, 10)), box((10, 40, 80)))
    return cut(legs, cylinder(5, 10, (40, 20, 0)), cylinder(5, 10, (0, 20, 50), (1, 0, 0)))


def test_the_thickness_of_an_angle_bracket_is_that_of_its_legs() -> None:
    found = find(bracket())
    assert [part.thickness for part in of(found, "prism", "plate")] == near(10, 10)
    assert only(of(found, "body")).thickness == one(10)


def test_a_flange_of_any_outline_with_a_hub_on_it_is_a_plate() -> None:
    ends = fuse(box((60, 30, 4), (-30, -15, 0)), cylinder(15, 4, (-30, 0, 0)), cylinder(15, 4, (30, 0, 0)))
    found = find(cut(fuse(ends, cylinder(12, 20)), cylinder(8, 20)))
    part = only(of(found, "prism", "plate"))
    assert [part.thickness, part.width] == near(4, 30)
    assert "obround" in part.tags


def test_fins_are_no_plates() -> None:
    fins = [box((2, 40, 15), (x, -20, 0)) for x in (-20, -10, 0, 10)]
    found = find(fuse(plate(), *fins))
    assert len(of(found, "rib", "fin")) == 4
    assert not [part for part in of(found, "prism", "plate") if part.thickness == one(2)]


def clamp() -> TopoDS_Shape:
    """A block with a bore and a saw cut of 4 from the bore to its side."""
    return cut(box((50, 40, 20), (-20, -20, 0)), cylinder(10, 20), box((40, 4, 20), (0, -2, 0)))


def test_the_slit_of_a_clamp_is_a_slot_as_wide_as_the_saw() -> None:
    found = find(clamp())
    slit = only(of(found, "slot", "slit"))
    assert [slit.width, slit.local_size[2]] == near(4, 20)  # type: ignore[index]
    assert only(of(found, "hole")).diameter == one(20)


def test_a_rib_is_as_high_as_both_of_its_flanks() -> None:
    # A wide groove beside the edge of a block leaves a wall whose outer flank is the whole side of the block.
    found = find(cut(plate(80, 60, 40), box((80, 20, 12), (-40, -24, -12))))
    rib = only(of(found, "rib")) if of(found, "rib") else None
    assert rib is None or rib.height == one(12)
    # The face between a shallow slot in the side of a block and the top of the block is no rib.
    block = fuse(plate(100, 60, 30), box((40, 40, 30), (-20, -20, 0)))
    assert not of(find(cut(block, box((60, 8, 10), (-50, -30, -20)))), "rib")


def test_a_pad_level_with_the_end_of_a_tube_has_its_own_size() -> None:
    tube = cut(cylinder(10, 30, (0, 0, 0), (1, 0, 0)), cylinder(9, 30, (0, 0, 0), (1, 0, 0)))
    pad = cut(box((15, 5, 4), (0, -2.5, -11)), cylinder(9.5, 40, (-5, 0, 0), (1, 0, 0)))
    part = only(of(find(fuse(tube, pad)), "prism"))
    assert [part.length, part.width] == near(15, 5)


def test_of_the_rings_of_a_bush_only_the_one_wider_than_both_neighbours_is_a_collar() -> None:
    steps = fuse(cylinder(20, 40), cylinder(30, 10, (0, 0, 40)), cylinder(22, 8, (0, 0, 50)))
    found = of(find(cut(steps, cylinder(12, 58))), "boss", "collar")
    assert [part.diameter for part in found] == near(60)


@pytest.mark.parametrize(("depth", "kind"), [(4.0, "pocket"), (20.0, "hole")])
def test_a_shallow_round_recess_by_itself_is_a_pocket(depth: float, kind: str) -> None:
    found = find(cut(plate(80, 80, 40), cylinder(20, depth, (0, 0, -depth)), cylinder(3, 40, (10, 0, -40))))
    part = only([p for p in found.parts if p.kind in ("pocket", "hole") and p.diameter != one(6)])
    assert part.kind == kind
    assert part.depth == one(depth)


@pytest.mark.parametrize(("wide", "is_counterbore"), [(20.0, False), (30.0, True)])
def test_a_counterbore_is_much_wider_than_its_bore(wide: float, is_counterbore: bool) -> None:
    hole = only(
        of(find(cut(plate(80, 80, 40), cylinder(17, 40, (0, 0, -40)), cylinder(wide, 25, (0, 0, -25)))), "hole")
    )
    assert ("counterbored" in hole.tags) is is_counterbore
    assert "stepped" in hole.tags
    assert list(hole.radii) == near(wide, 17)


def test_drill_points_and_chamfers_are_told_from_other_cones() -> None:
    drilled = fuse(cylinder(3, 12, (-15, 0, -12)), cone(0, 3, 2, (-15, 0, -14)), cone(3, 4, 1, (-15, 0, -1)))
    found = find(cut(plate(), drilled, cone(2, 8, 20, (15, 0, -20))))
    assert len(of(found, "cone", "drill_point")) == len(of(found, "cone", "chamfer")) == 1
    assert len(of(found, "cone")) == 3
    assert only(of(found, "cone", "drill_point")).tip == near(-15, 0, -14)


def test_a_screw_is_as_long_as_its_body_with_a_rounded_head() -> None:
    screw = fuse(cylinder(8, 6), cylinder(5, 40, (0, 0, -40)))
    found = find(filleted(screw, 2, *rims(screw, 8, 6)))
    assert only(of(found, "body", "screw")).length == one(46)


def test_a_step_behind_a_wall_that_leans_is_still_a_step() -> None:
    found = find(cut(plate(), prism([(10, -20, 0), (30, -20, 0), (30, -20, -8), (12, -20, -8)], (0, 40, 0))))
    assert len(of(found, "step")) == 1
    assert math.isclose(of(found, "step")[0].depth or 0.0, 8 * MM, rel_tol=1e-6)


def test_a_boss_as_high_as_wide_is_not_slender() -> None:
    for angle in (0.0, 20.0, 77.0):
        found = find(turned(fuse(plate(), shifted(cylinder(5, 10), (1, 2, 0))), (1, 1, 0), angle))
        assert "slender" not in only(of(found, "boss")).tags
