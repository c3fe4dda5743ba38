"""How does light fall on the model? A neutral studio light, edge lines, and hidden parts that shine through."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from querycad_segworker.visibility.cameras import Camera
from querycad_segworker.visibility.raycast import IdImage

NEUTRAL = (222, 224, 228)
"""sRGB of what is not marked: light and grey, so that any marked colour stands out and dark lines read well."""
INK = (38, 42, 48)
"""sRGB of edge lines."""
SMOOTH_DEG = 12.0
"""Faces that meet with less than this between their normals get a faint line: a blend's tangent edges structure the
picture, but are no edges of the part; tessellated normals are off by up to some 6 degrees on each side."""
XRAY = 0.30
"""Opacity of what is hidden: the shape in front stays readable."""
XRAY_OUTLINE = 0.85
"""Opacity of its outline, which must be made out even against a similar colour."""
XRAY_INK = 0.55
"""What is left of the lines in front of it."""
BAND = 128
"""Rows shaded at a time: a large image would need several times its own memory for what is computed on the way."""

_KEY_LIGHT = np.array([-0.45, 0.60, 0.66], dtype=np.float32)  # camera frame, unit: from the upper left, as on drawings
_AMBIENT, _KEY, _HEAD = 0.50, 0.34, 0.26  # add up to about 1 for a surface half-way between light and viewer


def shade(image: IdImage, color_of: NDArray[np.uint8], ghost: IdImage | None = None) -> NDArray[np.uint8]:
    """How does the view look, lit, coloured and with its edges drawn? (H, W, 3) uint8 sRGB on white.

    image: with normals. color_of: (F, 3) uint8 by face id. ghost: the same camera's view of some of the faces alone;
    where one of them is hidden behind another colour in `image`, it shines through.
    """
    height = len(image.face_id_map)
    picture = np.empty((*image.face_id_map.shape, 3), dtype=np.uint8)
    for top in range(0, height, BAND):
        rows = slice(max(0, top - 1), min(height, top + BAND + 1))  # lines reach one row across
        band = _shade(_cut(image, rows), color_of, None if ghost is None else _cut(ghost, rows))
        picture[top : top + BAND] = band[top - rows.start :][:BAND]
    return picture


def light_on(normals: NDArray[np.float32], camera: Camera) -> NDArray[np.float32]:
    """How bright are surfaces that point this way? (N, 3) unit, world frame in; (N,) float32 out, about 0.5 to 1.1."""
    local = normals @ camera.axes.T.astype(np.float32)
    light: NDArray[np.float32] = (
        _AMBIENT + _KEY * np.clip(local @ _KEY_LIGHT, 0, None) + _HEAD * np.clip(local[:, 2], 0, None)
    )
    return light


def _cut(image: IdImage, rows: slice) -> IdImage:
    """The image's rows alone; the camera is still that of the whole."""
    normals = None if image.normals is None else image.normals[rows]
    return IdImage(image.camera, image.face_id_map[rows], image.depth_m[rows], normals)


def _shade(image: IdImage, color_of: NDArray[np.uint8], ghost: IdImage | None) -> NDArray[np.uint8]:
    """What `shade` returns, for a few rows."""
    if image.normals is None:
        raise ValueError("shading needs an image with normals")
    shown = image.face_id_map >= 0
    picture = np.full((*shown.shape, 3), 255, dtype=np.float32)
    light = light_on(image.normals[shown], image.camera)
    picture[shown] = color_of[image.face_id_map[shown]] * light[:, None]
    facing = np.ones(shown.shape, dtype=np.float32)
    facing[shown] = image.normals[shown] @ np.array(image.camera.backward, dtype=np.float32)
    ink = _lines(image, image.normals, facing)
    if ghost is not None:
        _shine_through(picture, ink, image, ghost, color_of)
    picture += (np.array(INK, dtype=np.float32) - picture) * ink[..., None]
    return np.clip(picture, 0, 255).astype(np.uint8)


def _shine_through(
    picture: NDArray[np.float32],
    ink: NDArray[np.float32],
    image: IdImage,
    ghost: IdImage,
    color_of: NDArray[np.uint8],
) -> None:
    """Blends what is hidden into the picture, with an outline in its own colour; lines in front of it get lighter."""
    color_key = np.append(color_of.astype(np.int32) @ (1 << 16, 1 << 8, 1), -1)  # index -1: background
    behind = color_key[ghost.face_id_map]
    hidden = (behind >= 0) & (behind != color_key[image.face_id_map])
    opacity = np.where(hidden, np.float32(XRAY), np.float32(0))
    for axis in (0, 1):
        first, second = _pair(axis)
        change = behind[first] != behind[second]
        for side in (first, second):
            opacity[side][change & hidden[side]] = XRAY_OUTLINE
    blend = opacity[hidden][:, None]
    picture[hidden] += (color_of[ghost.face_id_map[hidden]] - picture[hidden]) * blend
    ink[hidden] *= XRAY_INK


def _lines(image: IdImage, normals: NDArray[np.float32], facing: NDArray[np.float32]) -> NDArray[np.float32]:
    """How dark is the line on each pixel? (H, W) float32, 0 to 1. `facing`: cosine between normal and viewer.

    Silhouettes and steps in depth are strongest, sharp edges between faces follow, tangent edges are faint.
    """
    ids = image.face_id_map
    ink = np.zeros(ids.shape, dtype=np.float32)
    slope = np.sqrt(1 - np.clip(facing, 0.05, 1) ** 2) / np.clip(facing, 0.05, 1)  # depth gained per sideways step
    for axis in (0, 1):
        first, second = _pair(axis)
        differs = ids[first] != ids[second]
        outline = differs & ((ids[first] < 0) | (ids[second] < 0))
        with np.errstate(invalid="ignore"):  # infinity minus infinity: background beside background
            drop = np.abs(image.depth_m[first] - image.depth_m[second])
            step = drop > image.camera.pixel_m * (4 + 2 * np.maximum(slope[first], slope[second]))
        sharp = np.einsum("ijk,ijk->ij", normals[first], normals[second]) < np.cos(np.radians(SMOOTH_DEG))
        weight = np.select([outline | step, differs & sharp, differs], [0.95, 0.75, 0.22], 0.0).astype(np.float32)
        ink[first] = np.maximum(ink[first], weight)
        ink[second] = np.maximum(ink[second], np.where(weight > 0.5, weight, 0))
    return ink


def _pair(axis: int) -> tuple[tuple[slice, ...], tuple[slice, ...]]:
    """Index of every pixel that has a next one along the axis, and of those next ones."""
    here, following = slice(None, -1), slice(1, None)
    return ((here,), (following,)) if axis == 0 else ((slice(None), here), (slice(None), following))
