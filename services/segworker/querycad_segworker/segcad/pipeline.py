"""Which faces of a model does a phrase mean, as far as can be seen? The six stages, one after the other.

Render, detect, segment, align, prune view by view; then merge what the views found (QueryCAD paper, section SegCAD).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Side
from querycad_segworker.visibility.faces import FaceVisibility, visible_pixels
from querycad_segworker.visibility.renderer import Renderer

from .align import Aligned, Discarded, align
from .detect import detect
from .merge import Find, merge
from .ports import Detection, Masks, VisionModels, VisionOptions
from .prune import FaceGraph, prune
from .render import View, render
from .segment import segment


@dataclass(frozen=True, slots=True, eq=False)
class Looked:
    """What every stage made of one view; what the pictures are drawn from."""

    view: View
    detections: tuple[Detection, ...]
    masks: Masks
    """One for each detection."""
    aligned: tuple[Aligned, ...]
    discarded: tuple[Discarded, ...]
    finds: tuple[Find, ...]
    """One for each of `aligned`: the faces that pruning left."""


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """What vision found in a model."""

    finds: tuple[Find, ...]
    """Parts, by their lowest face."""
    visibility: FaceVisibility
    """How much of each face the six sides show."""


def find(
    renderer: Renderer,
    graph: FaceGraph,
    face_count: int,
    phrase: str,
    models: VisionModels,
    options: VisionOptions | None = None,
    watch: Callable[[Looked], None] = lambda _: None,
) -> Seen:
    """Which parts does `phrase` mean? `watch` is shown every view, which is not kept otherwise."""
    numbers = options or VisionOptions()
    finds: list[Find] = []
    views: list[tuple[NDArray[np.int64], float]] = []
    for view in render(renderer, face_count, numbers):
        looked = look(view, graph, phrase, models, numbers)
        finds.extend(looked.finds)
        views.append((view.visible, view.camera.pixel_m))
        watch(looked)
        del view, looked  # or the next view would be made while this one is still held
    return Seen(merge(finds, graph if numbers.join_neighbours else None), _visibility(renderer, face_count, views))


def look(view: View, graph: FaceGraph, phrase: str, models: VisionModels, options: VisionOptions) -> Looked:
    """Which faces does `phrase` mean in this view?"""
    detections = detect(view, phrase, models.detector, options)
    masks = segment(view, detections, models.segmenter)
    aligned, discarded = align(view, masks.masks, options)
    finds = tuple(
        Find(prune(one.faces, one.nearest, graph), (view.camera.name,), detections[one.mask].score) for one in aligned
    )
    return Looked(view, detections, masks, tuple(aligned), tuple(discarded), finds)


def _visibility(renderer: Renderer, face_count: int, views: list[tuple[NDArray[np.int64], float]]) -> FaceVisibility:
    """What the sides show: the six views themselves, or, where corners were looked from, six more."""
    if len(views) != len(Side):
        return visible_pixels(renderer, face_count)
    pixels = np.stack([visible for visible, _ in views]).astype(np.int32)
    return FaceVisibility(pixels, np.array([pixel_m for _, pixel_m in views]))
