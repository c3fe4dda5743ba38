"""From which sides is a part visible?"""

from __future__ import annotations

import math

from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import DOWN, box, compound, cone, cut, cylinder, find, fuse, plate, turned

from querycad_contracts import Part, Side


def seen(shape: TopoDS_Shape, kind: str = "hole") -> list[Part]:
    return [part for part in find(shape).seen_parts if part.kind == kind]


def test_a_through_hole_is_visible_from_both_of_its_ends() -> None:
    (hole,) = seen(cut(plate(), cylinder(4, 30, (5, 5, -25))))
    assert set(hole.sides) == {Side.TOP, Side.BOTTOM}


def test_a_slot_cut_through_a_plate_from_its_edge_is_visible_both_ways_and_from_that_edge() -> None:
    (slot,) = seen(cut(plate(60, 40, 10), box((30, 6, 10), (5, -3, -10))), "slot")
    assert set(slot.sides) == {Side.TOP, Side.BOTTOM, Side.RIGHT}


def test_a_hole_in_the_floor_of_a_pocket_is_visible_through_the_pocket() -> None:
    pocket = box((30, 20, 10), (-15, -10, -10))
    (hole,) = seen(cut(plate(), pocket, cylinder(4, 5, (0, 0, -10), DOWN)))
    assert hole.sides == (Side.TOP,)


def test_a_hole_in_the_wall_of_a_deep_pocket_is_visible_only_through_its_other_end() -> None:
    pocket = box((20, 20, 15), (-10, -10, -15))
    holes = seen(cut(plate(), pocket, cylinder(2, 20, (10, 0, -8), (1, 0, 0))))
    assert [hole.sides for hole in holes] == [(Side.RIGHT,)]


def test_a_hole_under_a_roof_is_hidden_from_above() -> None:
    roof = fuse(box((40, 40, 4), (-20, -20, 20)), box((4, 40, 20), (-20, -20, 0)))
    (hole,) = seen(cut(fuse(plate(), roof), cylinder(4, 8, along=DOWN)))
    assert Side.TOP not in hole.sides


def test_a_cavity_with_a_hole_inside_is_visible_from_nowhere() -> None:
    closed = cut(box((60, 60, 60), (-30, -30, -30)), box((40, 40, 40), (-20, -20, -20)))
    (hole,) = seen(cut(closed, cylinder(4, 6, (0, 0, -20), DOWN)))
    assert hole.sides == ()


def test_an_oblique_hole_is_visible_from_the_sides_it_leans_to() -> None:
    lean = math.radians(45)
    along = (-math.sin(lean), 0.0, -math.cos(lean))
    shape = cut(box((60, 40, 40), (-60, -20, -40)), cylinder(4, 20, (8 * -along[0] - 5, 0, 8 * -along[2] - 5), along))
    (hole,) = seen(shape)
    assert set(hole.sides) <= {Side.TOP, Side.RIGHT}
    assert hole.sides


def test_a_closed_body_is_visible_from_everywhere_and_a_covered_one_from_where_it_shows() -> None:
    (body,) = seen(plate(), "body")
    assert set(body.sides) == set(Side)


def test_a_boss_below_is_not_visible_from_above() -> None:
    (boss,) = seen(fuse(plate(), cylinder(5, 10, (0, 0, -20), DOWN)), "boss")
    assert Side.TOP not in boss.sides
    assert Side.BOTTOM in boss.sides


def test_sides_turn_with_the_model() -> None:
    (hole,) = seen(turned(cut(plate(), cylinder(4, 8, along=DOWN)), (1, 0, 0), 90))
    assert hole.sides == (Side.FRONT,)


def test_a_post_exactly_behind_another_one_is_not_visible_from_the_front() -> None:
    posts = seen(fuse(plate(), box((10, 10, 30), (-5, -18, 0)), box((10, 10, 30), (-5, 8, 0))), "protrusion")
    front, rear = sorted(posts, key=lambda post: post.center[1])
    assert Side.FRONT in front.sides
    assert Side.FRONT not in rear.sides
    assert Side.BACK in rear.sides


def test_a_boss_glimpsed_through_the_holes_of_what_covers_it_is_not_visible() -> None:
    boss = fuse(plate(), cylinder(12, 2, (0, 0, -0.001)), cone(12, 11, 1, (0, 0, 1.999)))
    holes = [cylinder(1.5, 20, (11.5 * math.cos(a), 11.5 * math.sin(a), 2)) for a in (0.3, 1.9, 3.5)]
    cover = cut(cylinder(15, 10), cylinder(12.5, 3.5, (0, 0, -0.2)), *holes)
    hidden, lid = (part for part in seen(compound(boss, cover), "boss") if part.radius and part.radius > 0.01)
    assert Side.TOP not in hidden.sides
    assert Side.TOP in lid.sides


def test_the_end_of_a_shaft_that_sticks_out_of_its_housing_is_visible_from_beside() -> None:
    housing = cut(box((60, 40, 40), (-30, -20, -20)), cylinder(6, 50, (-25, 0, 0), (1, 0, 0)))
    shaft = fuse(cylinder(5.9, 40, (-20, 0, 0), (1, 0, 0)), cylinder(4, 26, (19.99, 0, 0), (1, 0, 0)))
    ends = [part for part in seen(compound(housing, shaft), "boss") if part.radius and part.radius < 0.005]
    assert ends
    assert all({Side.TOP, Side.FRONT, Side.RIGHT} <= set(part.sides) for part in ends)


def test_of_holes_in_a_row_on_one_axis_one_sees_the_first() -> None:
    lower = cut(box((40, 40, 6), (-20, -20, 0)), cylinder(3, 6))
    upper = cut(box((40, 40, 6), (-20, -20, 6)), cylinder(4, 6, (0, 0, 6)))
    below, above = sorted(seen(compound(lower, upper)), key=lambda hole: hole.center[2])
    assert below.sides == (Side.BOTTOM,)
    assert above.sides == (Side.TOP,)


def test_a_hole_much_narrower_than_the_one_before_it_is_told_apart() -> None:
    lower = cut(box((40, 40, 6), (-20, -20, 0)), cylinder(2, 6))
    upper = cut(box((40, 40, 6), (-20, -20, 6)), cylinder(10, 6, (0, 0, 6)))
    below, _ = sorted(seen(compound(lower, upper)), key=lambda hole: hole.center[2])
    assert set(below.sides) == {Side.TOP, Side.BOTTOM}


def test_a_round_part_is_visible_end_on() -> None:
    discs = seen(fuse(cylinder(20, 5), cylinder(8, 10, (0, 0, 5))), "boss")
    base = max(discs, key=lambda disc: disc.radius or 0.0)
    assert Side.BOTTOM in base.sides


def test_a_slot_is_visible_from_the_side_that_it_runs_out_at() -> None:
    (slot,) = seen(cut(plate(60, 40, 20), box((40, 8, 6), (0, -4, -6))), "slot")
    assert {Side.TOP, Side.RIGHT} <= set(slot.sides)
    assert Side.LEFT not in slot.sides


def test_a_bolt_circle_is_visible_where_all_of_its_holes_are() -> None:
    holes = [cylinder(2, 30, (15 * x, 15 * y, -25)) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    (through,) = seen(cut(plate(), *holes), "pattern")
    assert set(through.sides) == {Side.TOP, Side.BOTTOM}
    blind = [cylinder(2, 5, (15 * x, 15 * y, 0), DOWN) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    (closed,) = seen(cut(plate(), *blind), "pattern")
    assert closed.sides == (Side.TOP,)


def test_a_groove_around_a_boss_that_stands_out_of_it_is_seen_from_where_it_opens() -> None:
    """Its middle is filled: one looks in beside the boss, and not where a lid lies on the groove."""
    ring = cut(box((100, 20, 100), (-50, 0, -50)), cylinder(30, 10, (0, 10, 0), (0, 1, 0)))
    open_groove = fuse(ring, cylinder(25, 30, (0, 10, 0), (0, 1, 0)))
    (groove,) = seen(open_groove, "groove")
    assert groove.sides == (Side.BACK,)
    lid = cut(cylinder(45, 5, (0, 20, 0), (0, 1, 0)), cylinder(25, 5, (0, 20, 0), (0, 1, 0)))
    (covered,) = seen(compound(open_groove, lid), "groove")
    assert covered.sides == ()
