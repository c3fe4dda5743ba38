"""Teeth around an axis: counted, with tip and root diameter; fine pointed ones on the outside are a knurl."""

from __future__ import annotations

import math

import pytest
from tests.segworker.shapes import Found, cut, cylinder, extruded, find, turned

MM = 1e-3


def trapezoids(count: int, root: float, tip: float) -> list[tuple[float, float]]:
    """Teeth with a flat tip and a flat bottom."""
    pitch = 2 * math.pi / count
    corners = [(root, 0.0), (root, 0.35), (tip, 0.5), (tip, 0.8)]
    return [
        (r * math.cos((i + share) * pitch), r * math.sin((i + share) * pitch))
        for i in range(count)
        for r, share in corners
    ]


def points(count: int, root: float, tip: float) -> list[tuple[float, float]]:
    """A star: two flanks a tooth."""
    return [
        (r * math.cos(i * math.pi / count), r * math.sin(i * math.pi / count))
        for i in range(2 * count)
        for r in (tip if i % 2 else root,)
    ]


@pytest.mark.parametrize(("count", "degrees"), [(8, 0), (23, 0), (23, 35)])
def test_a_gear_has_its_teeth_counted_and_its_tip_and_root_diameter(count: int, degrees: float) -> None:
    shape = cut(extruded(trapezoids(count, 16, 20), 0, 10), cylinder(5, 10))
    (gear,) = find(turned(shape, (1, 2, 3), degrees)).of("gear")
    assert gear.count == count == len(gear.children)
    # The flat bottoms run a little below the root circle on which their ends lie.
    assert list(gear.radii) == pytest.approx([20 * MM, 16 * MM], rel=0.03)
    assert gear.width == pytest.approx(10 * MM)
    assert "knurl" not in gear.tags


def knurled(count: int, root: float) -> Found:
    return find(cut(extruded(points(count, root, 20), 0, 12), cylinder(5, 12)))


def test_fine_pointed_teeth_around_a_knob_are_a_knurl() -> None:
    (knurl,) = knurled(60, 19.2).of("gear")
    assert "knurl" in knurl.tags
    assert knurl.label.startswith("knurl")
    assert knurl.count == 60
    assert list(knurl.radii) == pytest.approx([20 * MM, 19.2 * MM])


def test_deep_pointed_teeth_are_a_ratchet_and_no_knurl() -> None:
    (ratchet,) = knurled(24, 16).of("gear")
    assert (ratchet.count, "knurl" in ratchet.tags) == (24, False)


def test_a_star_of_five_points_is_neither() -> None:
    assert knurled(5, 12).of("gear") == []
