"""The right mask of those that the network offers, in the picture's pixels."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from querycad_segworker.segcad.engines.sam import Sam, Sam2, SamExporter, SamPoints, layout_of
from querycad_segworker.segcad.engines.sessions import Feeds, Graph, Port, UnknownLayout

SIDE, SMALL = 32, 8
PIXELS = {"pixel_values": Port((None, 3, SIDE, SIDE), np.float32)}
POINTS = {"input_points": Port((None,) * 4, np.float32), "input_labels": Port((None,) * 3, np.int64)}
BOXES = {"input_boxes": Port((None, None, 4), np.float32)}


class Drawn(Graph):
    """A graph that answers as it is told, and keeps what it was asked."""

    def __init__(self, inputs: dict[str, Port], *answer: NDArray[Any]) -> None:
        self.path, self.inputs, self.outputs, self.answer = Path("drawn.onnx"), inputs, (), answer
        self.asked: list[Feeds] = []

    def run(self, feeds: Feeds, outputs: Sequence[str]) -> tuple[NDArray[Any], ...]:
        self.asked.append(feeds)
        return self.answer


def exporter(batch: int | None, *answer: NDArray[Any]) -> tuple[Drawn, Drawn]:
    encoder = Drawn({"input_image": Port((None, None, 3), np.float32)}, np.zeros(1))
    points = {"point_coords": Port((batch, None, 2), np.float32), "mask_input": Port((1, 1, SMALL, SMALL), np.float32)}
    return encoder, Drawn(points, *answer)


def masks_of(*areas: tuple[slice, slice]) -> NDArray[np.float32]:
    """(M, 8, 8) logits, 1 in the area and -1 around it."""
    masks = np.full((len(areas), SMALL, SMALL), -1.0, dtype=np.float32)
    for mask, area in zip(masks, areas, strict=True):
        mask[area] = 1.0
    return masks


ALL, LEFT, DOT = (slice(None), slice(None)), (slice(None), slice(0, 4)), (slice(3, 4), slice(1, 2))
SQUARE = np.zeros((32, 32, 3), dtype=np.uint8)


@pytest.mark.parametrize(
    ("encoder", "decoder", "layout"),
    [
        ({"input_image": Port((1, 3, SIDE, SIDE), np.float32)}, exporter(1)[1].inputs, SamExporter),
        (PIXELS, POINTS | BOXES, Sam2),
        (PIXELS, POINTS, SamPoints),
    ],
)
def test_a_layout_is_known_by_its_inputs(
    encoder: dict[str, Port], decoder: dict[str, Port], layout: type[object]
) -> None:
    assert isinstance(layout_of(Drawn(encoder), Drawn(decoder)), layout)


def test_an_unknown_layout_is_told_with_its_inputs() -> None:
    with pytest.raises(UnknownLayout, match="image_embed"):
        Sam(Drawn({"image": PIXELS["pixel_values"]}), Drawn({"image_embed": PIXELS["pixel_values"]}))


def test_a_box_becomes_two_labelled_corners_in_the_network_s_pixels() -> None:
    encoder, decoder = exporter(None, masks_of(LEFT)[None], np.array([[0.7]]))
    picture = np.zeros((32, 64, 3), dtype=np.uint8)
    Sam(encoder, decoder).segment(picture, np.array([[8, 4, 40, 20]], dtype=np.float32))
    assert encoder.asked[0]["input_image"].shape == (16, 32, 3)
    assert decoder.asked[0]["point_coords"].tolist() == [[[4, 2], [20, 10]]]
    assert decoder.asked[0]["point_labels"].tolist() == [[2, 3]]


@pytest.mark.parametrize(("batch", "runs"), [(None, 1), (1, 3)])
def test_boxes_share_a_run_where_the_decoder_takes_several(batch: int | None, runs: int) -> None:
    count = 3 // runs
    encoder, decoder = exporter(batch, np.stack([masks_of(LEFT)] * count), np.full((count, 1), 0.7))
    found = Sam(encoder, decoder).segment(SQUARE, np.array([[0, 0, 16, 32]] * 3, dtype=np.float32))
    assert found.masks.shape == (3, 32, 32)
    assert (len(encoder.asked), len(decoder.asked)) == (1, runs)


def test_of_four_masks_the_first_is_that_for_a_box() -> None:
    masks, scores = masks_of(LEFT, ALL, DOT, ALL)[None], np.array([[0.1, 0.9, 0.8, 0.7]])
    found = Sam(*exporter(None, masks, scores)).segment(SQUARE, np.array([[0, 0, 16, 32]], dtype=np.float32))
    assert found.scores.tolist() == pytest.approx([0.1])
    assert found.masks[0, :, :14].all()
    assert not found.masks[0, :, 18:].any()


def test_of_three_masks_the_best_scored_is_taken() -> None:
    encoder = Drawn(PIXELS, *[np.zeros(1)] * 3)
    decoder = Drawn(POINTS | BOXES, masks_of(DOT, LEFT, ALL)[None, None], np.array([[[0.2, 0.9, 0.8]]]))
    found = Sam(encoder, decoder).segment(SQUARE, np.array([[0, 0, 16, 32]], dtype=np.float32))
    assert found.scores.tolist() == pytest.approx([0.9])
    assert decoder.asked[0]["input_boxes"].shape == (1, 1, 4)
    assert decoder.asked[0]["input_points"].shape == (1, 1, 0, 2)


def test_a_point_s_masks_are_told_apart_by_the_box() -> None:
    """The middle of the box may mean a dot, the object, or all of it; the scores favour what the box does not hold."""
    encoder = Drawn(PIXELS, np.zeros(1), np.zeros(1))
    decoder = Drawn(POINTS, masks_of(DOT, LEFT, ALL)[None, None], np.array([[[0.9, 0.2, 0.8]]]))
    found = Sam(encoder, decoder).segment(SQUARE, np.array([[1, 0, 15, 31]], dtype=np.float32))
    assert decoder.asked[0]["input_points"].tolist() == [[[[8.0, 15.5]]]]
    assert found.scores.tolist() == pytest.approx([0.2])


def test_what_a_mask_covers_of_the_padding_does_not_count() -> None:
    """A lying picture fills the upper half of the square: below it there is nothing to be masked."""
    dot = (slice(0, 4), slice(0, 5))
    encoder = Drawn(PIXELS, np.zeros(1), np.zeros(1))
    decoder = Drawn(POINTS, masks_of(dot, ALL)[None, None], np.array([[[0.5, 0.4]]]))
    found = Sam(encoder, decoder).segment(
        np.zeros((16, 32, 3), dtype=np.uint8), np.array([[0, 0, 32, 16]], dtype=np.float32)
    )
    assert found.masks.shape == (1, 16, 32)
    assert found.masks.all()
    assert found.scores.tolist() == pytest.approx([0.4])
