"""A picture of a model from one of its sides or from a corner, without marks."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

from querycad_contracts import Side, ViewName
from querycad_segworker.mesh import Mesh
from querycad_segworker.model import Artefacts
from querycad_segworker.visibility.cameras import Camera, isometric_camera, side_camera
from querycad_segworker.visibility.raycast import Scene

from .pictures import save_png
from .shading import NEUTRAL, shade
from .sheet import OVERSAMPLING

MARGIN = 0.05


def draw_view(artefacts: Artefacts, view: ViewName, size: tuple[int, int], path: Path | BytesIO) -> None:
    """Draws the model into a PNG file, or memory; `size`: pixels (width, height). Raises OSError."""
    save_png(picture_of(Mesh.load(artefacts.mesh), view, size), path)


def picture_of(mesh: Mesh, view: ViewName, size: tuple[int, int]) -> Image.Image:
    """How does the model look from there? An RGB image of `size` pixels (width, height)."""
    scene = Scene(mesh, threads=1)  # a segworker is one of several processes that share the machine
    camera = _camera(view, scene, (size[0] * OVERSAMPLING, size[1] * OVERSAMPLING))
    faces = int(mesh.triangle_face.max(initial=-1)) + 1
    colors = np.tile(np.array(NEUTRAL, dtype=np.uint8), (max(faces, 1), 1))
    fine = Image.fromarray(shade(scene.render_ids(camera, normals=True), colors))
    return fine.resize(size, Image.Resampling.BOX)


def _camera(view: ViewName, scene: Scene, size: tuple[int, int]) -> Camera:
    if view is ViewName.ISOMETRIC:
        return isometric_camera(scene.bounds, *size, MARGIN)
    return side_camera(Side(view.value), scene.bounds, *size, MARGIN)
