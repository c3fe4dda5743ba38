"""How much of a part do align, prune and merge give back when detector and segmenter are perfect?"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Part
from querycad_segworker.segcad.engines.known import KnownParts
from querycad_segworker.segcad.merge import Find, merge
from querycad_segworker.segcad.pipeline import look
from querycad_segworker.segcad.ports import VisionOptions
from querycad_segworker.segcad.prune import FaceGraph, prune
from querycad_segworker.segcad.render import View, render
from querycad_segworker.visibility.renderer import Renderer


@dataclass(frozen=True, slots=True)
class Recovered:
    """How a part came back."""

    face_iou: float
    """Of its visible faces with those of the find that is most like it."""
    is_meant: bool
    """Whether the stages are meant to give it back: as far as it is seen it hangs together over common edges, and it is
    not most of the model in every view that shows it."""


SURFACES = "face"


def recovery(
    renderer: Renderer, graph: FaceGraph, face_count: int, parts: Sequence[Part], options: VisionOptions
) -> Mapping[str, Recovered]:
    """How each part that is seen comes back, by id. Parts of one kind are looked for together, as for a phrase.

    Only faces that own a pixel in some view count. Plane faces as such are left out: looked for together, they border
    each other all over the model and are one find.
    """
    views = list(render(renderer, face_count, options))
    shown = np.sum([view.visible for view in views], axis=0) > 0
    kinds: dict[str, list[Part]] = defaultdict(list)
    for part in parts:
        if part.kind != SURFACES:
            kinds[part.kind].append(part)
    found: dict[str, Recovered] = {}
    for alike in kinds.values():
        models = KnownParts(face_count, [part.faces for part in alike], options.color_seed).models
        finds = merge(
            [find for view in views for find in look(view, graph, "", models, options).finds],
            graph if options.join_neighbours else None,
        )
        for part in alike:
            faces = frozenset(face for face in part.faces if shown[face])
            if faces:
                iou = max((_iou(faces, find) for find in finds), default=0.0)
                found[part.id] = Recovered(iou, _is_meant(faces, views, graph, options))
    return found


def _is_meant(faces: frozenset[int], views: Sequence[View], graph: FaceGraph, options: VisionOptions) -> bool:
    if prune(faces, min(faces), graph) != faces:
        return False
    shares = (_share(view.visible, faces) for view in views)
    return any(0 < share <= options.largest_mask for share in shares)


def _share(visible: NDArray[np.int64], faces: frozenset[int]) -> float:
    """Which share of the model's pixels in this view is the faces'?"""
    return float(visible[list(faces)].sum() / max(1, visible.sum()))


def _iou(faces: frozenset[int], find: Find) -> float:
    return len(faces & find.faces) / len(faces | find.faces)
