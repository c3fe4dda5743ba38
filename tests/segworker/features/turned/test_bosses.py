"""Bosses: what stands out round, one part a step, with the measures that a drawing would give."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    DOWN,
    box,
    chamfered,
    cone,
    cut,
    cylinder,
    filleted,
    find,
    fuse,
    plate,
    rims,
    shifted,
    torus,
    turned,
)

from querycad_contracts import Part, Side

MM = 1e-3


def test_the_rings_of_a_grille_are_rims_and_a_disc_with_two_curved_slots_is_a_disc() -> None:
    spokes = [turned(box((29, 4, 4), (0, -2, -1)), (0, 0, 1), 90.0 * i) for i in range(4)]
    ring = cut(cylinder(30, 2), cylinder(26, 4, (0, 0, -1)))
    guard = find(fuse(ring, cylinder(12, 2), *(cut(spoke, cylinder(99, 9, (0, 0, 2))) for spoke in spokes)))
    rim, hub = sorted(guard.of("boss"), key=lambda boss: -(boss.diameter or 0.0))
    assert "rim" in rim.tags
    assert "flat" not in rim.tags
    assert (rim.outer_diameter, rim.inner_diameter, rim.thickness) == near(60, 52, 4)
    assert "flat" in hub.tags
    assert hub.inner_diameter is None
    slot = cut(cylinder(20, 4, (0, 0, -1)), cylinder(14, 6, (0, 0, -2)), box((50, 50, 9), (-25, -9, -4)))
    disc = only_boss(cut(cylinder(30, 2), slot))
    assert "rim" not in disc.tags


def only_boss(shape: TopoDS_Shape) -> Part:
    (boss,) = find(shape).of("boss")
    return boss


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-8)


def test_a_boss_stands_from_its_base_to_its_tip() -> None:
    boss = only_boss(fuse(plate(), cylinder(6, 9, (4, 5, 0))))
    assert [boss.radius, boss.diameter, boss.height] == near(6, 12, 9)
    assert list(boss.tip or ()) == near(4, 5, 9)
    assert boss.normal == pytest.approx((0, 0, 1))
    assert "cylindrical" in boss.tags
    assert not {"slender", "flat", "hollow", "conical"} & set(boss.tags)


def test_a_boss_below_points_downwards() -> None:
    boss = only_boss(fuse(plate(), cylinder(6, 9, (0, 0, -20), DOWN)))
    assert list(boss.tip or ()) == near(0, 0, -29)
    assert boss.normal == pytest.approx((0, 0, -1))


def test_longer_than_wide_is_a_shaft() -> None:
    boss = only_boss(fuse(plate(), cylinder(4, 30)))
    assert "slender" in boss.tags
    assert boss.label.startswith("shaft")


def test_a_low_wide_step_is_a_disc() -> None:
    boss = only_boss(fuse(plate(), cylinder(10, 3)))
    assert "flat" in boss.tags
    assert boss.label.startswith("disc")
    assert boss.thickness == pytest.approx(3 * MM)


def test_a_boss_with_a_bore_is_a_standoff_and_knows_its_bore() -> None:
    found = find(cut(fuse(plate(), cylinder(5, 12)), cylinder(2, 10, (0, 0, 12), DOWN)))
    (boss,) = found.of("boss")
    assert "hollow" in boss.tags
    assert boss.label.startswith("standoff")
    assert boss.children == (found.hole.id,)
    assert [boss.height, boss.depth, *boss.radii] == near(12, 10, 5, 2)


def test_a_stepped_shaft_is_one_part_a_step() -> None:
    bosses = find(fuse(cylinder(20, 10), cylinder(12, 25, (0, 0, 10)), cylinder(8, 40, (0, 0, 35)))).of("boss")
    assert sorted((round((b.radius or 0) / MM, 6), round((b.height or 0) / MM, 6)) for b in bosses) == [
        (8, 40),
        (12, 25),
        (20, 10),
    ]
    assert all("stepped" in boss.tags for boss in bosses)


def test_a_free_cylinder_is_a_boss_without_a_base() -> None:
    boss = only_boss(cylinder(10, 50))
    assert "free" in boss.tags
    assert [boss.radius, boss.height] == near(10, 50)


def test_a_cone_that_stands_out_is_conical() -> None:
    boss = only_boss(fuse(plate(), cone(10, 5, 12)))
    assert "conical" in boss.tags
    assert [boss.radius, boss.height] == near(10, 12)


def test_a_broken_edge_at_the_tip_does_not_shorten_the_boss() -> None:
    block = fuse(plate(), cylinder(6, 9))
    boss = only_boss(chamfered(block, 1.0, *rims(block, 6, 9)))
    assert [boss.radius, boss.height] == near(6, 9)
    assert list(boss.tip or ()) == near(0, 0, 9)


def test_a_rounding_at_the_foot_leaves_one_boss() -> None:
    block = fuse(plate(), cylinder(6, 9))
    boss = only_boss(filleted(block, 1.0, *rims(block, 6, 0)))
    assert boss.radius == pytest.approx(6 * MM)
    assert list(boss.tip or ()) == near(0, 0, 9)


def test_a_hole_is_no_boss() -> None:
    assert find(cut(plate(), cylinder(5, 30, (0, 0, -25)))).of("boss") == []


def test_a_rounded_corner_is_no_boss() -> None:
    from tests.segworker.shapes import upright

    block = box((40, 30, 10))
    assert find(filleted(block, 5.0, *upright(block))).of("boss") == []


def test_a_boss_is_visible_from_its_top_and_around_but_not_through_the_plate() -> None:
    found = find(fuse(plate(), cylinder(6, 9)))
    (boss,) = [part for part in found.seen_parts if part.kind == "boss"]
    assert set(boss.sides) == {Side.TOP, Side.LEFT, Side.RIGHT, Side.FRONT, Side.BACK}


def test_a_boss_reaches_from_the_plate_to_its_end_over_fillet_and_chamfer() -> None:
    shape = fuse(plate(), cylinder(8, 12))
    shape = filleted(shape, 2, *rims(shape, 8, 0))
    boss = only_boss(chamfered(shape, 1, *rims(shape, 8, 12)))
    assert [boss.height, boss.extents[2]] == near(12, 12)
    assert boss.center[2] == pytest.approx(6 * MM)


def test_a_disc_is_as_thick_as_between_its_faces_where_notches_part_its_chamfers() -> None:
    disc = cylinder(20, 8)
    disc = chamfered(disc, 1, *rims(disc, 20, 0), *rims(disc, 20, 8))
    for x, y in ((20, 0), (-20, 0), (0, 20)):
        disc = cut(disc, box((6, 6, 8), (x - 3, y - 3, 0)))
    boss = next(boss for boss in find(disc).of("boss") if boss.radius == pytest.approx(20 * MM))
    assert [boss.height, boss.extents[2]] == near(8, 8)


def test_lands_are_wider_than_what_stands_beside_them() -> None:
    spool = fuse(cylinder(8, 10), cylinder(5, 10, (0, 0, 10)), cylinder(8, 12, (0, 0, 20)), cylinder(6, 10, (0, 0, 32)))
    lands = [boss for boss in find(spool).of("boss") if "land" in boss.tags]
    assert sorted(boss.height or 0.0 for boss in lands) == near(10, 12)
    pin = fuse(cylinder(8, 10), cylinder(5, 20, (0, 0, 10)))
    assert not any("land" in boss.tags for boss in find(pin).of("boss"))


def test_a_screw_boss_grows_out_of_the_corner_of_a_box() -> None:
    tray = cut(box((80, 60, 30), (-40, -30, 0)), box((76, 56, 30), (-38, -28, 2)))
    for x, y in ((-35, -25), (35, -25), (35, 25), (-35, 25)):
        tray = cut(fuse(tray, cylinder(4, 20, (x, y, 2))), cylinder(1.25, 12, (x, y, 10)))
    bosses = find(tray).of("boss")
    assert [value for boss in bosses for value in (boss.diameter, boss.height)] == near(*[8, 20] * 4)
    assert all("hollow" in boss.tags for boss in bosses)


def test_the_round_end_of_an_arm_is_no_boss() -> None:
    arm = fuse(box((40, 16, 10), (0, -8, 0)), cylinder(8, 10))
    assert not find(cut(arm, cylinder(3, 10))).of("boss")


@pytest.mark.parametrize(("deep", "tube"), [(25, False), (50, True), (60, True)])
def test_a_tube_is_bored_along_most_of_it_and_a_shaft_with_a_hole_in_it_is_none(deep: float, *, tube: bool) -> None:
    boss = only_boss(cut(cylinder(7.5, 60), cylinder(4, deep)))
    assert ("tube" in boss.tags) is tube
    assert boss.label.partition(",")[0] == ("tube" if tube else "shaft")


def test_a_neck_that_tapers_from_its_flange_is_a_conical_boss() -> None:
    flange = cut(fuse(cylinder(75, 20), cone(35, 27, 30, (0, 0, 20))), cylinder(25, 60, (0, 0, -5)))
    (neck,) = [boss for boss in find(flange).of("boss") if "conical" in boss.tags]
    assert [neck.diameter, neck.height] == near(70, 30)


def test_the_short_hub_of_a_welding_neck_flange_is_a_step_and_a_chamfer_as_high_is_none() -> None:
    hub = fuse(cylinder(100, 22), cone(54.5, 44.5, 21.5, (0, 0, 22)), cylinder(44.5, 12, (0, 0, 43.5)))
    steps = find(cut(hub, cylinder(39, 60, (0, 0, -1)))).of("boss")
    assert sorted(step.diameter or 0 for step in steps) == pytest.approx([0.089, 0.109, 0.2])
    assert min(steps, key=lambda step: step.diameter or 0).height == pytest.approx(0.012)
    pin = fuse(cylinder(54.5, 22), cone(54.5, 44.5, 21.5, (0, 0, 22)))
    assert [boss.diameter for boss in find(pin).of("boss")] == pytest.approx([0.109])


def test_a_cone_that_eases_the_corner_of_a_shoulder_is_no_boss() -> None:
    shaft = fuse(cylinder(30, 20), cone(15, 12, 3, (0, 0, 20)), cylinder(12, 60, (0, 0, 20)))
    assert sorted(boss.diameter or 0.0 for boss in find(shaft).of("boss")) == near(24, 60)


@pytest.mark.parametrize(("depth", "hollow"), [(8, False), (25, True)])
def test_a_centre_hole_in_its_end_makes_no_shaft_hollow(depth: float, hollow: bool) -> None:
    (shaft,) = find(cut(cylinder(10, 30), cylinder(1.25, depth))).of("boss")
    assert ("hollow" in shaft.tags, len(shaft.radii)) == (hollow, 1 + hollow)


def test_a_cross_hole_makes_no_shaft_hollow() -> None:
    pin = cylinder(2, 40, (0, -20, 20), (0, 1, 0))
    shaft = fuse(cylinder(10, 40), cylinder(7, 40, (0, 0, 40)))
    (solid,) = find(cut(shaft, pin)).of("body")
    assert "hollow" not in solid.tags
    assert solid.inner_diameter is None
    (tube,) = find(cut(shaft, pin, cylinder(5, 80))).of("body")
    assert "hollow" in tube.tags
    assert tube.inner_diameter == pytest.approx(10 * MM)


@pytest.mark.parametrize(("narrow", "thickness"), [(8.0, 3 * math.sqrt(0.5)), (6.0, None)])
def test_a_hollow_cone_is_as_thick_as_its_wall_unless_that_tapers(narrow: float, thickness: float | None) -> None:
    bowl = cut(cone(11, 41, 30), cone(narrow, 38, 30))
    (shell,) = find(bowl).of("boss")
    assert shell.thickness == (None if thickness is None else pytest.approx(thickness * MM))
    assert ("tube" in shell.tags, "flat" in shell.tags) == (False, False)
    assert list(shell.radii) == near(41, 38)


def test_a_countersink_in_the_end_of_a_boss_does_not_widen_its_bore() -> None:
    (boss,) = find(fuse(plate(), cut(cylinder(10, 16), cylinder(3, 16), cone(3, 8, 9, (0, 0, 7))))).of("boss")
    assert [boss.thickness, *boss.radii] == near(7, 10, 3)


def test_the_rim_of_a_pot_is_as_wide_inside_as_the_pot_there() -> None:
    pot = fuse(cone(40, 54, 100), cylinder(60, 14, (0, 0, 96)))
    found = find(cut(pot, cone(37.4, 51.96, 104, (0, 0, 6)), cylinder(5, 6)))
    (rim,) = [boss for boss in found.of("boss") if "conical" not in boss.tags]
    assert list(rim.radii) == near(60, 51.96)


@pytest.mark.parametrize("degrees", [0, 35])
def test_both_sides_of_a_round_groove_are_one_step(degrees: float) -> None:
    roller = cut(cylinder(32, 160), torus(32, 4, (0, 0, 25)), torus(34, 5, (0, 0, 50)))
    found = find(turned(roller, (1, 2, 3), degrees))
    (step,) = found.of("boss")
    assert [step.height, step.diameter] == near(160, 64)
    assert len(found.of("groove")) == 2


def test_the_fillet_at_a_shoulder_and_a_long_waist_part_steps() -> None:
    stepped = fuse(cylinder(20, 30), cylinder(12, 30, (0, 0, 30)))
    eased = find(filleted(stepped, 4, *rims(stepped, 12, 30)))
    assert sorted(step.height or 0 for step in eased.of("boss")) == near(30, 30)
    waisted = find(cut(cylinder(20, 120), torus(70, 60, (0, 0, 60))))
    assert len(waisted.of("boss")) == 2


def test_the_drum_of_a_spool_is_a_step_between_flanges_and_the_bottom_of_a_seal_groove_is_none() -> None:
    spool = fuse(cylinder(43, 72), cylinder(95, 5), cylinder(100, 4, (0, 0, 68)))
    found = {round(2e3 * (boss.radius or 0.0)): boss for boss in find(cut(spool, cylinder(26, 72))).of("boss")}
    assert sorted(found) == [86, 190, 200]
    assert found[86].height == pytest.approx(63 * MM)
    assert ["flange" in found[size].tags for size in (190, 200)] == [True, True]
    piston = fuse(cylinder(17.5, 14), cylinder(20, 3), cylinder(20, 3, (0, 0, 11)))
    assert only_boss(piston).diameter == pytest.approx(40 * MM)


def test_the_round_of_a_wider_step_does_not_lengthen_the_narrower_one_and_a_flare_at_the_foot_does() -> None:
    stepped = fuse(cylinder(15, 5), cylinder(10, 40))
    rounded = find(filleted(stepped, 2, *rims(stepped, 15, 5))).of("boss")
    assert sorted((boss.diameter, boss.height) for boss in rounded) == [near(20, 35), near(30, 5)]
    shoulder = fuse(cylinder(15, 5), cone(15, 10, 5, (0, 0, 5)), cylinder(10, 40))
    assert sorted((boss.diameter, boss.height) for boss in find(shoulder).of("boss")) == [near(20, 30), near(30, 10)]
    flare = fuse(plate(), cone(12, 10, 2), cylinder(10, 30))
    assert [only_boss(flare).diameter, only_boss(flare).height] == near(20, 30)


def test_a_disc_with_draft_on_both_sides_of_its_parting_line_is_one_step_and_a_double_bevel_is_none() -> None:
    disc = fuse(cone(39.5, 40, 10), cone(40, 39.5, 10, (0, 0, 10)))
    assert [only_boss(disc).diameter, only_boss(disc).height] == near(80, 20)
    double = fuse(cone(37, 40, 2), cone(40, 38, 2, (0, 0, 2)))
    assert [boss.height for boss in find(double).of("boss")] == near(2, 2)


def test_a_chamfer_breaks_the_edge_of_a_hub_with_draft_and_an_end_face_with_draft_is_no_step() -> None:
    hub = fuse(plate(), cone(15, 14.5, 10), cone(14.5, 13.5, 1, (0, 0, 10)))
    assert [only_boss(hub).height] == near(11)
    assert find(hub).of("chamfer")
    crowned = find(fuse(plate(), cylinder(15, 10), cone(15, 5, 0.5, (0, 0, 10))))
    assert [boss.height for boss in crowned.of("boss")] == near(10.5)
    assert not crowned.of("chamfer")


def test_between_a_long_cone_and_a_collar_lies_a_step_and_between_short_flanks_a_groove() -> None:
    spindle = fuse(
        cylinder(40, 20), cone(40, 20, 40, (0, 0, 20)), cylinder(20, 20, (0, 0, 60)), cylinder(30, 15, (0, 0, 80))
    )
    steps = sorted((boss.diameter, boss.height) for boss in find(spindle).of("boss"))
    assert steps == [near(40, 20), near(60, 15), near(80, 20), near(80, 40)]
    shaft = fuse(cylinder(25, 20), cone(25, 20, 5, (0, 0, 20)), cylinder(20, 8, (0, 0, 25)))
    grooved = find(fuse(shaft, cone(20, 25, 5, (0, 0, 33)), cylinder(25, 20, (0, 0, 38))))
    assert [boss.diameter for boss in grooved.of("boss")] == near(50)
    assert len(grooved.of("groove")) == 1


@pytest.mark.parametrize(("recess", "bosses"), [(15.0, 1), (8.0, 0)])
def test_a_boss_around_a_bore_in_a_wide_recess_is_one_and_what_a_narrow_groove_leaves_is_none(
    recess: float, bosses: int
) -> None:
    ring = cut(cylinder(recess, 5), cylinder(6.5, 5))
    found = find(cut(cylinder(20, 20), ring, cylinder(3, 15)))
    sizes = [boss.diameter for boss in found.of("boss") if (boss.diameter or 0) < 0.02]
    assert sizes == pytest.approx([0.013] * bosses)


def test_the_middle_of_a_disc_turned_out_on_both_sides_is_a_hub_and_no_bosses() -> None:
    ring = cut(cylinder(50, 12), cylinder(23, 12))
    wheel = cut(cylinder(70, 35), ring, shifted(ring, (0, 0, 23)), cylinder(12, 35))
    found = find(wheel)
    assert [part.diameter for part in found.parts if "hub" in part.tags] == pytest.approx([0.046])
    assert not [boss for boss in found.of("boss") if (boss.diameter or 0) < 0.1]
