"""Bottoms of blind holes, round or pointed, are bottoms; counterbores across two bodies."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import (
    ball,
    box,
    compound,
    cone,
    cut,
    cylinder,
    filleted,
    find,
    halved,
    nurbs,
    plate,
    rims,
    turned,
)

MM = 1e-3


def rounded_tool() -> TopoDS_Shape:
    tool = cylinder(5, 14, (0, 0, -12))
    return filleted(tool, 2, *rims(tool, 5, -12))


def drilled(*tools: TopoDS_Shape) -> TopoDS_Shape:
    return cut(plate(60, 40, 20), *tools)


BLIND = [
    (drilled(cylinder(5, 10, (0, 0, -10)), cone(0, 5, 3, (0, 0, -13))), "conical", 10.0),
    (drilled(cylinder(5, 10, (0, 0, -10)), ball(5, (0, 0, -10))), "spherical", 10.0),
    (drilled(cylinder(5, 10, (0, 0, -10)), ball(7, (0, 0, -6))), "spherical", 10.899),
    (drilled(cone(0, 6, 12, (0, 0, -12))), "conical", 12.0),
    (drilled(rounded_tool()), "flat", 12.0),
]


@pytest.mark.parametrize("change", [lambda s: s, halved, nurbs, lambda s: turned(s, (1, 2, 3), 40)])
@pytest.mark.parametrize(("shape", "bottom", "depth"), BLIND)
def test_a_blind_hole_with_any_bottom_is_not_through(
    change: Callable[[TopoDS_Shape], TopoDS_Shape], shape: TopoDS_Shape, bottom: str, depth: float
) -> None:
    (hole,) = find(change(shape)).of("hole")
    assert (hole.bottom, "blind" in hole.tags) == (bottom, True)
    assert hole.depth == pytest.approx(depth * MM, rel=1e-3)


def test_what_goes_on_beyond_the_cone_is_through() -> None:
    shape = drilled(cylinder(5, 15, (0, 0, -15)), cone(0, 5, 6, (0, 0, -21)))
    (hole,) = find(shape).of("hole")
    assert hole.bottom == "through"


def test_what_a_ball_leaves_is_no_cutout() -> None:
    found = find(drilled(ball(8, (0, 0, -4))))
    assert (len(found.of("dimple")), found.of("cutout")) == (1, [])


def stacked(wide: float, apart: float = 0.0) -> TopoDS_Shape:
    """A plate of 10 mm with a hole of 6 mm, and on it one of 5 mm with a hole of `wide`."""
    lower = cut(box((60, 40, 10)), cylinder(3, 10, (30, 20, 0)))
    return compound(lower, cut(box((60, 40, 5), (0, 0, 10 + apart)), cylinder(wide / 2, 5, (30, 20, 10 + apart))))


def test_a_wide_hole_over_a_narrow_one_of_another_body_is_its_counterbore() -> None:
    found = find(turned(stacked(11.0), (1, 2, 3), 40))
    (counterbore,) = found.of("counterbore")
    assert (counterbore.diameter, counterbore.depth) == pytest.approx((11 * MM, 5 * MM))
    (hole,) = [hole for hole in found.of("hole") if "counterbored" in hole.tags]
    assert hole.diameter == pytest.approx(6 * MM)
    assert counterbore.id in hole.children


@pytest.mark.parametrize(("wide", "apart"), [(8.0, 0.0), (6.0, 0.0), (11.0, 2.0)])
def test_a_clearance_hole_or_one_at_a_distance_is_no_counterbore(wide: float, apart: float) -> None:
    assert find(stacked(wide, apart)).of("counterbore") == []
