"""Which faces does a mask mean? Its pixels are looked up in the ID image of the view it was made of (stage 4)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from .ports import VisionOptions
from .render import View


@dataclass(frozen=True, slots=True)
class Aligned:
    """A mask, and the faces that it means."""

    mask: int
    """Which of the masks given."""
    faces: frozenset[int]
    nearest: int
    """Of these, the one that the mask shows nearest to the camera."""


@dataclass(frozen=True, slots=True)
class Discarded:
    """A mask that means no part, and why not."""

    mask: int
    reason: str


@dataclass(frozen=True, slots=True, eq=False)
class _Area:
    """Where a mask covers the model."""

    mask: int
    window: tuple[slice, slice]
    covers: NDArray[np.bool_]
    """Inside the window: masked, and not background."""
    pixels: int


def align(
    view: View, masks: NDArray[np.bool_], options: VisionOptions | None = None
) -> tuple[list[Aligned], list[Discarded]]:
    """Which faces does each of the (N, H, W) bool masks mean, and which masks mean none? Both in the masks' order.

    Only pixels of the model count. First masks over more than `largest_mask` of it go, then, from small to large, those
    of which smaller ones that stay cover more than `covered`; equal ones are one. Raises ValueError for masks of
    another size than the view.
    """
    numbers = options or VisionOptions()
    if masks.shape[1:] != view.face_id_map.shape:
        raise ValueError(f"masks of {masks.shape[1:]} pixels do not fit a view of {view.face_id_map.shape}")
    aligned: list[Aligned] = []
    gone: list[Discarded] = []
    taken = np.zeros(view.face_id_map.shape, dtype=np.bool_)
    model_pixels = int(view.visible.sum())
    for area in sorted(_areas(view, masks), key=lambda area: area.pixels):
        reason = _not_a_part(area, taken, model_pixels, numbers)
        found = _faces(view, area, numbers) if reason is None else None
        if found is None:
            gone.append(Discarded(area.mask, reason or "no face is masked enough"))
            continue
        taken[area.window] |= area.covers
        aligned.append(found)
    return sorted(aligned, key=lambda one: one.mask), sorted(gone, key=lambda one: one.mask)


def _areas(view: View, masks: NDArray[np.bool_]) -> list[_Area]:
    areas = []
    for index, mask in enumerate(masks):
        left, top, width, height = cv2.boundingRect(np.ascontiguousarray(mask).view(np.uint8))
        window = (slice(top, top + height), slice(left, left + width))
        covers = mask[window] & (view.face_id_map[window] >= 0)
        areas.append(_Area(index, window, covers, int(np.count_nonzero(covers))))
    return areas


def _not_a_part(area: _Area, taken: NDArray[np.bool_], model_pixels: int, options: VisionOptions) -> str | None:
    """Why is the mask not one part? None when it may be."""
    if not area.pixels:
        return "it shows nothing of the model"
    share = area.pixels / model_pixels
    if share > options.largest_mask:
        return f"it covers {share:.0%} of the model"
    covered = np.count_nonzero(taken[area.window] & area.covers) / area.pixels
    if covered > options.covered:
        return f"smaller masks cover {covered:.0%} of it"
    return None


def _faces(view: View, area: _Area, options: VisionOptions) -> Aligned | None:
    """The faces of which enough is masked; None when there are none."""
    ids = view.face_id_map[area.window][area.covers]
    masked = np.bincount(ids, minlength=len(view.visible))
    meant = masked > options.face_share * view.visible
    if not meant.any():
        return None
    depth = np.where(meant[ids], view.ids.depth_m[area.window][area.covers], np.inf)
    return Aligned(area.mask, frozenset(np.flatnonzero(meant).tolist()), int(ids[depth.argmin()]))
