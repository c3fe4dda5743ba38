"""What is asked of the tiny models, and how the answers of the references are kept. Needs numpy only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

PHRASES = {"one word": "Hole", "three words": "round power connector", "split words": "m4 hole"}
EDGES = (96, 160)
"""Shortest and longest edge that the detector's pictures are resized to: the published 800 and 1333 take seconds."""
FRAME = 128
"""Edge of the fixed picture of the detector's first export, and of SAM's picture: the published 800 and 1024."""
THRESHOLD = 0.30
DETECTORS = {"detector-transformers": "fixed", "detector-original": "free"}
"""Each export, and whether the size of its picture is fixed."""
FREE = ("lying", "large")
"""Pictures that become EDGES in size, for which the second export is traced."""
SEGMENTERS = ("sam-exporter", "sam-exporter-raw", "sam2", "sam-points")
BOXES = np.array([[0.10, 0.15, 0.55, 0.80], [0.40, 0.05, 0.95, 0.50], [0.30, 0.40, 0.45, 0.60]])
"""x0, y0, x1, y1 as shares of the picture."""


def pictures() -> dict[str, NDArray[np.uint8]]:
    """(H, W, 3) uint8: lying, standing, and one that is made smaller; discs and bars on a gradient."""
    sizes = {"lying": (48, 80), "standing": (72, 32), "large": (180, 300)}
    return {name: _picture(*size) for name, size in sizes.items()}


def boxes_in(image: NDArray[np.uint8]) -> NDArray[np.float32]:
    """(N, 4) float32 boxes in the picture's pixels."""
    return np.asarray(BOXES * np.tile(image.shape[1::-1], 2), dtype=np.float32)


def _picture(height: int, width: int) -> NDArray[np.uint8]:
    y, x = np.mgrid[0:height, 0:width]
    image = np.stack([255 * x / width, 255 * y / height, 128 + 60 * np.sin(x / 7.0)], axis=2)
    image[np.hypot(x - 0.3 * width, y - 0.45 * height) < 0.22 * min(height, width)] = (220, 40, 60)
    image[np.hypot(x - 0.7 * width, y - 0.3 * height) < 0.15 * min(height, width)] = (30, 200, 240)
    image[int(0.75 * height) : int(0.9 * height), int(0.2 * width) : int(0.8 * width)] = (250, 250, 30)
    return image.round().astype(np.uint8)
