"""What superlatives compare."""

from __future__ import annotations

import random

from tests.made import hole, part

from querycad_segworker.relations.orders import SAME_SIZE, by_size, compared


def test_of_a_disc_among_shafts_and_only_there_the_thickest_is_the_widest() -> None:
    shaft = part("boss-1", diameter=0.02)
    disc, wide = (part(f"boss-{n}", diameter=d, thickness=t) for n, d, t in ((2, 0.036, 0.012), (3, 0.08, 0.01)))
    assert compared([shaft, disc], "thickness") == [0.02, 0.036]
    assert compared([disc, wide], "thickness") == [0.012, 0.01]


def test_parts_are_grouped_with_the_first_one_that_is_as_large() -> None:
    chosen = random.Random(7)
    found = [hole(n, 0.0, diameter=chosen.uniform(0.004, 0.006)) for n in range(200)]
    found += [part(f"slot-{n}", width=0.005, length=0.005) for n in range(3)]
    groups = by_size(found)
    assert sorted(one.id for group in groups for one in group) == sorted(one.id for one in found)
    assert [group[0].id for group in groups if group[0].kind == "slot"] == ["slot-0"]
    firsts: list[float] = []
    for group in (group for group in groups if group[0].kind == "hole"):
        own = group[0].diameter or 0.0
        assert all(max(own, one) > SAME_SIZE * min(own, one) for one in firsts)
        for one in group:
            size = one.diameter or 0.0
            assert max(own, size) <= SAME_SIZE * min(own, size) + 1e-9
            assert not any(max(other, size) <= SAME_SIZE * min(other, size) for other in firsts)  # an earlier one
        firsts.append(own)


def test_what_has_no_size_is_a_group() -> None:
    assert len(by_size([part("slot-1", width=0.0, length=0.0), part("slot-2", width=0.0, length=0.0)])) == 1
