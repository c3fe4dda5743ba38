"""Visibility: the pixels of each face from each side, none lost and none twice."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.segworker.meshes import BOTTOM, TOP, box, empty, scaled, tunnel

from querycad_contracts import Side
from querycad_segworker.visibility.cameras import side_cameras
from querycad_segworker.visibility.faces import shows_backs, visible_pixels
from querycad_segworker.visibility.raycast import Scene

ROW = {side: row for row, side in enumerate(Side)}


def test_the_pixels_of_all_faces_add_up_to_the_silhouette() -> None:
    scene = Scene(tunnel())
    found = visible_pixels(scene, 10, 320, 240)
    for row, camera in enumerate(side_cameras(scene.bounds, 320, 240)):
        assert found.pixels[row].sum() == (scene.render_ids(camera).face_id_map >= 0).sum()


def test_each_side_of_a_box_owns_its_view() -> None:
    found = visible_pixels(box(), 6)
    assert found.pixels.argmax(axis=1).tolist() == list(range(6))
    assert (found.pixels > 0).sum() == 12


def test_pixels_times_their_size_are_the_projected_area() -> None:
    mesh = scaled(box(), 0.02)
    found = visible_pixels(mesh, 6)
    areas = found.pixels.diagonal() * found.pixel_m**2
    assert areas == pytest.approx(np.full(6, 0.02**2 * np.cos(np.radians(1.0))), rel=0.005)


def test_tunnel_walls_are_seen_from_its_ends_and_nowhere_else() -> None:
    walls = visible_pixels(tunnel(), 10).pixels[:, 6:]
    seen_from = {side for side in Side if walls[ROW[side]].any()}
    assert seen_from == {Side.TOP, Side.BOTTOM}
    assert walls[[TOP, BOTTOM], 0].all()  # turned to the right, one sees the wall on the left
    assert not walls[:, 1:].any()


@pytest.mark.parametrize("factor", [1e-3, 1e3])
def test_counts_do_not_depend_on_scale(factor: float) -> None:
    here, there = visible_pixels(tunnel(), 10, 320, 180), visible_pixels(scaled(tunnel(), factor), 10, 320, 180)
    assert np.abs(here.pixels - there.pixels).max() <= 2  # rounding on edges
    assert there.pixel_m == pytest.approx(here.pixel_m * factor)


def test_a_face_without_triangles_owns_no_pixels() -> None:
    found = visible_pixels(box(), 9, 64, 64)
    assert found.pixels.shape == (6, 9)
    assert found.pixels.dtype == np.int32
    assert not found.pixels[:, 6:].any()


def test_a_face_that_was_not_announced_is_refused() -> None:
    with pytest.raises(ValueError, match="face 5, but only 5"):
        visible_pixels(box(), 5)


def test_an_empty_model_shows_nothing() -> None:
    assert not visible_pixels(empty(), 3, 32, 32).pixels.any()


def test_a_closed_model_shows_no_backs_and_one_inside_out_or_open_does() -> None:
    mesh = box()
    assert not shows_backs(Scene(mesh))
    assert not shows_backs(Scene(empty()))
    inside_out = replace(mesh, triangles=np.ascontiguousarray(mesh.triangles[:, ::-1]))
    assert shows_backs(Scene(inside_out))
    assert shows_backs(Scene(mesh.of_faces(np.arange(1, 6)))), "from the top, through the missing face"
