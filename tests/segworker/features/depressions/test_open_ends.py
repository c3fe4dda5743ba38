"""Slots that one can leave at both ends, at one, or at none."""

from __future__ import annotations

import pytest
from OCP.TopoDS import TopoDS_Shape
from tests.segworker.shapes import box, cut, filleted, find, fuse, prism, shifted, upright

BLOCK = box((60, 30, 20), (0, 0, 0))


@pytest.mark.parametrize(
    ("x", "length", "tag"), [(0, 60, "open_ended"), (0, 40, "open_end"), (20, 40, "open_end"), (10, 40, None)]
)
def test_a_slot_tells_at_how_many_ends_it_is_open(x: float, length: float, tag: str | None) -> None:
    found = find(cut(BLOCK, box((length, 8, 6), (x, 11, 14))))
    (slot,) = [*found.of("slot"), *found.of("pocket")]
    assert {"open_ended", "open_end"}.intersection(slot.tags) == ({tag} if tag else set())


def test_a_vee_beside_narrow_lands_and_chamfers_is_no_step() -> None:
    """The chamfers of the block lean as the flanks of the groove do."""
    outline = [(0, 0), (42, 0), (42, 18), (34, 26), (28, 26), (21, 19), (14, 26), (8, 26), (0, 18)]
    found = find(prism([(x, 0, z) for x, z in outline], (0, 64, 0)))
    assert found.of("step") == []
    (vee,) = found.of("slot")
    assert "v_shaped" in vee.tags
    assert [vee.depth, vee.width] == pytest.approx([7e-3, 14e-3])


def gusseted(gap: float, legs: float = 40.0) -> TopoDS_Shape:
    """An angle of two plates 120 x 80 x 10 with two gussets of 8 in its corner, this far apart."""
    outline = [(0.0, 0.0, 0.0), (0.0, legs, 0.0), (0.0, 0.0, legs)]
    gusset = prism(outline, (8, 0, 0))
    left, right = (shifted(gusset, (at, 10, 10)) for at in (60 - gap / 2 - 8, 60 + gap / 2))
    return fuse(box((120, 80, 10)), box((120, 10, 80)), left, right)


def test_the_room_between_two_gussets_is_a_slot_as_long_and_high_as_they_are() -> None:
    (slot,) = find(gusseted(30)).of("slot")
    assert [slot.width, slot.length, slot.depth] == pytest.approx([0.03, 0.04, 0.04])


def test_gussets_farther_apart_than_long_leave_no_slot_and_a_channel_keeps_its_length() -> None:
    assert not [part for kind in ("slot", "channel", "notch") for part in find(gusseted(50)).of(kind)]
    uneven = cut(box((100, 60, 40)), box((100, 40, 30), (0, 10, 10)), box((50, 10, 40), (50, 50, 20)))
    (channel,) = find(uneven).of("channel")
    assert channel.length == pytest.approx(0.1)


def test_the_waist_of_a_casing_between_flange_and_foot_is_no_pocket() -> None:
    casing = box((80, 40, 60), (10, 10, 0))
    waist = fuse(filleted(casing, 8, *upright(casing)), box((100, 60, 10)), box((100, 60, 10), (0, 0, 50)))
    found = find(waist)
    assert not [part for kind in ("pocket", "channel", "slot") for part in found.of(kind)]


def test_a_pocket_with_an_island_stays_one() -> None:
    island = cut(box((80, 60, 20)), box((70, 50, 10), (5, 5, 10)))
    (pocket,) = find(fuse(island, box((20, 16, 6), (30, 22, 10)))).of("pocket")
    assert [pocket.length, pocket.width, pocket.depth] == pytest.approx([0.07, 0.05, 0.01])
