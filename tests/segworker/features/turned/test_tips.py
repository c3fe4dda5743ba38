"""The ends of shafts, rods and screws: which are free, which one is the tip."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import DOWN, Found, box, compound, cone, cut, cylinder, extruded, find, fuse, gear, turned

from querycad_contracts import Part

MM = 1e-3
X = (1.0, 0.0, 0.0)


def tips(part: Part) -> list[tuple[float, ...]]:
    """In millimetres."""
    return sorted(tuple(round(c / MM, 6) + 0.0 for c in tip) for tip in part.tips)


def body(found: Found, index: int) -> Part:
    return found.of("body")[index]


def housing(depth: float) -> TopoDS_Shape:
    """A block with a bore of 10 mm from its right side, at x = 0, so deep."""
    return cut(box((40, 30, 30), (-40, -15, -15)), cylinder(5, depth, (-depth, 0, 0), X))


def test_a_rod_alone_has_two_tips_and_a_pin_on_a_plate_one() -> None:
    rod = body(find(cylinder(4, 60)), 0)
    assert tips(rod) == [(0, 0, 0), (0, 0, 60)]
    assert rod.tip == rod.tips[0] == pytest.approx((0, 0, 60 * MM))
    (pin,) = find(fuse(box((40, 40, 5), (-20, -20, -5)), cylinder(4, 12))).of("boss")
    assert tips(pin) == [(0, 0, 12)]


@pytest.mark.parametrize("move", [0, 73], ids=["along x", "oblique"])
def test_the_tip_of_a_shaft_in_a_blind_bore_is_the_end_outside(move: float) -> None:
    def placed(shape: TopoDS_Shape) -> TopoDS_Shape:
        return turned(shape, (1, 2, 3), move)

    apart = find(placed(cylinder(5, 60, (-20, 0, 0), X)))
    outside = max(apart.of("body")[0].tips, key=lambda tip: sum(c * c for c in tip))
    found = find(compound(placed(housing(20)), placed(cylinder(5, 60, (-20, 0, 0), X))))
    shaft = body(found, 1)
    assert shaft.tips == (shaft.tip,)
    assert shaft.tip == pytest.approx(outside)
    (boss,) = found.of("boss")
    assert boss.tip == pytest.approx(outside)


@pytest.mark.parametrize("move", [0, 73], ids=["upright", "oblique"])
def test_a_spindle_with_a_point_has_its_tip_there_and_one_with_two_points_has_both(move: float) -> None:
    point, other = cone(8, 2, 10, (0, 0, 60)), cone(8, 2, 10, along=(0, 0, -1))
    spindle = fuse(cylinder(8, 60), cylinder(14, 6, (0, 0, 40)), point)
    shaft = body(find(turned(spindle, (1, 2, 3), move)), 0)
    assert len(shaft.tips) == 1
    if not move:
        assert tips(shaft) == [(0, 0, 70)]
        (tapered,) = [boss for boss in find(spindle).of("boss") if "conical" in boss.tags]
        assert tips(tapered) == [(0, 0, 70)]
    assert len(body(find(fuse(spindle, other)), 0).tips) == 2


def test_both_ends_of_a_shaft_through_a_housing_are_free() -> None:
    shaft = body(find(compound(housing(40), cylinder(5, 100, (-70, 0, 0), X))), 1)
    assert tips(shaft) == [(-70, 0, 0), (30, 0, 0)]


def test_in_a_closed_housing_neither_end_is_free_and_both_are_tips() -> None:
    closed = cut(box((80, 30, 30), (-40, -15, -15)), box((70, 20, 20), (-35, -10, -10)))
    shaft = body(find(compound(closed, cylinder(5, 60, (-30, 0, 0), X))), 1)
    assert tips(shaft) == [(-30, 0, 0), (30, 0, 0)]


def test_a_shaft_is_as_thick_as_its_widest_step_that_is_no_collar_and_as_long_as_all() -> None:
    steps = fuse(cylinder(8, 30), cylinder(11, 40, (0, 0, 30)), cylinder(7, 25, (0, 0, 70)))
    shaft = body(find(fuse(steps, cylinder(16, 5, (0, 0, 45)))), 0)
    assert "screw" not in shaft.tags
    assert [shaft.diameter, shaft.length] == pytest.approx([22 * MM, 95 * MM])
    assert sorted(shaft.radii) == pytest.approx([7 * MM, 8 * MM, 11 * MM, 16 * MM])


@pytest.mark.parametrize("holes", [0, 6])
def test_a_shaft_with_a_gear_on_it_is_a_shaft(holes: int) -> None:
    teeth = gear(20, 25.0, 20.0, 15.0)
    teeth = cut(teeth, *(turned(cylinder(2, 15, (14, 0, 0)), (0, 0, 1), 360 * i / holes) for i in range(holes)))
    shaft = body(find(fuse(cylinder(8, 90, (0, 0, -40)), teeth)), 0)
    assert {"shaft", "slender"} <= set(shaft.tags)
    assert [shaft.diameter, shaft.length] == pytest.approx([16 * MM, 90 * MM])
    assert tips(shaft) == [(0, 0, -40), (0, 0, 50)]


def test_a_gear_with_a_hub_is_no_shaft() -> None:
    whole = body(find(fuse(cylinder(8, 40, (0, 0, -12)), gear(20, 25.0, 20.0, 15.0))), 0)
    assert "shaft" not in whole.tags
    assert whole.tip is None


def test_a_centre_hole_does_not_make_a_shaft_hollow_and_a_bore_does() -> None:
    plain = body(find(cut(cylinder(10, 80), cylinder(2, 8, (0, 0, 72)))), 0)
    assert "hollow" not in plain.tags
    assert plain.radii == pytest.approx([10 * MM])
    hollow = body(find(cut(cylinder(10, 80), cylinder(2, 80))), 0)
    assert "hollow" in hollow.tags
    assert hollow.radii == pytest.approx([10 * MM, 2 * MM])


@pytest.mark.parametrize("hexagonal", [True, False], ids=["hexagonal", "cylindrical"])
def test_a_screw_is_as_thick_as_its_shank_and_ends_at_the_shank(hexagonal: bool) -> None:
    corners = [(9.24, 0), (4.62, 8), (-4.62, 8), (-9.24, 0), (-4.62, -8), (4.62, -8)]
    head = extruded(corners, 0.0, 6.4) if hexagonal else cylinder(8, 9)
    screw = body(find(fuse(head, cylinder(5, 40, along=DOWN))), 0)
    assert "screw" in screw.tags
    assert [screw.diameter, screw.length] == pytest.approx([10 * MM, (46.4 if hexagonal else 49) * MM])
    assert tips(screw) == [(0, 0, -40)]
