"""What is shown to the networks? The model from every view, each face in a colour of its own (stage 1)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from querycad_contracts import Side
from querycad_segworker.render.colored import face_colors, paint
from querycad_segworker.visibility.cameras import CORNERS, Camera, corner_camera, side_camera
from querycad_segworker.visibility.faces import face_pixels
from querycad_segworker.visibility.raycast import FaceIds, IdImage
from querycad_segworker.visibility.renderer import Renderer

from .ports import VisionOptions


@dataclass(frozen=True, slots=True, eq=False)
class View:
    """The model from one camera: the picture for the networks, and what each of its pixels shows."""

    ids: IdImage
    picture: NDArray[np.uint8]
    """(H, W, 3) uint8 sRGB."""
    visible: NDArray[np.int64]
    """(F,) int64, pixels that each face owns."""

    @property
    def camera(self) -> Camera:
        """Where is it seen from?"""
        return self.ids.camera

    @property
    def face_id_map(self) -> FaceIds:
        """Which face does each pixel show? (H, W) int16 or int32, -1 for the background."""
        return self.ids.face_id_map


def render(renderer: Renderer, face_count: int, options: VisionOptions) -> Iterator[View]:
    """How does the model look from each view? One view at a time: each holds some 20 MB."""
    colors = face_colors(face_count, options.color_seed)
    for camera in cameras(renderer.bounds, options):
        yield _view(renderer.render_ids(camera, normals=options.shaded), colors)


def _view(ids: IdImage, colors: NDArray[np.uint8]) -> View:
    """A function of its own: a loop's variable would hold the last view's image while the next one is drawn."""
    return View(ids, paint(ids, colors), face_pixels(ids, len(colors)))


def cameras(bounds_m: ArrayLike, options: VisionOptions) -> tuple[Camera, ...]:
    """Which cameras look at a model in this box? The sides in the order of `Side`, or the corners."""
    size = (options.width, options.height)
    if options.views == len(Side):
        return tuple(side_camera(side, bounds_m, *size, off_axis_deg=options.azimuth_offset_deg) for side in Side)
    return tuple(corner_camera(corner, bounds_m, *size, elevation_deg=options.elevation_deg) for corner in CORNERS)
