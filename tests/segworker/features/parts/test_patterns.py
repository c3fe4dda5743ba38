"""Patterns: what was laid out on a circle, in a row or in a grid is one part that carries its members."""

from __future__ import annotations

import math

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import Found, box, compound, cut, cylinder, find, fuse, plate, scaled, shifted, turned

from querycad_contracts import Part

MM = 1e-3


def only(found: Found, tag: str) -> Part:
    (pattern,) = found.of("pattern")
    assert tag in pattern.tags
    return pattern


def drilled(shape: TopoDS_Shape, spots: list[tuple[float, float]], radius: float = 2.0) -> TopoDS_Shape:
    return cut(shape, *(cylinder(radius, 80, (x, y, -40)) for x, y in spots))


def circle(count: int, radius: float, start: float = 0.0) -> list[tuple[float, float]]:
    angles = [start + 2 * math.pi * i / count for i in range(count)]
    return [(radius * math.cos(a), radius * math.sin(a)) for a in angles]


@pytest.mark.parametrize("count", [3, 4, 6, 8])
def test_like_holes_around_a_bore_are_a_bolt_circle(count: int) -> None:
    flange = cut(cylinder(30, 8), cylinder(10, 8))
    pattern = only(find(drilled(flange, circle(count, 22, 0.3))), "bolt_circle")
    assert pattern.count == count == len(pattern.children)
    assert pattern.diameter == pytest.approx(44 * MM)
    assert pattern.pitch == pytest.approx(44 * MM * math.sin(math.pi / count))
    assert pattern.center == pytest.approx((0, 0, 4 * MM), abs=1e-9)


def test_its_holes_know_that_they_lie_on_it_and_the_bore_does_not() -> None:
    found = find(drilled(cut(cylinder(30, 8), cylinder(10, 8)), circle(6, 22)))
    on_it = [hole.id for hole in found.of("hole") if "bolt_circle" in hole.tags]
    assert sorted(on_it) == sorted(only(found, "bolt_circle").children)
    assert len(on_it) == len(found.of("hole")) - 1


@pytest.mark.parametrize("factor", [0.05, 1.0, 30.0])
def test_a_bolt_circle_is_found_at_any_size_and_in_any_place(factor: float) -> None:
    flange = drilled(cut(cylinder(30, 8), cylinder(10, 8)), circle(5, 22))
    moved = shifted(turned(scaled(flange, factor), (1, 2, 3), 50), (70, -40, 20))
    pattern = only(find(moved), "bolt_circle")
    assert pattern.count == 5
    assert pattern.diameter == pytest.approx(44 * factor * MM, rel=1e-5)


def test_holes_in_a_line_at_equal_distances_are_a_row() -> None:
    pattern = only(find(drilled(plate(100, 20, 5), [(x, 3) for x in (-30, -15, 0, 15, 30)])), "row")
    assert pattern.count == 5
    assert [pattern.pitch, pattern.length] == pytest.approx([15 * MM, 60 * MM])


def test_rows_and_columns_of_holes_are_one_grid() -> None:
    spots = [(10.0 * i, 14.0 * j) for i in range(-2, 3) for j in range(-1, 2)]
    pattern = only(find(drilled(plate(60, 50, 5), spots)), "grid")
    assert pattern.count == 15
    assert [pattern.pitch, pattern.length, pattern.width] == pytest.approx([10 * MM, 40 * MM, 28 * MM])


def test_a_square_grid_of_holes_is_one_grid_and_not_circles_around_its_holes() -> None:
    spots = [(7.0 * i, 7.0 * j) for i in range(-2, 3) for j in range(-2, 2)]
    corners = [(x, y) for x in (-26.0, 26.0) for y in (-17.0, 17.0)]
    found = find(drilled(drilled(plate(60, 40, 5), spots), corners, 2.1))
    assert sorted((pattern.tags[0], pattern.count) for pattern in found.of("pattern")) == [
        ("grid", 20),
        ("rectangle", 4),
    ]


def test_rectangular_cutouts_make_a_grid_as_well() -> None:
    tools = [box((6, 3, 20), (12.0 * i - 3, 8.0 * j - 1.5, -10)) for i in range(-1, 2) for j in range(2)]
    pattern = only(find(cut(plate(60, 40, 5), *tools)), "grid")
    assert pattern.count == 6
    assert "cutout" in pattern.tags


def test_standoffs_in_the_corners_are_a_pattern_of_bosses() -> None:
    posts = [cylinder(3, 8, (x, y, 0)) for x in (-20, 20) for y in (-12, 12)]
    pattern = only(find(fuse(plate(), *posts)), "rectangle")
    assert pattern.count == 4
    assert "boss" in pattern.tags


@pytest.mark.parametrize(
    "spots",
    [
        [(-20.0, 0.0), (0.0, 7.0), (20.0, 0.0)],
        [(-20.0, 0.0), (0.0, 0.0), (15.0, 0.0)],
        [(-20.0, -10.0), (20.0, 10.0)],
    ],
)
def test_holes_without_a_layout_are_no_pattern(spots: list[tuple[float, float]]) -> None:
    assert find(drilled(plate(), spots)).of("pattern") == []


def test_rows_that_stand_apart_are_rows_though_there_are_like_holes_elsewhere() -> None:
    rows = [(x, -25.0) for x in (-10.0, 0.0, 10.0)] + [(40.0, y) for y in (-3.0, 7.0, 17.0)]
    found = find(drilled(plate(100, 60, 10), [*rows, (-43.0, 22.0), (13.0, 21.0)]))
    assert [pattern.count for pattern in found.of("pattern")] == [3, 3]
    assert [pattern.length for pattern in found.of("pattern")] == pytest.approx([20 * MM] * 2)
    assert all("row" in pattern.tags for pattern in found.of("pattern"))


@pytest.mark.parametrize("aside", [[(-10.0, 6.0), (3.0, 7.0), (14.0, 21.0)], [(20.0, 0.0), (33.0, 0.0), (14.0, 21.0)]])
def test_three_of_many_that_happen_to_lie_in_a_line_are_no_row(aside: list[tuple[float, float]]) -> None:
    """Nearer ones lie beside them, or the line goes on unevenly."""
    found = find(drilled(plate(100, 60, 10), [(-10.0, 0.0), (0.0, 0.0), (10.0, 0.0), *aside]))
    assert not found.of("pattern")


def test_holes_of_different_sizes_are_no_pattern() -> None:
    shape = drilled(drilled(plate(), [(-20.0, 0.0), (0.0, 0.0)]), [(20.0, 0.0)], 3.0)
    assert find(shape).of("pattern") == []


def test_holes_of_two_bodies_are_two_patterns() -> None:
    one = drilled(plate(100, 20, 5), [(x, 3) for x in (-30, 0, 30)])
    assert len(find(compound(one, shifted(one, (0, 40, 0)))).of("pattern")) == 2


def test_a_bolt_circle_may_leave_out_places() -> None:
    flange = cut(cylinder(50, 8), cylinder(20, 8))
    circled = only(find(drilled(flange, circle(12, 38)[3:])), "bolt_circle")
    assert circled.count == 9
    assert circled.diameter == pytest.approx(76 * MM)
    assert circled.pitch == pytest.approx(76 * MM * math.sin(math.pi / 12))


@pytest.mark.parametrize("places", [(0, 1, 2, 4, 5), (0, 1, 3)])
def test_holes_on_too_few_places_of_a_circle_are_none(places: tuple[int, ...]) -> None:
    flange = cut(cylinder(50, 8), cylinder(20, 8))
    assert not find(drilled(flange, [circle(8, 38)[i] for i in places])).of("pattern")
