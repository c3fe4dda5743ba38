"""How far edges reach: arcs to their farthest point, wherever on them that lies."""

import math

import pytest
from tests.segworker.shapes import box, cut, cylinder, extruded, filleted, find, turned, upright

from querycad_segworker.features.shared.reach import edges_span
from querycad_segworker.topology import EdgeKind, EdgeRecord
from querycad_segworker.vectors import add, cross, dot, scale, sub, unit

SIDE, ROUND = 100.0, 10.0
CORE = SIDE - 2 * math.sqrt(3) * ROUND
"""Between the middles of the rounds."""
TRIANGLE = extruded([(0, 0), (SIDE, 0), (SIDE / 2, SIDE * math.sqrt(3) / 2)], 0, 8)


@pytest.mark.parametrize("degrees", [0.0, 17.0])
def test_a_plate_reaches_to_the_middle_of_no_arc_but_to_its_farthest_point(degrees: float) -> None:
    (plate,) = find(turned(filleted(TRIANGLE, ROUND, *upright(TRIANGLE)), (0, 0, 1), degrees)).of("prism")
    assert plate.width == pytest.approx(1e-3 * (CORE * math.sqrt(3) / 2 + 2 * ROUND))
    assert plate.length == pytest.approx(1e-3 * (CORE + 2 * ROUND))


def test_a_plate_with_square_corners_rounded_keeps_its_size() -> None:
    block = box((60, 40, 5))
    (plate,) = find(filleted(block, 6, *upright(block))).of("prism")
    assert plate.length == pytest.approx(0.06)
    assert plate.width == pytest.approx(0.04)


def test_every_arc_reaches_from_its_lowest_to_its_highest_point() -> None:
    shape = cut(
        filleted(TRIANGLE, ROUND, *upright(TRIANGLE)), cylinder(9, 20, (5, -2, -1)), cylinder(4, 20, (50, 30, -1))
    )
    brep = find(turned(shape, (1, 2, 3), 40)).brep
    arcs = [edge for edge in brep.edges if edge.kind is EdgeKind.CIRCLE]
    assert {edge.closed for edge in arcs} == {True, False}
    for way in (unit((1, 0, 0)), unit((1, 2, 3)), unit((-3, 1, 0.5)), unit((0.2, -1, 4))):
        for edge in arcs:
            along = [dot(point, way) for point in _points(edge)]
            assert edges_span(brep, (edge.id,), way) == pytest.approx((min(along), max(along)), abs=1e-8)


def _points(edge: EdgeRecord) -> list[tuple[float, float, float]]:
    """2001 points from one end of an arc to the other."""
    assert edge.center is not None
    assert edge.axis is not None
    assert edge.radius is not None
    to_mid = sub(edge.mid, edge.center)
    aside, half = cross(edge.axis, to_mid), edge.length / edge.radius / 2
    angles = [half * i / 1000 for i in range(-1000, 1001)]
    return [add(edge.center, add(scale(to_mid, math.cos(a)), scale(aside, math.sin(a)))) for a in angles]
