"""What a part is to the others: radial, a flange, an ear, none of a slot's ends; recognised on built shapes."""

from __future__ import annotations

import math
from functools import cache

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import DOWN, box, cone, cut, cylinder, find, fuse, plate, turned

from querycad_contracts import Part
from querycad_segworker.grounding.old.ground import ground

TUBE = cut(fuse(cylinder(20, 60), box((80, 80, 8), (-40, -40, 0)), cylinder(40, 8, (0, 0, 52))), cylinder(14, 60))


def parts(shape: TopoDS_Shape) -> list[Part]:
    return list(find(shape).seen_parts)


def named(shape: TopoDS_Shape, description: str) -> list[Part]:
    return meant(parts(shape), description)


def meant(among: list[Part], description: str) -> list[Part]:
    return list(ground(among, description, None).parts)


def diameters_mm(found: list[Part]) -> list[float]:
    return sorted(round(1e3 * (part.diameter or 0.0), 3) for part in found)


@cache
def bolted(turn_degrees: int = 0) -> list[Part]:
    """A tube between a square flange with holes of 6 mm, below, and a round one with holes of 8 mm; turned about y."""
    corners = [(x, y) for x in (-31, 31) for y in (-31, 31)]
    circle = [(29 * math.cos(a), 29 * math.sin(a)) for a in (0.3, 1.87, 3.44, 5.01)]
    holes = [cylinder(3, 8, (x, y, 0)) for x, y in corners] + [cylinder(4, 8, (x, y, 52)) for x, y in circle]
    side = cylinder(5, 30, (0, 0, 30), (1, 0, 0))
    return parts(turned(cut(TUBE, side, *holes), (0, 1, 0), turn_degrees))


def test_a_square_plate_bolted_on_around_a_tube_is_a_flange_as_a_round_one_is() -> None:
    assert sorted(p.kind for p in meant(bolted(), "flange")) == ["boss", "prism"]
    assert [p.kind for p in meant(bolted(), "square flange")] == ["prism"]
    assert [p.kind for p in meant(bolted(), "round flange")] == ["boss"]


@pytest.mark.parametrize(("degrees", "low", "high"), [(0, "lower", "upper"), (90, "left", "right")])
def test_holes_in_one_of_two_flanges_are_told_by_its_side(degrees: int, low: str, high: str) -> None:
    assert diameters_mm(meant(bolted(degrees), f"bolt hole in {low} flange")) == [6.0] * 4
    assert diameters_mm(meant(bolted(degrees), f"bolt hole in {high} flange")) == [8.0] * 4
    assert len(meant(bolted(degrees), "bolt hole in flange")) == 8


def test_a_port_is_none_of_the_holes_that_a_flange_is_bolted_on_with() -> None:
    assert diameters_mm(meant(bolted(), "port")) == [10.0, 28.0]


def test_a_hole_that_points_at_the_axis_of_a_hub_is_radial() -> None:
    hub = fuse(cylinder(40, 10), cylinder(20, 30))
    drilled = [cylinder(2, 30, (0, 0, 20), (1, 0, 0)), cylinder(2, 30, (0, 30, 5), DOWN)]
    among = parts(cut(hub, cylinder(10, 30), *drilled))
    for words in ("radial hole", "set screw hole", "radial screw hole in hub"):
        (hole,) = meant(among, words)
        assert hole.axis is not None
        assert abs(hole.axis[0]) == pytest.approx(1.0)
    assert len(meant(among, "hole")) == 3


def test_a_hole_beside_the_axis_is_not_radial() -> None:
    shape = cut(cylinder(20, 30), cylinder(8, 30), cylinder(2, 60, (-30, 13, 15), (1, 0, 0)))
    assert named(shape, "radial hole") == []


def test_an_ear_is_a_projection_with_a_hole() -> None:
    ears = [box((24, 10, 6), (30, y, 0)) for y in (-20, 10)]
    drilled = cut(fuse(box((60, 60, 40), (-30, -30, 0)), *ears), cylinder(2.5, 6, (48, -15, 0)))
    found = named(drilled, "ear")
    assert len(found) == 1
    assert found[0].center[1] < 0


def test_the_round_ends_of_a_slot_are_no_arcs_where_there_are_others() -> None:
    slot = [cylinder(4, 10, (x, 0, -10)) for x in (-10, 10)] + [box((20, 8, 10), (-10, -4, -10))]
    among = parts(cut(plate(100, 60, 10), *slot, cylinder(22, 10, (0, 48, -10))))
    assert {round(p.radius or 0, 6) for p in meant(among, "concave arc")} == {0.022}
    assert len([p for p in among if p.kind == "arc"]) == 3


def test_a_tight_row_of_holes_is_for_pins_and_not_for_screws() -> None:
    row = [cylinder(0.5, 4, (2.54 * i - 6, 0, -4)) for i in range(6)]
    corners = [cylinder(1.6, 4, (x, y, -4)) for x in (-25, 25) for y in (-15, 15)]
    assert diameters_mm(named(cut(plate(60, 40, 4), *row, *corners), "mounting hole")) == [3.2] * 4
    assert diameters_mm(named(cut(plate(60, 40, 4), *row), "mounting hole")) == [1.0] * 6


def test_a_hole_lies_in_the_wall_that_it_is_cut_into_and_not_in_one_that_it_is_seen_through() -> None:
    walls = cut(box((80, 50, 50), (-40, -25, 0)), box((72, 60, 50), (-36, -30, 4)))
    right = [cylinder(3, 10, (35, y, 30), (1, 0, 0)) for y in (-10, 0, 10)]
    among = parts(cut(walls, cylinder(20, 10, (-45, 0, 28), (1, 0, 0)), *right))
    assert diameters_mm(meant(among, "hole in left wall")) == [40.0]
    assert diameters_mm(meant(among, "hole in right wall")) == [6.0] * 3
    assert diameters_mm(meant(among, "small holes in the right wall")) == [6.0] * 3
    assert meant(among, "hole in front wall") == []


def test_the_counterbore_of_a_slot_is_no_slot_of_its_own() -> None:
    def obround(length: float, width: float, top: float, depth: float) -> list[TopoDS_Shape]:
        ends = [cylinder(width / 2, depth, (x, 0, top - depth)) for x in (-length / 2, length / 2)]
        return [*ends, box((length, width, depth), (-length / 2, -width / 2, top - depth))]

    shape = cut(plate(80, 40, 12), *obround(24, 7, 0, 12), *obround(24, 14, 0, 5))
    (slot,) = named(shape, "slot")
    assert slot.width == pytest.approx(0.007)


def test_a_plate_that_lies_flat_is_horizontal() -> None:
    angle = parts(fuse(box((60, 40, 5), (0, 0, 0)), box((5, 40, 50), (0, 0, 0))))
    (lying,) = meant(angle, "horizontal plate")
    (standing,) = meant(angle, "vertical plate")
    assert lying.extents[2] == pytest.approx(0.005)
    assert standing.extents[2] > 0.04


def test_a_cylinder_on_a_disc_is_not_the_disc() -> None:
    (standing,) = named(fuse(cylinder(40, 8), cylinder(25, 14, (0, 0, 8))), "cylinder on the base")
    assert standing.diameter == pytest.approx(0.05)


def test_a_cross_hole_runs_square_to_the_length_of_a_long_part() -> None:
    bar = box((20, 20, 100), (-10, -10, 0))
    among = parts(cut(bar, cylinder(3, 100), cylinder(4, 30, (0, -15, 60), (0, 1, 0))))
    assert diameters_mm(meant(among, "cross hole")) == [8.0]
    cube = cut(box((40, 40, 40)), cylinder(3, 40, (20, 20, 0)))
    assert named(cube, "cross hole") == []


def test_a_hole_at_the_side_is_neither_bored_from_above_nor_from_below() -> None:
    among = parts(cut(box((60, 40, 20)), cylinder(3, 20, (30, 20, 0)), cylinder(2, 15, (0, 20, 10), (1, 0, 0))))
    assert diameters_mm(meant(among, "hole at side")) == [4.0]
    assert diameters_mm(meant(among, "hole")) == [4.0, 6.0]


def test_the_round_wall_around_a_bore_is_its_collar() -> None:
    arm = fuse(cylinder(19, 40), box((70, 16, 20), (10, -8, 10)))
    (collar,) = named(cut(arm, cylinder(14, 40)), "collar around bore")
    assert collar.diameter == pytest.approx(0.038)


def test_a_shape_belongs_to_its_noun_over_a_noun_between_them() -> None:
    clamp = cut(box((40, 30, 20), (-20, -15, 0)), cylinder(9, 30, (0, -15, 20), (0, 1, 0)), cylinder(2, 8, (15, 0, 12)))
    (seat,) = named(clamp, "the half round bar seat")
    assert seat.radius == pytest.approx(0.009)


def test_a_raised_key_is_no_product() -> None:
    (key,) = named(fuse(box((60, 40, 10)), box((30, 8, 4), (15, 16, 10))), "rectangular key")
    assert sorted(key.extents) == pytest.approx([0.004, 0.008, 0.03])


def test_a_conical_point_is_a_cone() -> None:
    (point,) = named(fuse(cylinder(7, 60), cone(7, 1, 8, (0, 0, 60))), "conical point")
    assert point.kind == "cone"


def test_dowel_holes_have_the_size_of_a_dowel_pin_where_others_have_not() -> None:
    screws = [cylinder(2.75, 10, (x, y, 0)) for x in (8, 52) for y in (8, 32)]
    dowels = [cylinder(2, 10, (x, 20, 0)) for x in (8, 52)]
    assert diameters_mm(named(cut(box((60, 40, 10)), *screws, *dowels), "dowel hole")) == [4.0, 4.0]
    assert diameters_mm(named(cut(box((60, 40, 10)), *screws), "dowel hole")) == [5.5] * 4
