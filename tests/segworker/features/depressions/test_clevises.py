"""The gap of a fork between two ears."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, cylinder, find, fuse, plate, shifted

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-7)


def eared(gap: float, thickness: float = 10.0) -> TopoDS_Shape:
    """Two ears 30 wide and 40 high with round tops, this far apart on a plate, and a bore through both."""
    ear = fuse(box((30, thickness, 25), (-15, 0, 0)), cylinder(15, thickness, (0, 0, 25), (0, 1, 0)))
    ears = [shifted(ear, (0, at, 0)) for at in (gap / 2, -gap / 2 - thickness)]
    return cut(fuse(plate(100, 100, 10), *ears), cylinder(5, 100, (0, -50, 25), (0, 1, 0)))


def test_the_gap_between_ears_with_round_tops_is_the_slot_of_a_fork() -> None:
    (slot,) = find(eared(20)).of("slot")
    assert "fork" in slot.tags
    assert [slot.length, slot.width, slot.depth] == near(30, 20, 40)


def test_ears_as_far_apart_as_they_are_wide_and_a_single_ear_are_no_fork() -> None:
    single = fuse(plate(100, 100, 10), box((30, 10, 25), (-15, 0, 0)), cylinder(15, 10, (0, 0, 25), (0, 1, 0)))
    assert not [slot for shape in (eared(30), eared(40), single) for slot in find(shape).of("slot")]
