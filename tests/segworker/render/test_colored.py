"""Colours by which networks tell faces apart."""

from __future__ import annotations

import numpy as np
import pytest
from tests.segworker.meshes import box, tunnel

from querycad_contracts import Side
from querycad_segworker.render.colored import face_colors, paint
from querycad_segworker.visibility.cameras import isometric_camera, side_camera
from querycad_segworker.visibility.raycast import Scene


@pytest.mark.parametrize("count", [1, 7, 8, 60, 343, 2000])
def test_any_two_faces_differ_by_a_step_of_the_grid(count: int) -> None:
    colors = np.vstack([face_colors(count), [(255, 255, 255)]]).astype(np.int64)
    levels = max(2, int(np.ceil((count + 1) ** (1 / 3) - 1e-9)))
    closest = min(int(np.abs(colors[i + 1 :] - colors[i]).max(axis=1).min()) for i in range(count))
    assert closest >= 255 / (levels - 1) - 1


def test_colours_are_the_same_for_a_seed_and_others_for_another() -> None:
    assert (face_colors(50, seed=3) == face_colors(50, seed=3)).all()
    assert (face_colors(50, seed=3) != face_colors(50, seed=4)).any()


def test_every_visible_face_has_exactly_its_colour_on_white() -> None:
    mesh = tunnel()
    image = Scene(mesh).render_ids(side_camera(Side.TOP, mesh.bounds, 320, 180))
    colors = face_colors(10)
    picture = paint(image, colors)
    assert (picture[image.face_id_map < 0] == 255).all()
    for face in set(np.unique(image.face_id_map)) - {-1}:
        assert (picture[image.face_id_map == face] == colors[face]).all()


def test_light_makes_the_sides_of_a_box_differ_though_their_colour_is_one() -> None:
    mesh = box()
    image = Scene(mesh).render_ids(isometric_camera(mesh.bounds, 320, 180), normals=True)
    picture = paint(image, np.full((6, 3), 200, dtype=np.uint8))
    shades = {
        tuple(np.median(picture[image.face_id_map == face], axis=0))
        for face in set(np.unique(image.face_id_map)) - {-1}
    }
    assert len(shades) == 3
