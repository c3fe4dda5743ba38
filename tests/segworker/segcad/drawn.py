"""Views drawn by hand: small arrays of face ids and depths, no model behind them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from querycad_contracts import Side
from querycad_segworker.render.colored import face_colors, paint
from querycad_segworker.segcad.render import View
from querycad_segworker.visibility.cameras import side_camera
from querycad_segworker.visibility.raycast import IdImage


def view(*rows: str, depth: Sequence[str] = (), faces: int = 10) -> View:
    """A view from the top: each character is a pixel, a digit its face, a dot the background.

    `depth`: as many digits, each a depth in metres; 1 m everywhere when left out.
    """
    ids = np.array([[-1 if c == "." else int(c) for c in row] for row in rows], dtype=np.int32)
    away = np.array([[float(c) for c in row] for row in depth] if depth else np.ones(ids.shape), dtype=np.float32)
    away[ids < 0] = np.inf
    camera = side_camera(Side.TOP, [(0, 0, 0), (1, 1, 1)], ids.shape[1], ids.shape[0])
    image = IdImage(camera, ids, away, None)
    visible = np.bincount(ids[ids >= 0], minlength=faces).astype(np.int64)
    return View(image, paint(image, face_colors(faces)), visible)


def masks(*each: Sequence[str]) -> NDArray[np.bool_]:
    """(N, H, W) bool: an x is masked."""
    return np.array([[[c == "x" for c in row] for row in mask] for mask in each], dtype=np.bool_)
