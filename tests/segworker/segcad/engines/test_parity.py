"""The detector and the segmenter answer as the public reference implementations do, in every layout of their exports.

The references' answers come twice: recorded, with the exported models, in `recorded.tar.xz`; and made anew by
`make parity`, which installs PyTorch and transformers.
"""

from __future__ import annotations

import os
import shutil
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.segworker.segcad.engines.cases import (
    DETECTORS,
    EDGES,
    FRAME,
    FREE,
    PHRASES,
    SEGMENTERS,
    THRESHOLD,
    boxes_in,
    pictures,
)

from querycad_segworker.segcad.engines.grounding_dino import DetectorOptions, GroundingDino
from querycad_segworker.segcad.engines.images import resize, size_by_edges, size_within
from querycad_segworker.segcad.engines.sam import Sam
from querycad_segworker.segcad.engines.sessions import Graph
from querycad_segworker.segcad.engines.tokenizer import SEPARATORS, Tokenizer, caption_of

RECORDED = Path(__file__).with_name("recorded.tar.xz")
TOLERANCE = 1e-3
OPTIONS = DetectorOptions(THRESHOLD, *EDGES)


class References:
    """Exported models and what the references answer to which pictures."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        with np.load(folder / "expected.npz") as kept:
            self._kept = dict(kept)
        self.pictures = {name: pictures()[name] for name in sorted({key.split("/")[0] for key in self._kept})}

    def answer(self, *key: str) -> NDArray[Any]:
        return np.asarray(self._kept["/".join(key)])

    def tokenizer(self) -> Tokenizer:
        return Tokenizer(self.folder / "vocab.txt")

    @cache  # noqa: B019  # a handful of them, for as long as the tests of this file run
    def detector(self, name: str) -> GroundingDino:
        return GroundingDino(Graph(self.folder / name / "model.onnx", threads=1), self.tokenizer(), OPTIONS)

    @cache  # noqa: B019
    def segmenter(self, name: str) -> Sam:
        encoder, decoder = (Graph(self.folder / name / f"{part}.onnx", threads=1) for part in ("encoder", "decoder"))
        return Sam(encoder, decoder)


@pytest.fixture(scope="module", params=["recorded", "made now"])
def references(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> References:
    folder = tmp_path_factory.mktemp("references")
    if request.param == "recorded":
        shutil.unpack_archive(RECORDED, folder, filter="data")
    elif "QUERYCAD_PARITY" not in os.environ:
        pytest.skip("`make parity` installs PyTorch and transformers, and runs this against them")
    else:
        from tests.segworker.segcad.engines.reference import build

        build(folder)
    return References(folder)


def test_the_answers_are_worth_comparing(references: References) -> None:
    """Random weights may answer nothing, or all the same."""
    for name in references.pictures:
        for key in PHRASES:
            assert len(references.answer(name, "free", key, "scores")) >= 3
        for model in ("sam/box", "sam/points", "sam2"):
            masks = references.answer(name, model, "masks") > 0
            assert masks.any(axis=(1, 2)).any()
            assert not masks.all(axis=(1, 2)).all()


@pytest.mark.parametrize("phrase", PHRASES)
def test_a_phrase_becomes_the_reference_s_tokens_and_masks(references: References, phrase: str) -> None:
    prompt = references.tokenizer().encode(caption_of(PHRASES[phrase]))
    for name in references.pictures:
        assert prompt.input_ids.tolist() == references.answer(name, "free", phrase, "input_ids").tolist()
        assert (prompt.self_attention == references.answer(name, "free", phrase, "self_attention")).all()
        assert (prompt.position_ids == references.answer(name, "free", phrase, "position_ids")).all()


def test_a_picture_becomes_the_reference_s_pixels(references: References) -> None:
    for name, image in references.pictures.items():
        size = (image.shape[0], image.shape[1])
        for kind, inner in (("free", size_by_edges(size, *EDGES)), ("fixed", size_within(size, (FRAME, FRAME)))):
            expected = references.answer(name, kind, "pixels")[: inner[0], : inner[1]]
            assert (resize(image, inner) == expected).all()


@pytest.mark.parametrize("phrase", PHRASES)
@pytest.mark.parametrize("export", DETECTORS)
def test_the_detector_finds_the_reference_s_boxes(references: References, export: str, phrase: str) -> None:
    detector = references.detector(export)
    size = DETECTORS[export]
    for name, image in references.pictures.items():
        if size == "free" and name not in FREE:
            continue
        found = detector.detect(image, PHRASES[phrase])
        limit = np.tile(image.shape[1::-1], 2)
        boxes = references.answer(name, size, phrase, "boxes").clip(0, limit)
        scores = references.answer(name, size, phrase, "scores")
        seen = (boxes[:, 2:] > boxes[:, :2]).all(axis=1)
        np.testing.assert_allclose([one.score for one in found], scores[seen], atol=TOLERANCE)
        np.testing.assert_allclose([one.box for one in found], boxes[seen], atol=TOLERANCE * limit.max())
        assert {one.phrase for one in found} <= {PHRASES[phrase]}


@pytest.mark.parametrize("export", DETECTORS)
def test_views_in_one_run_are_the_views_one_by_one(references: References, export: str) -> None:
    detector = references.detector(export)
    image = references.pictures[FREE[0]]
    views = [image, image[::-1], image[:, ::-1]]
    together = detector.detect_views([np.ascontiguousarray(view) for view in views], "hole")
    for view, found in zip(views, together, strict=True):
        alone = detector.detect(np.ascontiguousarray(view), "hole")
        np.testing.assert_allclose([one.score for one in found], [one.score for one in alone], atol=TOLERANCE)
        np.testing.assert_allclose([one.box for one in found], [one.box for one in alone], atol=0.1)


@pytest.mark.parametrize("export", SEGMENTERS)
def test_the_segmenter_makes_the_reference_s_masks(references: References, export: str) -> None:
    segmenter = references.segmenter(export)
    model = {"sam2": "sam2", "sam-points": "sam/points"}.get(export, "sam/box")
    for name, image in references.pictures.items():
        made, scores = segmenter.mask_logits(image, boxes_in(image))
        logits = np.stack(list(made))
        expected, quality = references.answer(name, model, "masks"), references.answer(name, model, "scores")
        np.testing.assert_allclose(scores, quality, atol=TOLERANCE * np.abs(quality).max())
        np.testing.assert_allclose(logits, expected, atol=TOLERANCE * np.abs(expected).max())
        assert ((logits > 0) == (expected > 0)).mean() > 1 - TOLERANCE


@pytest.mark.parametrize("export", SEGMENTERS)
def test_boxes_together_are_the_boxes_one_by_one(references: References, export: str) -> None:
    segmenter = references.segmenter(export)
    image = next(iter(references.pictures.values()))
    together = segmenter.segment(image, boxes_in(image))
    alone = [segmenter.segment(image, box[None]) for box in boxes_in(image)]
    np.testing.assert_allclose(together.scores, np.concatenate([one.scores for one in alone]), atol=TOLERANCE)
    assert (together.masks == np.concatenate([one.masks for one in alone])).mean() > 1 - TOLERANCE


def test_the_separators_are_in_the_vocabulary(references: References) -> None:
    vocabulary = (references.folder / "vocab.txt").read_text(encoding="utf-8").split("\n")
    assert set(SEPARATORS) <= set(vocabulary)
