"""Arms that run out from a hub: free, rounded, to an eye or a rim; and what is none."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, cylinder, edges, filleted, find, fuse, turned, upright

MM = 1e-3


def star(count: int, height: float = 42.0) -> TopoDS_Shape:
    """Arms 16 wide, 12 thick, that reach 85 from the axis of a hub of 26 and end round."""
    arm = fuse(box((77, 16, 12), (0, -8, 0)), cylinder(8, 12, (77, 0, 0)))
    return fuse(cylinder(26, height), *(turned(arm, (0, 0, 1), i * 360 / count) for i in range(count)))


@pytest.mark.parametrize("count", [1, 3, 4])
def test_arms_are_measured_from_the_hub_to_their_round_end(count: int) -> None:
    arms = [part for part in find(star(count)).of("prism") if "arm" in part.tags]
    assert len(arms) == count
    for arm in arms:
        assert (arm.width, arm.thickness, arm.length) == pytest.approx((16 * MM, 12 * MM, 59 * MM))
        assert math.dist((0, 0), (arm.tip or (0, 0))[:2]) == pytest.approx(85 * MM)


def test_fillets_at_the_root_and_rounds_along_the_edges_change_nothing() -> None:
    lever = star(1)
    root = [edge for edge in upright(lever) if _off_axis(edge) < 26.5]
    (arm,) = [part for part in find(filleted(lever, 4, *root)).of("prism") if "arm" in part.tags]
    assert (arm.width, arm.thickness, arm.length) == pytest.approx((16 * MM, 12 * MM, 59 * MM))


def _off_axis(edge: object) -> float:
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    point = BRepAdaptor_Curve(edge).Value(0.0)
    return math.hypot(point.X(), point.Y())


def test_an_arm_to_an_eye_ends_there() -> None:
    lever = fuse(cylinder(22, 32), box((110, 18, 10), (0, -9, 0)), cylinder(14, 20, (110, 0, 0)))
    (arm,) = [part for part in find(lever).of("prism") if "arm" in part.tags]
    assert arm.width == pytest.approx(18 * MM)
    assert arm.length == pytest.approx(77 * MM, rel=0.02)
    assert arm.center_length == pytest.approx(110 * MM)


def test_an_arm_with_nothing_round_at_its_end_has_no_length_between_centres() -> None:
    bar = fuse(cylinder(22, 32), box((110, 18, 10), (0, -9, 0)))
    for lever, length in ((bar, None), (cut(bar, cylinder(4, 10, (96, 0, 0))), 96 * MM)):
        (arm,) = [part for part in find(lever).of("prism") if "arm" in part.tags]
        assert arm.center_length == (None if length is None else pytest.approx(length))


def test_an_arm_between_two_hubs_points_away_from_the_one_with_more_arms() -> None:
    arms = [turned(box((70, 14, 10), (0, -7, 0)), (0, 0, 1), way) for way in (0, 135)]
    eyes = [turned(cylinder(10, 40, (70, 0, 0)), (0, 0, 1), way) for way in (0, 135)]  # wider ones are beside the hub
    crank = fuse(*eyes, *arms, cylinder(16, 10))
    found = [part for part in find(crank).of("prism") if "arm" in part.tags]
    assert sorted(round(math.degrees(math.atan2(arm.axis[1], arm.axis[0]))) for arm in found if arm.axis) == [0, 135]


def test_spokes_end_at_the_inside_of_the_rim() -> None:
    rim = cut(cylinder(90, 32), cylinder(74, 32))
    spokes = (turned(box((80, 18, 12), (0, -9, 10)), (0, 0, 1), i * 72) for i in range(5))
    wheel = cut(fuse(rim, cylinder(25, 44), *spokes), cylinder(12, 44))
    found = [part for part in find(wheel).of("prism") if "spoke" in part.tags]
    assert len(found) == 5
    assert {round(1e3 * (spoke.length or 0), 3) for spoke in found} == {49.0}
    assert {spoke.center_length for spoke in found} == {None}


def test_ribs_around_a_post_and_pads_are_no_arms() -> None:
    plate = box((100, 100, 10), (-50, -50, 0))
    ribs = (turned(box((42, 8, 44), (0, -4, 10)), (0, 0, 1), 90 * i) for i in range(4))
    post = fuse(plate, cylinder(18, 60, (0, 0, 10)), *ribs)
    assert not [part for part in find(post).parts if "arm" in part.tags]
    block = fuse(box((60, 40, 10)), box((20, 8, 10), (20, 16, 10)))
    assert not [part for part in find(block).parts if "arm" in part.tags]
    assert edges(block)


@pytest.mark.parametrize("degrees", [0, 35])
def test_an_arm_may_run_tangentially_into_a_hub_that_stands_out_beyond_it_and_a_link_has_none(degrees: float) -> None:
    for high, arms in ((22, 1), (8, 0)):
        lever = fuse(cylinder(18, high), box((80, 36, 8), (0, -18, 0)), cylinder(18, 8, (80, 0, 0)))
        lever = cut(lever, cylinder(8, high), cylinder(5, 8, (80, 0, 0)))
        found = [part for part in find(turned(lever, (1, 2, 3), degrees)).of("prism") if "arm" in part.tags]
        assert [part.thickness for part in found] == pytest.approx([8e-3] * arms)
        assert [part.width for part in found] == pytest.approx([36e-3] * arms)


def test_an_arm_to_an_eye_is_no_elevation() -> None:
    hubs = fuse(cylinder(22, 32, (0, 0, -16)), cylinder(14, 20, (110, 0, -10)))
    lever = find(fuse(hubs, box((110, 18, 10), (0, -9, -5))))
    assert [part for part in lever.of("prism") if "arm" in part.tags]
    assert not lever.of("elevation")


def test_a_spider_in_a_frame_is_no_plate_nor_are_its_openings_hollows_and_arms_without_a_rim_make_a_plate() -> None:
    frame = cut(fuse(box((80, 80, 4), (-40, -40, 0)), cylinder(40, 25)), cylinder(38, 25))
    struts = (turned(box((38, 5, 6), (0, -2.5, 0)), (0, 0, 1), 45 + 90 * i) for i in range(4))
    spider = cut(fuse(cylinder(16, 6), *struts), cylinder(4, 6))
    found = find(fuse(frame, spider))
    spokes = [part for part in found.parts if "spoke" in part.tags]
    assert len(spokes) == 4
    assert not [spoke for spoke in spokes if "foot" in spoke.tags]  # they hold the hub, and nothing stands on them
    assert len([part for part in found.of("prism") if "plate" in part.tags]) == 1
    assert not found.of("depression")
    free = find(spider)
    assert [part for part in free.of("prism") if "plate" in part.tags]
