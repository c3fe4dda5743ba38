"""How thick are the walls of the bodies of an assembly?"""

from __future__ import annotations

import pytest
from tests.segworker.shapes import (
    box,
    compound,
    cut,
    filleted,
    find,
    fuse,
    shifted,
    turned,
    upright,
)


def test_each_body_of_an_assembly_has_the_thickness_of_its_own_walls() -> None:
    case = cut(box((80, 60, 30)), box((74, 54, 27.1), (3, 3, 3)))
    foot = box((10, 10, 10), (5, 5, -10))
    bodies = [part for part in find(compound(case, foot)).parts if part.kind == "body"]
    assert bodies[0].thickness == pytest.approx(0.003)
    assert bodies[1].thickness is None


def test_what_a_body_stands_on_is_a_plate_also_where_it_is_a_thick_one() -> None:
    support = fuse(box((42, 14, 6)), box((18, 14, 30), (12, 0, 6)))
    (base,) = [part for part in find(support).of("prism") if part.center[2] < 0.0031]
    assert (base.thickness, base.length, base.width) == pytest.approx((0.006, 0.042, 0.014))
    assert {"plate", "grounded"} <= set(base.tags)


def test_a_bar_without_anything_on_it_and_a_high_foot_are_no_plates() -> None:
    assert not any("plate" in part.tags for part in find(box((42, 14, 6))).of("prism"))
    tall = fuse(box((42, 14, 12)), box((18, 14, 30), (12, 0, 12)))
    assert not any(part.height == pytest.approx(0.012) for part in find(tall).of("prism"))


def test_fins_are_no_walls_of_a_housing() -> None:
    tray = cut(box((100, 60, 40)), box((84, 44, 30.1), (8, 8, 10)))
    fins = [box((100, 2, 12), (0, 4 + 10 * k, -12)) for k in range(6)]
    found = find(fuse(tray, *fins))
    walls = found.of("wall")
    assert walls
    assert all(part.thickness == pytest.approx(0.008) for part in walls)
    assert len(found.of("rib")) == 6
    (body,) = found.of("body")
    assert body.thickness in (None, pytest.approx(0.008))


def test_rounded_edges_are_told_by_how_they_lie() -> None:
    block = box((60, 40, 20))
    rounds = find(filleted(block, 4.0, *upright(block))).of("round")
    assert len(rounds) == 4
    assert all("vertical" in part.tags for part in rounds)
    lying = find(turned(filleted(block, 4.0, *upright(block)), (1, 0, 0), 90)).of("round")
    assert len(lying) == 4
    assert all("horizontal" in part.tags for part in lying)


@pytest.mark.parametrize(("side", "thickness"), [(4.0, 0.004), (6.0, None)])
def test_a_flange_around_its_opening_is_no_side_of_a_box(side: float, thickness: float | None) -> None:
    """Three sides are 4 mm thick, the fourth is so or 6 mm; the flange and the floor are 9 mm."""
    outside = fuse(box((100, 76 + side, 60)), box((140, 116 + side, 9), (-20, -20, 51)))
    (body,) = find(cut(outside, box((92, 72, 60), (4, 4, 9)))).of("body")
    assert body.thickness == (None if thickness is None else pytest.approx(thickness))


@pytest.mark.parametrize("reach", [20.0, 43.0, 70.0])
def test_a_floor_on_another_body_is_found(reach: float) -> None:
    case = cut(box((80, 60, 30)), box((74, 54, 30), (3, 3, 3)))
    (floor,) = find(compound(case, box((reach, 37, 15), (7, 11, -15)))).of("floor")
    assert floor.thickness == pytest.approx(0.003)


@pytest.mark.parametrize(("pad", "walls"), [(20.0, [0.004, 0.006]), (50.0, [0.004, 0.006, 0.009])])
def test_a_small_pad_on_a_leg_makes_no_wall_of_both(pad: float, walls: list[float]) -> None:
    angle = fuse(box((60, 40, 6)), box((4, 40, 50)))
    found = find(fuse(angle, box((pad, 30, 3), (7, 5, 6))))
    assert sorted(wall.thickness or 0.0 for wall in found.of("wall")) == pytest.approx(walls)


@pytest.mark.parametrize(("low", "high", "count"), [(45.0, 105.0, 1), (55.0, 95.0, 0)])
def test_a_wall_lies_behind_more_than_half_of_one_of_its_sides(low: float, high: float, count: int) -> None:
    """A slab with a block below one end and one above the other: 57 % of its sides lie across from each other, 42 %."""
    shape = fuse(box((150, 40, 6)), box((low, 40, 34), (0, 0, -34)), box((150 - high, 40, 34), (high, 0, 6)))
    for by in ((0.0, 0.0, 0.0), (13.7, -4.2, 8.9)):
        walls = find(shifted(shape, by)).of("wall")
        assert sum(wall.thickness == pytest.approx(0.006) for wall in walls) == count


def test_ends_of_walls_far_apart_are_no_wall() -> None:
    """Two of the inner walls of a house end at one level, 30 mm before its outside."""
    house = cut(box((200, 120, 40)), box((192, 112, 40), (4, 4, 4)))
    rooms = fuse(house, box((4, 86, 40), (60, 30, 0)), box((4, 86, 40), (130, 30, 0)))
    thick = {round((wall.thickness or 0.0) * 1e3, 3) for wall in find(rooms).of("wall")}
    assert thick == {4.0}


def test_both_feet_of_a_hat_rail_are_plates_and_one_plate_is_one() -> None:
    hat = cut(
        box((68, 56, 26)), box((36, 56, 24), (16, 0, 0)), box((14, 56, 24), (0, 0, 2)), box((14, 56, 24), (54, 0, 2))
    )
    feet = [part for part in find(hat).of("prism") if part.center[2] < 0.0011]
    assert [foot.thickness for foot in feet] == pytest.approx([0.002] * 2)
    grooved = cut(box((68, 56, 6)), box((8, 56, 2), (30, 0, 0)))
    assert len(find(grooved).of("prism")) == 1


def test_two_ears_level_with_one_large_face_are_both_plates() -> None:
    tab = box((22, 24, 4), (20, -12, 0))
    right = filleted(tab, 5, *upright(tab))
    ears = fuse(box((60, 60, 30), (-30, -30, 0)), right, shifted(right, (-62, 0, 0)))
    found = [part for part in find(ears).of("prism") if "plate" in part.tags]
    assert [part.thickness for part in found] == pytest.approx([0.004, 0.004])
