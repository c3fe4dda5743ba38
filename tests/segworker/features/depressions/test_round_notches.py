"""Round notches and grooves: the flutes of knobs, and what is none."""

from __future__ import annotations

import math

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cone, cut, cylinder, filleted, find, fuse, plate, upright

MM = 1e-3


def near(*values: float) -> object:
    """Millimetres."""
    return pytest.approx([value * MM for value in values], abs=1e-7)


def fluted() -> TopoDS_Shape:
    """A knob of radius 20 with six flutes of radius 3, on a skirt of radius 26 up to z = 4; its top is z = 30."""
    spots = [(21 * math.cos(i * math.pi / 3), 21 * math.sin(i * math.pi / 3)) for i in range(6)]
    return fuse(cut(cylinder(20, 30), *(cylinder(3, 30, (x, y, 0)) for x, y in spots)), cylinder(26, 4))


def test_flutes_in_a_knob_are_round_slots_as_deep_as_below_its_crown() -> None:
    flutes = find(fluted()).of("slot")
    assert len(flutes) == 6
    assert all("axial" in flute.tags and "keyway" not in flute.tags for flute in flutes)
    assert [flute.length for flute in flutes] == near(*[26] * 6)
    assert [flute.depth for flute in flutes] == near(*[2] * 6)


def test_round_hollows_that_are_closed_at_both_ends_or_run_out_in_rounds_are_no_slots() -> None:
    flanged = fuse(fluted(), cylinder(26, 4, (0, 0, 26)))
    assert not find(flanged).of("slot")
    pair = fuse(cylinder(10, 10), box((10, 20, 10), (-5, 5, 0)))
    corner = [edge for edge in upright(pair) if abs(BRepAdaptor_Curve(edge).Value(0).Y()) < 9]
    assert not find(filleted(pair, 2, *corner)).of("slot")


def test_a_hole_in_the_bottom_of_a_round_groove_leaves_it_one() -> None:
    groove = cylinder(4, 100, (-50, 0, 0), (1, 0, 0))
    (slot,) = find(cut(plate(), groove, cylinder(1.5, 30, (0, 0, -25)))).of("slot")
    assert [slot.length, slot.width, slot.depth] == near(60, 8, 4)


@pytest.mark.parametrize(
    "body",
    [cylinder(27, 26), cone(27, 26.2, 26), fuse(cylinder(27, 20), cone(27, 26.5, 6, (0, 0, 20)))],
    ids=["straight", "with draft", "tapered at its end"],
)
def test_flutes_that_end_before_the_end_face_are_slots_and_a_seat_in_an_edge_is_a_step(body: TopoDS_Shape) -> None:
    spots = [(27.5 * math.cos(i * math.pi / 6), 27.5 * math.sin(i * math.pi / 6)) for i in range(12)]
    found = find(cut(body, *(cylinder(2, 30, (x, y, 5)) for x, y in spots)))
    assert [slot.length for slot in found.of("slot")] == near(*[21] * 12)
    assert not found.of("step")
    seat = find(cut(plate(), cylinder(8, 3, (0, -20, -3))))
    assert [step.depth for step in seat.of("step")] == near(3)
    assert not seat.of("slot")


def test_a_round_cut_in_the_edge_of_a_block_is_a_step_also_where_it_is_deeper_than_long() -> None:
    found = find(cut(plate(), cylinder(4, 15, (0, -20, -15))))
    assert [step.depth for step in found.of("step")] == near(15)
    assert not found.of("slot")
