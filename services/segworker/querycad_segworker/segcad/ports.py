"""What do the stages of the vision path owe each other? The neural models' ports, their values, and the options.

Images are (H, W, 3) uint8 sRGB, rows downwards. Boxes are pixels x0, y0, x1, y1 with (0, 0) at the outer corner of the
first pixel, so that a box around the whole image is (0, 0, W, H).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

Box = tuple[float, float, float, float]
"""x0, y0, x1, y1 in pixels, x0 <= x1, y0 <= y1, inside the image."""


@dataclass(frozen=True, slots=True)
class VisionOptions:
    """Every number of the vision path, by name; all but `join_neighbours` are the QueryCAD paper's by default."""

    views: Literal[6, 8] = 6
    """6: along the axes; 8: from the corners, half-way between the axes."""
    azimuth_offset_deg: float = 1.0
    """Turn of each axis view, so that walls along the viewing direction own pixels."""
    elevation_deg: float = 45.0
    """Of the corner views, above and below the horizon."""
    width: int = 1920
    height: int = 1080
    shaded: bool = False
    """Whether the detector sees light on the faces' colours; the published pictures are flat."""
    color_seed: int = 0
    """Which face gets which colour: the same for the same seed."""
    box_threshold: float = 0.30
    """Score below which a detected box is no detection."""
    face_share: float = 0.05
    """A face counts when more than this share of its visible pixels is masked."""
    largest_mask: float = 0.45
    """A mask over more than this share of the model's pixels is the model, not a part of it."""
    covered: float = 0.50
    """A mask covered by smaller ones over more than this share of itself is a group of parts, not a part."""
    join_neighbours: bool = True
    """Whether finds that meet along an edge are one part where no view shows them apart; as published, False: only
    finds that share a face are."""


@dataclass(frozen=True, slots=True)
class Detection:
    """A place in an image where the phrase may be seen."""

    box: Box
    score: float
    """0 to 1; above the detector's threshold."""
    phrase: str


@dataclass(frozen=True, slots=True, eq=False)
class Masks:
    """What the segmenter made of N boxes, in their order."""

    masks: NDArray[np.bool_]
    """(N, H, W) bool."""
    scores: NDArray[np.float32]
    """(N,) float32: the segmenter's own estimate of each mask's quality (intersection over union), about 0 to 1."""

    def __post_init__(self) -> None:
        if self.masks.ndim != 3 or self.masks.dtype != np.bool_ or self.scores.shape != (len(self.masks),):
            raise ValueError(
                f"masks must be (N, H, W) bool with (N,) scores, not {self.masks.shape} {self.masks.dtype} "
                f"with {self.scores.shape}"
            )


class Detector(Protocol):
    """Finds boxes for words. GroundingDINO as published; one object a process, made after the fork."""

    def detect(self, image: NDArray[np.uint8], phrase: str) -> list[Detection]:
        """Where in the (H, W, 3) uint8 image may `phrase` be seen? Best score first; empty when nowhere."""
        ...


class Segmenter(Protocol):
    """Turns boxes into masks. SAM as published; one object a process, made after the fork."""

    def segment(self, image: NDArray[np.uint8], boxes: NDArray[np.float32]) -> Masks:
        """Which pixels of the (H, W, 3) uint8 image belong to what each box holds?

        boxes: (N, 4) float32, N >= 1. The image is embedded once, all boxes are decoded in one batch.
        """
        ...


@dataclass(frozen=True, slots=True)
class VisionModels:
    """The two models that the vision path needs, ready to run."""

    detector: Detector
    segmenter: Segmenter


class WeightsAbsent(Exception):
    """The weights of the vision path are not on this machine: a state to tell the user, not a fault.

    The message is one sentence that says which are missing and how to get them.
    `querycad_segworker.segcad.engines.weights.load_models` raises it.
    """
