"""OpenGL draws what rays show: the same faces, depths and normals, but for rounding on silhouettes."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.segworker.meshes import box, box_faces, empty, joined, quads, scaled, sphere, tunnel
from tests.segworker.shapes import cut, cylinder, find, plate

from querycad_contracts import Side
from querycad_segworker.mesh import Mesh
from querycad_segworker.visibility.cameras import CORNERS, Camera, corner_camera, isometric_camera, side_camera
from querycad_segworker.visibility.gl import ALIKE, GlScene, GlUnavailable
from querycad_segworker.visibility.raycast import BACKGROUND, FaceIds, Scene
from querycad_segworker.visibility.renderer import make_renderer

SIZE = (640, 360)


@pytest.fixture(autouse=True)
def _needs_egl() -> None:
    try:
        GlScene(box())
    except GlUnavailable as reason:
        pytest.skip(f"{reason} (libegl1 and libgl1-mesa-dri of the system)")


def drilled() -> Mesh:
    """Many small faces, and holes seen into at one degree."""
    holes = [cylinder(1.5 + 0.3 * i, 30, (8 * i - 24, 6 * (i % 2) - 3, -25)) for i in range(7)]
    return find(cut(plate(), *holes)).mesh


def cameras(mesh: Mesh) -> list[Camera]:
    sides = [side_camera(side, mesh.bounds, *SIZE) for side in Side]
    return sides + [corner_camera(corner, mesh.bounds, *SIZE, elevation_deg=45.0) for corner in CORNERS]


def near_borders(*id_maps: FaceIds) -> NDArray[np.bool_]:
    """Pixels with a neighbour of another face, in any of the images."""
    near = np.zeros(id_maps[0].shape, dtype=np.bool_)
    for ids in id_maps:
        down, across = ids[1:] != ids[:-1], ids[:, 1:] != ids[:, :-1]
        near[1:] |= down
        near[:-1] |= down
        near[:, 1:] |= across
        near[:, :-1] |= across
    return near


@pytest.mark.parametrize("make", [tunnel, drilled, lambda: joined(sphere(), scaled(tunnel(), 0.4, (0.9, 0.2, 0.5)))])
def test_pixels_differ_on_silhouettes_only(make: object) -> None:
    assert callable(make)
    mesh = make()
    drawn, cast = GlScene(mesh), Scene(mesh, threads=1)
    for camera in cameras(mesh):
        one, other = drawn.render_ids(camera), cast.render_ids(camera)
        same = one.face_id_map == other.face_id_map
        assert same.mean() >= ALIKE
        assert same[~near_borders(one.face_id_map, other.face_id_map)].all()


def test_the_fronts_of_a_closed_model_are_the_whole_picture() -> None:
    mesh = drilled()
    assert mesh.closed
    fronts, both = GlScene(mesh), GlScene(replace(mesh, closed=False))
    for camera in cameras(mesh):
        one, other = fronts.render_ids(camera), both.render_ids(camera)
        assert (one.face_id_map == other.face_id_map).all()
        assert (one.depth_m == other.depth_m).all()


def test_the_inside_of_an_open_model_is_drawn() -> None:
    mesh = box().of_faces(np.array([0, 1, 2]))
    shown = set[int]()
    for camera in cameras(mesh):
        shown |= set(np.unique(GlScene(mesh).render_ids(camera).face_id_map)) - {BACKGROUND}
        assert (GlScene(mesh).render_ids(camera).face_id_map >= 0).any()
    assert shown == {0, 1, 2}


def test_depths_and_normals_are_those_of_rays() -> None:
    mesh = sphere()
    camera = isometric_camera(mesh.bounds, *SIZE)
    one, other = (scene.render_ids(camera, normals=True) for scene in (GlScene(mesh), Scene(mesh, threads=1)))
    shown = (one.face_id_map == 0) & (other.face_id_map == 0)
    assert np.abs(one.depth_m[shown] - other.depth_m[shown]).max() < 1e-3 * camera.range_m
    assert one.normals is not None
    assert other.normals is not None
    assert np.abs(one.normals[shown] - other.normals[shown]).max() < 2e-3
    assert np.isinf(one.depth_m[one.face_id_map == BACKGROUND]).all()


@pytest.mark.parametrize("size_m", [1e-4, 1.0, 1e4])
def test_a_screw_and_a_bridge_render_alike(size_m: float) -> None:
    mesh = scaled(tunnel(), size_m, (37 * size_m, -5 * size_m, 0))
    reference = tunnel()
    pixels = GlScene(mesh).render_ids(isometric_camera(mesh.bounds, *SIZE)).face_id_map
    wanted = GlScene(reference).render_ids(isometric_camera(reference.bounds, *SIZE)).face_id_map
    assert (pixels == wanted).mean() >= ALIKE


def test_faces_that_share_vertices_are_told_apart() -> None:
    apart = quads(*box_faces((0, 0, 0), (1, 1, 1)))
    points, index = np.unique(apart.vertices_m, axis=0, return_inverse=True)
    shared = Mesh(points, index.reshape(-1).astype(np.int32)[apart.triangles], apart.triangle_face)
    assert len(shared.vertices_m) == 8
    camera = isometric_camera(apart.bounds, *SIZE)
    assert (GlScene(shared).render_ids(camera).face_id_map == GlScene(apart).render_ids(camera).face_id_map).all()


def test_views_of_different_sizes_follow_one_another() -> None:
    mesh = tunnel()
    scene = GlScene(mesh)
    for size in ((64, 64), (320, 180), (64, 64)):
        image = scene.render_ids(isometric_camera(mesh.bounds, *size), normals=size[0] > 100)
        assert image.face_id_map.shape == (size[1], size[0])
        assert set(np.unique(image.face_id_map)) >= {BACKGROUND, 0}


def test_no_triangles_are_background() -> None:
    image = GlScene(empty()).render_ids(isometric_camera([(0, 0, 0), (1, 1, 1)], 32, 32), normals=True)
    assert (image.face_id_map == BACKGROUND).all()


FORKING = """
import os
import numpy as np
from querycad_segworker.mesh import Mesh
from querycad_segworker.visibility.cameras import isometric_camera
from querycad_segworker.visibility.gl import GlScene, GlUnavailable
mesh = Mesh(np.eye(3), np.array([[0, 1, 2]], dtype=np.int32), np.zeros(1, dtype=np.int32))
camera = isometric_camera(mesh.bounds, 64, 64)

def in_child(work):
    child = os.fork()
    if not child:
        os._exit(work())
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])

def draws():
    return 0 if (GlScene(mesh).render_ids(camera).face_id_map == 0).any() else 1

def refuses():
    try:
        GlScene(mesh)
    except GlUnavailable:
        return 0
    return 1

assert in_child(draws) == 0 and in_child(draws) == 0, "workers forked before the first scene draw, each on its own"
assert draws() == 0
assert in_child(refuses) == 0, "a worker forked after it does without, and does not hang"
assert draws() == 0
"""


def test_every_worker_has_a_context_of_its_own_made_after_the_fork() -> None:
    subprocess.run([sys.executable, "-c", FORKING], check=True, timeout=60)


def test_without_egl_rays_draw() -> None:
    script = (
        "import numpy as np\n"
        "from querycad_segworker.mesh import Mesh\n"
        "from querycad_segworker.visibility.renderer import make_renderer\n"
        "mesh = Mesh(np.eye(3), np.array([[0, 1, 2]], dtype=np.int32), np.zeros(1, dtype=np.int32))\n"
        "print(type(make_renderer(mesh)).__name__)\n"
    )
    no_drivers = {**os.environ, "__EGL_VENDOR_LIBRARY_DIRS": "/nowhere", "__EGL_VENDOR_LIBRARY_FILENAMES": "/nowhere"}
    done = subprocess.run(
        [sys.executable, "-c", script], check=True, capture_output=True, text=True, env=no_drivers, timeout=60
    )
    assert done.stdout.strip() == "Scene"
    assert isinstance(make_renderer(box()), GlScene)
