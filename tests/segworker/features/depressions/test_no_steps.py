"""What meets in concave edges and is no step: obtuse sides of a body, corners of walls; what looks alike is one."""

from __future__ import annotations

import math

import pytest
from tests.segworker.shapes import box, cut, cylinder, extruded, find, fuse, plate, turned

from querycad_contracts import Part

MM = 1e-3


def leaning(degrees: float) -> list[str]:
    """What is cut into a block with a ledge whose wall leans back so far from upright."""
    back = 20 * math.tan(math.radians(degrees))
    outline = [(0, 0), (60, 0), (60, 10), (40, 10), (40 - back, 30), (0, 30)]
    return [part.kind for part in find(extruded(outline, 0, 40)).parts if part.kind.cuts_in]


@pytest.mark.parametrize("degrees", [30.0, 45.0])
def test_sides_of_a_body_at_an_obtuse_angle_are_no_step(degrees: float) -> None:
    assert not leaning(degrees)


@pytest.mark.parametrize("degrees", [0.0, 20.0])
def test_a_step_with_a_leaning_wall_is_one(degrees: float) -> None:
    assert leaning(degrees) == ["step"]


def angle(thick: float, inside: float = 0.0) -> list[Part]:
    """The steps and what is nameless of an angle with legs of 60 and 50, 40 long, with a fillet inside."""
    shape = extruded([(0, 0), (60, 0), (60, thick), (thick, thick), (thick, 50), (0, 50)], 0, 40)
    if inside:
        corner = box((inside, inside, 40), (thick, thick, 0))
        shape = fuse(shape, cut(corner, cylinder(inside, 40, (thick + inside, thick + inside, 0))))
    return [part for part in find(shape).parts if part.kind in ("step", "depression", "elevation")]


@pytest.mark.parametrize("inside", [0.0, 4.0], ids=["sharp", "filleted"])
def test_the_inside_of_an_angle_bracket_is_no_step(inside: float) -> None:
    assert not angle(8.0, inside)


def test_what_is_cut_out_of_a_thick_block_is_a_step() -> None:
    assert [part.depth for part in angle(30.0) if part.kind == "step"] == [pytest.approx(30 * MM)]


@pytest.mark.parametrize("turn", [0.0, 90.0])
def test_a_rebate_in_the_edge_of_a_plate_is_a_step(turn: float) -> None:
    found = find(turned(cut(plate(80, 60, 10), box((100, 5, 5), (-50, 25, -5))), (1, 0, 0), turn))
    assert [step.depth for step in found.of("step")] == [pytest.approx(5 * MM)]
