"""Boxes come back in the pixels of the picture that was asked about, whatever the graph made of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from querycad_segworker.segcad.engines.grounding_dino import DetectorOptions, GroundingDino
from querycad_segworker.segcad.engines.sessions import Feeds, Graph, Port, UnknownLayout
from querycad_segworker.segcad.engines.tokenizer import Tokenizer

TEXT = {"input_ids": Port((None, None), np.int64)}


class Drawn(Graph):
    """A graph that answers as it is told, and keeps what it was asked."""

    def __init__(self, inputs: dict[str, Port], boxes: list[list[float]], logits: list[list[float]]) -> None:
        self.path, self.inputs, self.outputs = Path("drawn.onnx"), TEXT | inputs, ("logits", "pred_boxes")
        self.answer = np.array(logits, dtype=np.float32), np.array(boxes, dtype=np.float32)
        self.asked: list[Feeds] = []

    def run(self, feeds: Feeds, outputs: Sequence[str]) -> tuple[NDArray[Any], ...]:
        self.asked.append(feeds)
        (image,) = {"pixel_values", "img"} & feeds.keys()
        return tuple(np.stack([one] * len(feeds[image])) for one in self.answer)


FREE = {"pixel_values": Port((None, 3, None, None), np.float32), "pixel_mask": Port((None, None, None), np.int64)}
FIXED = {"pixel_values": Port((1, 3, 80, 80), np.float32), "pixel_mask": Port((1, 80, 80), np.int64)}
BLIND = {"img": Port((1, 3, 80, 80), np.float32)}
LYING = np.zeros((20, 40, 3), dtype=np.uint8)


@pytest.fixture
def tokenizer(tmp_path: Path) -> Tokenizer:
    (tmp_path / "vocab.txt").write_text("[PAD]\n[UNK]\n[CLS]\n[SEP]\n.\n?\nhole", encoding="utf-8")
    return Tokenizer(tmp_path / "vocab.txt")


def logit(probability: float) -> float:
    return float(np.log(probability / (1 - probability)))


def test_scores_above_the_threshold_come_best_first(tokenizer: Tokenizer) -> None:
    hidden = float("-inf")
    logits = [[logit(0.29), hidden], [logit(0.31), hidden], [logit(0.2), logit(0.9)], [hidden, hidden]]
    graph = Drawn(FREE, [[0.5, 0.5, 0.2, 0.2]] * 4, logits)
    scores = [one.score for one in GroundingDino(graph, tokenizer).detect(LYING, "hole")]
    np.testing.assert_allclose(scores, [0.9, 0.31], rtol=1e-5)


def test_a_box_is_a_share_of_the_picture(tokenizer: Tokenizer) -> None:
    graph = Drawn(FREE, [[0.5, 0.5, 0.5, 0.4]], [[3.0]])
    (found,) = GroundingDino(graph, tokenizer).detect(LYING, "Hole")
    assert found.box == pytest.approx((10, 6, 30, 14))
    assert found.phrase == "Hole"


@pytest.mark.parametrize("graph_inputs", [FIXED, FREE])
def test_padding_does_not_move_the_boxes_of_a_graph_that_knows_of_it(
    tokenizer: Tokenizer, graph_inputs: dict[str, Port]
) -> None:
    graph = Drawn(graph_inputs, [[0.25, 0.5, 0.5, 1.0]], [[3.0]])
    (found,) = GroundingDino(graph, tokenizer).detect(LYING, "hole")
    assert found.box == pytest.approx((0, 0, 20, 20))


def test_a_fixed_picture_keeps_its_shape_inside_the_frame(tokenizer: Tokenizer) -> None:
    graph = Drawn(FIXED, [[0.5] * 4], [[3.0]])
    GroundingDino(graph, tokenizer).detect(LYING, "hole")
    (feeds,) = graph.asked
    assert feeds["pixel_values"].shape == (1, 3, 80, 80)
    assert feeds["pixel_mask"][0].sum() == 40 * 80
    assert not feeds["pixel_values"][0, :, 40:].any()


def test_a_graph_that_knows_of_no_padding_gives_shares_of_the_frame(tokenizer: Tokenizer) -> None:
    """The picture is the upper half of the frame: y from 0 to 0.5 of it."""
    graph = Drawn(BLIND, [[0.5, 0.25, 1.0, 0.5]], [[3.0]])
    (found,) = GroundingDino(graph, tokenizer).detect(LYING, "hole")
    assert found.box == pytest.approx((0, 0, 40, 20))


def test_boxes_end_at_the_picture_s_edge(tokenizer: Tokenizer) -> None:
    graph = Drawn(FREE, [[1.0, 0.5, 0.5, 0.5], [1.6, 0.5, 0.5, 0.5]], [[3.0], [3.0]])
    (found,) = GroundingDino(graph, tokenizer).detect(LYING, "hole")  # the other one lies outside
    assert found.box == pytest.approx((30, 5, 40, 15))


@pytest.mark.parametrize(("inputs", "runs"), [(FREE, 1), (FIXED, 3)])
def test_views_share_a_run_where_the_graph_takes_several(
    tokenizer: Tokenizer, inputs: dict[str, Port], runs: int
) -> None:
    graph = Drawn(inputs, [[0.5] * 4], [[3.0]])
    found = GroundingDino(graph, tokenizer, DetectorOptions(0.3, 20, 40)).detect_views([LYING] * 3, "hole")
    assert [len(one) for one in found] == [1, 1, 1]
    assert len(graph.asked) == runs


def test_another_network_is_refused_by_name(tokenizer: Tokenizer) -> None:
    with pytest.raises(UnknownLayout, match=r"drawn\.onnx is no known export of GroundingDINO"):
        GroundingDino(Drawn({"tokens": Port((1,), np.int64)}, [[0.5] * 4], [[3.0]]), tokenizer)
