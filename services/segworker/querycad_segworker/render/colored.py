"""How does a view look to a network that finds things in pictures? Every face in a colour of its own."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from querycad_segworker.visibility.raycast import IdImage

from .shading import BAND, light_on


def face_colors(count: int, seed: int = 0) -> NDArray[np.uint8]:
    """Which colour has each face? (count, 3) uint8 sRGB, all different, none white; the same for the same seed.

    The points of a regular grid in the colour cube, as coarse as the number allows: with n = ceil(cbrt(count + 1))
    levels a channel, any two colours are at least 255 / (n - 1) apart in some channel, less one for rounding. The seed
    says which face gets which, so that faces which are neighbours in the file are strangers in colour.
    """
    levels = max(2, math.ceil((count + 1) ** (1 / 3) - 1e-9))
    steps = np.round(np.linspace(0, 255, levels)).astype(np.uint8)
    grid = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)[:-1]  # white comes last
    return grid[np.random.default_rng(seed).permutation(len(grid))[:count]]


def paint(image: IdImage, colors: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """What is seen, each face in its colour on white, with light on it where `image` has normals? (H, W, 3) uint8.

    colors: (F, 3) uint8 by face id. Without light every pixel of a face has exactly its colour.
    """
    table = np.full((len(colors) + 1, 4), 255, dtype=np.uint8)
    table[:-1, :3] = colors  # the last one, index -1, is the background's
    words = table.view(np.uint32)[:, 0]
    picture = np.empty((*image.face_id_map.shape, 3), dtype=np.uint8)
    for top in range(0, len(picture), BAND):
        rows = slice(top, min(top + BAND, len(picture)))
        packed = np.take(words, image.face_id_map[rows], mode="wrap")
        band = cv2.cvtColor(packed.view(np.uint8).reshape(*packed.shape, 4), cv2.COLOR_RGBA2RGB)
        if image.normals is not None:
            shown = image.face_id_map[rows] >= 0
            lit = band[shown] * light_on(image.normals[rows][shown], image.camera)[:, None]
            band[shown] = np.clip(lit, 0, 255).astype(np.uint8)
        picture[rows] = band
    return picture
