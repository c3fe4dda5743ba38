"""What superlatives compare."""

from __future__ import annotations

from tests.made import part

from querycad_segworker.relations.orders import compared


def test_of_a_disc_among_shafts_and_only_there_the_thickest_is_the_widest() -> None:
    shaft = part("boss-1", diameter=0.02)
    disc, wide = (part(f"boss-{n}", diameter=d, thickness=t) for n, d, t in ((2, 0.036, 0.012), (3, 0.08, 0.01)))
    assert compared([shaft, disc], "thickness") == [0.02, 0.036]
    assert compared([disc, wide], "thickness") == [0.012, 0.01]
