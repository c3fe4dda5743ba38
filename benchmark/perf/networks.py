"""What do the networks of the vision path cost? Detector and segmenter apart, a view at a time and together."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmark.scoring.items import BadBenchmark
from querycad_segworker.segcad.engines.grounding_dino import GroundingDino
from querycad_segworker.segcad.engines.sam import Sam
from querycad_segworker.segcad.engines.weights import load_models
from querycad_segworker.segcad.ports import VisionOptions, WeightsAbsent

from .figures import Measurement

PHRASE = "power connector"


@dataclass(frozen=True, slots=True)
class NetworkOptions:
    """What is measured, and how often."""

    weights: Path
    views: int = 6
    boxes: int = 20
    repeat: int = 3


def network_measurements(options: NetworkOptions) -> Iterator[Measurement]:
    """Seconds a view, each beside the same work done one by one. Raises BadBenchmark where there are no weights."""
    try:
        models = load_models(options.weights)
    except WeightsAbsent as absent:
        raise BadBenchmark(str(absent)) from absent
    detector, segmenter = models.detector, models.segmenter
    assert isinstance(detector, GroundingDino)
    assert isinstance(segmenter, Sam)
    views = [_view(seed) for seed in range(options.views)]
    yield from _detector(detector, views, options)
    yield from _segmenter(segmenter, views[0], options)


def _detector(
    detector: GroundingDino, views: list[NDArray[np.uint8]], options: NetworkOptions
) -> Iterator[Measurement]:
    together, alone = _alternating(
        lambda: detector.detect_views(views, PHRASE),
        lambda: [detector.detect(view, PHRASE) for view in views],
        options.repeat,
    )
    yield Measurement(
        name=f"detector, a view of {len(views)} asked together",
        value=together / len(views),
        unit="s",
        baseline_name="a view asked alone",
        baseline=alone / len(views),
    )


def _segmenter(segmenter: Sam, view: NDArray[np.uint8], options: NetworkOptions) -> Iterator[Measurement]:
    boxes = _boxes(options.boxes, view.shape[1], view.shape[0])
    together, alone = _alternating(
        lambda: segmenter.segment(view, boxes),
        lambda: [segmenter.segment(view, box[None]) for box in boxes],
        options.repeat,
    )
    first = alone / len(boxes)
    yield Measurement(
        name=f"segmenter, a view with {len(boxes)} boxes together",
        value=together,
        unit="s",
        baseline_name="the boxes one by one, the view embedded for each",
        baseline=alone,
        limit="under the baseline",
        holds=together < alone,
    )
    yield Measurement(
        name="  each further box of a view",
        value=max(together - first, 0.0) / max(len(boxes) - 1, 1),
        unit="s",
        baseline_name="the first box: embedding, box and mask",
        baseline=first,
    )


def _alternating(one: Callable[[], object], other: Callable[[], object], repeat: int) -> tuple[float, float]:
    """Median seconds of both, taken in turns, so that both see the same machine; the first turn warms up."""
    taken: tuple[list[float], list[float]] = ([], [])
    for turn in range(repeat + 1):
        for call, seconds in zip((one, other), taken, strict=True):
            start = time.perf_counter()
            call()
            if turn:
                seconds.append(time.perf_counter() - start)
    return statistics.median(taken[0]), statistics.median(taken[1])


def _view(seed: int) -> NDArray[np.uint8]:
    """A picture of the size that the pipeline draws; how long a network takes does not depend on what it shows."""
    options = VisionOptions()
    image = np.random.default_rng(seed).integers(0, 256, (options.height, options.width, 3), dtype=np.uint8)
    return np.asarray(image)


def _boxes(count: int, width: int, height: int) -> NDArray[np.float32]:
    """(N, 4) boxes of a fifth of the picture, anywhere in it."""
    low = np.random.default_rng(0).random((count, 2)) * 0.8
    return (np.hstack([low, low + 0.2]) * [width, height, width, height]).astype(np.float32)
