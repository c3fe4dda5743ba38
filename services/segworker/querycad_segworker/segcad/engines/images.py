"""How does a picture become a network's input, and a network's small mask a picture? Exactly as in the references."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

Size = tuple[int, int]
"""Height and width in pixels."""

IMAGENET_MEAN = np.array([0.485, 0.456, 0.406], dtype=np.float32)
IMAGENET_STD = np.array([0.229, 0.224, 0.225], dtype=np.float32)
"""Of red, green and blue in 0..1: what all the models here were trained with."""


def resize(image: NDArray[np.uint8], size: Size) -> NDArray[np.uint8]:
    """The (H, W, 3) uint8 image at another size. Pillow's bilinear filter, which averages where it shrinks.

    The references resize so. OpenCV's bilinear filter skips pixels where it shrinks, and its area filter is a box.
    """
    if image.shape[:2] == size:
        return image
    return np.asarray(Image.fromarray(image).resize((size[1], size[0]), Image.Resampling.BILINEAR))


def normalised(image: NDArray[np.uint8]) -> NDArray[np.float32]:
    """(3, H, W) float32 of an (H, W, 3) uint8 image: by ImageNet's mean and deviation."""
    scaled = image.astype(np.float32) * np.float32(1 / 255)
    return np.ascontiguousarray(((scaled - IMAGENET_MEAN) / IMAGENET_STD).transpose(2, 0, 1))


def padded(pixels: NDArray[np.float32], size: Size) -> NDArray[np.float32]:
    """(3, H, W) with zeros to the right and below, up to `size`."""
    return np.pad(pixels, ((0, 0), (0, size[0] - pixels.shape[1]), (0, size[1] - pixels.shape[2])))


def size_by_edges(size: Size, shortest: int, longest: int) -> Size:
    """The size at which the shorter edge is `shortest`, unless the longer one would exceed `longest`.

    Rounds as the detector's reference processor does, so that the same pixels come out.
    """
    low, high = float(min(size)), float(max(size))
    edge: float = shortest
    if high / low * shortest > longest:
        edge = longest * low / high
    short, other = round(edge), int(edge * high / low)
    if min(size) == short:
        return size
    return (short, other) if size[0] <= size[1] else (other, short)


def size_within(size: Size, frame: Size) -> Size:
    """The largest size of the same shape inside `frame`; rounded down, as the detector's reference processor does."""
    scale = min(frame[0] / size[0], frame[1] / size[1])
    return int(size[0] * scale), int(size[1] * scale)


def size_by_longest(size: Size, longest: int) -> Size:
    """The size at which the longer edge is `longest`; rounded to the nearest pixel, as SAM's reference does."""
    scale = longest / max(size)
    return int(size[0] * scale + 0.5), int(size[1] * scale + 0.5)


def enlarged(mask: NDArray[np.float32], size: Size) -> NDArray[np.float32]:
    """The (H, W) float32 mask at another size, bilinear between pixel centres: the references' interpolation."""
    return np.asarray(cv2.resize(mask, (size[1], size[0]), interpolation=cv2.INTER_LINEAR), dtype=np.float32)
