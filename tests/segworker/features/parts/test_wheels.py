"""Wheels: rims, webs, spokes and hubs; forks and their tines; beams and their webs."""

from __future__ import annotations

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS_Edge, TopoDS_Shape
from tests.segworker.shapes import (
    box,
    chamfered,
    compound,
    cut,
    cylinder,
    edges,
    extruded,
    find,
    fuse,
    plate,
    scaled,
    turned,
)

MM = 1e-3


def ring(outer: float, inner: float, height: float, z: float = 0.0) -> TopoDS_Shape:
    return cut(cylinder(outer, height, (0, 0, z)), cylinder(inner, height, (0, 0, z)))


def spoked(spokes: int = 5) -> TopoDS_Shape:
    """Rim 120/100 x 12, hub 30/10 x 20, spokes 8 x 8 that run into both."""
    bars = [turned(box((52, 8, 8), (0, -4, 2)), (0, 0, 1), i * 360.0 / spokes) for i in range(spokes)]
    wheel = fuse(ring(60, 50, 12), *bars, cylinder(15, 20, (0, 0, -4)))
    return cut(wheel, cylinder(5, 20, (0, 0, -4)))


def webbed() -> TopoDS_Shape:
    """A disc 110 x 22, turned out on both sides between radius 21 and 46, with a web of 8."""
    recess = ring(46, 21, 7)
    disc = cut(cylinder(55, 22), recess, ring(46, 21, 7, 15))
    return cut(disc, cylinder(10, 22))


def fork(gap: float = 16.0) -> TopoDS_Shape:
    """A bar 40 x 30 with a slot of 65 mm from its end."""
    return cut(box((105, 40, 30), (0, -20, 0)), box((65, gap, 30), (40, -gap / 2, 0)))


@pytest.mark.parametrize("size", [0.1, 1.0])
def test_the_inside_of_a_rim_is_no_hole(size: float) -> None:
    found = find(scaled(spoked(), size))
    assert [hole.diameter for hole in found.of("hole")] == [pytest.approx(10 * MM * size)]
    (rim,) = [boss for boss in found.of("boss") if "rim" in boss.tags]
    assert (rim.thickness, rim.width) == pytest.approx((10 * MM * size, 12 * MM * size))


def test_a_ring_has_a_hole_and_no_rim() -> None:
    found = find(ring(60, 50, 12))
    assert len(found.of("hole")) == 1
    assert not [boss for boss in found.of("boss") if "rim" in boss.tags]


def test_spokes_run_out_from_the_middle() -> None:
    assert len([part for part in find(spoked()).of("prism") if "spoke" in part.tags]) == 5


def test_bars_beside_each_other_are_no_spokes() -> None:
    comb = fuse(box((80, 10, 10)), *(box((6, 40, 6), (10 + 25 * i, 10, 2)) for i in range(3)))
    assert not [part for part in find(comb).parts if "spoke" in part.tags]


def test_a_disc_turned_out_on_both_sides_has_a_rim_and_a_web() -> None:
    found = find(webbed())
    (rim,) = [wall for wall in found.of("wall") if "rim" in wall.tags]
    (web,) = [wall for wall in found.of("wall") if "web" in wall.tags]
    assert (rim.thickness, rim.width, web.thickness) == pytest.approx((9 * MM, 22 * MM, 8 * MM))
    assert min(web.extents) == pytest.approx(8 * MM)


@pytest.mark.parametrize(("longer", "length"), [(0, 22), (5, 27)])
def test_a_hub_reaches_through_the_web_from_end_to_end(longer: float, length: float) -> None:
    wheel = fuse(webbed(), ring(21, 10, longer, 22)) if longer else webbed()
    (hub,) = [part for part in find(wheel).of("prism") if "hub" in part.tags]
    assert (hub.length, hub.diameter) == pytest.approx((length * MM, 42 * MM))


def test_a_thin_tube_through_two_plates_is_one_and_a_thick_hub_is_none() -> None:
    plates = fuse(box((80, 80, 8), (-40, -40, 20)), box((80, 80, 8), (-40, -40, 120)), cylinder(12, 148))
    tubes = [part for part in find(cut(plates, cylinder(8, 148))).parts if {"hub", "tube"} <= set(part.tags)]
    assert [(tube.length, tube.diameter) for tube in tubes] == [pytest.approx((148 * MM, 24 * MM))]
    thick = [part for part in find(cut(plates, cylinder(4, 148))).parts if "hub" in part.tags]
    assert len(thick) == 1
    assert "tube" not in thick[0].tags


def test_what_stands_out_on_one_side_alone_is_no_such_hub() -> None:
    flange = fuse(ring(55, 10, 12), ring(21, 10, 20, 12))
    assert not [part for part in find(flange).parts if "hub" in part.tags]


def test_a_seal_groove_in_a_flange_makes_no_rim() -> None:
    flange = cut(cylinder(55, 22), ring(40, 36, 3, 19))
    assert not [part for part in find(flange).parts if "rim" in part.tags]


def test_a_fork_has_two_tines_and_its_slot_goes_in_from_the_end() -> None:
    found = find(fork())
    tines = [wall for wall in found.of("wall") if "tine" in wall.tags]
    assert [wall.thickness for wall in tines] == pytest.approx([12 * MM] * 2)
    (slot,) = found.of("slot")
    assert (slot.length, slot.depth, slot.width) == pytest.approx((65 * MM, 65 * MM, 16 * MM))


def test_a_short_notch_leaves_no_tines() -> None:
    notched = cut(box((105, 40, 30), (0, -20, 0)), box((10, 16, 30), (95, -8, 0)))
    assert not [part for part in find(notched).parts if "tine" in part.tags]


def test_a_beam_has_a_web_between_two_flanges() -> None:
    beam = cut(box((200, 50, 80)), box((200, 22, 64), (0, 0, 8)), box((200, 22, 64), (0, 28, 8)))
    found = find(beam)
    (web,) = [part for part in found.parts if "web" in part.tags]
    flanges = [wall for wall in found.of("wall") if "flange" in wall.tags]
    assert web.thickness == pytest.approx(6 * MM)
    assert [wall.thickness for wall in flanges] == pytest.approx([8 * MM] * 2)


def test_a_box_section_has_no_web() -> None:
    tube = cut(box((200, 50, 50)), box((200, 42, 42), (0, 4, 4)))
    assert not [part for part in find(tube).parts if "web" in part.tags]


def test_the_legs_of_an_angle_are_as_long_as_their_outer_sides() -> None:
    angle = fuse(box((60, 40, 5)), box((5, 40, 50)))
    legs = {wall.length or 0.0 for wall in find(angle).of("wall") if "leg" in wall.tags}
    assert sorted(legs) == pytest.approx([50 * MM, 60 * MM])


def test_a_step_is_as_high_as_its_wall_with_the_chamfer() -> None:
    block = cut(box((80, 50, 35)), box((50, 50, 15), (30, 0, 20)))
    upper = [e for e in edges(block) if edge_at(e, 30.0, 35.0)]
    (step,) = find(chamfered(block, 6.0, *upper)).of("step")
    assert (step.depth, step.extents[2]) == pytest.approx((15 * MM, 15 * MM))


def edge_at(edge: TopoDS_Edge, x: float, z: float) -> bool:
    """Does an edge along y lie there?"""
    curve = BRepAdaptor_Curve(edge)
    ends = [curve.Value(t) for t in (curve.FirstParameter(), curve.LastParameter())]
    return all(abs(p.X() - x) < 1e-6 and abs(p.Z() - z) < 1e-6 for p in ends)


def test_a_bar_between_hubs_is_an_arm_though_a_keyway_opens_in_its_side() -> None:
    lever = fuse(cylinder(18, 30), box((80, 16, 12), (0, -8, 0)), cylinder(14, 24, (80, 0, 0)))
    lever = cut(lever, cylinder(10, 30), box((6, 13, 30), (-3, 0, 0)), cylinder(7, 24, (80, 0, 0)))
    (bar,) = find(lever).of("prism")
    assert (bar.width, bar.thickness) == pytest.approx((16 * MM, 12 * MM))
    assert "arm" in bar.tags


def test_a_plate_with_a_recess_is_no_base_of_itself() -> None:
    block = cut(plate(100, 65, 30), cylinder(18, 6, (0, 0, -6)), cylinder(14, 30, (0, 0, -30)))
    assert all(prism.height != pytest.approx(30 * MM) or "plate" not in prism.tags for prism in find(block).of("prism"))


def test_a_t_slot_is_wider_at_its_floor() -> None:
    slot = cut(plate(120, 80, 40), box((120, 14, 25), (-60, -7, -25)), box((120, 24, 10), (-60, -12, -25)))
    (found,) = find(slot).of("slot")
    assert found.local_size is not None
    assert (found.width, min(found.local_size[:2])) == pytest.approx((14 * MM, 24 * MM))


def profile(neck: float) -> TopoDS_Shape:
    """An extruded bar with a slot whose walls slant to its floor, 8 wide and 9 deep, behind a mouth of `neck`."""
    half = neck / 2
    slot = [(half, 15.5), (half, 12.8), (8, 12.8), (8, 10.5), (4, 6), (-4, 6), (-8, 10.5), (-8, 12.8)]
    slot += [(-half, 12.8), (-half, 15.5)]
    bar = [(-15.0, -15.0), (15.0, -15.0), (15.0, 15.0), (-15.0, 15.0)]
    return cut(extruded(bar, 0, 100), extruded(slot, -1, 102))


def test_the_slot_of_an_extruded_profile_is_a_t_slot_with_slanting_corners() -> None:
    (slot,) = find(profile(8.0)).of("slot")
    assert "t_slot" in slot.tags
    assert (slot.width, slot.mouth_width, slot.bottom_width) == pytest.approx((8 * MM, 8 * MM, 16 * MM))
    assert (slot.depth, slot.length) == pytest.approx((9 * MM, 100 * MM))
    assert not [part for part in find(profile(3.0)).of("slot") if "t_slot" in part.tags]


def test_a_round_notch_in_a_plate_that_is_deeper_than_wide_leaves_tines() -> None:
    strap = plate(80, 40, 10)
    for reach, count in ((30, 2), (10, 0)):
        notch = fuse(box((reach + 5, 24, 20), (40 - reach, -12, -15)), cylinder(12, 20, (40 - reach, 0, -15)))
        tines = [wall for wall in find(cut(strap, notch)).of("wall") if "tine" in wall.tags]
        assert [tine.thickness for tine in tines] == pytest.approx([8 * MM] * count)


def test_the_bar_between_two_windows_is_a_wall_though_it_is_wider_than_thick() -> None:
    first, second = (box((40, 40, 20), (x, -20, -15)) for x in (-50, 10))
    (bar,) = (wall for wall in find(cut(plate(120, 60, 10), first, second)).of("wall") if "between" in wall.tags)
    assert (bar.thickness, bar.length) == pytest.approx((20 * MM, 40 * MM))
    apart = cut(plate(160, 60, 10), first, box((40, 40, 20), (35, -20, -15)))
    for shape in (apart, cut(plate(120, 60, 10), first)):
        assert not [part for part in find(shape).parts if "between" in part.tags]


def test_bosses_on_two_walls_of_a_hollow_body_are_no_hub_through_it() -> None:
    body = fuse(box((80, 80, 60), (-40, -40, 0)), cylinder(20, 80, (0, 0, -10)))
    hollow = cut(body, box((60, 60, 44), (-30, -30, 8)))
    two_bores = cut(hollow, cylinder(8, 18, (0, 0, -10)), cylinder(6, 18, (0, 0, 52)))
    one_bore = cut(body, cylinder(8, 80, (0, 0, -10)))
    hubs = [[part for part in find(shape).parts if "hub" in part.tags] for shape in (one_bore, two_bores)]
    assert [len(each) for each in hubs] == [1, 0]


def test_flanges_at_the_ends_of_a_pipe_make_no_hub_around_it() -> None:
    pipe = cut(fuse(cylinder(15, 100), cylinder(25, 4), cylinder(25, 4, (0, 0, 96))), cylinder(12, 100))
    through_a_wall = cut(fuse(box((80, 80, 10), (-40, -40, 45)), cylinder(25, 100)), cylinder(12, 100))
    hubs = [[part for part in find(shape).parts if "hub" in part.tags] for shape in (pipe, through_a_wall)]
    assert [len(each) for each in hubs] == [0, 1]


def test_rings_on_the_lugs_of_a_fork_are_no_hub_across_its_gap() -> None:
    rings = cylinder(15, 72, (0, 36, 30), (0, -1, 0))
    block = cut(fuse(box((60, 60, 60), (-30, -30, 0)), rings), cylinder(9, 72, (0, 36, 30), (0, -1, 0)))
    forked = cut(block, box((60, 30, 50), (-30, -15, 10)))
    hubs = [[part for part in find(shape).parts if "hub" in part.tags] for shape in (block, forked)]
    assert [len(each) for each in hubs] == [1, 0]


def test_a_thick_web_between_deep_recesses_is_one_and_seal_grooves_leave_none() -> None:
    pulley = cut(cylinder(45, 20), ring(29, 20, 5), ring(29, 20, 5, 15), cylinder(11, 20))
    (web,) = [wall for wall in find(pulley).of("wall") if "web" in wall.tags]
    assert web.thickness == pytest.approx(10 * MM)
    sealed = cut(cylinder(45, 20), ring(29, 24, 3), ring(29, 24, 3, 17), cylinder(11, 20))
    assert not [wall for wall in find(sealed).of("wall") if "web" in wall.tags]


def handwheel(rise: float) -> TopoDS_Shape:
    """Rim 200/160 x 18 about a hub of 46 that reaches `rise` higher, round spokes of 13; a boss meets one of them."""
    bars = [turned(cylinder(6.5, 85, along=(1, 0, 0)), (0, 0, 1), i * 72.0) for i in range(5)]
    wheel = fuse(ring(100, 80, 18, -9), *bars, cylinder(23, 26 + rise, (0, 0, -13)), cylinder(12, 18, (83, 0, -9)))
    return cut(wheel, cylinder(7, 26 + rise, (0, 0, -13)), cylinder(4, 18, (90, 0, -9)))


@pytest.mark.parametrize("degrees", [0, 35])
def test_round_spokes_count_about_the_axis_of_their_wheel_though_its_hub_is_higher_on_one_side(degrees: float) -> None:
    found = find(turned(handwheel(14), (1, 2, 3), degrees))
    assert len([boss for boss in found.of("boss") if "spoke" in boss.tags]) == 5
    (body,) = found.of("body")
    assert body.inner_diameter == pytest.approx(14 * MM)
    assert not {"ring", "tube", "plate"} & set(body.tags)


def test_pins_and_set_screws_of_a_collar_are_no_spokes() -> None:
    ways = [(0.0, 0.0, 1.0, degrees) for degrees in (0, 120, 240)]
    collar = ring(20, 10, 12, -6)
    pins = [turned(cylinder(2, 15, (15, 0, 0), (1, 0, 0)), way[:3], way[3]) for way in ways]
    holes = [turned(cylinder(2, 15, (8, 0, 0), (1, 0, 0)), way[:3], way[3]) for way in ways]
    screws = [turned(cylinder(2, 9, (10, 0, 0), (1, 0, 0)), way[:3], way[3]) for way in ways]
    for shape in (fuse(collar, *pins), compound(cut(collar, *holes), *screws)):
        assert not [part for part in find(shape).parts if "spoke" in part.tags]
