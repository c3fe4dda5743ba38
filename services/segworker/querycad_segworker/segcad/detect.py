"""Where in a view may a phrase be seen? The boxes that the detector is sure enough of (stage 2)."""

from __future__ import annotations

from .ports import Detection, Detector, VisionOptions
from .render import View


def detect(view: View, phrase: str, detector: Detector, options: VisionOptions) -> tuple[Detection, ...]:
    """Which boxes may hold what `phrase` means? Best score first; empty when none."""
    found = detector.detect(view.picture, phrase)
    return tuple(each for each in found if each.score > options.box_threshold)
