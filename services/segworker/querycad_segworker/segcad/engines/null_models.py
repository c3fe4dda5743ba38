"""What takes the networks' place where their weights are missing: nothing is found, everything else is done."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.segcad.ports import Detection, Masks, VisionModels


class _NullModel:
    def detect(self, image: NDArray[np.uint8], phrase: str) -> list[Detection]:  # noqa: ARG002 - the port's names
        return []

    def segment(self, image: NDArray[np.uint8], boxes: NDArray[np.float32]) -> Masks:
        return Masks(np.zeros((len(boxes), *image.shape[:2]), dtype=np.bool_), np.zeros(len(boxes), dtype=np.float32))


NULL_MODELS = VisionModels(_NullModel(), _NullModel())
"""Finds nothing."""
