"""Slots that one can leave at both ends, at one, or at none."""

from __future__ import annotations

import pytest
from tests.segworker.shapes import box, cut, find

BLOCK = box((60, 30, 20), (0, 0, 0))


@pytest.mark.parametrize(
    ("x", "length", "tag"), [(0, 60, "open_ended"), (0, 40, "open_end"), (20, 40, "open_end"), (10, 40, None)]
)
def test_a_slot_tells_at_how_many_ends_it_is_open(x: float, length: float, tag: str | None) -> None:
    found = find(cut(BLOCK, box((length, 8, 6), (x, 11, 14))))
    (slot,) = [*found.of("slot"), *found.of("pocket")]
    assert {"open_ended", "open_end"}.intersection(slot.tags) == ({tag} if tag else set())
