"""Which pixels belong to what a box holds? One mask for each box (stage 3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .ports import Detection, Masks, Segmenter
from .render import View


def segment(view: View, detections: Sequence[Detection], segmenter: Segmenter) -> Masks:
    """Which pixels of the view does each detection mean? The segmenter is not asked where nothing was detected."""
    if not detections:
        return Masks(np.zeros((0, *view.face_id_map.shape), dtype=np.bool_), np.zeros(0, dtype=np.float32))
    boxes = np.array([detection.box for detection in detections], dtype=np.float32)
    return segmenter.segment(view.picture, boxes)
