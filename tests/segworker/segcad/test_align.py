"""Masks to faces, on arrays drawn by hand."""

from __future__ import annotations

import numpy as np
import pytest
from tests.segworker.segcad.drawn import masks, view

from querycad_segworker.segcad.align import align
from querycad_segworker.segcad.ports import VisionOptions

PLATE = (
    "0000000000",
    "0011100000",
    "0011100220",
    "0000000220",
    "..........",
)


def test_a_mask_means_the_faces_it_covers() -> None:
    (found,), gone = align(view(*PLATE), masks(("..........", "..xxx.....", "..xxx.....", "..........", "..........")))
    assert found.faces == {1}
    assert found.mask == 0
    assert gone == []


def test_a_face_counts_only_above_five_per_cent_of_its_pixels() -> None:
    """Face 0 has 30 pixels: one is 3.3 per cent, two are 6.7."""
    one = ("..........", "..xxxx....", "..xxx.....", "..........", "..........")
    two = ("..........", "..xxxx....", "..xxxx....", "..........", "..........")
    (first,), _ = align(view(*PLATE), masks(one))
    (second,), _ = align(view(*PLATE), masks(two))
    assert first.faces == {1}
    assert second.faces == {0, 1}


def test_exactly_the_share_is_not_more_than_the_share() -> None:
    picture = view("00000000001111111111")
    (found,), _ = align(picture, masks(("xxxxx..........xx...",)), VisionOptions(face_share=0.2))
    assert found.faces == {0}


def test_background_under_a_mask_does_not_count() -> None:
    picture = view("0.........", "0.........", "1111111111")
    (found,), gone = align(picture, masks(("xxxxxxxxxx", "xxxxxxxxxx", "..........")))
    assert found.faces == {0}
    assert gone == []


def test_a_mask_over_more_than_45_per_cent_of_the_model_goes() -> None:
    picture = view("00000000001111111111")
    found, (gone,) = align(picture, masks(("xxxxxxxxxx..........",), ("...........xxxxxxxxx",)))
    assert [one.mask for one in found] == [1]
    assert gone.mask == 0
    assert gone.reason == "it covers 50% of the model"


def test_a_mask_over_half_covered_by_smaller_ones_goes() -> None:
    picture = view("00112233445566778899")
    group = "xxxxxx.............."
    found, (gone,) = align(picture, masks((group,), ("xx..................",), ("..xx................",)))
    assert [one.mask for one in found] == [1, 2]
    assert gone.mask == 0
    assert gone.reason == "smaller masks cover 67% of it"


def test_a_mask_just_half_covered_by_smaller_ones_stays() -> None:
    picture = view("00112233445566778899")
    found, gone = align(picture, masks(("xxxx................",), ("xx..................",)))
    assert [one.mask for one in found] == [0, 1]
    assert gone == []


def test_of_equal_masks_one_stays() -> None:
    found, gone = align(view("0011223344"), masks(("xx........",), ("xx........",)))
    assert len(found) == len(gone) == 1


def test_masks_that_go_cover_no_others() -> None:
    """The middle mask goes, as the smallest covers it; of the largest that leaves a third covered, so it stays."""
    picture = view("0011223344556677889900112233")
    smallest, middle, largest = (
        "xxxx........................",
        "xxxxxx......................",
        "xxxxxxxxxx..................",
    )
    found, gone = align(picture, masks((largest,), (middle,), (smallest,)))
    assert [one.mask for one in found] == [0, 2]
    assert [one.mask for one in gone] == [1]


def test_a_mask_beside_the_model_shows_nothing_of_it() -> None:
    found, (gone,) = align(
        view("00........"),
        masks(
            (".....xxxx.",),
        ),
    )
    assert found == []
    assert gone.reason == "it shows nothing of the model"


def test_the_nearest_face_is_the_one_whose_masked_pixels_come_nearest() -> None:
    picture = view("0000111122223333", depth=("1111999955554444",))
    (found,), _ = align(picture, masks(("....xxxxxx......",)))
    assert found.faces == {1, 2}
    assert found.nearest == 2


def test_masks_of_another_size_than_the_view_are_refused() -> None:
    with pytest.raises(ValueError, match="do not fit"):
        align(view("0011"), np.zeros((1, 2, 2), dtype=np.bool_))


def test_a_view_without_masks_means_nothing() -> None:
    assert align(view("0011"), np.zeros((0, 1, 4), dtype=np.bool_)) == ([], [])
