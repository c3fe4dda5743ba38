"""Counting by stretches of rows: the same counts as a ray for every pixel, from far fewer rays."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.segworker.meshes import box, empty, joined, quads, sphere, tunnel

from querycad_segworker.mesh import Mesh
from querycad_segworker.visibility.cameras import Camera, isometric_camera, side_cameras
from querycad_segworker.visibility.faces import face_pixels
from querycad_segworker.visibility.raycast import Scene
from querycad_segworker.visibility.scanlines import Edges, seen_pixels


def soup(seed: int, faces: int = 12) -> Mesh:
    """Triangles anywhere that cut through one another."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform(-1, 1, (faces, 3, 3))
    return Mesh(
        corners.reshape(-1, 3),
        np.arange(3 * faces, dtype=np.int32).reshape(-1, 3),
        np.arange(faces, dtype=np.int32),
    )


def turned(mesh: Mesh) -> Mesh:
    """Every second triangle the other way round."""
    triangles = mesh.triangles.copy()
    triangles[::2] = triangles[::2, ::-1]
    return Mesh(mesh.vertices_m, triangles, mesh.triangle_face)


def ridge() -> Mesh:
    """One face folded like a roof, before a wall: seen from the side, the fold hides what is behind it."""
    roof = [
        [(-1, 0, 0), (0, -0.5, 0.4), (0, 0.5, 0.4), (-1, 1, 0)],
        [(0, -0.5, 0.4), (1, 0, 0), (1, 1, 0), (0, 0.5, 0.4)],
    ]
    wall = [[(-2, 2, -1), (2, 2, -1), (2, 2, 1), (-2, 2, 1)]]
    return quads(roof, wall)


def views(mesh: Mesh, width: int = 320, height: int = 180) -> tuple[Camera, ...]:
    bounds = mesh.bounds
    return (*side_cameras(bounds, width, height), isometric_camera(bounds, width, height))


def counts(mesh: Mesh, *size: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """By stretches, and by a ray for each pixel: (views, faces)."""
    scene, edges, faces = Scene(mesh), Edges.of(mesh), int(mesh.triangle_face.max()) + 1
    quick = [seen_pixels(scene, edges, camera, faces) for camera in views(mesh, *size)]
    return np.array(quick), np.array([face_pixels(scene.render_ids(camera), faces) for camera in views(mesh, *size)])


@pytest.mark.parametrize(
    "make",
    [
        box,
        tunnel,
        sphere,
        ridge,
        lambda: turned(sphere()),
        lambda: joined(tunnel(), box((-0.2, -0.2, -3), (0.2, 0.2, 3))),
        lambda: joined(sphere(), sphere(0.5), box((2, -1, -1), (3, 1, 1))),
    ],
    ids=["box", "tunnel", "ball", "ridge", "triangles either way", "bar in a tunnel", "ball in a ball beside a box"],
)
def test_stretches_count_what_a_ray_for_every_pixel_counts(make: Callable[[], Mesh]) -> None:
    quick, slow = counts(make())
    assert (quick == slow).all()


def test_a_ball_that_pokes_out_of_a_plate_is_seen_although_no_edge_announces_it() -> None:
    quick, slow = counts(joined(box((-3, -3, -1), (3, 3, 0.6)), sphere()), 1280, 720)
    assert slow[:, 6].any()
    assert quick[:, 6] == pytest.approx(slow[:, 6], rel=0.05)


@pytest.mark.parametrize("seed", range(4))
def test_of_triangles_that_cut_through_one_another_the_same_are_seen(seed: int) -> None:
    """Where they cut, a stretch may be given to one of the two: pixels along the cut, no more."""
    quick, slow = counts(soup(seed))
    assert (quick.sum(axis=1) == slow.sum(axis=1)).all()
    large = slow > 200
    assert (quick[large] > 0).all()
    assert np.abs(quick - slow).sum() <= 0.05 * slow.sum()


def test_fewer_rays_than_a_tenth_of_the_pixels_are_cast(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = Scene(tunnel())
    camera = side_cameras(scene.bounds, 1280, 720)[0]
    cast = []
    faces_at = scene.faces_at

    def counted(camera: Camera, rows: NDArray[np.int64], columns: NDArray[np.int64]) -> NDArray[np.int32]:
        cast.append(len(rows))
        return faces_at(camera, rows, columns)

    monkeypatch.setattr(scene, "faces_at", counted)
    seen = seen_pixels(scene, Edges.of(scene.mesh), camera, 10)
    assert sum(cast) < seen.sum() / 10


def test_an_inner_edge_is_drawn_only_where_its_face_folds() -> None:
    mesh = sphere(rings=8)
    edges = Edges.of(mesh)
    side, top = mesh.vertices_m[:, [0, 2]], mesh.vertices_m[:, :2]
    drawn = edges.seen(side)[len(edges.borders) :]
    assert np.abs(mesh.vertices_m[drawn][..., 1]).max() < 0.5  # near the ball's outline as seen along y
    assert len(drawn) < len(edges.inner) / 3
    assert {tuple(edge) for edge in edges.seen(top)} != {tuple(edge) for edge in edges.seen(side)}


def test_nothing_is_seen_of_an_empty_model() -> None:
    mesh = empty()
    assert not seen_pixels(Scene(mesh), Edges.of(mesh), views(mesh)[0], 3).any()
