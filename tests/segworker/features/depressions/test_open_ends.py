"""Slots that one can leave at both ends, at one, or at none."""

from __future__ import annotations

import pytest
from tests.segworker.shapes import box, cut, find, prism

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
