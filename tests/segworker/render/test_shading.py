"""Shading: on images of a few pixels, drawn by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from querycad_segworker.render.shading import BAND, INK, shade
from querycad_segworker.visibility.cameras import Camera, isometric_camera
from querycad_segworker.visibility.raycast import IdImage

CAMERA: Camera = replace(isometric_camera([(0, 0, 0), (1, 1, 1)], 6, 6), pixel_m=0.1)
GREY = np.array([[200, 200, 200]], dtype=np.uint8)


def picture_of(ids: list[list[int]], depth: float = 1.0) -> IdImage:
    """Everything facing the viewer, at one depth."""
    face_id_map = np.array(ids, dtype=np.int32)
    shown = face_id_map >= 0
    depth_m = np.where(shown, depth, np.inf).astype(np.float32)
    normals = np.where(shown[..., None], CAMERA.backward, 0).astype(np.float32)
    return IdImage(CAMERA, face_id_map, depth_m, normals)


def darkness(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    dark: NDArray[np.float64] = 255.0 - pixels.mean(axis=-1, dtype=np.float64)
    return dark


def test_background_is_white_and_a_face_has_its_colour() -> None:
    ids = [[-1] * 6, *[[-1, 0, 0, 0, 0, 0]] * 5]
    result = shade(picture_of(ids), np.array([[250, 120, 10]], dtype=np.uint8))
    assert (result[0, 0] == 255).all()
    red, green, blue = (int(value) for value in result[4, 4])
    assert red > green > blue
    assert green / red == pytest.approx(120 / 250, abs=0.02)


def test_the_silhouette_is_inked() -> None:
    result = shade(picture_of([[-1, -1, 0, 0, 0, 0]] * 6), GREY)
    assert darkness(result[3, 1:3]).min() > 150
    assert darkness(result[3, [0, 4, 5]]).max() < 80


def test_a_sharp_edge_is_darker_than_a_tangent_one() -> None:
    smooth = picture_of([[0, 0, 0, 1, 1, 1]] * 6)
    assert smooth.normals is not None
    turned = smooth.normals.copy()
    turned[:, 3:] = CAMERA.right
    colors = np.repeat(GREY, 2, axis=0)
    sharp = IdImage(CAMERA, smooth.face_id_map, smooth.depth_m, turned)
    inside = darkness(shade(smooth, colors)[3, 1])
    faint, strong = darkness(shade(smooth, colors)[3, 2]), darkness(shade(sharp, colors)[3, 2])
    assert inside < faint < strong


def test_a_step_within_one_face_is_inked() -> None:
    flat = picture_of([[0] * 6] * 6)
    depth = flat.depth_m.copy()
    depth[:, 3:] += 2.0
    stepped = IdImage(CAMERA, flat.face_id_map, depth, flat.normals)
    assert darkness(shade(stepped, GREY)[3, 2]) > 150
    assert darkness(shade(flat, GREY)[3, 2]) < 100


def test_a_hidden_face_shines_through_but_not_through_its_own_colour() -> None:
    colors = np.array([[200, 200, 200], [0, 0, 250]], dtype=np.uint8)
    front, hidden = picture_of([[0] * 6] * 6), picture_of([[1] * 6] * 6, depth=2.0)
    plain, ghostly = shade(front, colors), shade(front, colors, hidden)
    assert int(ghostly[3, 3, 2]) - int(ghostly[3, 3, 0]) > 40
    assert plain[3, 3, 0] == plain[3, 3, 2]
    assert (shade(hidden, colors, hidden) == shade(hidden, colors)).all()


def test_shading_in_bands_leaves_no_seams() -> None:
    height = 2 * BAND + 10
    tall = picture_of([[0, 0, 0, 0]] * height)
    result = shade(tall, GREY)
    assert (result == result[0, 0]).all()
    ids = tall.face_id_map.copy()
    ids[BAND:] = -1
    depth = np.where(ids >= 0, tall.depth_m, np.inf).astype(np.float32)
    cut = shade(IdImage(CAMERA, ids, depth, tall.normals), GREY)
    assert np.abs(cut[BAND - 1, 0].astype(int) - INK).max() < 30
    assert np.abs(cut[BAND, 0].astype(int) - INK).max() < 30


def test_an_image_without_normals_is_refused() -> None:
    image = picture_of([[0]])
    with pytest.raises(ValueError, match="normals"):
        shade(IdImage(CAMERA, image.face_id_map, image.depth_m, None), GREY)
