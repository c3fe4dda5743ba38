"""Walls and floors of boxes, legs of brackets, ears: plane faces close together with nothing but material between."""

from __future__ import annotations

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS_Edge, TopoDS_Shape
from tests.segworker.shapes import (
    UP,
    box,
    cut,
    cylinder,
    edges,
    filleted,
    find,
    fuse,
    plate,
    prism,
    scaled,
    shifted,
    turned,
    upright,
)

MM = 1e-3
Y = (0.0, 1.0, 0.0)


def tray() -> TopoDS_Shape:
    """Open at the top: walls of 5 mm, a floor of 3 mm."""
    return cut(box((80, 60, 40)), box((70, 50, 40), (5, 5, 3)))


def bracket() -> TopoDS_Shape:
    """An L: one leg lies and is 6 mm thick, one stands and is 4 mm thick."""
    return fuse(box((60, 40, 6)), box((4, 40, 50)))


@pytest.mark.parametrize("size", [0.01, 1.0, 100.0])
def test_a_box_has_four_walls_and_a_floor(size: float) -> None:
    found = find(scaled(turned(tray(), (0.2, 0.4, 0.9), 33.0), size))
    assert [wall.thickness for wall in found.of("wall")] == pytest.approx([5 * MM * size] * 4, rel=1e-3)
    (floor,) = found.of("floor")
    assert floor.thickness == pytest.approx(3 * MM * size, rel=1e-3)
    assert (floor.length, floor.width) == pytest.approx((70 * MM * size, 50 * MM * size), rel=1e-3)


def test_a_block_has_no_walls_and_a_plate_is_none() -> None:
    assert not find(box((60, 40, 30))).of("wall")
    assert not find(plate(80, 60, 6)).of("wall")


def test_a_cover_has_a_roof() -> None:
    (roof,) = find(turned(tray(), (1.0, 0.0, 0.0), 180.0)).of("floor")
    assert {"roof", "lying"} <= set(roof.tags)


def test_the_rim_of_a_tray_is_no_wall_as_thick_as_the_tray_is_high() -> None:
    low = cut(box((80, 60, 10)), box((70, 50, 10), (5, 5, 3)))
    walls = [*find(low).of("wall"), *find(low).of("floor")]
    assert 10 * MM not in [pytest.approx(wall.thickness) for wall in walls]


def test_the_legs_of_an_angle_have_their_own_thickness() -> None:
    legs = {wall.thickness or 0.0: wall for wall in find(bracket()).of("wall")}
    assert sorted(legs) == pytest.approx([4 * MM, 6 * MM])
    assert all("leg" in wall.tags for wall in legs.values())
    standing, lying = (legs[thickness] for thickness in sorted(legs))
    assert "upright" in standing.tags
    assert "lying" in lying.tags


def test_a_short_thick_leg_with_a_rounded_corner_has_its_thickness() -> None:
    short = fuse(box((80, 40, 7)), box((10, 40, 32), (0, 0, -25)))
    walls = find(filleted(short, 5.0, *_edges_at(short, 10.0, 0.0))).of("wall")
    assert sorted(wall.thickness or 0.0 for wall in walls) == pytest.approx([7 * MM, 10 * MM])
    assert not find(box((80, 22, 10))).of("wall")


def _edges_at(shape: TopoDS_Shape, x: float, z: float) -> list[TopoDS_Edge]:
    """Those whose middle lies there."""
    middles = [(edge, BRepAdaptor_Curve(edge)) for edge in edges(shape)]
    points = [(edge, c.Value((c.FirstParameter() + c.LastParameter()) / 2)) for edge, c in middles]
    return [edge for edge, p in points if abs(p.X() - x) < 1e-6 and abs(p.Z() - z) < 1e-6]


def test_an_ear_with_a_round_end_has_its_thickness() -> None:
    ear = fuse(box((30, 8, 30)), cylinder(15, 8, (15, 0, 30), Y))
    ear = shifted(cut(ear, cylinder(6, 20, (15, -5, 30), Y)), (0, 16, 6))
    walls = find(fuse(box((90, 40, 6), (-30, 0, 0)), ear)).of("wall")
    (found,) = [wall for wall in walls if "ear" in wall.tags]
    assert found.thickness == pytest.approx(8 * MM)
    assert "upright" in found.tags
    plain = fuse(box((90, 40, 6), (-30, 0, 0)), box((30, 8, 50), (0, 16, 6)))
    assert not [wall for wall in find(plain).of("wall") if "ear" in wall.tags]


def corner(*gussets: TopoDS_Shape) -> TopoDS_Shape:
    return fuse(box((80, 40, 8)), box((6, 40, 60)), *gussets)


@pytest.mark.parametrize(("along", "up"), [(40.0, 40.0), (30.0, 45.0), (45.0, 20.0)])
def test_a_triangle_in_the_corner_of_two_plates_is_a_gusset_and_as_large_as_its_feet(along: float, up: float) -> None:
    found = find(corner(prism([(6, 18, 8), (6 + along, 18, 8), (6, 18, 8 + up)], (0, 4, 0))))
    (gusset,) = found.of("rib")
    assert "gusset" in gusset.tags
    assert (gusset.thickness, gusset.length, gusset.height) == pytest.approx((4 * MM, along * MM, up * MM))


@pytest.mark.parametrize("above", [0.0, 8.0])
def test_a_gusset_may_end_level_with_the_sides_of_what_it_braces(above: float) -> None:
    outline = [(6, 0, 8), (46, 0, 8), (46, 0, 8 + above), (6, 0, 48)]
    outline = outline if above else [outline[0], outline[1], outline[3]]
    pair = [prism([(x, y, z) for x, _, z in outline], (0, 4, 0)) for y in (0, 36)]
    wider = fuse(box((80, 60, 8), (0, -10, 0)), box((6, 40, 60)), *pair)  # the base goes on past them
    for shape in (corner(*pair), wider):
        gussets = find(shape).of("rib")
        assert [part.tags.count("gusset") for part in gussets] == [1, 1]
        assert [(p.thickness, p.length, p.height) for p in gussets] == 2 * [pytest.approx((4 * MM, 40 * MM, 40 * MM))]


def test_gussets_stay_gussets_however_many_are_alike_and_cooling_fins_are_none() -> None:
    found = find(corner(*[prism([(6, y, 8), (46, y, 8), (6, y, 48)], (0, 4, 0)) for y in (3, 18, 33)]))
    assert ["gusset" in rib.tags for rib in found.of("rib")] == 3 * [True]
    assert [rib.thickness for rib in found.of("rib")] == pytest.approx(3 * [4 * MM])
    fins = find(fuse(box((80, 40, 8)), *[box((80, 4, 30), (0, y, 8)) for y in (3, 18, 33)])).of("rib")
    assert [("gusset" in rib.tags, "fin" in rib.tags) for rib in fins] == 3 * [(False, True)]


def test_the_upright_between_two_gussets_is_a_leg_and_neither_floor_nor_rib() -> None:
    pair = [prism([(6, y, 8), (46, y, 8), (6, y, 48)], (0, 4, 0)) for y in (0, 36)]
    braced = find(fuse(box((80, 60, 8), (0, -10, 0)), box((6, 40, 60)), *pair))
    legs = {"upright" in leg.tags: leg for leg in braced.of("wall") if "leg" in leg.tags}
    assert (legs[True].thickness, legs[True].height) == pytest.approx((6 * MM, 60 * MM))
    assert not braced.of("floor")
    assert ["gusset" in rib.tags for rib in braced.of("rib")] == [True, True]
    trough = cut(box((80, 40, 40)), box((80, 34, 37), (0, 3, 3)))
    assert [floor.thickness for floor in find(trough).of("floor")] == pytest.approx([3 * MM])


def test_a_bracket_has_legs_however_large_its_gusset_and_a_block_with_a_braced_flange_has_none() -> None:
    gusset = prism([(5, 7, 5), (75, 7, 5), (5, 7, 75)], (0, 6, 0))
    walls = find(fuse(box((100, 20, 5)), box((5, 20, 90)), gusset)).of("wall")
    assert sorted(wall.length or 0.0 for wall in walls if "leg" in wall.tags) == pytest.approx([90 * MM, 100 * MM])
    small = prism([(40, 7, 5), (60, 7, 5), (40, 7, 25)], (0, 6, 0))
    block = find(fuse(box((100, 40, 5)), box((40, 40, 60)), small))
    assert [rib for rib in block.of("rib") if "gusset" in rib.tags]
    assert not [part for part in block.parts if "leg" in part.tags]


def test_a_side_of_a_tray_is_no_rib_where_a_tab_stands_out_below_it_and_a_divider_is_one() -> None:
    sides = cut(box((80, 60, 26)), box((74, 54, 23), (3, 3, 3)))
    tabbed = find(fuse(sides, box((18, 20, 3), (31, -20, 0))))
    assert not tabbed.of("rib")
    assert len(tabbed.of("wall")) == 4
    for standing in (sides, box((80, 60, 3))):
        (rib,) = find(fuse(standing, box((3, 54, 15), (40, 3, 3)))).of("rib")
        assert rib.thickness == pytest.approx(3 * MM)


def test_a_side_of_a_box_that_is_level_with_its_outside_is_no_gusset() -> None:
    open_box = cut(box((80, 40, 60)), box((74, 32, 52), (6, 4, 8)))
    assert not [part for part in find(open_box).parts if "gusset" in part.tags]


def test_a_plate_that_fills_the_corner_and_a_web_between_two_walls_are_no_gussets() -> None:
    block = corner(box((40, 4, 40), (6, 18, 8)))
    web = cut(box((60, 40, 30)), box((26, 34, 27), (3, 3, 3)), box((25, 34, 27), (32, 3, 3)))
    for shape in (block, web):
        assert not [part for part in find(shape).parts if "gusset" in part.tags]


def test_the_bar_between_two_windows_is_a_wall_and_the_rim_beside_one_is_not_between() -> None:
    windows = box((40, 40, 10), (7, 10, 0)), box((40, 40, 10), (53, 10, 0))
    (bar,) = [part for part in find(cut(box((100, 60, 10)), *windows)).parts if "between" in part.tags]
    assert bar.kind == "wall"
    assert bar.thickness == pytest.approx(6 * MM)
    assert not [part for part in find(cut(box((100, 60, 10)), windows[0])).parts if "between" in part.tags]


def test_an_upright_plate_is_as_high_as_it_reaches_and_a_lying_one_as_thick() -> None:
    upright, lying = sorted(find(corner()).of("prism"), key=lambda part: abs((part.axis or UP)[2]))
    assert (upright.height, upright.thickness) == pytest.approx((60 * MM, 6 * MM))
    assert (lying.height, lying.thickness) == pytest.approx((8 * MM, 8 * MM))
    assert [wall.height for wall in find(corner()).of("wall") if "upright" in wall.tags] == pytest.approx([60 * MM])


def test_a_bore_that_ends_level_with_the_floor_leaves_the_floor_and_the_sides_their_thickness() -> None:
    tray = cut(box((100, 60, 40)), box((94, 54, 40), (3, 3, 4)))
    post = cut(fuse(tray, cylinder(6, 12, (20, 20, 4))), cylinder(2, 12, (20, 20, 4)))
    for shape in (tray, post):
        found = find(shape)
        assert [round(1e3 * (one.thickness or 0.0), 3) for one in found.of("floor")] == [4.0]
        assert [round(1e3 * (one.thickness or 0.0), 3) for one in found.of("body")] == [3.0]
    uneven = cut(box((100, 60, 40)), box((92, 54, 40), (5, 3, 4)))
    assert find(uneven).of("body")[0].thickness is None


def test_a_leg_with_rounded_corners_is_no_thicker_than_between_its_faces() -> None:
    leg, foot = box((8, 60, 70), (0, 0, 0)), box((80, 60, 8), (0, 0, 0))
    shape = fuse(leg, foot)
    curves = [(edge, BRepAdaptor_Curve(edge)) for edge in edges(shape)]
    middles = [(edge, curve.Value((curve.FirstParameter() + curve.LastParameter()) / 2)) for edge, curve in curves]
    outer = [edge for edge, at in middles if (at.X(), at.Z()) == pytest.approx((0, 0), abs=1e-9)]
    plates = [part for part in find(filleted(shape, 6, *outer)).of("prism") if "plate" in part.tags]
    assert len(plates) == 2
    for part in plates:
        assert part.normal is not None
        along = [abs(x) for x in part.normal].index(1.0)
        assert part.extents[along] == pytest.approx(0.008)


def test_an_arm_bent_from_one_plate_to_another_leaves_the_corner_open_and_is_no_gusset() -> None:
    plates = fuse(box((100, 40, 8)), box((8, 40, 90)))
    arm = prism([(70, 18, 8), (85, 18, 8), (85, 18, 85), (8, 18, 85), (8, 18, 65), (70, 18, 65)], (0, 4, 0))
    brace = prism([(8, 18, 8), (85, 18, 8), (8, 18, 85)], (0, 4, 0))
    tags = [{tag for part in find(fuse(plates, one)).parts for tag in part.tags} for one in (arm, brace)]
    assert ["gusset" in each for each in tags] == [False, True]


def test_the_flange_at_the_end_of_a_tine_makes_that_no_thicker() -> None:
    fork = cut(box((120, 90, 35)), box((95, 70, 35), (25, 10, 0)))
    flanged = fuse(fork, box((10, 30, 35), (110, -30, 0)), box((10, 30, 35), (110, 90, 0)))
    for shape in (fork, flanged):
        assert max(wall.thickness or 0.0 for wall in find(shape).of("wall")) < 30 * MM


def test_the_edge_of_a_leg_is_no_rib_of_its_own() -> None:
    leg = box((38, 10, 60), (40, 0, -60))
    yoke = fuse(box((120, 60, 10)), leg, shifted(leg, (0, 50, 0)))
    eyes = fuse(yoke, *(cylinder(19, 16, (59, y, -60), Y) for y in (-3, 47)))
    assert not find(eyes).of("rib")
    assert len(find(fuse(box((120, 60, 10)), box((60, 6, 15), (30, 27, 10)))).of("rib")) == 1


def flanged_tray(tab: TopoDS_Shape) -> TopoDS_Shape:
    """A tray of 2 mm sheet with a rim that stands out by 5 mm, and a tab."""
    outside = fuse(box((110, 70, 2), (-55, -35, 18)), box((100, 60, 20), (-50, -30, 0)))
    return fuse(cut(outside, box((96, 56, 18), (-48, -28, 2))), tab)


def test_no_wall_lies_behind_the_rim_of_a_flange() -> None:
    found = find(flanged_tray(box((1, 1, 1))))
    assert [wall.thickness for wall in found.of("wall")] == pytest.approx([2 * MM] * len(found.of("wall")))


def test_the_edge_of_a_wall_that_hangs_below_a_tray_is_no_rib() -> None:
    assert not find(flanged_tray(box((100, 2, 10), (-50, -30, -10)))).of("rib")


def test_what_hangs_below_the_middle_of_a_tray_is_one() -> None:
    (rib,) = find(flanged_tray(box((100, 2, 10), (-50, -1, -10)))).of("rib")
    assert [rib.thickness, rib.height] == pytest.approx([2 * MM, 10 * MM])


def test_the_end_wall_of_a_narrow_pocket_may_be_thicker_than_the_pocket_is_wide() -> None:
    block = cut(box((60, 60, 40)), box((40, 5, 30), (10, 27.5, 10)))
    assert [round((wall.thickness or 0.0) / MM, 6) for wall in find(block).of("wall")].count(10) == 2


def test_the_ears_of_a_split_collar_are_walls_however_thick_and_the_halves_of_a_split_block_are_none() -> None:
    saw = box((100, 4, 36), (0, -2, 0))
    collar = fuse(cylinder(60, 36), box((40, 44, 36), (50, -22, 0)))
    ears = find(cut(collar, cylinder(30, 36), saw)).of("wall")
    assert [wall.thickness for wall in ears] == pytest.approx(2 * [20 * MM])
    assert [("ear" in wall.tags, "leg" in wall.tags) for wall in ears] == 2 * [(True, False)]
    assert not find(cut(box((120, 120, 36), (-60, -60, 0)), cylinder(30, 36), saw)).of("wall")


def test_holes_in_the_top_of_a_pad_make_no_wall_through_the_plate_below_it() -> None:
    padded = fuse(box((200, 120, 25)), *(box((40, 70, 6), (x, 25, 25)) for x in (20, 140)))
    bored = cut(padded, *(cylinder(5, 28, (x, y, 3)) for x in (40, 160) for y in (45, 75)))
    for shape in (padded, bored):
        assert not find(shape).of("wall")
    hollow = cut(bored, box((180, 100, 23), (10, 10, 0)))
    assert min(floor.thickness or 0.0 for floor in find(hollow).of("floor")) == pytest.approx(2 * MM)


@pytest.mark.parametrize("aside", [20.0, 24.0])
def test_a_flange_with_a_flat_on_its_rim_is_no_wall_and_an_ear_is_one(aside: float) -> None:
    bushing = cut(fuse(cylinder(25, 4), cylinder(15, 30)), cylinder(10, 30), box((10, 60, 4), (aside, -30, 0)))
    assert not find(bushing).of("wall")
    lug = fuse(box((60, 60, 8)), box((6, 30, 30), (0, 15, 8)), cylinder(15, 6, (0, 30, 38), (1, 0, 0)))
    eye = find(cut(lug, cylinder(6, 6, (0, 30, 38), (1, 0, 0))))
    assert [part for part in eye.of("wall") if "ear" in part.tags]


def test_the_bottom_of_a_nut_pocket_is_no_third_ear_and_an_ear_with_a_spot_face_stays_one() -> None:
    clamp = cut(fuse(cylinder(15, 14), box((30, 12, 14), (0, -6, 0))), cylinder(8, 14), box((40, 2, 14), (0, -1, 0)))
    bolt = cylinder(2.15, 40, (22, -20, 7), Y)
    nut = box((7, 2, 8), (18.5, -6, 3))
    for seat, ears in ((nut, [5, 5]), (cylinder(3.8, 1, (22, -6, 7), Y), [5, 5])):
        walls = find(cut(clamp, bolt, seat)).parts
        found = [wall.thickness for wall in walls if wall.kind in ("wall", "floor") and "ear" in wall.tags]
        assert found == pytest.approx([ear * MM for ear in ears])


def test_the_flange_of_bent_sheet_between_its_web_and_an_end_plate_is_no_gusset() -> None:
    """A channel of 3 mm sheet with windows in both flanges, and a plate that closes one end of it."""
    outside, inside = box((90, 60, 100)), box((84, 60, 100), (3, 3, 0))
    sheet = cut(
        filleted(outside, 5, *upright(outside)),
        filleted(inside, 2, *upright(inside)),
        box((90, 20, 100), (0, 45, 0)),
        box((100, 25, 70), (-5, 12, 15)),
    )
    found = find(fuse(sheet, box((90, 40, 3), (0, 5, -3))))
    assert not [part for part in found.parts if "gusset" in part.tags]
    assert sum(abs(wall.normal[0]) > 0.99 for wall in found.of("wall") if wall.normal) == 2


def test_a_gusset_with_fillets_on_both_feet_is_one() -> None:
    shape = corner(prism([(6, 18, 8), (46, 18, 8), (6, 18, 48)], (0, 4, 0)))
    (gusset,) = find(filleted(shape, 1.5, *_feet(shape))).of("rib")
    assert "gusset" in gusset.tags


def _feet(shape: TopoDS_Shape) -> list[TopoDS_Edge]:
    """The straight edges of a gusset's sides at the corner's plates."""
    found = []
    for edge in edges(shape):
        curve = BRepAdaptor_Curve(edge)
        middle = curve.Value((curve.FirstParameter() + curve.LastParameter()) / 2)
        at_foot = abs(middle.X() - 6) < 1e-6 or abs(middle.Z() - 8) < 1e-6
        if at_foot and min(abs(middle.Y() - side) for side in (18, 22)) < 1e-6:
            found.append(edge)
    return found


def test_a_wall_beside_a_slot_is_as_high_as_the_slot_is_deep() -> None:
    block = cut(box((60, 40, 60)), box((20, 40, 25), (35, 0, 35)))
    heights = {wall.thickness: wall.height for wall in find(block).of("wall") if wall.thickness}
    assert heights[min(heights)] == pytest.approx(25 * MM)


def test_the_side_of_a_box_is_as_high_as_its_outside_however_thick_the_floor() -> None:
    walls = find(cut(box((80, 60, 50)), box((74, 54, 50), (3, 3, 8)))).of("wall")
    assert [wall.height for wall in walls] == pytest.approx(4 * [50 * MM])


def test_the_floor_of_a_pocket_with_round_ends_is_no_ear() -> None:
    """Its round end is the foot of the wall around it, also where a slot lies about the same middle."""
    case = cut(box((70, 40, 20), (-35, -20, 0)), _obround(64, 34, 16, 4), _obround(37.5, 7.5, 10, 0))
    (floor,) = find(case).of("floor")
    assert floor.thickness == pytest.approx(4 * MM)
    assert "ear" not in floor.tags


def _obround(length: float, width: float, height: float, z: float) -> TopoDS_Shape:
    far = (length - width) / 2
    middle = box((2 * far, width, height), (-far, -width / 2, z))
    return fuse(middle, *(cylinder(width / 2, height, (x, 0, z)) for x in (-far, far)))
