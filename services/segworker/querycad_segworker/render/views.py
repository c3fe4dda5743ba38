"""From where are the marked parts seen best? As few views as show them all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Side
from querycad_segworker.visibility.cameras import CORNERS, MARGIN, Camera, corner_camera, side_camera
from querycad_segworker.visibility.raycast import Scene

PREVIEW = (480, 360)
"""Pixels of the images that views are compared on: fourteen of them take as long as one 1920x1080 view."""
MIN_PIXELS = 4
"""Preview pixels below which a part counts as not seen: about 10 by 10 in the picture."""
SHOWN_SHARE = 0.3
"""A part is shown in a view where it appears at least this large, relative to its best view."""
SIDE_WEIGHT = 0.7
"""A view along an axis counts less than one from a corner: it tells nothing about depth, so it must show much more."""
NEARLY = 0.95
"""Of views that show nearly as much as the best, the first is taken: the isometric view, unless another pays off."""
MAX_VIEWS = 4

UNMARKED = -1

Viewpoint = Side | tuple[int, int, int]
VIEWPOINTS: tuple[Viewpoint, ...] = (*CORNERS, *Side)
"""The 8 corners, the usual isometric view first, then the 6 sides."""


@dataclass(frozen=True, slots=True)
class View:
    """A direction to look from and the parts that are labelled there."""

    viewpoint: Viewpoint
    parts: tuple[int, ...]


def camera_at(
    viewpoint: Viewpoint,
    bounds_m: NDArray[np.float64],
    size: tuple[int, int],
    margin: float,
    focus_m: NDArray[np.float64],
) -> Camera:
    """Which camera looks from this viewpoint, `focus_m` (N, 3) filling the image?"""
    if isinstance(viewpoint, Side):
        return side_camera(viewpoint, bounds_m, *size, margin, focus_m)
    return corner_camera(viewpoint, bounds_m, *size, margin, focus_m)


def choose_views(scene: Scene, part_of: NDArray[np.int32], part_count: int) -> tuple[View, ...]:
    """Which views show all parts? At most four; every part is labelled in exactly one of them.

    part_of: (F,) int32, index of each face's part, -1 for none. Greedy: the view that shows most of the parts still to
    be shown, and of such views the one that shows them largest, relative to each part's best view; then the next.
    Parts seen from nowhere go to the first view.
    """
    if not (part_of >= 0).any():
        return (View(VIEWPOINTS[0], tuple(range(part_count))),)
    areas = _part_areas(scene, part_of, part_count)
    best = areas.max(axis=0)
    weight = np.array([SIDE_WEIGHT if isinstance(viewpoint, Side) else 1.0 for viewpoint in VIEWPOINTS])
    share = areas / np.where(best > 0, best, 1.0)
    left = best > 0
    chosen: list[tuple[int, NDArray[np.bool_]]] = []
    while left.any() and len(chosen) < MAX_VIEWS:
        shown = (share >= SHOWN_SHARE) & left
        gain = weight * (shown + share * left).sum(axis=1)
        view = int((gain >= NEARLY * gain.max()).argmax())
        chosen.append((view, shown[view]))
        left = left & ~shown[view]
    if not chosen:
        return (View(VIEWPOINTS[0], tuple(range(part_count))),)
    unseen = ~np.any([shown for _, shown in chosen], axis=0)
    return tuple(
        View(VIEWPOINTS[view], tuple(int(part) for part in np.flatnonzero(shown | unseen if order == 0 else shown)))
        for order, (view, shown) in enumerate(chosen)
    )


def _part_areas(scene: Scene, part_of: NDArray[np.int32], part_count: int) -> NDArray[np.float64]:
    """How large does each part appear in each preview? (views, parts) float64, visible projected area in m2.

    The marked faces fill the previews. Less than `MIN_PIXELS` count as nothing, unless no preview shows more.
    """
    focus = scene.mesh.of_faces(np.flatnonzero(part_of >= 0)).points_m
    if not len(focus):
        return np.zeros((len(VIEWPOINTS), part_count))
    lookup = np.append(part_of, UNMARKED)  # index -1: background
    pixels = np.zeros((len(VIEWPOINTS), part_count), dtype=np.int64)
    pixel_m = np.zeros((len(VIEWPOINTS), 1))
    for row, viewpoint in enumerate(VIEWPOINTS):
        camera = camera_at(viewpoint, scene.bounds, PREVIEW, MARGIN, focus)
        parts = lookup[scene.render_ids(camera).face_id_map]
        pixels[row] = np.bincount(parts[parts >= 0], minlength=part_count)
        pixel_m[row] = camera.pixel_m
    pixels[pixels < np.minimum(pixels.max(axis=0), MIN_PIXELS)] = 0
    return pixels * pixel_m**2


def marked_faces(face_count: int, faces: Sequence[Sequence[int]]) -> NDArray[np.int32]:
    """Which part does each face belong to? (face_count,) int32, -1 for none; a face named twice is the first part's."""
    part_of = np.full(face_count, UNMARKED, dtype=np.int32)
    for part in reversed(range(len(faces))):
        part_of[list(faces[part])] = part
    return part_of
