"""Ray casting: every pixel shows the face that geometry says, at the depth that geometry says, at any scale."""

from __future__ import annotations

import numpy as np
import pytest
from tests.segworker.meshes import (
    BACK,
    FRONT,
    LEFT,
    RIGHT,
    TOP,
    box,
    empty,
    joined,
    quads,
    scaled,
    sphere,
    tunnel,
)

from querycad_contracts import Side
from querycad_segworker.mesh import Mesh
from querycad_segworker.visibility.cameras import (
    CORNERS,
    corner_camera,
    isometric_camera,
    side_camera,
    side_cameras,
)
from querycad_segworker.visibility.raycast import Scene, render_ids

ONE_DEGREE = np.radians(1.0)


@pytest.mark.parametrize(("row", "side"), list(enumerate(Side)))
def test_a_box_shows_each_side_one_full_face_and_one_sliver(row: int, side: Side) -> None:
    mesh = box()
    camera = side_camera(side, mesh.bounds, 800, 600)
    counts = np.bincount(render_ids(mesh, camera).face_id_map.ravel() + 1, minlength=7)[1:]
    edge = 1 / camera.pixel_m
    assert counts[row] == pytest.approx(edge * edge * np.cos(ONE_DEGREE), rel=0.005)
    assert (counts > 0).sum() == 2
    sliver = counts[np.arange(6) != row].max()
    assert sliver == pytest.approx(edge * edge * np.sin(ONE_DEGREE), rel=0.1)


def test_the_sliver_is_on_the_side_that_the_camera_is_turned_to() -> None:
    neighbour = {
        Side.TOP: RIGHT,
        Side.BOTTOM: RIGHT,
        Side.FRONT: RIGHT,
        Side.RIGHT: BACK,
        Side.BACK: LEFT,
        Side.LEFT: FRONT,
    }
    mesh = box()
    for row, camera in enumerate(side_cameras(mesh.bounds, 400, 300)):
        seen = set(np.unique(render_ids(mesh, camera).face_id_map)) - {-1}
        assert seen == {row, neighbour[Side(camera.name)]}


def squares(depths: tuple[float, ...]) -> Mesh:
    """Squares of width 1 facing front, side by side in x, at these y."""
    return quads(
        *[[[(2 * i, y, 0), (2 * i + 1, y, 0), (2 * i + 1, y, 1), (2 * i, y, 1)]] for i, y in enumerate(depths)]
    )


def test_the_id_map_and_depth_are_those_of_projected_squares() -> None:
    mesh = squares((0.0, 0.7, -0.4))
    camera = side_camera(Side.FRONT, mesh.bounds, 640, 480)
    image = render_ids(mesh, camera)
    rows, columns = np.mgrid[0:480, 0:640] + 0.5
    expected = np.full((480, 640), -1)
    certain = np.ones((480, 640), dtype=bool)
    for face in range(3):
        spots = camera.to_pixels(mesh.vertices_m[4 * face : 4 * face + 4])
        (left, top), (right, bottom) = spots[:, :2].min(axis=0), spots[:, :2].max(axis=0)
        inside = np.minimum(np.minimum(columns - left, right - columns), np.minimum(rows - top, bottom - rows))
        expected[inside > 0] = face
        certain &= np.abs(inside) > 1e-3  # a pixel's centre on the very edge may go either way
    assert (image.face_id_map == expected)[certain].all()
    assert certain.mean() > 0.99
    hit = image.face_id_map >= 0
    spots = np.stack([columns[hit], rows[hit], image.depth_m[hit]], axis=1)
    y = camera.to_world(spots)[:, 1]
    assert np.allclose(y, np.array([0.0, 0.7, -0.4])[image.face_id_map[hit]], atol=1e-5)
    assert np.isinf(image.depth_m[~hit]).all()


def test_what_is_nearer_hides_what_is_behind_it() -> None:
    near, far = box((-1, -1, 0), (1, 1, 1)), box((-3, -3, -5), (3, 3, -4))
    mesh = joined(far, near)
    image = render_ids(mesh, side_camera(Side.TOP, mesh.bounds, 300, 300))
    assert image.face_id_map[150, 150] == 6 + TOP
    assert image.face_id_map[30, 30] == TOP
    assert image.depth_m[30, 30] - image.depth_m[150, 150] == pytest.approx(5, abs=0.1)
    below = render_ids(mesh, side_camera(Side.BOTTOM, mesh.bounds, 300, 300))
    assert not (below.face_id_map >= 6).any()


@pytest.mark.parametrize("factor", [1e-6, 1e-3, 1e3, 1e5])
def test_scale_changes_nothing_but_the_depth(factor: float) -> None:
    small, large = tunnel(), scaled(tunnel(), factor)
    here = render_ids(small, isometric_camera(small.bounds, 200, 160), normals=True)
    there = render_ids(large, isometric_camera(large.bounds, 200, 160), normals=True)
    assert (here.face_id_map == there.face_id_map).mean() > 0.9995  # rounding on edges
    same = (here.face_id_map == there.face_id_map) & (here.face_id_map >= 0)
    assert np.allclose(there.depth_m[same], here.depth_m[same] * factor, rtol=1e-4)
    assert here.normals is not None
    assert there.normals is not None
    assert np.allclose(here.normals[same], there.normals[same], atol=1e-4)


def test_a_model_far_from_the_origin_is_as_sharp_as_one_at_it() -> None:
    near = tunnel()
    far = scaled(near, 1.0, (5e4, -3e4, 1e4))
    here = render_ids(near, isometric_camera(near.bounds, 200, 160)).face_id_map
    there = render_ids(far, isometric_camera(far.bounds, 200, 160)).face_id_map
    assert (here == there).mean() > 0.9995


@pytest.mark.parametrize("corner", CORNERS)
def test_a_closed_surface_has_no_cracks(corner: tuple[int, int, int]) -> None:
    mesh = sphere()
    camera = corner_camera(corner, mesh.bounds, 300, 300)
    shown = render_ids(mesh, camera).face_id_map >= 0
    radius = 1 / camera.pixel_m
    rows, columns = np.mgrid[0:300, 0:300] + 0.5
    from_center = np.hypot(rows - 150, columns - 150)
    assert shown[from_center < 0.99 * radius].all()
    assert not shown[from_center > radius].any()


def test_normals_of_a_tessellated_ball_are_smooth_and_face_the_viewer() -> None:
    mesh = sphere()
    camera = isometric_camera(mesh.bounds, 200, 200)
    image = render_ids(mesh, camera, normals=True)
    assert image.normals is not None
    hit = image.face_id_map >= 0
    rows, columns = np.nonzero(hit)
    points = camera.to_world(np.stack([columns + 0.5, rows + 0.5, image.depth_m[hit]], axis=1))
    radial = points / np.linalg.norm(points, axis=1, keepdims=True)
    cosine = (image.normals[hit] * radial).sum(axis=1)
    assert np.degrees(np.arccos(np.clip(np.median(cosine), -1, 1))) < 0.5  # facets themselves are 3.75 degrees apart
    assert (image.normals[hit] @ np.array(camera.backward) > -1e-3).all()
    assert not image.normals[~hit].any()


def test_edges_between_faces_stay_sharp_though_they_share_vertices() -> None:
    shared = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    triangles = np.array([[0, 4, 5], [0, 5, 1], [1, 5, 7], [1, 7, 3]], dtype=np.int32)  # the front and top of a box
    mesh = Mesh(shared, triangles, np.array([0, 0, 1, 1], dtype=np.int32))
    image = render_ids(mesh, isometric_camera(mesh.bounds, 80, 80), normals=True)
    assert image.normals is not None
    assert np.allclose(image.normals[image.face_id_map == 0], (0, -1, 0), atol=1e-6)
    assert np.allclose(image.normals[image.face_id_map == 1], (0, 0, 1), atol=1e-6)


def test_triangles_without_area_and_hair_thin_slivers_change_nothing() -> None:
    mesh = box()
    extra = np.array([[0, 0, 0, 1e-12, 0, 0, 0, 0, 2], [0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 1, 1, 1, 2, 2, 2]]) / 8.0
    spoilt = Mesh(
        np.concatenate([mesh.vertices_m, extra.reshape(-1, 3)]),
        np.concatenate([mesh.triangles, np.arange(9, dtype=np.int32).reshape(3, 3) + np.int32(len(mesh.vertices_m))]),
        np.concatenate([mesh.triangle_face, np.array([6, 7, 8], dtype=np.int32)]),
    )
    camera = isometric_camera(mesh.bounds, 160, 120)
    clean, dirty = render_ids(mesh, camera, normals=True), render_ids(spoilt, camera, normals=True)
    assert (clean.face_id_map == dirty.face_id_map).all()
    assert clean.normals is not None
    assert dirty.normals is not None
    assert np.allclose(clean.normals, dirty.normals, atol=1e-6)


def test_an_empty_mesh_is_all_background() -> None:
    mesh = empty()
    image = render_ids(mesh, isometric_camera(mesh.bounds, 40, 30), normals=True)
    assert (image.face_id_map == -1).all()
    assert np.isinf(image.depth_m).all()
    assert image.normals is not None
    assert not image.normals.any()


def test_a_sheet_without_thickness_is_seen_from_both_sides() -> None:
    sheet = quads([[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]])
    counts = [(render_ids(sheet, camera).face_id_map >= 0).mean() for camera in side_cameras(sheet.bounds, 100, 100)]
    assert min(counts[:2]) > 0.85


def test_tiles_and_threads_do_not_show() -> None:
    mesh = tunnel()
    camera = isometric_camera(mesh.bounds, 700, 500)
    one, many = Scene(mesh, threads=1).render_ids(camera, True), Scene(mesh, threads=4).render_ids(camera, True)
    assert (one.face_id_map == many.face_id_map).all()
    assert (one.depth_m == many.depth_m).all()
    assert one.normals is not None
    assert many.normals is not None
    assert (one.normals == many.normals).all()


def test_a_view_of_a_corner_of_the_model_is_a_cutout_of_the_whole() -> None:
    mesh = tunnel()
    close = corner_camera(CORNERS[0], mesh.bounds, 60, 60, focus_m=[(0.4, -0.6, 0.9), (0.6, -0.4, 1.1)])
    image = render_ids(mesh, close)
    assert (image.face_id_map >= 0).all()
    assert TOP in image.face_id_map
    assert image.face_id_map.shape == image.depth_m.shape == (60, 60)
    assert image.normals is None


def test_one_looks_into_a_tunnel_from_its_two_ends_only() -> None:
    scene = Scene(tunnel())
    seen = scene.sees([(0, 0, 1), (0, 0, -1)], [(0, 0, 1), (0, 0, -1)])
    assert seen[:, 0].tolist() == [side is Side.TOP for side in Side]
    assert seen[:, 1].tolist() == [side is Side.BOTTOM for side in Side]


def test_a_lid_hides_the_opening_under_it() -> None:
    lid = box((-1, -1, 3), (1, 1, 3.1))
    seen = Scene(joined(tunnel(), lid)).sees([(0, 0, 1)], [(0, 0, 1)])
    assert not seen.any()


def test_without_normals_a_point_is_seen_from_wherever_nothing_is_before_it() -> None:
    scene = Scene(box())
    points = [(0, 0, 0), (0, 0, 0.5), (0.5, 0, 0), (0, 0, 9)]
    inside, top, right, outside = scene.sees(points).T
    assert not inside.any()
    assert top.tolist() == [side is Side.TOP for side in Side]
    assert right[list(Side).index(Side.RIGHT)]
    assert outside.tolist() == [side is not Side.BOTTOM for side in Side]


@pytest.mark.parametrize("factor", [1e-3, 1e3])
def test_what_is_seen_does_not_depend_on_scale(factor: float) -> None:
    openings = np.array([(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.7, 0.7, 1.0)])
    normals = [(0, 0, 1), (0, 0, -1), (0, 0, 1)]
    here, there = Scene(tunnel()), Scene(scaled(tunnel(), factor))
    assert (here.sees(openings, normals) == there.sees(openings * factor, normals)).all()


def test_every_point_is_seen_where_there_is_nothing_else() -> None:
    assert Scene(empty()).sees([(1, 2, 3)]).all()
    assert Scene(box()).sees(np.zeros((0, 3))).shape == (6, 0)


def test_points_and_normals_must_be_as_many() -> None:
    with pytest.raises(ValueError, match="2 points but 1 normals"):
        Scene(box()).sees([(0, 0, 0), (1, 1, 1)], [(0, 0, 1)])


@pytest.mark.parametrize("factor", [1e-3, 1.0, 1e3])
def test_reach_is_the_distance_to_the_next_surface(factor: float) -> None:
    scene = Scene(scaled(box(), factor))
    starts = np.array([(0, 0, 0), (0, 0, 0.5), (0, 0, 0.5)]) * factor
    found = scene.reach(starts, [(1, 0, 0), (0, 0, -1), (0, 0, 1)]) / factor
    assert found[:2] == pytest.approx([0.5, 1.0], rel=1e-4)
    assert np.isinf(found[2])


def test_the_way_through_a_tunnel_is_clear_and_through_its_wall_is_not() -> None:
    scene = Scene(tunnel())
    assert scene.is_clear((0, 0, -0.9), (0, 0, 0.9))
    assert scene.is_clear((0.1, 0, 0), (0.1, 0, 0))
    assert not scene.is_clear((0, 0, 0), (0.9, 0, 0))
