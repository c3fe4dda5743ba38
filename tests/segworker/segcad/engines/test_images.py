"""Pictures change size exactly as the references change them."""

from __future__ import annotations

import numpy as np
import pytest

from querycad_segworker.segcad.engines.images import (
    enlarged,
    normalised,
    padded,
    resize,
    size_by_edges,
    size_by_longest,
    size_within,
)


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ((1080, 1920), (750, 1333)),  # limited by the longer edge
        ((1920, 1080), (1333, 750)),
        ((600, 600), (800, 800)),
        ((480, 640), (800, 1066)),
        ((800, 1000), (800, 1000)),
        ((10, 1000), (13, 1333)),
    ],
)
def test_the_shorter_edge_decides_unless_the_longer_one_is_too_long(
    size: tuple[int, int], expected: tuple[int, int]
) -> None:
    assert size_by_edges(size, 800, 1333) == expected


def test_a_frame_is_filled_in_one_direction() -> None:
    assert size_within((1080, 1920), (800, 800)) == (450, 800)
    assert size_within((50, 20), (800, 800)) == (800, 320)


def test_sam_s_image_is_as_long_as_its_square() -> None:
    assert size_by_longest((1080, 1920), 1024) == (576, 1024)
    assert size_by_longest((3, 1024), 1024) == (3, 1024)


def test_shrinking_averages_all_pixels() -> None:
    stripes = np.zeros((64, 64, 3), dtype=np.uint8)
    stripes[:, ::2] = 255  # a filter that skips pixels would return stripes, or nothing
    small = resize(stripes, (8, 8))
    assert np.abs(small[:, 1:-1].astype(int) - 127).max() <= 3  # at the edges half of the filter is outside


def test_an_image_of_the_right_size_is_not_touched() -> None:
    image = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
    assert resize(image, (4, 4)) is image


def test_black_and_white_are_imagenet_s() -> None:
    image = np.zeros((1, 2, 3), dtype=np.uint8)
    image[0, 1] = 255
    pixels = normalised(image)
    assert pixels.shape == (3, 1, 2)
    np.testing.assert_allclose(pixels[:, 0, 0], [-2.117904, -2.0357144, -1.8044444], rtol=1e-6)
    np.testing.assert_allclose(pixels[:, 0, 1], [2.2489083, 2.4285715, 2.64], rtol=1e-6)


def test_padding_is_right_and_below() -> None:
    frame = padded(np.ones((3, 2, 3), dtype=np.float32), (4, 5))
    assert frame[0].tolist() == [[1, 1, 1, 0, 0], [1, 1, 1, 0, 0], [0] * 5, [0] * 5]


def test_masks_grow_between_pixel_centers() -> None:
    grown = enlarged(np.array([[0.0, 1.0]], dtype=np.float32), (1, 4))
    assert grown.tolist() == [[0.0, 0.25, 0.75, 1.0]]
