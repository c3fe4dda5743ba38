"""A pocket with a narrower outlet of its depth is a pocket and a slot; slots that cross or widen make no pocket."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, filleted, find, plate, turned, upright

from querycad_contracts import Part

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-7)


def cuts(shape: TopoDS_Shape) -> dict[str, list[Part]]:
    """What is cut in, by kind."""
    parts = [part for part in find(shape).parts if part.kind.cuts_in]
    return {part.kind: [other for other in parts if other.kind is part.kind] for part in parts}


def pocket_with_outlet(width: float, radius: float = 0.0) -> TopoDS_Shape:
    """A pocket 20 x 16 x 6, open to the right by an outlet 20 long. `radius`: of the pocket's corners."""
    pocket = box((20, 16, 6), (-10, -8, -6))
    pocket = filleted(pocket, radius, *upright(pocket)) if radius else pocket
    return cut(plate(), pocket, box((30, width, 6), (5, -width / 2, -6)))


@pytest.mark.parametrize("turn", [0.0, 33.0])
@pytest.mark.parametrize("radius", [0.0, 3.0], ids=["sharp", "rounded"])
def test_a_pocket_with_a_narrow_outlet_is_a_pocket_and_a_slot(radius: float, turn: float) -> None:
    found = cuts(turned(pocket_with_outlet(6.0, radius), (0, 0, 1), turn))
    assert found.keys() == {"pocket", "slot"}
    (pocket,), (slot,) = found["pocket"], found["slot"]
    assert [pocket.length, pocket.width, pocket.depth] == near(20, 16, 6)
    assert {"open", "rectangular"} <= set(pocket.tags)
    assert [slot.length, slot.width, slot.depth] == near(20, 6, 6)
    assert pocket.extents[0] < 0.027


def test_an_outlet_as_wide_as_its_pocket_makes_both_one_slot() -> None:
    found = cuts(pocket_with_outlet(16.0))
    assert found.keys() == {"slot"}
    assert [found["slot"][0].length, found["slot"][0].width] == near(40, 16)


def test_a_slot_that_another_of_its_depth_crosses_is_no_pocket() -> None:
    found = cuts(cut(plate(), box((70, 10, 6), (-35, -5, -6)), box((6, 50, 6), (-3, -25, -6))))
    assert "pocket" not in found


def test_a_t_slot_with_a_closed_end_is_no_pocket() -> None:
    found = cuts(cut(plate(), box((60, 8, 6), (-10, -4, -6)), box((60, 14, 5), (-10, -7, -11))))
    assert found.keys() == {"slot"}
