"""Spacings in two directions run along those in which the parts lie apart."""

from __future__ import annotations

import pytest
from tests.made import part, whole

from querycad_answering.programs import write
from querycad_contracts import PartQuery
from querycad_language.forms import LONGEST, SHORTER, Distance, Several

HOLES = PartQuery(noun="hole", plural=True)
RAIL = PartQuery(noun="slot", definite=True)


def test_spacings_in_both_directions_run_along_the_sides_on_which_the_parts_lie_apart() -> None:
    four = tuple(part(f"hole-{i}", (0.0, 0.02 * (i % 2), 0.01 * (i // 2)), diameter=0.005) for i in range(4))
    both = Several(tuple(Distance(HOLES, "each other", "centers", axis) for axis in (LONGEST, SHORTER)))
    code = write(both, {HOLES: (four, 0)}, whole()).code
    assert "a.center[1] - b.center[1]" in code
    assert "a.center[2] - b.center[2]" in code
    assert "center[0]" not in code


@pytest.mark.parametrize(
    ("said", "axes"),
    [
        ((SHORTER, 2), (1, 2)),  # 'crosswise and up and down': across is what is not up
        ((0, 2), (1, 2)),  # what lies on one level in x is not asked for along x
        ((RAIL, SHORTER), (2, 1)),  # along what runs along z, and across it
    ],
)
def test_spacings_run_in_the_two_directions_of_the_pattern(
    said: tuple[int | PartQuery, int], axes: tuple[int, int]
) -> None:
    four = tuple(part(f"hole-{i}", (0.0, 0.02 * (i % 2), 0.01 * (i // 2)), diameter=0.005) for i in range(4))
    both = Several(tuple(Distance(HOLES, "each other", "centers", axis) for axis in said))
    rail = part("slot-1", extents=(0.002, 0.004, 0.05))
    code = write(both, {HOLES: (four, 0), RAIL: ((rail,), 0)}, whole()).code
    order = [code.index(f"a.center[{axis}] - b.center[{axis}]") for axis in axes]
    assert order == sorted(order)


def test_spacings_of_what_lies_apart_along_all_axes_are_along_those_that_are_named() -> None:
    three = tuple(part(f"hole-{i}", (0.01 * i, 0.02 * i, 0.03 * i), diameter=0.005) for i in range(3))
    both = Several(tuple(Distance(HOLES, "each other", "centers", axis) for axis in (0, 2)))
    code = write(both, {HOLES: (three, 0)}, whole()).code
    assert "a.center[1] - b.center[1]" not in code
