"""Teeth around an axis: counted, with tip and root diameter; fine pointed ones on the outside are a knurl."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    Found,
    Vec,
    box,
    cut,
    cylinder,
    extruded,
    find,
    fuse,
    gear,
    prism,
    sewn,
    shifted,
    turned,
)

MM = 1e-3


def points(count: int, root: float, tip: float) -> list[tuple[float, float]]:
    """A star: two flanks a tooth."""
    return [
        (r * math.cos(i * math.pi / count), r * math.sin(i * math.pi / count))
        for i in range(2 * count)
        for r in (tip if i % 2 else root,)
    ]


@pytest.mark.parametrize(("count", "degrees"), [(8, 0), (23, 0), (23, 35)])
def test_a_gear_has_its_teeth_counted_and_its_tip_and_root_diameter(count: int, degrees: float) -> None:
    shape = cut(gear(count, 20, 16, 10), cylinder(5, 10))
    (found,) = find(turned(shape, (1, 2, 3), degrees)).of("gear")
    assert found.count == count == len(found.children)
    # The flat bottoms run a little below the root circle on which their ends lie.
    assert list(found.radii) == pytest.approx([20 * MM, 16 * MM], rel=0.03)
    assert found.width == pytest.approx(10 * MM)
    assert "knurl" not in found.tags


def knurled(count: int, root: float) -> Found:
    return find(cut(extruded(points(count, root, 20), 0, 12), cylinder(5, 12)))


def test_fine_pointed_teeth_around_a_knob_are_a_knurl() -> None:
    (knurl,) = knurled(60, 19.2).of("gear")
    assert "knurl" in knurl.tags
    assert knurl.label.startswith("knurl")
    assert knurl.count == 60
    assert list(knurl.radii) == pytest.approx([20 * MM, 19.2 * MM])


def test_deep_pointed_teeth_are_a_ratchet_and_no_knurl() -> None:
    (ratchet,) = knurled(24, 16).of("gear")
    assert (ratchet.count, "knurl" in ratchet.tags) == (24, False)


def test_a_star_of_five_points_is_neither() -> None:
    assert knurled(5, 12).of("gear") == []


def diamonds(count: int, rows: int, tip: float, root: float, height: float) -> TopoDS_Shape:
    """A handle along z covered with pyramids: points and pits alternate around it and along it."""

    def corner(i: int, j: int) -> Vec:
        radius = tip if (i + j) % 2 == 0 and 0 < j < rows else root
        angle = math.pi * i / count
        return radius * math.cos(angle), radius * math.sin(angle), j * height

    around = range(2 * count)
    triangles = []
    for j in range(rows):
        for i in around:
            a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
            triangles += [(a, b, d), (b, c, d)] if (i + j) % 2 == 0 else [(a, b, c), (a, c, d)]
    ends = [tuple(corner(i, j) for i in around) for j in (0, rows)]
    return sewn([*triangles, *ends])


@pytest.mark.parametrize("degrees", [0, 37])
def test_rows_of_points_around_a_handle_are_a_diamond_knurl(degrees: float) -> None:
    handle = fuse(diamonds(30, 10, 10.0, 9.5, 1.0), cylinder(6, 30, (0, 0, -20)))
    found = find(turned(handle, (1, 2, 3), degrees))
    (knurl,) = found.of("gear")
    assert {"knurl", "diamond"} <= set(knurl.tags)
    assert knurl.count == 30
    assert [knurl.diameter, knurl.width] == pytest.approx([20 * MM, 10 * MM])
    assert found.of("chamfer") == found.of("slot") == []


def test_crossed_grooves_with_flat_tops_are_a_diamond_knurl() -> None:
    """Grooves along two directions leave a rhombus of the cylinder each."""
    bar, grooves = cylinder(10, 6), []
    for i in range(24):
        for lean in (45, -45):
            section = [(9.3, 0.0), (11.0, -1.2), (11.0, 1.2)]
            groove = prism([(x, y, -20) for x, y in section], (0, 0, 40))
            groove = shifted(turned(groove, (1, 0, 0), lean), (0, 0, 3))
            grooves.append(turned(groove, (0, 0, 1), 15 * i))
    (knurl,) = find(fuse(cut(bar, *grooves), cylinder(5, 40, (0, 0, -12)))).of("gear")
    assert {"knurl", "diamond"} <= set(knurl.tags)
    assert knurl.count == 24


@pytest.mark.parametrize("radius", [18.0, 20.0, 21.3])
def test_slots_around_a_disc_are_slots_and_no_gear(radius: float) -> None:
    disc = fuse(cylinder(30, 6), cylinder(radius + 8, 8, (0, 0, 6)))
    slots = [turned(box((20, 4, 6), (radius, -2, 8)), (0, 0, 1), 40 * i) for i in range(9)]
    found = find(cut(disc, *slots))
    assert found.of("gear") == []
    assert len(found.of("slot")) == 9


def test_teeth_whose_flanks_stand_at_nearly_equal_angles_are_counted_once() -> None:
    """The teeth end on a wider flange; their flanks seem to repeat twice as often as they do."""
    pitch = 2 * math.pi / 30
    outline = [
        (r * math.cos((i + share) * pitch), r * math.sin((i + share) * pitch))
        for i in range(30)
        for r, share in ((41, -0.18), (41, 0.18), (48, 0.34), (48, 0.66))
    ]
    found = find(fuse(extruded(outline, 0, 24), cylinder(56, 8, (0, 0, -8)), cylinder(12, 30, (0, 0, 24))))
    (gear,) = found.of("gear")
    assert gear.count == 30 == len(gear.children)
    assert gear.diameter == pytest.approx(96 * MM)


@pytest.mark.parametrize("degrees", [0, 35])
def test_a_rim_with_deep_slots_and_hollows_is_still_a_disc_and_no_gear(degrees: float) -> None:
    slot = fuse(box((40, 8, 10), (28, -4, 0)), cylinder(4, 10, (28, 0, 0)))
    slots = [turned(slot, (0, 0, 1), 60 * i) for i in range(6)]
    hollows = [turned(cylinder(22, 10, (69.28, 0, 0)), (0, 0, 1), 60 * i + 30) for i in range(6)]
    wheel = fuse(cut(cylinder(60, 10), *slots, *hollows), cylinder(18, 14, (0, 0, 10)))
    found = find(turned(wheel, (1, 2, 3), degrees))
    assert found.of("gear") == []
    assert sorted(boss.diameter or 0 for boss in found.of("boss")) == pytest.approx([36 * MM, 120 * MM])
    (disc,) = (boss for boss in found.of("boss") if "flat" in boss.tags and (boss.diameter or 0) > 0.1)
    assert disc.height == pytest.approx(10 * MM)
    assert len(found.of("slot")) == 6
    for part in found.of("slot"):
        assert {"through", "radial", "open"} <= set(part.tags)
        assert part.width == pytest.approx(8 * MM)


def test_three_arms_of_one_radius_are_no_disc() -> None:
    arms = [turned(box((40, 12, 6), (0, -6, 0)), (0, 0, 1), 120 * i) for i in range(3)]
    star = fuse(fuse(*arms), cylinder(15, 6))
    ring = cut(cylinder(60, 6), cylinder(38, 6))
    found = find(cut(star, ring))
    assert [boss for boss in found.of("boss") if (boss.diameter or 0) > 0.07] == []


def test_slots_milled_into_the_face_of_a_disc_are_no_teeth() -> None:
    milled = [
        turned(shifted(fuse(box((38, 4, 2), (-19, -2, 10)), cylinder(2, 2, (-19, 0, 10)), cylinder(2, 2, (19, 0, 10))),
                       (101, 0, 0)), (0, 0, 1), 60 * i)
        for i in range(6)
    ]  # fmt: skip
    parts = find(cut(cylinder(130, 12), *milled)).parts
    assert not [part for part in parts if part.kind in ("gear", "tooth")]
    assert len([part for part in parts if part.kind == "pocket" and "obround" in part.tags]) == 6


@pytest.mark.parametrize("degrees", [0, 35])
def test_slots_cut_through_a_polygonal_plate_are_no_teeth(degrees: float) -> None:
    """Sides of the plate and walls of the slots repeat eight times around the hole, three faces and more each time."""
    slot = fuse(box((26, 18, 20), (162, -9, 0)), cylinder(9, 20, (162, 0, 0)), cylinder(9, 20, (188, 0, 0)))
    slots = [turned(slot, (0, 0, 1), 45 * i) for i in range(8)]
    corners = [(227.3 * math.cos(a), 227.3 * math.sin(a)) for a in (math.radians(22.5 + 45 * i) for i in range(8))]
    base = cut(extruded(corners, 0, 20), cylinder(40, 20), *slots)
    found = find(turned(base, (1, 2, 3), degrees))
    assert found.of("gear") == []
    assert [part.length for part in found.of("cutout")] == pytest.approx([44 * MM] * 8)
    assert all("radial" in part.tags for part in found.of("cutout"))


def test_slots_across_the_way_to_the_hole_are_not_radial() -> None:
    slots = [turned(box((6, 30, 20), (100, -15, 0)), (0, 0, 1), 90 * i) for i in range(4)]
    base = cut(box((300, 300, 20), (-150, -150, 0)), cylinder(40, 20), *slots)
    cutouts = find(base).of("cutout")
    assert len(cutouts) == 4
    assert not any("radial" in part.tags for part in cutouts)


def test_the_slots_of_a_castle_nut_are_slots_and_its_flats_no_teeth() -> None:
    corners = [(12 * math.cos(i * math.pi / 3), 12 * math.sin(i * math.pi / 3)) for i in range(6)]
    slits = [turned(box((20, 4, 10), (0, -2, 8)), (0, 0, 1), 30 + i * 60) for i in range(6)]
    found = find(cut(extruded(corners, 0, 16), cylinder(6, 16), *slits))
    assert found.of("gear") == []
    assert [slot.width for slot in found.of("slot")] == pytest.approx([4 * MM] * 6)


@pytest.mark.parametrize("degrees", [0, 35])
def test_a_hexagon_beside_splines_does_not_count_as_their_teeth(degrees: float) -> None:
    hexagon = [(14 * math.cos(i * math.pi / 3), 14 * math.sin(i * math.pi / 3)) for i in range(6)]
    tool = fuse(extruded(hexagon, -20, 16), cylinder(15, 4, (0, 0, -4)), gear(12, 11.6, 10.2, 9))
    (splines,) = find(turned(cut(tool, cylinder(6, 40, (0, 0, -25))), (1, 2, 3), degrees)).of("gear")
    assert [splines.count, splines.width] == pytest.approx([12, 9 * MM])
    assert splines.diameter == pytest.approx(23.2 * MM)


def test_teeth_on_one_root_cylinder_are_one_gear_and_a_nut_is_none() -> None:
    teeth = [turned(box((8, 4, 10), (14, -2, 0)), (0, 0, 1), 36 * i) for i in range(10)]
    (one,) = find(fuse(cylinder(16, 10), *teeth)).of("gear")
    assert one.count == 10
    hexagon = [(14 * math.cos(i * math.pi / 3), 14 * math.sin(i * math.pi / 3)) for i in range(6)]
    nut = fuse(extruded(hexagon, 0, 10), cylinder(16, 3, (0, 0, -3)))
    assert find(cut(nut, cylinder(6, 20, (0, 0, -5)))).of("gear") == []


def test_ribs_with_parallel_sides_inside_a_cap_are_ribs_and_the_teeth_of_a_straight_sided_spline_are_a_gear() -> None:
    cap = cut(cylinder(27, 26), cylinder(24, 23.5))
    ribs = [turned(box((5, 1.5, 18), (20, -0.75, 6)), (0, 0, 1), i * 45) for i in range(8)]
    ribbed = find(cut(fuse(cap, *ribs), cylinder(21, 23.5)))
    assert not ribbed.of("gear")
    assert [rib.thickness for rib in ribbed.of("rib")] == pytest.approx([1.5 * MM] * 8)
    grooves = [turned(box((13, 6, 20), (0, -3, 0)), (0, 0, 1), i * 60) for i in range(6)]
    spline = find(cut(cylinder(25, 20), cylinder(11.5, 20), *grooves))
    assert [gear.count for gear in spline.of("gear")] == [6]
    assert not spline.of("rib")
