"""What outlines are called, what is inside of them, and what only stands in them."""

from __future__ import annotations

import math

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, cylinder, filleted, find, fuse, plate, prism, shifted, upright

from querycad_contracts import Part

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-7)


def only(found: list[Part]) -> Part:
    (part,) = found
    return part


def arch(width: float, height: float, thickness: float) -> TopoDS_Shape:
    """A rectangle with a half circle on top."""
    return fuse(box((width, height, thickness), (-width / 2, -height, 0)), cylinder(width / 2, thickness))


@pytest.mark.parametrize("floor", [0, 3])
def test_a_window_with_a_round_top_is_arched_and_no_triangle(floor: float) -> None:
    found = find(cut(plate(100, 60, 8), shifted(arch(20, 20, 8), (0, 0, floor - 8))))
    window = only([*found.of("cutout"), *found.of("pocket")])
    assert "arched" in window.tags
    assert [window.length, window.width] == near(30, 20)


def test_a_triangle_with_rounded_corners_stays_one() -> None:
    tool = prism([(-20, -15, -8), (20, -15, -8), (0, 20, -8)], (0, 0, 8))
    window = only(find(cut(plate(100, 60, 8), filleted(tool, 3, *upright(tool)))).of("cutout"))
    assert {"triangular", "rounded_corners"} <= set(window.tags)


def test_rounded_corners_make_no_round_end_of_a_slot() -> None:
    tool = box((20, 40, 10), (-10, 0, -10))
    corners = [edge for edge in upright(tool) if math.isclose(BRepAdaptor_Curve(edge).Value(0.0).Y(), 0, abs_tol=1e-9)]
    slot = only(find(cut(plate(100, 60, 20), filleted(tool, 4, *corners))).of("slot"))
    assert {"rectangular", "rounded_corners"} <= set(slot.tags)
    assert slot.radius == pytest.approx(4 * MM)


def test_the_round_end_of_an_end_mill_does() -> None:
    slot = only(
        find(cut(plate(100, 60, 20), box((20, 40, 10), (-10, 0, -10)), cylinder(10, 10, (0, 0, -10)))).of("slot")
    )
    assert "obround" in slot.tags


def cover(tab: TopoDS_Shape) -> TopoDS_Shape:
    """Open below, its walls 2 mm thick, with a tab."""
    return fuse(cut(box((100, 60, 15), (-50, -30, 0)), box((96, 56, 13), (-48, -28, 0))), tab)


def test_a_tab_that_hangs_out_of_a_cover_is_none_of_its_inside() -> None:
    found = find(cover(box((1.5, 10, 8), (-48, -5, -6))))
    inside = only(found.of("pocket"))
    assert [inside.length, inside.width, inside.depth] == near(96, 56, 13)
    assert [floor.thickness for floor in found.of("floor")] == near(2)


def test_a_block_inside_a_cover_leaves_its_measures() -> None:
    inside = only(find(cover(box((10, 10, 6), (-48, -5, 4)))).of("pocket"))
    assert [inside.length, inside.width, inside.depth] == near(96, 56, 13)
