"""Grooves and counterbores whose ring a slit, a port or a cross hole opens; grooves in half a bore."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cone, cut, cylinder, find, fuse, turned

MM = 1e-3
X = (1.0, 0.0, 0.0)


def bored(*grooves: float) -> TopoDS_Shape:
    """A block with a bore of 20 mm along x, and rings of 28 mm, 8 mm wide, around it at these places."""
    rings = [cylinder(14, 8, (at - 4, 0, 0), X) for at in grooves]
    return cut(box((120, 60, 60), (-60, -30, -30)), cylinder(10, 120, (-60, 0, 0), X), *rings)


@pytest.mark.parametrize("port", [5.0, 7.0])
def test_a_groove_in_a_bore_is_one_where_a_port_opens_it(port: float) -> None:
    """The wider port cuts through both walls of the groove, too."""
    found = find(cut(bored(-20.0, 20.0), cylinder(port, 30, (-20, 0, 0)), cylinder(port, 30, (20, 0, 0))))
    grooves = found.of("groove")
    assert [groove.width for groove in grooves] == pytest.approx([8 * MM] * 2)
    assert [groove.depth for groove in grooves] == pytest.approx([4 * MM] * 2)
    assert not found.of("slot")
    assert not found.of("wall")


def test_a_port_beside_the_groove_leaves_the_bore_as_it_is() -> None:
    found = find(cut(bored(20.0), cylinder(7, 30, (-20, 0, 0))))
    assert len(found.of("groove")) == 1


@pytest.mark.parametrize("slit", [0.0, 2.5])
def test_a_stepped_bore_is_one_through_hole_where_a_slit_opens_it(slit: float) -> None:
    """A seat clamp: 34.9 mm with a ledge of 31.8 mm at its end."""
    ring = cut(cylinder(22, 15), cylinder(17.45, 13), cylinder(15.9, 15))
    shape = cut(ring, box((30, slit, 15), (0, -slit / 2, 0))) if slit else ring
    hole = max(find(shape).of("hole"), key=lambda part: part.volume or 0.0)
    assert "through" in hole.tags
    assert sorted(hole.radii) == pytest.approx([15.9 * MM, 17.45 * MM])


def test_half_a_ring_is_no_shoulder() -> None:
    """Half of a stepped bore holds nothing that is put into it."""
    whole = cut(box((60, 60, 40), (-30, -30, 0)), cylinder(10, 40), cylinder(18, 20))
    half = cut(whole, box((60, 30, 40), (-30, 0, 0)))
    assert not [hole for hole in find(half).of("hole") if len(hole.radii) > 1]


def test_a_groove_in_half_a_bore_is_no_woodruff_seat() -> None:
    half = cut(bored(0.0), box((120, 60, 30), (-60, -30, -30)), cylinder(5, 30))
    slots = [slot for slot in find(half).of("slot") if slot.width == pytest.approx(8 * MM)]
    assert [slot.depth for slot in slots] == pytest.approx([4 * MM] * 2)
    assert not any("woodruff" in slot.tags for slot in slots)


def test_a_slot_through_the_end_of_a_shaft_leaves_its_chamfer() -> None:
    shaft = fuse(cylinder(10, 38), cone(10, 8, 2, (0, 0, 38)))
    for width, count in ((5.0, 1), (18.0, 0)):
        slotted = cut(shaft, box((40, width, 10), (-20, -width / 2, 34)))
        chamfers = [part for part in find(slotted).of("chamfer") if "outer" in part.tags]
        assert [one.chamfer_size for one in chamfers] == pytest.approx([2 * MM] * count)


@pytest.mark.parametrize(("wide", "discs"), [(4.0, 1), (8.5, 0)])
def test_a_rim_with_many_grip_notches_is_a_disc_and_one_of_narrow_teeth_is_none(wide: float, discs: int) -> None:
    notches = [turned(box((8, wide, 10), (31, -wide / 2, 0)), (0, 0, 1), 18.0 * i) for i in range(20)]
    diameters = [round((boss.diameter or 0.0) / MM) for boss in find(cut(cylinder(33.5, 10), *notches)).of("boss")]
    assert diameters.count(67) == discs
